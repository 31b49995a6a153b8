#pragma once

#include <opencv2/core/mat.hpp>
#include <vector>

namespace eyrie {

/// Grey values by which a vehicle or a shadow differs from the ground at least.
inline constexpr double kGroundContrast = 12;

/// Where a picture differs from all of the ground's, and where it may lie in the shade: it is as much darker than all
/// of them as a shadow makes it, and no more; 255 or 0.
struct GroundMasks {
    cv::Mat differs, shaded;
};

/// `vehicle`, `grounds`: the same places (CV_8UC1) while a vehicle is there and while it is not. `unknown`: of each of
/// the grounds the places of which it says nothing, 255; by default it says something of all. Nothing differs where
/// all of them say nothing.
GroundMasks masksAgainst(const cv::Mat& vehicle, const std::vector<cv::Mat>& grounds,
                         const std::vector<cv::Mat>& unknown = {});

/// As at night, when lamps and beams make up the silhouettes.
bool allDark(const std::vector<cv::Mat>& grounds);

}  // namespace eyrie
