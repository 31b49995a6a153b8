#include "registration/pictures/padded_picture.h"

#include <algorithm>
#include <cstring>

namespace eyrie {
namespace {

void halveRow(const std::uint8_t* upper, const std::uint8_t* lower, int width, std::uint8_t* out) {
    for (int x = 0; x < width; ++x) {
        const int sum = upper[2 * x] + upper[2 * x + 1] + lower[2 * x] + lower[2 * x + 1];
        out[x] = static_cast<std::uint8_t>((sum + 2) >> 2);
    }
}

void addRows(const std::uint8_t* above, const std::uint8_t* here, const std::uint8_t* below, int width,
             std::uint16_t* sum) {
    for (int x = 0; x < width; ++x) sum[x] = static_cast<std::uint16_t>(above[x] + 2 * here[x] + below[x]);
}

void addColumns(const std::uint16_t* sum, int width, std::uint8_t* out) {
    for (int x = 0; x < width; ++x) out[x] = static_cast<std::uint8_t>((sum[x - 1] + 2 * sum[x] + sum[x + 1] + 8) >> 4);
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

void smoothe(const PaddedPicture& source, PaddedPicture& smooth) {
    const int width = source.width();
    const int height = source.height();
    smooth.resize(width, height);
    std::vector<std::uint16_t> padded(std::size_t(width) + 2);
    std::uint16_t* sum = padded.data() + 1;
    for (int y = 0; y < height; ++y) {
        addRows(source.row(std::max(y - 1, 0)), source.row(y), source.row(std::min(y + 1, height - 1)), width, sum);
        sum[-1] = sum[0];
        sum[width] = sum[width - 1];
        addColumns(sum, width, smooth.row(y));
    }
}

}  // namespace eyrie
