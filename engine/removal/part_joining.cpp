#include "removal/part_joining.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "core/geometry/angle.h"
#include "core/values/inferred_ids.h"
#include "removal/best_pairs.h"
#include "removal/vector_support.h"

namespace eyrie {
namespace {

constexpr double kOutlineMargin = 1;  ///< px: vectors lie on outlines
constexpr double kVectorFloor = 0.1;  ///< px/frame by which vectors of one vehicle may differ …
constexpr double kVectorShare = 0.2;  ///< … or this share of the speed
constexpr double kSmallestGap = 3;    ///< px: vectors of an outline are about 2 px apart

/// Lengths in px.
struct Limits {
    double car_length;
    double part_length;
    double vehicle_length;
    double width;
    double silhouette_length;
    double silhouette_gap;  ///< 0: silhouettes are not looked at

    static Limits of(const PartJoiningOptions& options, const SceneScale& scale) {
        const double gap = scale.px(options.part_silhouette_gap_m);
        return {scale.px(options.part_car_length_m),        scale.px(options.part_length_m),
                scale.px(options.part_vehicle_length_m),    std::max(4.0, scale.px(options.part_vehicle_width_m)),
                scale.px(options.part_silhouette_length_m), gap > 0 ? std::max(kSmallestGap, gap) : 0};
    }
    double farthest() const { return std::max({vehicle_length, car_length, silhouette_length}); }
};

/// Whether the silhouette of one vehicle reaches from the middle of the one to the middle of the other: vectors that
/// move like them, some of them on its outline, without a larger gap.
bool onOneSilhouette(const Detection& a, const Detection& b, const FrameMotion& motion, double largest_gap) {
    const cv::Point2d way = b.box.centre - a.box.centre;
    const double length = std::hypot(way.x, way.y);
    if (!(length >= 1)) return false;
    const cv::Point2d along = way / length;
    const double half_width = std::min(a.box.width, b.box.width) / 2 + kOutlineMargin;
    std::vector<double> places{0, length};
    bool on_outline = false;
    for (const MotionVector& vector : motion.motion_vectors) {
        const cv::Point2d from = cv::Point2d(vector.position) - a.box.centre;
        const double place = from.dot(along);
        if (place < 0 || place > length || std::abs(from.cross(along)) > half_width) continue;
        if (!similarVelocity(vector.velocity, a.velocity, kVectorFloor, kVectorShare)) continue;
        on_outline = on_outline || isOfSilhouette(vector);
        places.push_back(place);
    }
    if (!on_outline) return false;
    std::sort(places.begin(), places.end());
    return std::adjacent_find(places.begin(), places.end(), [&](double p, double q) { return q - p > largest_gap; }) ==
           places.end();
}

/// The union of two parts, and which parameter allowed its length (px) up to what limit.
struct Joined {
    OrientedBox box;
    double limit = 0;
    const char* parameter = "";
};

/// Nothing when they are not parts of one vehicle.
std::optional<Joined> unionOfParts(const Detection& a, const Detection& b, const FrameMotion& motion,
                                   const PartJoiningOptions& options, const Limits& limits) {
    if (!similarVelocity(a.velocity, b.velocity, options.part_velocity_floor, options.part_velocity_share)) return {};
    if (std::abs(turnBetween(a.box.heading, b.box.heading)) > radiansFromDegrees(options.part_max_turn_deg)) return {};
    const bool a_leads = a.box.area() >= b.box.area();
    const OrientedBox both = unionBox(a_leads ? a.box : b.box, a_leads ? b.box : a.box);
    const double widest = std::max(a.box.width, b.box.width);
    if (both.area() <= 0 || both.width > std::max(limits.width, widest)) return {};
    // Parts lie one behind the other: beside each other they are two vehicles, or one and its shadow.
    if (both.width > 1.5 * widest + 1) return {};
    if (limits.silhouette_gap > 0 && both.length <= limits.silhouette_length &&
        onOneSilhouette(a, b, motion, limits.silhouette_gap)) {
        return Joined{both, limits.silhouette_length, "duplicates.part_silhouette_length"};
    }
    if (a.complete || b.complete) return {};
    const bool parts = std::max(a.box.length, b.box.length) <= limits.part_length;
    const double longest = parts ? limits.vehicle_length : limits.car_length;
    if (both.length > longest) return {};
    return Joined{both, longest, parts ? "duplicates.part_vehicle_length" : "duplicates.part_car_length"};
}

}  // namespace

void PartJoiningOptions::describe(ParameterVisitor& visitor) {
    const ParameterDeclarer declare(visitor, ChainStage::removal);
    declare.flag("duplicates.join_parts", join_parts,
                 {"",
                  "Join detections that move alike one behind the other and fit into one vehicle: front and rear of a "
                  "plain roof.",
                  ""});
    declare.real("duplicates.part_car_length", part_car_length_m, 0, 100,
                 {"m", "Parts are joined when together they are no longer than this.", ""});
    declare.real("duplicates.part_length", part_length_m, 0, 100,
                 {"m", "Two parts both shorter than this are joined up to the length of a long vehicle.", ""});
    declare.real("duplicates.part_vehicle_length", part_vehicle_length_m, 0, 100,
                 {"m", "Longest vehicle that two short parts may make up.", ""});
    declare.real("duplicates.part_vehicle_width", part_vehicle_width_m, 0, 100,
                 {"m", "Parts are not joined into anything wider than this.", ""});
    declare.real(
        "duplicates.part_silhouette_gap", part_silhouette_gap_m, 0, 100,
        {"m",
         "Detections are joined, complete ones too, where the silhouette of one vehicle reaches from one to the "
         "other without a larger gap. 0: never.",
         ""});
    declare.real("duplicates.part_silhouette_length", part_silhouette_length_m, 0, 100,
                 {"m", "Longest vehicle that parts on one silhouette may make up.", ""});
    declare.real("duplicates.part_velocity_floor", part_velocity_floor, 0, 10,
                 {"px/frame", "Velocities of parts may always differ by this.", ""});
    declare.real("duplicates.part_velocity_share", part_velocity_share, 0, 1,
                 {"", "Velocities of parts may differ by this share of the speed.", ""});
    declare.real("duplicates.part_max_turn", part_max_turn_deg, 0, 180,
                 {"°", "Largest difference of the parts' headings.", ""});
}

std::vector<Detection> joinParts(std::vector<Detection> detections, const FrameMotion& motion,
                                 const PartJoiningOptions& options, const SceneScale& scale, RemovalTrace* trace) {
    if (!options.join_parts) return detections;
    const Limits everywhere = Limits::of(options, scale.at(scale.slope.centre()));
    const auto limitsFor = [&](const Detection& a, const Detection& b) {
        return scale.slope.isFlat() ? everywhere : Limits::of(options, scale.at((a.box.centre + b.box.centre) / 2));
    };
    const auto worth = [&](std::size_t i, std::size_t k) -> std::optional<double> {
        const Detection& a = detections[i];
        const Detection& b = detections[k];
        if (a.rejection != Rejection::none || b.rejection != Rejection::none) return {};
        const cv::Point2d apart = a.box.centre - b.box.centre;
        const double distance = std::sqrt(apart.dot(apart));
        const Limits limits = limitsFor(a, b);
        if (!(distance < limits.farthest()) || !unionOfParts(a, b, motion, options, limits)) return {};
        return -distance;
    };
    BestPairs pairs(detections.size(), worth);
    while (const auto best = pairs.best()) {
        Detection* first = &detections[best->first];
        Detection* second = &detections[best->second];
        const Limits limits = limitsFor(*first, *second);
        const auto joined = unionOfParts(*first, *second, motion, options, limits);
        if (trace != nullptr) {
            trace->duplicates.push_back({static_cast<int>(second - detections.data()),
                                         static_cast<int>(first - detections.data()), joined->box.length, joined->limit,
                                         joined->parameter});
        }
        const double area = first->box.area() + second->box.area();
        if (area > 0) {
            first->velocity = (first->velocity * first->box.area() + second->velocity * second->box.area()) / area;
        }
        first->box = joined->box;
        first->score = std::max(first->score, second->score);
        first->complete = first->complete && second->complete;
        second->rejection = Rejection::duplicate;
        pairs.changed(best->first, worth);
        pairs.changed(best->second, worth);
    }
    return detections;
}

}  // namespace eyrie
