#include "removal/part_joining.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/angle.h"
#include "removal/vector_support.h"

namespace eyrie {
namespace {

/// Lengths in px.
struct Limits {
    double car_length;
    double part_length;
    double vehicle_length;
    double width;
};

/// The union of two parts, or an empty box when they are not parts of one vehicle.
OrientedBox unionOfParts(const Detection& a, const Detection& b, const PartJoiningOptions& options,
                         const Limits& limits) {
    if (!similarVelocity(a.velocity, b.velocity, options.velocity_floor_px, options.velocity_share)) return {};
    if (std::abs(turnBetween(a.box.heading, b.box.heading)) > radiansFromDegrees(options.max_turn_deg)) return {};
    const bool a_leads = a.box.area() >= b.box.area();
    const OrientedBox both = unionBox(a_leads ? a.box : b.box, a_leads ? b.box : a.box);
    const double widest = std::max(a.box.width, b.box.width);
    if (both.width > std::max(limits.width, widest)) return {};
    // Parts lie one behind the other: beside each other they are two vehicles, or one and its shadow.
    if (both.width > 1.5 * widest + 1) return {};
    const bool parts = std::max(a.box.length, b.box.length) <= limits.part_length;
    if (both.length > (parts ? limits.vehicle_length : limits.car_length)) return {};
    return both;
}

}  // namespace

void PartJoiningOptions::describe(ParameterVisitor& visitor) {
    visitor.flag("duplicates.join_parts", enabled,
                 {"",
                  "Join detections that move alike one behind the other and fit into one vehicle: front and rear of a "
                  "plain roof.",
                  ""});
    visitor.real("duplicates.part_car_length", car_length_m, 0, 100,
                 {"m", "Parts are joined when together they are no longer than this.", ""});
    visitor.real("duplicates.part_length", part_length_m, 0, 100,
                 {"m", "Two parts both shorter than this are joined up to the length of a long vehicle.", ""});
    visitor.real("duplicates.part_vehicle_length", vehicle_length_m, 0, 100,
                 {"m", "Longest vehicle that two short parts may make up.", ""});
    visitor.real("duplicates.part_vehicle_width", vehicle_width_m, 0, 100,
                 {"m", "Parts are not joined into anything wider than this.", ""});
    visitor.real("duplicates.part_velocity_floor", velocity_floor_px, 0, 10,
                 {"px/frame", "Velocities of parts may always differ by this.", ""});
    visitor.real("duplicates.part_velocity_share", velocity_share, 0, 1,
                 {"", "Velocities of parts may differ by this share of the speed.", ""});
    visitor.real("duplicates.part_max_turn", max_turn_deg, 0, 180,
                 {"°", "Largest difference of the parts' headings.", ""});
}

std::vector<Detection> joinParts(std::vector<Detection> detections, const PartJoiningOptions& options,
                                 const SceneScale& scale, RemovalTrace* trace) {
    if (!options.enabled) return detections;
    const Limits limits{scale.px(options.car_length_m), scale.px(options.part_length_m),
                        scale.px(options.vehicle_length_m), std::max(4.0, scale.px(options.vehicle_width_m))};
    for (;;) {
        double closest = std::numeric_limits<double>::max();
        Detection* first = nullptr;
        Detection* second = nullptr;
        OrientedBox box;
        for (std::size_t i = 0; i < detections.size(); ++i) {
            Detection& a = detections[i];
            if (a.rejection != Rejection::none) continue;
            for (std::size_t k = i + 1; k < detections.size(); ++k) {
                Detection& b = detections[k];
                if (b.rejection != Rejection::none || a.complete || b.complete) continue;
                const cv::Point2d apart = a.box.centre - b.box.centre;
                const double distance = std::hypot(apart.x, apart.y);
                if (distance >= closest || distance > std::max(limits.vehicle_length, limits.car_length)) continue;
                const OrientedBox both = unionOfParts(a, b, options, limits);
                if (both.area() <= 0) continue;
                closest = distance;
                first = &a;
                second = &b;
                box = both;
            }
        }
        if (first == nullptr) return detections;
        if (trace != nullptr) {
            const bool parts = std::max(first->box.length, second->box.length) <= limits.part_length;
            trace->duplicates.push_back({static_cast<int>(second - detections.data()),
                                         static_cast<int>(first - detections.data()), box.length,
                                         parts ? limits.vehicle_length : limits.car_length,
                                         parts ? "duplicates.part_vehicle_length" : "duplicates.part_car_length"});
        }
        const double area = first->box.area() + second->box.area();
        if (area > 0) {
            first->velocity = (first->velocity * first->box.area() + second->velocity * second->box.area()) / area;
        }
        first->box = box;
        first->score = std::max(first->score, second->score);
        second->rejection = Rejection::duplicate;
    }
}

}  // namespace eyrie
