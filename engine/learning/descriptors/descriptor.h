#pragma once

#include <cstdint>
#include <memory>
#include <opencv2/core/mat.hpp>
#include <span>
#include <string>
#include <vector>

namespace eyrie {

/// What describes a window to a classifier (Teutsch §5.4.3). The numbers are stored in model files: never change them.
enum class DescriptorKind { moments = 0, dct = 1, hog = 2, channel_features = 3, multi_lbp = 4 };

/// All kinds, in the order of table 7.4.
const std::vector<DescriptorKind>& allDescriptors();
/// The word on the command line: moments, dct, hog, chnftrs, multi_lbp.
const char* nameOf(DescriptorKind kind);
/// What people call it: moments, DCT, HOG, channel features, Multi-LBP.
const char* titleOf(DescriptorKind kind);
/// Throws Error(parameter) naming the known ones.
DescriptorKind descriptorFromName(const std::string& name);

/// Turns a window into a feature vector. Without state that changes: may be used by several threads.
class Descriptor {
 public:
    virtual ~Descriptor() = default;
    virtual DescriptorKind kind() const = 0;
    virtual int dimension() const = 0;
    /// `window` is CV_8UC1, 16 wide and 32 high, heading up; `values` takes dimension() numbers, all finite.
    virtual void compute(const cv::Mat& window, std::span<float> values) const = 0;
};

/// `seed` chooses the rectangles of the channel features; the others do not depend on it.
std::unique_ptr<Descriptor> makeDescriptor(DescriptorKind kind, std::uint64_t seed);

/// One row per window.
cv::Mat1f describeWindows(const Descriptor& descriptor, const std::vector<cv::Mat>& windows);

}  // namespace eyrie
