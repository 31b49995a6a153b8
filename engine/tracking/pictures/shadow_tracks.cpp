#include <cmath>
#include <map>
#include <optional>

#include "core/robust_statistics.h"
#include "tracking/pictures/cast_shadow.h"

namespace eyrie {
namespace {

constexpr double kTallest = 2.5;    ///< times as far as those of most vehicles the shadows of lorries reach
constexpr double kSameWay = 0.9;    ///< cosine between where it lies and where shadows fall
constexpr double kShadedBox = 0.3;  ///< share of its box, at least

/// How far the shadows of most vehicles reach in the middle of a track's life, m; nothing where that is not known.
std::optional<double> reachDuring(const TrackPath& track, const std::vector<CastShadow>& shadows,
                                  const GroundTurns& turns) {
    const FrameIndex middle = track.states[track.states.size() / 2].first;
    const CastShadow* shadow = shadowIn(shadows, turns.at(middle).stretch);
    if (shadow == nullptr) return std::nullopt;
    return std::hypot(shadow->reach_m.x, shadow->reach_m.y);
}

/// Whether a track usually lies that way off a vehicle which shadows fall to.
bool liesWhereShadowsFall(const TrackPath& track, const TrackPath& vehicle, const std::vector<CastShadow>& shadows,
                          const GroundTurns& turns, const SceneScale& scale) {
    std::vector<double> cosines;
    for (const auto& [frame, state] : track.states) {
        const TimedPathState* at = vehicle.at(frame);
        const CastShadow* shadow = shadowIn(shadows, turns.at(frame).stretch);
        if (at == nullptr || shadow == nullptr) continue;
        const cv::Point2d reach = reachAt(*shadow, turns.at(frame), at->second.box.centre, scale);
        const cv::Point2d way = cv::Point2d(state.box.centre) - cv::Point2d(at->second.box.centre);
        const double lengths = std::hypot(reach.x, reach.y) * std::hypot(way.x, way.y);
        if (lengths > 0) cosines.push_back(reach.dot(way) / lengths);
    }
    return !cosines.empty() && medianOf(std::move(cosines)) >= kSameWay;
}

}  // namespace

void dropShadowTracks(std::vector<TrackPath>& paths, const std::vector<SilhouetteLook>& looks,
                      const std::vector<CastShadow>& shadows, const GroundTurns& turns, const SceneScale& scale,
                      DropList& dropped) {
    if (shadows.empty()) return;
    const std::map<TrackId, double> shaded = usualByTrack(looks, &SilhouetteLook::shaded, 1);
    const auto is_shadow = [&](const TrackPath& track, const TrackPath& vehicle) {
        const auto share = shaded.find(track.id);
        if (share == shaded.end() || share->second < kShadedBox) return false;
        const std::optional<double> reach = reachDuring(track, shadows, turns);
        return reach && drivesAsShadowOf(track, vehicle, scale, kTallest * *reach) &&
               liesWhereShadowsFall(track, vehicle, shadows, turns, scale);
    };
    dropShadows(paths, is_shadow, dropped);
}

}  // namespace eyrie
