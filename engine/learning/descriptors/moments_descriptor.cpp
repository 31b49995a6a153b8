#include "learning/descriptors/moments_descriptor.h"

#include <algorithm>
#include <cmath>
#include <opencv2/core.hpp>
#include <vector>

#include "learning/descriptors/haralick.h"
#include "learning/models/window.h"

namespace eyrie {
namespace {

/// Continuous, odd and monotone; brings values of many orders of magnitude together.
float logScaled(double value) {
    return static_cast<float>(std::copysign(std::log10(1 + 1e6 * std::abs(value)), value));
}

int borderMedian(const cv::Mat& window) {
    std::vector<uchar> border;
    for (int x = 0; x < kWindowWidth; ++x) {
        border.push_back(window.at<uchar>(0, x));
        border.push_back(window.at<uchar>(kWindowHeight - 1, x));
    }
    for (int y = 1; y < kWindowHeight - 1; ++y) {
        border.push_back(window.at<uchar>(y, 0));
        border.push_back(window.at<uchar>(y, kWindowWidth - 1));
    }
    const auto middle = border.begin() + static_cast<std::ptrdiff_t>(border.size() / 2);
    std::nth_element(border.begin(), middle, border.end());
    return *middle;
}

struct BlobMoments {
    double mass = 0;
    double x = 0;  // centroid
    double y = 0;
    double normalised[5][5] = {};  // [power of x][power of y], order 2 to 4
};

BlobMoments blobMoments(const cv::Mat& window) {
    const int ground = borderMedian(window);
    BlobMoments m;
    for (int y = 0; y < kWindowHeight; ++y) {
        for (int x = 0; x < kWindowWidth; ++x) {
            const double value = std::abs(window.at<uchar>(y, x) - ground);
            m.mass += value;
            m.x += value * x;
            m.y += value * y;
        }
    }
    if (m.mass == 0) {
        m.x = (kWindowWidth - 1) / 2.0;
        m.y = (kWindowHeight - 1) / 2.0;
        return m;
    }
    m.x /= m.mass;
    m.y /= m.mass;
    for (int y = 0; y < kWindowHeight; ++y) {
        for (int x = 0; x < kWindowWidth; ++x) {
            const double value = std::abs(window.at<uchar>(y, x) - ground);
            if (value == 0) continue;
            double px[5] = {1};
            double py[5] = {1};
            for (int k = 1; k < 5; ++k) {
                px[k] = px[k - 1] * (x - m.x);
                py[k] = py[k - 1] * (y - m.y);
            }
            for (int order = 2; order <= 4; ++order) {
                for (int p = 0; p <= order; ++p) m.normalised[p][order - p] += value * px[p] * py[order - p];
            }
        }
    }
    for (int order = 2; order <= 4; ++order) {
        const double scale = std::pow(m.mass, 1 + order / 2.0);
        for (int p = 0; p <= order; ++p) m.normalised[p][order - p] /= scale;
    }
    return m;
}

void huInvariants(const double n[5][5], double hu[7]) {
    const double a = n[3][0] + n[1][2];
    const double b = n[2][1] + n[0][3];
    const double c = n[3][0] - 3 * n[1][2];
    const double d = 3 * n[2][1] - n[0][3];
    const double difference = n[2][0] - n[0][2];
    hu[0] = n[2][0] + n[0][2];
    hu[1] = difference * difference + 4 * n[1][1] * n[1][1];
    hu[2] = c * c + d * d;
    hu[3] = a * a + b * b;
    hu[4] = c * a * (a * a - 3 * b * b) + d * b * (3 * a * a - b * b);
    hu[5] = difference * (a * a - b * b) + 4 * n[1][1] * a * b;
    hu[6] = d * a * (a * a - 3 * b * b) - c * b * (3 * a * a - b * b);
}

cv::Mat inLevels(const cv::Mat& window) {
    double low = 0;
    double high = 0;
    cv::minMaxLoc(window, &low, &high);
    cv::Mat levels(window.size(), CV_8UC1);
    const int range = static_cast<int>(high - low) + 1;
    for (int y = 0; y < window.rows; ++y) {
        for (int x = 0; x < window.cols; ++x) {
            levels.at<uchar>(y, x) =
                static_cast<uchar>((window.at<uchar>(y, x) - static_cast<int>(low)) * kHaralickLevels / range);
        }
    }
    return levels;
}

}  // namespace

void MomentsDescriptor::compute(const cv::Mat& window, std::span<float> values) const {
    requireWindow(window);
    const BlobMoments blob = blobMoments(window);
    auto out = values.begin();
    double hu[7];
    huInvariants(blob.normalised, hu);
    for (const double value : hu) *out++ = logScaled(value);
    *out++ = static_cast<float>(blob.mass / (kWindowWidth * kWindowHeight));
    *out++ = static_cast<float>(blob.x - (kWindowWidth - 1) / 2.0);
    *out++ = static_cast<float>(blob.y - (kWindowHeight - 1) / 2.0);
    for (int order = 2; order <= 4; ++order) {
        for (int p = order; p >= 0; --p) *out++ = logScaled(blob.normalised[p][order - p]);
    }
    const cv::Mat levels = inLevels(window);
    for (const int distance : {1, 2, 3}) {
        for (const cv::Point direction : {cv::Point(1, 0), cv::Point(1, -1), cv::Point(0, -1), cv::Point(-1, -1)}) {
            for (const float value : haralickFeatures(levels, direction * distance)) *out++ = value;
        }
    }
}

}  // namespace eyrie
