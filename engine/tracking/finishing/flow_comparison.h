#pragma once

#include <cmath>
#include <optional>
#include <vector>

#include "tracking/ground_motion.h"

namespace eyrie {

inline constexpr int kFlowWindow = 24;         ///< frames over which motion is compared with the camera's …
inline constexpr int kShortestFlowWindow = 8;  ///< … and at least that many
inline constexpr int kFlowWindowStep = 6;      ///< states from one window to the next

/// Cosine of the angle to the ground's motion through the picture from which parallax may be what moves a thing.
inline constexpr double kAlongFlow = 0.8;

/// How a track moved over the ground, beside how the ground itself moved through the picture. Medians over windows of
/// 24 frames.
struct FlowComparison {
    double ratio = 0;      ///< own motion to the ground's
    double fastest = 0;    ///< the same in the window of its fastest motion
    double alignment = 0;  ///< cosine of the angle between both
    double flow = 0;       ///< px/frame of the ground
};

/// The same of one window.
struct FlowMoments {
    double ratio = 0;
    double alignment = 0;
    double flow = 0;

    template <class Archive>
    void transfer(Archive& archive) {
        archive(ratio, alignment, flow);
        archive.require(std::isfinite(ratio) && std::isfinite(alignment) && std::isfinite(flow),
                        "a motion that is no number");
    }
};

/// A thing that was at `begin` and is at `end`, and the ground that it was on, which is at `ground` now.
FlowMoments flowMoments(cv::Point2d begin, cv::Point2d ground, cv::Point2d end, int frames);

/// Nothing where there are none.
std::optional<FlowComparison> comparisonOf(const std::vector<FlowMoments>& windows);

/// Nothing where the track is too short or the ground's motion unknown.
std::optional<FlowComparison> comparedWithFlow(const TrackPath& path, const GroundMotion& ground);

}  // namespace eyrie
