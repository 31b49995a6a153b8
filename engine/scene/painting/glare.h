#pragma once

#include <opencv2/core/mat.hpp>

namespace eyrie {

/// Adds the halos that lens and haze make around lamps. `lamps` (CV_32SC3): their light alone, summed over `passes`;
/// `light` (CV_32FC3): the mean of all. `strength` 1: a clean lens and clear air.
void addGlare(cv::Mat& light, const cv::Mat& lamps, int passes, double strength);

}  // namespace eyrie
