#include "imaging/thresholds.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <vector>

namespace eyrie {

std::optional<float> quantileThreshold(const cv::Mat& values, const cv::Mat& mask, double q) {
    CV_Assert(values.empty() || (values.type() == CV_32FC1 && mask.type() == CV_8UC1 && mask.size() == values.size()));
    std::vector<float> positive;
    positive.reserve(values.total());
    std::size_t counted = 0;
    for (int y = 0; y < values.rows; ++y) {
        const float* value = values.ptr<float>(y);
        const uchar* in = mask.ptr<uchar>(y);
        for (int x = 0; x < values.cols; ++x) {
            if (!in[x]) continue;
            ++counted;
            if (value[x] > 0) positive.push_back(value[x]);
        }
    }
    if (positive.empty()) return std::nullopt;
    const double share = std::clamp(q, 0.0, 1.0) * static_cast<double>(counted);
    const auto wanted = static_cast<std::size_t>(std::max(1.0, std::floor(share + 1e-9)));
    const auto last = positive.begin() + static_cast<std::ptrdiff_t>(std::min(wanted, positive.size()) - 1);
    std::nth_element(positive.begin(), last, positive.end(), std::greater<>());
    return *last;
}

void binarise(const cv::Mat& values, const cv::Mat& mask, float threshold, cv::Mat& binary) {
    CV_Assert(values.empty() || (values.type() == CV_32FC1 && mask.type() == CV_8UC1 && mask.size() == values.size()));
    binary.create(values.size(), CV_8UC1);
    for (int y = 0; y < values.rows; ++y) {
        const float* value = values.ptr<float>(y);
        const uchar* in = mask.ptr<uchar>(y);
        uchar* out = binary.ptr<uchar>(y);
        for (int x = 0; x < values.cols; ++x) out[x] = (in[x] != 0 && value[x] >= threshold) ? 255 : 0;
    }
}

}  // namespace eyrie
