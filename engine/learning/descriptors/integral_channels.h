#pragma once

#include <cstddef>
#include <cstdint>
#include <opencv2/core/mat.hpp>
#include <vector>

namespace eyrie {

/// The seven channels of an image (Teutsch §5.4.3, fig. 5.26 a) as integral images: channel 0 is the gradient
/// magnitude, channels 1 to 6 hold the magnitude where the gradient's axis is nearest to 0°, 30°, 60°, 90°, 120° and
/// 150° (clockwise on screen from +x), and 0 elsewhere.
/// Magnitudes are half the central differences' length, rounded, at most 127; the image's outermost ring of pixels has
/// none (0). Sums wrap around at 2¹⁶, which keeps every rectangle of up to 516 px exact: 127 · 516 < 2¹⁶.
class IntegralChannels {
 public:
    static constexpr int kChannels = 7;
    static constexpr int kLargestMagnitude = 127;

    /// `gray` is CV_8UC1, not empty.
    explicit IntegralChannels(const cv::Mat& gray);

    int width() const { return width_; }
    int height() const { return height_; }
    /// Position of the corner above and left of pixel (x, y) of a channel in `data`; x may be width() and y height().
    /// Reading up to `kPadding` values beyond a row's end is allowed.
    std::size_t offset(int channel, int x, int y) const {
        return (static_cast<std::size_t>(channel) * static_cast<std::size_t>(height_ + 1) +
                static_cast<std::size_t>(y)) *
                   stride_ +
               static_cast<std::size_t>(x);
    }
    const std::uint16_t* data() const { return sums_.data(); }
    std::size_t stride() const { return stride_; }
    /// Sum of a channel over a rectangle of at most 516 px inside the image.
    std::uint16_t sum(int channel, const cv::Rect& area) const;

    static constexpr int kPadding = 128;  ///< at least as many values as the widest vector holds

 private:
    int width_;
    int height_;
    std::size_t stride_;
    std::vector<std::uint16_t> sums_;
};

}  // namespace eyrie
