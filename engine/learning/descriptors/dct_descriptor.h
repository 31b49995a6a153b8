#pragma once

#include "learning/descriptors/descriptor.h"

namespace eyrie {

/// Local discrete cosine transform (Teutsch §5.4.3): 3×7 blocks of 8×8 px with a stride of 4, of each the first 21
/// coefficients in zigzag order (those with column + row ≤ 5), orthonormal; 441 values.
class DctDescriptor : public Descriptor {
 public:
    DescriptorKind kind() const override { return DescriptorKind::dct; }
    int dimension() const override { return 441; }
    void compute(const cv::Mat& window, std::span<float> values) const override;
};

}  // namespace eyrie
