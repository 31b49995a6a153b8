#pragma once

#include <functional>
#include <opencv2/core.hpp>

#include "annotation/scenes.h"
#include "events/ground/ground_stretches.h"

namespace eyrie::test {

/// What the camera saw that shows the ground so in each frame, in pictures of 200×120 px. `broken_at`: the frame that
/// is not registered onto the one before.
inline Footage footageOf(const std::function<cv::Matx33d(double frame)>& image_from_ground, int last,
                         int broken_at = -1) {
    std::vector<Homography> steps = stepsOf(image_from_ground, last);
    if (broken_at > 0) steps.erase(steps.begin() + broken_at - 1);
    Footage footage;
    footage.camera = CameraMotion(steps);
    footage.image_size = {200, 120};
    footage.last_frame = last;
    return footage;
}

}  // namespace eyrie::test
