#include "tracking/pictures/ground_turns.h"

#include "core/geometry/homography_jacobian.h"

namespace eyrie {
namespace {

/// Errors of the slope, or one that nobody knows, add up as well; from here on a stretch begins anew.
constexpr double kMostEnlarged = 1.5;

}  // namespace

GroundTurns::GroundTurns(const GroundMotion& ground, FrameIndex first, FrameIndex last, int longest) : first_(first) {
    turns_.reserve(static_cast<std::size_t>(last - first) + 1);
    turns_.push_back({first, 0, 1});
    for (FrameIndex frame = first + 1; frame <= last; ++frame) {
        const cv::Matx33d* step = ground.step(frame - 1, frame, false);
        if (step == nullptr || frame - turns_.back().stretch >= longest) {
            turns_.push_back({frame, 0, 1});
            continue;
        }
        const cv::Size image = ground.imageSize(frame);
        const cv::Point2d middle(image.width / 2.0, image.height / 2.0);
        Turn turn = turns_.back();
        turn.angle = HomographyJacobian(*step, middle).turned(turn.angle);
        turn.enlargement *= ground.zoomAt(*step, middle);
        const bool certain = turn.enlargement < kMostEnlarged && turn.enlargement * kMostEnlarged > 1;
        turns_.push_back(certain ? turn : Turn{frame, 0, 1});
    }
}

}  // namespace eyrie
