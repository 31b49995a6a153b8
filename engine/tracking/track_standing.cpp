#include <algorithm>
#include <cmath>
#include <optional>
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

bool wasTakenForVehicle(const TrackPath& path, const BoxesAt& vehicles_at) {
    return std::any_of(path.states.begin(), path.states.end(), [&](const TimedState& timed) {
        const auto& [frame, state] = timed;
        if (state.origin != StateOrigin::detected) return false;
        const double reach = std::max(state.box.length, state.box.width) / 2;
        const std::vector<OrientedBox> vehicles = vehicles_at(frame);
        return std::any_of(vehicles.begin(), vehicles.end(), [&](const OrientedBox& box) {
            return std::hypot(box.centre.x - state.box.centre.x, box.centre.y - state.box.centre.y) < reach;
        });
    });
}

}  // namespace

void dropStanding(std::vector<TrackPath>& paths, const GroundMotion& ground, const BoxesAt& vehicles_at,
                  const FinishingOptions& options, DropList& dropped) {
    if (!vehicles_at) return;
    std::erase_if(paths, [&](const TrackPath& path) {
        const auto motion = againstFlow(path, ground);
        if (!motion || motion->flow < kLeastFlow) return false;
        const bool above = motion->alignment > kAlongFlow && motion->ratio < parallaxAt(options.standing_height);
        const bool below = motion->alignment < -kAlongFlow && motion->ratio < parallaxAt(options.standing_depth);
        const bool never_moved = motion->fastest < parallaxAt(options.standing_depth);
        if (!(above || below || never_moved) || wasTakenForVehicle(path, vehicles_at)) return false;
        dropped.add(path, TrackDrop::could_stand);
        return true;
    });
}

}  // namespace eyrie
