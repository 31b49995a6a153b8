#include "imaging/gradients.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

namespace eyrie {
namespace {

/// Filters of flat ground leave this much; a quantile threshold must not take it for a gradient.
constexpr float kRounding = 1e-6F;

void magnitudeOf(const cv::Mat& dx, const cv::Mat& dy, cv::Mat& gradient) {
    gradient.create(dx.size(), CV_32FC1);
    for (int y = 0; y < dx.rows; ++y) {
        const float* x_row = dx.ptr<float>(y);
        const float* y_row = dy.ptr<float>(y);
        float* out = gradient.ptr<float>(y);
        for (int x = 0; x < dx.cols; ++x) {
            const float squared = x_row[x] * x_row[x] + y_row[x] * y_row[x];
            out[x] = squared > kRounding ? std::sqrt(squared) : 0.0F;
        }
    }
}

}  // namespace

void simpleGradient(const cv::Mat& gray, cv::Mat& gradient) {
    CV_Assert(gray.empty() || gray.type() == CV_8UC1);
    gradient.create(gray.size(), CV_32FC1);
    for (int y = 0; y < gray.rows; ++y) {
        const uchar* row = gray.ptr<uchar>(y);
        const uchar* below = gray.ptr<uchar>(std::min(y + 1, gray.rows - 1));
        float* out = gradient.ptr<float>(y);
        const int last = gray.cols - 1;
        for (int x = 0; x < last; ++x) {
            const float dx = static_cast<float>(row[x + 1] - row[x]);
            const float dy = static_cast<float>(below[x] - row[x]);
            out[x] = std::sqrt(dx * dx + dy * dy);
        }
        out[last] = std::abs(static_cast<float>(below[last] - row[last]));
    }
}

void cannyGradient(const cv::Mat& gray, double variance, cv::Mat& gradient) {
    CV_Assert(gray.empty() || gray.type() == CV_8UC1);
    CV_Assert(variance > 0);
    if (gray.empty()) {
        gradient.create(gray.size(), CV_32FC1);
        return;
    }
    const int reach = std::max(1, static_cast<int>(std::ceil(3.5 * std::sqrt(variance))));
    cv::Mat smooth(1, 2 * reach + 1, CV_32F);
    cv::Mat derivative(1, 2 * reach + 1, CV_32F);
    double sum = 0;
    double slope = 0;
    for (int i = -reach; i <= reach; ++i) {
        const double g = std::exp(-i * i / (2 * variance));
        smooth.at<float>(i + reach) = static_cast<float>(g);
        derivative.at<float>(i + reach) = static_cast<float>(i * g);
        sum += g;
        slope += i * i * g;
    }
    smooth /= sum;
    derivative /= slope;
    cv::Mat dx;
    cv::Mat dy;
    cv::sepFilter2D(gray, dx, CV_32F, derivative, smooth, {-1, -1}, 0, cv::BORDER_REPLICATE);
    cv::sepFilter2D(gray, dy, CV_32F, smooth, derivative, {-1, -1}, 0, cv::BORDER_REPLICATE);
    magnitudeOf(dx, dy, gradient);
}

void morphologicalGradient(const cv::Mat& gray, cv::Mat& gradient) {
    CV_Assert(gray.empty() || gray.type() == CV_8UC1);
    gradient.create(gray.size(), CV_32FC1);
    if (gray.empty()) return;
    const cv::Mat square = cv::getStructuringElement(cv::MORPH_RECT, {3, 3});
    cv::Mat difference;
    cv::morphologyEx(gray, difference, cv::MORPH_GRADIENT, square);
    difference.convertTo(gradient, CV_32F);
}

}  // namespace eyrie
