#pragma once

#include "learning/descriptors/descriptor.h"

namespace eyrie {

/// Histograms of local binary patterns in four quantisations (Teutsch §5.4.3, after Heng et al. 2012): 2×4 blocks of
/// 8×8 px side by side, 256 patterns each; 8,192 values, the shares of a block's pixels. A bit is set where the
/// difference of a neighbour to the centre is, in the four quantisations, ≥ 0; ≥ T; ≥ −T; at least T either way.
/// The thesis does not name them; T = 6 grey values. Beyond the window its border is repeated.
class MultiLbpDescriptor : public Descriptor {
 public:
    static constexpr int kThreshold = 6;

    DescriptorKind kind() const override { return DescriptorKind::multi_lbp; }
    int dimension() const override { return 8192; }
    /// Value index: ((block row · 2 + block column) · 4 + quantisation) · 256 + pattern. Bit p of the pattern is the
    /// neighbour p, clockwise from the right one.
    void compute(const cv::Mat& window, std::span<float> values) const override;
};

}  // namespace eyrie
