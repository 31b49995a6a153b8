#pragma once

#include <cstdint>
#include <opencv2/core/mat.hpp>
#include <opencv2/core/types.hpp>
#include <vector>

#include "core/values/frame.h"
#include "scene/scene_description.h"

namespace eyrie {

/// What a pass looks at within the pixel and the exposure.
struct PassSample {
    cv::Point2d offset;  ///< px from the pixel's centre
    double moment = 0;   ///< frames from the middle of the exposure
};

/// The passes of a picture: offsets spread like the pixel's area widened by the lens blur, moments over the exposure.
/// Their means are zero.
std::vector<PassSample> passesOf(const Sensor& sensor);

/// Turns the mean light of the pixels (CV_32FC3, 0 … 255) into the picture the camera delivers: vignette, haze,
/// contrast, noise, compression. `moment` chooses the noise: the same moment has the same noise.
Frame develop(const cv::Mat& light, const Sensor& sensor, std::uint32_t seed, FrameIndex moment);

}  // namespace eyrie
