#include "tracking/finishing/flow_comparison.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "tracking/robust_statistics.h"

namespace eyrie {
namespace {

constexpr int kWindow = 24;          ///< frames over which motion is compared with the camera's …
constexpr int kShortestWindow = 8;   ///< … and at least that many
constexpr int kWindowStep = 6;       ///< frames from one window to the next
constexpr double kFlowNoise = 0.05;  ///< px/frame that registration may err by

}  // namespace

std::optional<FlowComparison> comparedWithFlow(const TrackPath& path, const GroundMotion& ground) {
    std::vector<double> ratios, alignments, flows;
    const auto& states = path.states;
    for (std::size_t i = 0; i < states.size(); i += kWindowStep) {
        const auto& [first, begin] = states[i];
        const auto& [last, end] = states[std::min(i + kWindow, states.size() - 1)];
        // A vehicle that stands says nothing about how it moves.
        if (begin.origin == StateOrigin::standing || end.origin == StateOrigin::standing) continue;
        const int frames = last - first;
        if (frames < (i == 0 ? 1 : kShortestWindow)) continue;
        const auto there = ground.carried({begin.box, {0, 0}}, first, last, true);
        if (!there) continue;
        const cv::Point2d flow = there->box.centre - cv::Point2d(begin.box.centre);
        const cv::Point2d own = cv::Point2d(end.box.centre) - there->box.centre;
        const double flow_length = std::hypot(flow.x, flow.y);
        const double own_length = std::hypot(own.x, own.y);
        ratios.push_back(own_length / (flow_length + kFlowNoise * frames));
        alignments.push_back(own.dot(flow) / std::max(own_length * flow_length, 1e-6));
        flows.push_back(flow_length / frames);
    }
    if (ratios.empty()) return std::nullopt;
    const double fastest = *std::max_element(ratios.begin(), ratios.end());
    return FlowComparison{medianOf(std::move(ratios)), fastest, medianOf(std::move(alignments)),
                          medianOf(std::move(flows))};
}

}  // namespace eyrie
