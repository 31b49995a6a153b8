#include "imaging/thresholds.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <vector>

namespace eyrie {

namespace {

/// The positive values in the mask, in reading order, and how many pixels there are in all.
RankedValues positiveValues(const cv::Mat& values, const cv::Mat& mask) {
    CV_Assert(values.empty() || (values.type() == CV_32FC1 && mask.type() == CV_8UC1 && mask.size() == values.size()));
    RankedValues found;
    found.positive.reserve(values.total());
    for (int y = 0; y < values.rows; ++y) {
        const float* value = values.ptr<float>(y);
        const uchar* in = mask.ptr<uchar>(y);
        for (int x = 0; x < values.cols; ++x) {
            if (!in[x]) continue;
            ++found.counted;
            if (value[x] > 0) found.positive.push_back(value[x]);
        }
    }
    return found;
}

/// Place of the threshold among `positive` values in descending order.
std::ptrdiff_t placeOfQuantile(std::size_t positive, std::size_t counted, double q) {
    const double share = std::clamp(q, 0.0, 1.0) * static_cast<double>(counted);
    const auto wanted = static_cast<std::size_t>(std::max(1.0, std::floor(share + 1e-9)));
    return static_cast<std::ptrdiff_t>(std::min(wanted, positive) - 1);
}

}  // namespace

RankedValues rankedValues(const cv::Mat& values, const cv::Mat& mask) {
    RankedValues found = positiveValues(values, mask);
    std::sort(found.positive.begin(), found.positive.end(), std::greater<>());
    found.positive.shrink_to_fit();
    return found;
}

std::optional<float> quantileThreshold(const std::vector<float>& ranked, std::size_t counted, double q) {
    if (ranked.empty()) return std::nullopt;
    return ranked[static_cast<std::size_t>(placeOfQuantile(ranked.size(), counted, q))];
}

std::optional<float> quantileThreshold(const cv::Mat& values, const cv::Mat& mask, double q) {
    auto [positive, counted] = positiveValues(values, mask);
    if (positive.empty()) return std::nullopt;
    const auto last = positive.begin() + placeOfQuantile(positive.size(), counted, q);
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
