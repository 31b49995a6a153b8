#pragma once

/// How a thing's own motion counts beside the camera's, in the scores of detections and of tracks alike.
/// tests/learn_track_score learns both with the same numbers.
namespace eyrie {

inline constexpr double kMostFlow = 4;         ///< px/frame of the ground; a faster camera tells no more
inline constexpr double kMostFlowRatio = 1.5;  ///< of own motion to the ground's; more tells no more
/// Of detections: the same of what is infinitely far below the ground's plane, or in the lens.
inline constexpr double kSticksRatio = 1.15;
inline constexpr double kFlowNoise = 0.05;  ///< px/frame that registration may err by

}  // namespace eyrie
