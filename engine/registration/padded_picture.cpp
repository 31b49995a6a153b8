#include "registration/padded_picture.h"

#include <cstring>

namespace eyrie {
namespace {

void halveRow(const std::uint8_t* upper, const std::uint8_t* lower, int width, std::uint8_t* out) {
    for (int x = 0; x < width; ++x) {
        const int sum = upper[2 * x] + upper[2 * x + 1] + lower[2 * x] + lower[2 * x + 1];
        out[x] = static_cast<std::uint8_t>((sum + 2) >> 2);
    }
}

}  // namespace

void PaddedPicture::resize(int width, int height) {
    width_ = width;
    height_ = height;
    stride_ = (width + 63) / 64 * 64 + kOverread;
    pixels_.resize(std::size_t(stride_) * std::size_t(height) + kOverread);
}

void PaddedPicture::copyFrom(const cv::Mat& gray) {
    resize(gray.cols, gray.rows);
    for (int y = 0; y < height_; ++y) std::memcpy(row(y), gray.ptr(y), std::size_t(width_));
}

void halve(const PaddedPicture& source, PaddedPicture& half) {
    half.resize(source.width() / 2, source.height() / 2);
    for (int y = 0; y < half.height(); ++y)
        halveRow(source.row(2 * y), source.row(2 * y + 1), half.width(), half.row(y));
}

}  // namespace eyrie
