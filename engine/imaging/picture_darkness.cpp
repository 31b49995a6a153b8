#include "imaging/picture_darkness.h"

#include <algorithm>
#include <vector>

#include "core/robust_statistics.h"

namespace eyrie {
namespace {

constexpr int kEvery = 16;  ///< px from one sample to the next
constexpr double kNight = 25;
constexpr double kLight = 60;  ///< grey values up to which it is night, and from which it is light

}  // namespace

double darknessOf(const cv::Mat& gray) {
    std::vector<double> samples;
    for (int y = 0; y < gray.rows; y += kEvery) {
        for (int x = 0; x < gray.cols; x += kEvery) samples.push_back(gray.at<uchar>(y, x));
    }
    if (samples.empty()) return 0;
    return std::clamp((kLight - medianOf(std::move(samples))) / (kLight - kNight), 0.0, 1.0);
}

}  // namespace eyrie
