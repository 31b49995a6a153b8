#include "removal/duplicate_removal.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "core/geometry/angle.h"
#include "removal/best_pairs.h"
#include "removal/vector_support.h"

namespace eyrie {
namespace {

/// Whether two boxes lie so far apart that they cannot touch.
bool farApart(const OrientedBox& a, const OrientedBox& b) {
    const cv::Point2d apart = a.centre - b.centre;
    const double reach = (a.length + a.width + b.length + b.width) / 2;
    return apart.dot(apart) > reach * reach;
}

double strengthOf(const Detection& a, const Detection& b, const DuplicateRemovalOptions& options) {
    if (farApart(a.box, b.box)) return 0;
    if (std::abs(turnBetween(a.box.heading, b.box.heading)) > radiansFromDegrees(options.max_turn_deg)) return 0;
    if (options.compare_speed &&
        !similarVelocity(a.velocity, b.velocity, options.velocity_floor, options.velocity_share))
        return 0;
    return options.measure == DuplicateMeasure::containment ? containment(a.box, b.box) : overlap(a.box, b.box);
}

/// Fuses b into a, or gives up b where the union would grow beyond the limit. `b` is the smaller one.
void fuse(Detection& a, Detection& b, const FrameMotion& motion, const DuplicateRemovalOptions& options) {
    const OrientedBox both = unionBox(a.box, b.box);
    const bool fits = options.growth_limit <= 0 || both.area() <= options.growth_limit * a.box.area();
    b.rejection = Rejection::duplicate;
    if (!fits) return;
    a.box = both;
    a.score = std::max(a.score, b.score);
    SupportRule rule;
    rule.compare_velocity = options.compare_speed;
    measureSupport(a, motion, rule);
}

/// Non-maximum suppression: from the highest score down, each box gives up those that overlap it. Boxes of a
/// classifier and segments do not judge each other.
void suppress(std::vector<Detection>& detections, const DuplicateRemovalOptions& options, RemovalTrace* trace) {
    std::vector<std::size_t> order;
    for (std::size_t i = 0; i < detections.size(); ++i) {
        const Detection& detection = detections[i];
        const bool takes_part = detection.complete || options.strategy == DuplicateStrategy::suppress;
        if (detection.rejection == Rejection::none && takes_part) order.push_back(i);
    }
    std::stable_sort(order.begin(), order.end(),
                     [&](std::size_t a, std::size_t b) { return detections[a].score > detections[b].score; });
    for (std::size_t a = 0; a < order.size(); ++a) {
        const Detection& surer = detections[order[a]];
        if (surer.rejection != Rejection::none) continue;
        for (std::size_t b = a + 1; b < order.size(); ++b) {
            Detection& weaker = detections[order[b]];
            if (weaker.rejection != Rejection::none || weaker.complete != surer.complete) continue;
            const double strength = strengthOf(surer, weaker, options);
            if (strength < options.threshold) continue;
            weaker.rejection = Rejection::duplicate;
            if (trace != nullptr) {
                trace->duplicates.push_back({static_cast<int>(order[b]), static_cast<int>(order[a]), strength,
                                             options.threshold, "duplicates.threshold"});
            }
        }
    }
}

}  // namespace

DuplicateRemovalOptions DuplicateRemovalOptions::thesis() {
    DuplicateRemovalOptions options;
    options.measure = DuplicateMeasure::overlap;
    options.threshold = 0.2;
    options.compare_speed = false;
    options.growth_limit = 0;
    options.parts.join_parts = false;
    return options;
}

void DuplicateRemovalOptions::describe(ParameterVisitor& visitor) {
    const ParameterDeclarer declare(visitor, ChainStage::removal);
    declare.choice(
        "duplicates.strategy", strategy, {"fuse", "suppress", "by_detector"},
        {"",
         "Duplicates are fused into their union, or the one with the higher score stays; by_detector: fused for "
         "segmentations, suppressed for the sliding window.",
         "Teutsch §5.5.1"});
    declare.choice(
        "duplicates.measure", measure, {"containment", "overlap"},
        {"",
         "How the overlap of two boxes is measured: share of the smaller one inside the other, or intersection over "
         "union.",
         "Teutsch §5.5.1"});
    declare.real(
        "duplicates.threshold", threshold, 0.001, 1,
        {"", "Boxes that overlap at least this much are duplicates. Smaller: neighbours merge.", "Teutsch §5.5.1"});
    declare.real("duplicates.max_turn", max_turn_deg, 0, 180,
                 {"°", "Largest difference of the headings of duplicates.", "Teutsch §5.5.1"});
    declare.flag("duplicates.compare_speed", compare_speed,
                 {"", "Only detections that move alike are duplicates.", ""});
    declare.real("duplicates.velocity_floor", velocity_floor, 0, 10,
                 {"px/frame", "Velocities of duplicates may always differ by this.", ""});
    declare.real("duplicates.velocity_share", velocity_share, 0, 1,
                 {"", "Velocities of duplicates may differ by this share of the speed.", ""});
    declare.real("duplicates.growth_limit", growth_limit, 0, 100,
                 {"",
                  "Where the union would be larger than this many times the larger box, that box stays as it is. 0: no "
                  "limit.",
                  ""});
    parts.describe(visitor);
}

std::vector<Detection> removeDuplicates(std::vector<Detection> detections, const FrameMotion& motion,
                                        const DuplicateRemovalOptions& options, const SceneScale& scale,
                                        RemovalTrace* trace) {
    detections = joinParts(std::move(detections), motion, options.parts, scale, trace);
    SupportRule rule;
    rule.compare_velocity = options.compare_speed;
    for (Detection& detection : detections) {
        if (detection.rejection == Rejection::none) measureSupport(detection, motion, rule);
    }
    suppress(detections, options, trace);
    const auto worth = [&](std::size_t i, std::size_t k) -> std::optional<double> {
        const Detection& a = detections[i];
        const Detection& b = detections[k];
        if (a.rejection != Rejection::none || b.rejection != Rejection::none) return {};
        const double strength = strengthOf(a, b, options);
        return strength < options.threshold ? std::nullopt : std::optional(strength);
    };
    BestPairs pairs(detections.size(), worth);
    while (const auto strongest = pairs.best()) {
        Detection* first = &detections[strongest->first];
        Detection* second = &detections[strongest->second];
        if (first->complete != second->complete) {
            (first->complete ? second : first)->rejection = Rejection::duplicate;
        } else if (first->box.area() >= second->box.area()) {
            fuse(*first, *second, motion, options);
        } else {
            fuse(*second, *first, motion, options);
        }
        if (trace != nullptr) {
            const bool first_stays = first->rejection == Rejection::none;
            const auto a = static_cast<int>(strongest->first);
            const auto b = static_cast<int>(strongest->second);
            trace->duplicates.push_back({first_stays ? b : a, first_stays ? a : b, strongest->worth, options.threshold,
                                         "duplicates.threshold"});
        }
        pairs.changed(strongest->first, worth);
        pairs.changed(strongest->second, worth);
    }
    return detections;
}

}  // namespace eyrie
