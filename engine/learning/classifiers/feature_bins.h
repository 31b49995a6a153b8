#pragma once

#include <cstdint>
#include <opencv2/core/mat.hpp>
#include <span>
#include <vector>

namespace eyrie {

/// Features sorted into at most 32 bins each, so that trees find their best split by adding up bins.
class FeatureBins {
 public:
    static constexpr int kBins = 32;

    /// Borders are chosen between neighbouring values of `features` (one row per sample) so that bins hold about
    /// equally many samples.
    explicit FeatureBins(const cv::Mat1f& features);

    int features() const { return static_cast<int>(borders_.size()); }
    /// Bin of every sample, in the samples' order.
    std::span<const std::uint8_t> codes(int feature) const {
        return {codes_.data() + static_cast<std::size_t>(feature) * samples_, samples_};
    }
    /// Ascending; a value belongs to bin k when it is at least borders[k − 1] and below borders[k].
    const std::vector<float>& borders(int feature) const { return borders_[static_cast<std::size_t>(feature)]; }

 private:
    std::size_t samples_;
    std::vector<std::vector<float>> borders_;
    std::vector<std::uint8_t> codes_;
};

}  // namespace eyrie
