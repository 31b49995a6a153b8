#pragma once

#include <cstdint>
#include <opencv2/core/mat.hpp>
#include <vector>

namespace eyrie {

/// An 8-bit grey picture whose rows may be read (never written) up to `kOverread` pixels past their right end, so that
/// kernels need no special case at the border. What stands there has no meaning.
class PaddedPicture {
 public:
    static constexpr int kOverread = 64;

    PaddedPicture() = default;
    PaddedPicture(int width, int height) { resize(width, height); }

    /// Keeps the memory when it suffices; the contents are undefined afterwards.
    void resize(int width, int height);
    /// Copies a CV_8UC1 picture.
    void copyFrom(const cv::Mat& gray);

    int width() const { return width_; }
    int height() const { return height_; }
    int stride() const { return stride_; }
    bool empty() const { return width_ == 0 || height_ == 0; }
    const std::uint8_t* row(int y) const { return pixels_.data() + std::ptrdiff_t(y) * stride_; }
    std::uint8_t* row(int y) { return pixels_.data() + std::ptrdiff_t(y) * stride_; }

 private:
    int width_ = 0;
    int height_ = 0;
    int stride_ = 0;
    std::vector<std::uint8_t> pixels_;
};

/// Half the size by the mean of 2×2 pixels; an odd last row or column is left out. Pixel (x, y) of the result lies at
/// (2x + ½, 2y + ½) of the source.
void halve(const PaddedPicture& source, PaddedPicture& half);

/// The picture under the binomial mask [1 2 1; 2 4 2; 1 2 1] / 16; border pixels repeat outwards.
void smoothe(const PaddedPicture& source, PaddedPicture& smooth);

}  // namespace eyrie
