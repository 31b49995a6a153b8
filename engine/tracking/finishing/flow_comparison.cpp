#include "tracking/finishing/flow_comparison.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "core/flow_limits.h"
#include "core/robust_statistics.h"

namespace eyrie {

FlowMoments flowMoments(cv::Point2d begin, cv::Point2d ground, cv::Point2d end, int frames) {
    const cv::Point2d flow = ground - begin;
    const cv::Point2d own = end - ground;
    const double flow_length = std::hypot(flow.x, flow.y);
    const double own_length = std::hypot(own.x, own.y);
    return {own_length / (flow_length + kFlowNoise * frames), own.dot(flow) / std::max(own_length * flow_length, 1e-6),
            flow_length / frames};
}

std::optional<FlowComparison> comparisonOf(const std::vector<FlowMoments>& windows) {
    if (windows.empty()) return std::nullopt;
    std::vector<double> ratios, alignments, flows;
    for (const FlowMoments& window : windows) {
        ratios.push_back(window.ratio);
        alignments.push_back(window.alignment);
        flows.push_back(window.flow);
    }
    const double fastest = *std::max_element(ratios.begin(), ratios.end());
    return FlowComparison{medianOf(std::move(ratios)), fastest, medianOf(std::move(alignments)),
                          medianOf(std::move(flows))};
}

std::optional<FlowComparison> comparedWithFlow(const TrackPath& path, const GroundMotion& ground) {
    std::vector<FlowMoments> windows;
    const auto& states = path.states;
    for (std::size_t i = 0; i < states.size(); i += kFlowWindowStep) {
        const auto& [first, begin] = states[i];
        const auto& [last, end] = states[std::min(i + kFlowWindow, states.size() - 1)];
        // A vehicle that stands says nothing about how it moves.
        if (begin.origin == StateOrigin::standing || end.origin == StateOrigin::standing) continue;
        const int frames = last - first;
        if (frames < (i == 0 ? 1 : kShortestFlowWindow)) continue;
        const auto there = ground.carried({begin.box, {0, 0}}, first, last, true);
        if (!there) continue;
        windows.push_back(
            flowMoments(cv::Point2d(begin.box.centre), there->box.centre, cv::Point2d(end.box.centre), frames));
    }
    return comparisonOf(windows);
}

}  // namespace eyrie
