#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <set>
#include <utility>

#include "tracking/spread.h"
#include "tracking/track_paths.h"

namespace eyrie {
namespace {

constexpr int kWindow = 24;          ///< frames over which motion is compared with the camera's …
constexpr int kShortestWindow = 8;   ///< … and at least that many
constexpr int kWindowStep = 6;       ///< frames from one window to the next
constexpr double kLeastFlow = 0.2;   ///< px/frame; below that the camera does not move enough to tell
constexpr double kAlongFlow = 0.8;   ///< cosine of the angle to the flow
constexpr double kFlowNoise = 0.05;  ///< px/frame that registration may err by

/// How a track moved over the ground, beside how the ground itself moved through the picture.
struct AgainstFlow {
    double ratio = 0;      ///< own motion to the ground's
    double fastest = 0;    ///< the same in the window of its fastest motion
    double alignment = 0;  ///< cosine of the angle between both
    double flow = 0;       ///< px/frame of the ground
};

std::optional<AgainstFlow> againstFlow(const TrackPath& path, const GroundMotion& ground) {
    std::vector<double> ratios, alignments, flows;
    const auto& states = path.states;
    for (std::size_t i = 0; i < states.size(); i += kWindowStep) {
        const auto& [first, begin] = states[i];
        const auto& [last, end] = states[std::min(i + kWindow, states.size() - 1)];
        const int frames = last - first;
        if (frames < (i == 0 ? 1 : kShortestWindow)) continue;
        const auto there = ground.carried({begin.box, {0, 0}}, first, last, true);
        if (!there) continue;
        const cv::Point2d flow = there->box.centre - begin.box.centre;
        const cv::Point2d own = end.box.centre - there->box.centre;
        const double flow_length = std::hypot(flow.x, flow.y);
        const double own_length = std::hypot(own.x, own.y);
        ratios.push_back(own_length / (flow_length + kFlowNoise * frames));
        alignments.push_back(own.dot(flow) / std::max(own_length * flow_length, 1e-6));
        flows.push_back(flow_length / frames);
    }
    if (ratios.empty()) return std::nullopt;
    const double fastest = *std::max_element(ratios.begin(), ratios.end());
    return AgainstFlow{medianOf(std::move(ratios)), fastest, medianOf(std::move(alignments)),
                       medianOf(std::move(flows))};
}

/// A thing that rises to `height` of the flight height moves this much of the ground's own motion more than the ground.
double parallaxAt(double height) {
    return height / (1 - height);
}

/// Whether a track cannot be told from something that stands, by its motion alone.
bool movesLikeStanding(const TrackPath& path, const GroundMotion& ground, const FinishingOptions& options) {
    const auto motion = againstFlow(path, ground);
    if (!motion || motion->flow < kLeastFlow) return false;
    const bool above = motion->alignment > kAlongFlow && motion->ratio < parallaxAt(options.standing_height);
    const bool below = motion->alignment < -kAlongFlow && motion->ratio < parallaxAt(options.standing_depth);
    const bool never_moved = motion->fastest < parallaxAt(options.standing_depth);
    return above || below || never_moved;
}

bool isAt(const OrientedBox& vehicle, const OrientedBox& box) {
    const cv::Point2d off = vehicle.centre - box.centre;
    return std::hypot(off.x, off.y) < std::max(box.length, box.width) / 2;
}

/// Those of the doubted tracks that were once taken for a vehicle. Frame by frame, so that each is asked for once.
std::set<TrackId> takenForVehicles(const std::vector<const TrackPath*>& doubted, const BoxesAt& vehicles_at) {
    std::map<FrameIndex, std::vector<std::pair<TrackId, const OrientedBox*>>> by_frame;
    for (const TrackPath* path : doubted) {
        for (const auto& [frame, state] : path->states) {
            if (state.origin == StateOrigin::detected) by_frame[frame].emplace_back(path->id, &state.box);
        }
    }
    std::set<TrackId> taken;
    for (const auto& [frame, boxes] : by_frame) {
        const std::vector<OrientedBox> vehicles = vehicles_at(frame);
        for (const auto& [id, box] : boxes) {
            const OrientedBox& place = *box;
            if (std::any_of(vehicles.begin(), vehicles.end(),
                            [&](const OrientedBox& vehicle) { return isAt(vehicle, place); }))
                taken.insert(id);
        }
    }
    return taken;
}

}  // namespace

void dropStanding(std::vector<TrackPath>& paths, const GroundMotion& ground, const BoxesAt& vehicles_at,
                  const FinishingOptions& options, DropList& dropped) {
    if (!vehicles_at) return;
    std::vector<const TrackPath*> doubted;
    for (const TrackPath& path : paths) {
        if (movesLikeStanding(path, ground, options)) doubted.push_back(&path);
    }
    std::set<TrackId> standing;
    for (const TrackPath* path : doubted) standing.insert(path->id);
    for (const TrackId id : takenForVehicles(doubted, vehicles_at)) standing.erase(id);
    std::erase_if(paths, [&](const TrackPath& path) {
        if (!standing.contains(path.id)) return false;
        dropped.add(path, TrackDrop::could_stand);
        return true;
    });
}

}  // namespace eyrie
