#pragma once

#include "learning/descriptors/descriptor.h"

namespace eyrie {

/// Histograms of oriented gradients (Teutsch §5.4.3): 3×7 blocks of 8×8 px with a stride of 4, each of 2×2 cells of
/// 4×4 px and 9 unsigned orientations of 20°; 756 values. Magnitudes are shared between the two nearest orientations;
/// each block is normalised to length 1, cut at 0.2 and normalised again. Beyond the window its border is repeated.
class HogDescriptor : public Descriptor {
 public:
    DescriptorKind kind() const override { return DescriptorKind::hog; }
    int dimension() const override { return 756; }
    void compute(const cv::Mat& window, std::span<float> values) const override;
};

}  // namespace eyrie
