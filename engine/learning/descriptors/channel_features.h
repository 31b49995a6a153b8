#pragma once

#include <cstdint>
#include <vector>

#include "learning/descriptors/descriptor.h"
#include "learning/descriptors/integral_channels.h"

namespace eyrie {

/// A first-order feature: the sum of one channel over a rectangle of the window.
struct ChannelRectangle {
    int channel = 0;
    cv::Rect area;  ///< px of the window; never touches its outermost ring, see ChannelFeatures
    bool operator==(const ChannelRectangle&) const = default;
};

/// The thesis' number of features.
inline constexpr int kChannelFeatureCount = 2000;

/// Random rectangles of 2 px and more a side; the same seed gives the same ones on every machine.
std::vector<ChannelRectangle> randomRectangles(std::uint64_t seed, int count = kChannelFeatureCount);

/// Whether a rectangle lies where ChannelFeatures allows it.
bool isAllowed(const ChannelRectangle& rectangle);

/// Integral channel features, ChnFtrs (Teutsch §5.4.3, Dollár 2009): sums over random rectangles in seven channels.
/// Rectangles keep off the window's outermost ring, whose gradients depend on pixels outside: so the features of a
/// window are the same whether it is described alone or as part of a large image, where windows share the channels.
class ChannelFeatures : public Descriptor {
 public:
    /// Throws Error(internal) when a rectangle is not allowed.
    explicit ChannelFeatures(std::vector<ChannelRectangle> rectangles);

    DescriptorKind kind() const override { return DescriptorKind::channel_features; }
    int dimension() const override { return static_cast<int>(rectangles_.size()); }
    void compute(const cv::Mat& window, std::span<float> values) const override;
    const std::vector<ChannelRectangle>& rectangles() const { return rectangles_; }

 private:
    std::vector<ChannelRectangle> rectangles_;
};

}  // namespace eyrie
