#include "learning/classifiers/feature_bins.h"

#include <algorithm>
#include <opencv2/core/utility.hpp>

namespace eyrie {
namespace {

/// A border that separates a from the larger b for floats.
float between(float a, float b) {
    const float middle = a + (b - a) / 2;
    return middle > a ? middle : b;
}

std::vector<float> chooseBorders(std::vector<float> values) {
    std::sort(values.begin(), values.end());
    std::vector<float> distinct;
    std::unique_copy(values.begin(), values.end(), std::back_inserter(distinct));
    std::vector<float> borders;
    if (distinct.size() <= FeatureBins::kBins) {
        for (std::size_t i = 1; i < distinct.size(); ++i) borders.push_back(between(distinct[i - 1], distinct[i]));
        return borders;
    }
    float before = distinct.front();
    for (std::size_t k = 1; k < FeatureBins::kBins; ++k) {
        const float value = values[values.size() * k / FeatureBins::kBins];
        auto at = std::lower_bound(distinct.begin(), distinct.end(), value);
        // A value that fills a whole bin is parted from the larger ones too.
        if (value == before) ++at;
        before = value;
        if (at == distinct.end()) continue;
        const float border = between(*(at - 1), *at);
        if (borders.empty() || border > borders.back()) borders.push_back(border);
    }
    return borders;
}

}  // namespace

FeatureBins::FeatureBins(const cv::Mat1f& features)
    : samples_(static_cast<std::size_t>(features.rows)),
      borders_(static_cast<std::size_t>(features.cols)),
      codes_(samples_ * borders_.size()) {
    cv::parallel_for_(cv::Range(0, features.cols), [&](const cv::Range& range) {
        std::vector<float> values(samples_);
        for (int f = range.start; f < range.end; ++f) {
            for (std::size_t i = 0; i < samples_; ++i) values[i] = features(static_cast<int>(i), f);
            const std::vector<float> borders = chooseBorders(values);
            std::uint8_t* codes = codes_.data() + static_cast<std::size_t>(f) * samples_;
            for (std::size_t i = 0; i < samples_; ++i) {
                codes[i] = static_cast<std::uint8_t>(std::upper_bound(borders.begin(), borders.end(), values[i]) -
                                                     borders.begin());
            }
            borders_[static_cast<std::size_t>(f)] = borders;
        }
    });
}

}  // namespace eyrie
