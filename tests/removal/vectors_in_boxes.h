#pragma once

#include "core/values/detection.h"
#include "core/values/motion_vector.h"
#include "core/values/scene_scale.h"

namespace eyrie::test {

inline const SceneScale kScale{0.25, 25, true};  // 1 m = 4 px, a car is 18 × 7.2 px

inline Detection detection(double x, double y, double length, double width, cv::Point2d velocity = {1, 0}) {
    Detection made;
    made.box = {{x, y}, length, width, 0};
    made.velocity = velocity;
    return made;
}

/// `count` vectors evenly along the middle line of a box with heading 0.
inline void fill(FrameMotion& motion, const OrientedBox& box, int count, cv::Point2d velocity = {1, 0}) {
    for (int i = 0; i < count; ++i) {
        const double x = box.centre.x + box.length * ((i + 0.5) / count - 0.5);
        motion.motion_vectors.push_back(
            {static_cast<CornerId>(motion.motion_vectors.size()), cv::Point2d(x, box.centre.y), velocity, 9});
    }
}

inline FrameMotion sparseMotion() {
    FrameMotion motion;
    motion.image_size = {640, 480};
    motion.corner_count = 3000;  // 0.0098 per px²: 1.3 on a car
    return motion;
}

}  // namespace eyrie::test
