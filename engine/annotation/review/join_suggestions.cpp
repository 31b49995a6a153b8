#include "annotation/review/join_suggestions.h"

#include <algorithm>
#include <cmath>

#include "annotation/keyframes/interpolation.h"
#include "core/geometry/angle.h"

namespace eyrie {
namespace {

double distance(cv::Point2d a, cv::Point2d b) {
    return std::hypot(a.x - b.x, a.y - b.y);
}

/// How far the beginning of `later` is from where `earlier` is expected then.
JoinSuggestion compare(const LabelledObject& earlier, const LabelledObject& later, const CameraMotion& camera) {
    JoinSuggestion suggestion;
    const FrameIndex end = earlier.last_frame;
    const FrameIndex begin = firstFrameOf(later);
    suggestion.gap = begin - end - 1;
    suggestion.over_ground = camera.connects(end, begin);
    const OrientedBox there = boxAt(later, begin, camera).box;
    const OrientedBox last = boxAt(earlier, end, camera).box;
    const cv::Point2d standing = carriedPoint(last.centre, end, begin, camera);
    suggestion.distance_px = distance(standing, there.centre);
    // The speed over the last frames, in the picture of the last.
    constexpr int kSpeedFrames = 8;
    const FrameIndex before = std::max(firstFrameOf(earlier), end - kSpeedFrames);
    if (before < end) {
        const cv::Point2d past = carriedPoint(boxAt(earlier, before, camera).box.centre, before, end, camera);
        const cv::Point2d velocity = (last.centre - past) * (1.0 / (end - before));
        const cv::Point2d going = carriedPoint(last.centre + velocity * (begin - end), end, begin, camera);
        suggestion.distance_px = std::min(suggestion.distance_px, distance(going, there.centre));
    }
    const auto carried = carriedBox(last, end, begin, camera);
    suggestion.heading_turn = std::abs(turnBetween(carried ? carried->heading : last.heading, there.heading));
    return suggestion;
}

}  // namespace

std::vector<JoinSuggestion> suggestJoins(const AnnotationSet& set, ObjectId object, const CameraMotion& camera,
                                         const SuggestionOptions& options) {
    std::vector<JoinSuggestion> suggestions;
    const auto found = set.objects.find(object);
    if (found == set.objects.end()) return suggestions;
    const LabelledObject& self = found->second;
    for (const auto& [id, other] : set.objects) {
        if (id == object) continue;
        const bool later = firstFrameOf(other) > self.last_frame;
        const bool earlier = other.last_frame < firstFrameOf(self);
        if (!later && !earlier) continue;
        const int gap = later ? firstFrameOf(other) - self.last_frame - 1 : firstFrameOf(self) - other.last_frame - 1;
        if (gap > options.max_gap) continue;
        JoinSuggestion suggestion = later ? compare(self, other, camera) : compare(other, self, camera);
        suggestion.object = id;
        suggestion.later = later;
        if (suggestion.distance_px > options.max_distance_px + options.px_per_gap_frame * gap) continue;
        suggestions.push_back(suggestion);
    }
    std::stable_sort(suggestions.begin(), suggestions.end(),
                     [](const auto& a, const auto& b) { return a.distance_px < b.distance_px; });
    if (suggestions.size() > static_cast<std::size_t>(options.max_count)) {
        suggestions.resize(static_cast<std::size_t>(options.max_count));
    }
    return suggestions;
}

std::vector<FuseSuggestion> suggestFusions(const AnnotationSet& set, ObjectId object, const CameraMotion& camera,
                                           double min_overlap) {
    std::vector<FuseSuggestion> suggestions;
    const auto found = set.objects.find(object);
    if (found == set.objects.end()) return suggestions;
    const LabelledObject& self = found->second;
    for (const auto& [id, other] : set.objects) {
        const FrameIndex first = std::max(firstFrameOf(self), firstFrameOf(other));
        const FrameIndex last = std::min(self.last_frame, other.last_frame);
        if (id == object || first > last) continue;
        constexpr int kLooks = 50;
        const int step = std::max(1, (last - first + 1) / kLooks);
        FuseSuggestion suggestion;
        suggestion.object = id;
        for (FrameIndex frame = first; frame <= last; frame += step) {
            const LabelledBox a = boxAt(self, frame, camera);
            const LabelledBox b = boxAt(other, frame, camera);
            if (!a.visible() || !b.visible()) continue;
            ++suggestion.shared_frames;
            suggestion.mean_overlap += overlap(a.box, b.box);
        }
        if (suggestion.shared_frames == 0) continue;
        suggestion.mean_overlap /= suggestion.shared_frames;
        if (suggestion.mean_overlap >= min_overlap) suggestions.push_back(suggestion);
    }
    std::stable_sort(suggestions.begin(), suggestions.end(),
                     [](const auto& a, const auto& b) { return a.mean_overlap > b.mean_overlap; });
    return suggestions;
}

}  // namespace eyrie
