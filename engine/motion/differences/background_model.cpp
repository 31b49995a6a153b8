#include "motion/differences/background_model.h"

#include <algorithm>
#include <array>
#include <opencv2/core/utility.hpp>
#include <opencv2/imgproc.hpp>

namespace eyrie {
namespace {

constexpr int kMostPictures = 128;

uchar lowerMedian(std::array<uchar, kMostPictures>& values, int count) {
    const auto middle = values.begin() + (count - 1) / 2;
    std::nth_element(values.begin(), middle, values.begin() + count);
    return *middle;
}

}  // namespace

Background medianBackground(const std::vector<WarpedFrame>& pictures) {
    CV_Assert(!pictures.empty() && pictures.size() <= static_cast<std::size_t>(kMostPictures));
    const cv::Size size = pictures.front().gray.size();
    const int enough = (static_cast<int>(pictures.size()) + 1) / 2;
    Background background;
    background.gray.create(size, CV_8UC1);
    background.known.create(size, CV_8UC1);
    cv::parallel_for_(cv::Range(0, size.height), [&](const cv::Range& rows) {
        std::array<uchar, kMostPictures> values{};
        for (int y = rows.start; y < rows.end; ++y) {
            for (int x = 0; x < size.width; ++x) {
                int count = 0;
                for (const WarpedFrame& picture : pictures) {
                    if (picture.inside.at<uchar>(y, x) == 0) continue;
                    values[static_cast<std::size_t>(count++)] = picture.gray.at<uchar>(y, x);
                }
                background.gray.at<uchar>(y, x) = count > 0 ? lowerMedian(values, count) : 0;
                background.known.at<uchar>(y, x) = count >= enough ? 255 : 0;
            }
        }
    });
    return background;
}

cv::Mat backgroundGradient(const cv::Mat& gray) {
    constexpr double kSobelScale = 1.0 / 8;
    cv::Mat dx;
    cv::Mat dy;
    cv::Sobel(gray, dx, CV_32F, 1, 0, 3, kSobelScale);
    cv::Sobel(gray, dy, CV_32F, 0, 1, 3, kSobelScale);
    cv::Mat magnitude;
    cv::magnitude(dx, dy, magnitude);
    return magnitude;
}

}  // namespace eyrie
