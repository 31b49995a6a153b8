#include "tracking/finishing/vehicle_looks.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "tracking/finishing/track_paths.h"

namespace eyrie {
namespace {

constexpr double kLeastDecision = -6;
constexpr double kMostDecision = 12;

}  // namespace

void TrackLooks::add(const OrientedBox& box, const std::vector<ClassifiedBox>& classified) {
    bool whole = false;
    const ClassifiedBox* nearest = nullptr;
    double nearest_off = std::max(box.length, box.width) / 2;
    for (const ClassifiedBox& other : classified) {
        const double off = std::hypot(other.box.centre.x - box.centre.x, other.box.centre.y - box.centre.y);
        if (off >= std::max(box.length, box.width) / 2) continue;
        whole = whole || other.whole;
        if (std::isnan(other.decision) || off >= nearest_off) continue;
        nearest = &other;
        nearest_off = off;
    }
    alike += whole ? 1 : 0;
    if (nearest == nullptr) return;
    ++looked_at;
    decision_sum += std::clamp(nearest->decision, kLeastDecision, kMostDecision);
}

double TrackLooks::decision() const {
    return looked_at > 0 ? decision_sum / looked_at : std::numeric_limits<double>::quiet_NaN();
}

VehicleLooks looksOf(const std::vector<TrackPath>& paths, const ClassifiedAt& classified_at) {
    VehicleLooks looks;
    std::optional<FrameIndex> asked;
    std::vector<ClassifiedBox> classified;
    visitByFrame(paths, [&](FrameIndex frame, const TrackPath& path, const PathState& state) {
        if (state.origin != StateOrigin::detected) return;
        if (asked != frame) {
            asked = frame;
            classified = classified_at(frame);
        }
        if (!classified.empty()) looks[path.id].add(state.box, classified);
    });
    return looks;
}

}  // namespace eyrie
