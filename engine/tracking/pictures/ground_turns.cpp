#include "tracking/pictures/ground_turns.h"

#include "core/geometry/homography_jacobian.h"

namespace eyrie {

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
        const HomographyJacobian there(*step, {image.width / 2.0, image.height / 2.0});
        Turn turn = turns_.back();
        turn.angle = there.turned(turn.angle);
        turn.enlargement *= there.scale();
        turns_.push_back(turn);
    }
}

}  // namespace eyrie
