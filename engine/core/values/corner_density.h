#pragma once

#include "core/values/motion_vector.h"
#include "core/values/scene_scale.h"

namespace eyrie {

/// Tracked corners per px² of the image; 0 when nothing is known.
inline double cornerDensity(const FrameMotion& motion) {
    const double area = static_cast<double>(motion.image_size.area());
    return area > 0 ? motion.corner_count / area : 0;
}

/// What a car covers seen from above, px².
inline double carArea(const SceneScale& scale) {
    return scale.px(kCarLength_m) * scale.px(kCarWidth_m);
}

/// Corners that lie on a car at the mean density of the frame.
inline double cornersOnCar(const FrameMotion& motion, const SceneScale& scale) {
    return cornerDensity(motion) * carArea(scale);
}

}  // namespace eyrie
