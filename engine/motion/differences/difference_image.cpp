#include "motion/differences/difference_image.h"

#include <algorithm>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "core/robust_statistics.h"

namespace eyrie {
namespace {

constexpr int kBorder = 5;  // px; interpolation and blur at the edge of a picture answer to nothing

cv::Mat smoothed(const cv::Mat& gray, double blur_px) {
    cv::Mat real;
    gray.convertTo(real, CV_32F);
    if (blur_px > 0) cv::GaussianBlur(real, real, {}, blur_px);
    return real;
}

cv::Mat withoutBorder(const cv::Mat& inside) {
    cv::Mat eroded;
    cv::erode(inside, eroded, cv::getStructuringElement(cv::MORPH_RECT, {kBorder, kBorder}), {-1, -1}, 1,
              cv::BORDER_CONSTANT, cv::Scalar(0));
    return eroded;
}

}  // namespace

DifferenceImage twoFrameDifference(const cv::Mat& now, const WarpedFrame& before, double blur_px) {
    DifferenceImage difference;
    difference.overlap = withoutBorder(before.inside);
    cv::absdiff(smoothed(now, blur_px), smoothed(before.gray, blur_px), difference.values);
    difference.values.setTo(0, difference.overlap == 0);
    difference.reference = before.gray;
    return difference;
}

DifferenceImage threeFrameDifference(const cv::Mat& now, const WarpedFrame& before, const WarpedFrame& long_before,
                                     double blur_px) {
    DifferenceImage first = twoFrameDifference(now, before, blur_px);
    const DifferenceImage second = twoFrameDifference(before.gray, long_before, blur_px);
    first.values = cv::min(first.values, second.values);
    first.overlap &= second.overlap;
    return first;
}

DifferenceImage backgroundDifference(const cv::Mat& now, const Background& background, double gradient_suppression,
                                     double blur_px) {
    DifferenceImage difference = twoFrameDifference(now, {background.gray, background.known}, blur_px);
    if (gradient_suppression <= 0) return difference;
    difference.values = cv::max(difference.values - gradient_suppression * backgroundGradient(background.gray), 0);
    difference.values.setTo(0, difference.overlap == 0);
    return difference;
}

double differenceNoise(const DifferenceImage& difference) {
    std::vector<float> values;
    values.reserve(difference.values.total());
    for (int y = 0; y < difference.values.rows; ++y) {
        const float* value = difference.values.ptr<float>(y);
        const uchar* in = difference.overlap.ptr<uchar>(y);
        for (int x = 0; x < difference.values.cols; ++x) {
            if (in[x] != 0) values.push_back(value[x]);
        }
    }
    if (values.empty()) return 0;
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return static_cast<double>(*middle) / kMedianOfAbsoluteNormal;
}

cv::Mat movingPixels(const DifferenceImage& difference, double low, double strong_limit) {
    const cv::Mat candidates = (difference.values > low) & difference.overlap;
    std::vector<uchar> levels;
    for (int y = 0; y < candidates.rows; ++y) {
        for (int x = 0; x < candidates.cols; ++x) {
            if (candidates.at<uchar>(y, x) != 0)
                levels.push_back(cv::saturate_cast<uchar>(difference.values.at<float>(y, x)));
        }
    }
    cv::Mat moving = cv::Mat::zeros(candidates.size(), CV_8UC1);
    if (levels.empty()) return moving;
    cv::Mat unused;
    const double otsu = cv::threshold(levels, unused, 0, 255, cv::THRESH_BINARY | cv::THRESH_OTSU);
    const double strong = std::min(otsu, strong_limit * low);
    cv::Mat labels;
    const int count = cv::connectedComponents(candidates, labels, 8, CV_32S);
    std::vector<char> accepted(static_cast<std::size_t>(count), 0);
    const auto each = [&](const auto& visit) {
        for (int y = 0; y < labels.rows; ++y) {
            for (int x = 0; x < labels.cols; ++x) {
                if (labels.at<int>(y, x) > 0) visit(y, x, accepted[static_cast<std::size_t>(labels.at<int>(y, x))]);
            }
        }
    };
    each([&](int y, int x, char& is) { is |= static_cast<double>(difference.values.at<float>(y, x)) >= strong; });
    each([&](int y, int x, const char& is) { moving.at<uchar>(y, x) = is != 0 ? 255 : 0; });
    return moving;
}

}  // namespace eyrie
