#include "imaging/picture_look.h"

#include <algorithm>
#include <cmath>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>
#include <vector>

namespace eyrie {
namespace {

constexpr double kClipLimit = 2.5;
constexpr int kTiles = 8;  ///< in each direction
constexpr double kMiddle = 127.5;

cv::Mat tableOf(const PictureLook& look) {
    const double contrast = std::clamp(look.contrast, -1.0, 1.0);
    const double gain = contrast < 0 ? 1 + contrast : std::pow(4, contrast);
    const double offset = std::clamp(look.brightness, -1.0, 1.0) * 255;
    cv::Mat table(1, 256, CV_8UC1);
    for (int value = 0; value < 256; ++value)
        table.at<uchar>(0, value) = cv::saturate_cast<uchar>((value - kMiddle) * gain + kMiddle + offset);
    return table;
}

}  // namespace

cv::Mat withLook(const cv::Mat& picture, const PictureLook& look) {
    const bool colour = picture.type() == CV_8UC3;
    if (picture.empty() || look.plain() || (!colour && picture.type() != CV_8UC1)) return picture;
    std::vector<cv::Mat> planes{picture};
    if (colour) {
        cv::Mat separate;
        cv::cvtColor(picture, separate, cv::COLOR_BGR2YCrCb);
        cv::split(separate, planes);
    }
    cv::Mat bright = planes.front();
    if (look.even) {
        cv::Mat evened;
        cv::createCLAHE(kClipLimit, {kTiles, kTiles})->apply(bright, evened);
        bright = evened;
    }
    cv::Mat adjusted;
    cv::LUT(bright, tableOf(look), adjusted);
    if (!colour) return adjusted;
    planes.front() = adjusted;
    cv::Mat result;
    cv::merge(planes, result);
    cv::cvtColor(result, result, cv::COLOR_YCrCb2BGR);
    return result;
}

}  // namespace eyrie
