#include <algorithm>
#include <cmath>
#include <map>

#include "core/robust_statistics.h"
#include "tracking/finishing/shared_frames.h"
#include "tracking/finishing/track_paths.h"

namespace eyrie {
namespace {

constexpr double kShortest = 0.5;     ///< s that vehicle and shadow are seen together …
constexpr double kOfShadow = 0.8;     ///< … and share of the shadow's life
constexpr double kSlowest = 2.5;      ///< m/s; queueing vehicles move alike, too
constexpr double kWay = 4;            ///< m together over the ground
constexpr double kDetected = 0.5;     ///< a shadow is detected less often than this share of its vehicle's detections
constexpr double kApart = 0.1;        ///< share of the speed by which velocities may differ
constexpr double kGap = 0.3;          ///< m between the long sides
constexpr double kGapPx = 0.2;        ///< px, added to it
constexpr double kLooseAcross = 0.5;  ///< m by which their distance scatters across the heading …
constexpr double kLooseAlong = 1.5;   ///< m … and along: corners on a shadow's outline come and go

/// How one track drives beside another in the frames they share; px and px/frame.
struct Beside {
    std::vector<double> along, across;            ///< centre in the axes of the other
    std::vector<double> gaps_along, gaps_across;  ///< between the boxes; negative where they overlap
    std::vector<double> speeds, apart;
};

Beside besideOf(const TrackPath& vehicle, const TrackPath& other) {
    Beside beside;
    forSharedFrames(vehicle, other, [&](FrameIndex, const MovingState& a, const MovingState& b) {
        const cv::Point2d offset = a.box.toBox(b.box.centre);
        beside.along.push_back(offset.x);
        beside.across.push_back(offset.y);
        beside.gaps_along.push_back(std::abs(offset.x) - (a.box.length + b.box.length) / 2);
        beside.gaps_across.push_back(std::abs(offset.y) - (a.box.width + b.box.width) / 2);
        beside.speeds.push_back(std::hypot(a.velocity.x, a.velocity.y));
        beside.apart.push_back(std::hypot(a.velocity.x - b.velocity.x, a.velocity.y - b.velocity.y));
    });
    return beside;
}

}  // namespace

bool drivesAsShadowOf(const TrackPath& shadow, const TrackPath& vehicle, const SceneScale& everywhere, double gap_m) {
    const double seen = kDetected * vehicle.statesOf(StateOrigin::detected);
    if (shadow.statesOf(StateOrigin::detected) >= seen) return false;
    const Beside beside = besideOf(vehicle, shadow);
    const SceneScale scale = scaleOf(shadow, everywhere);
    const auto frames = static_cast<double>(beside.along.size());
    if (frames < std::max(1.0, kShortest * scale.frame_rate_hz)) return false;
    if (frames < kOfShadow * static_cast<double>(shadow.states.size())) return false;
    const double speed = medianOf(beside.speeds);
    if (speed < scale.pxPerFrame(kSlowest) || speed * frames < scale.px(kWay)) return false;
    return medianOf(beside.apart) <= kApart * speed && medianOf(beside.gaps_along) < 0 &&
           medianOf(beside.gaps_across) < scale.px(gap_m) + kGapPx &&
           spreadOf(beside.across) <= scale.px(kLooseAcross) && spreadOf(beside.along) <= scale.px(kLooseAlong);
}

void dropShadows(std::vector<TrackPath>& paths, const IsShadow& is_shadow, DropList& dropped) {
    std::vector<TrackId> vehicle_of(paths.size(), 0);
    const LivingTracks living(paths);
    for (std::size_t i = 0; i < paths.size(); ++i) {
        const std::vector<std::size_t> others = living.during(paths[i].firstFrame(), paths[i].lastFrame());
        const auto vehicle = std::find_if(others.begin(), others.end(),
                                          [&](std::size_t other) { return is_shadow(paths[i], paths[other]); });
        if (vehicle != others.end()) vehicle_of[i] = paths[*vehicle].id;
    }
    std::size_t at = 0;
    std::erase_if(paths, [&](TrackPath& path) {
        const TrackId vehicle = vehicle_of[at++];
        if (vehicle != 0) drop(path, TrackDrop::shadow, dropped, vehicle);
        return vehicle != 0;
    });
    std::map<TrackId, TrackId> beside;
    for (const DroppedPath& each : dropped) {
        if (each.why == TrackDrop::shadow) beside[each.path.id] = each.beside;
    }
    // A shadow was seen less often than its vehicle, so that this ends.
    for (DroppedPath& each : dropped) {
        for (auto of = beside.find(each.beside); of != beside.end(); of = beside.find(each.beside))
            each.beside = of->second;
    }
}

void dropShadows(std::vector<TrackPath>& paths, const SceneScale& scale, DropList& dropped) {
    dropShadows(
        paths,
        [&](const TrackPath& shadow, const TrackPath& vehicle) {
            return drivesAsShadowOf(shadow, vehicle, scale, kGap);
        },
        dropped);
}

}  // namespace eyrie
