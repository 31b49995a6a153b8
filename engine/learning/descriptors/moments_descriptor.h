#pragma once

#include "learning/descriptors/descriptor.h"

namespace eyrie {

/// MOMENTS (Teutsch §5.4.3): Hu moments, central moments and Haralick features, 178 values. The thesis does not say
/// which; ours are
///   0 –  6  Hu's invariants of the blob, log-scaled with their sign
///   7       the blob's mean brightness, 8 – 9 its centroid relative to the window's centre, px
///  10 – 21  scale-normalised central moments of order 2, 3 and 4, log-scaled with their sign, x powers descending
///  22 –177  Haralick's 13 features of the grey values in 16 levels over the window's range, for steps of 1, 2 and
///           3 px in the directions →, ↗, ↑, ↖
/// The blob is the absolute difference of each pixel to the median of the window's border, so that dark and bright
/// vehicles look alike.
class MomentsDescriptor : public Descriptor {
 public:
    DescriptorKind kind() const override { return DescriptorKind::moments; }
    int dimension() const override { return 178; }
    void compute(const cv::Mat& window, std::span<float> values) const override;
};

}  // namespace eyrie
