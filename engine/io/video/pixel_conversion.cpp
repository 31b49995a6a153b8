#include "io/video/pixel_conversion.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "core/error.h"

namespace eyrie {

namespace {

const AVPixFmtDescriptor& descriptorOf(const AVFrame& picture) {
    const AVPixFmtDescriptor* descriptor = av_pix_fmt_desc_get(static_cast<AVPixelFormat>(picture.format));
    if (descriptor == nullptr || (descriptor->flags & AV_PIX_FMT_FLAG_HWACCEL))
        throw Error(ErrorKind::input, "the pixel format of the video is unknown; convert it to H.264");
    return *descriptor;
}

bool isFullRange(const AVFrame& picture, const AVPixFmtDescriptor& descriptor) {
    if (picture.color_range == AVCOL_RANGE_JPEG || (descriptor.flags & AV_PIX_FMT_FLAG_RGB)) return true;
    if (std::strncmp(descriptor.name, "yuvj", 4) == 0) return true;
    const bool only_luma = descriptor.nb_components <= 2;
    return picture.color_range == AVCOL_RANGE_UNSPECIFIED && only_luma;
}

/// Eight-bit value of every sample of this depth.
std::vector<std::uint8_t> lumaTable(int depth, bool full_range) {
    const double unit = std::ldexp(1.0, depth - 8);
    const double black = full_range ? 0 : 16 * unit;
    const double white = full_range ? std::ldexp(1.0, depth) - 1 : 235 * unit;
    std::vector<std::uint8_t> table(std::size_t{1} << depth);
    for (std::size_t sample = 0; sample < table.size(); ++sample) {
        const double value = (static_cast<double>(sample) - black) * 255.0 / (white - black);
        table[sample] = static_cast<std::uint8_t>(std::clamp(std::lround(value), 0L, 255L));
    }
    return table;
}

/// Luma lies in samples of its own that can be looked up one by one.
bool hasPlainLuma(const AVPixFmtDescriptor& descriptor) {
    constexpr auto odd = AV_PIX_FMT_FLAG_RGB | AV_PIX_FMT_FLAG_PAL | AV_PIX_FMT_FLAG_BITSTREAM | AV_PIX_FMT_FLAG_BE |
                         AV_PIX_FMT_FLAG_FLOAT | AV_PIX_FMT_FLAG_BAYER;
    return (descriptor.flags & odd) == 0 && descriptor.comp[0].depth >= 8 && descriptor.comp[0].depth <= 16;
}

int colourMatrix(const AVFrame& picture) {
    switch (picture.colorspace) {
        case AVCOL_SPC_BT709:
            return SWS_CS_ITU709;
        case AVCOL_SPC_BT470BG:
        case AVCOL_SPC_SMPTE170M:
            return SWS_CS_ITU601;
        case AVCOL_SPC_FCC:
            return SWS_CS_FCC;
        case AVCOL_SPC_SMPTE240M:
            return SWS_CS_SMPTE240M;
        case AVCOL_SPC_BT2020_NCL:
        case AVCOL_SPC_BT2020_CL:
            return SWS_CS_BT2020;
        default:
            return picture.height >= 720 ? SWS_CS_ITU709 : SWS_CS_ITU601;  // the players' guess
    }
}

}  // namespace

cv::Mat PixelConversion::gray(const AVFrame& picture) {
    const AVPixFmtDescriptor& descriptor = descriptorOf(picture);
    cv::Mat result;
    if (!hasPlainLuma(descriptor)) {
        cv::cvtColor(colour(picture), result, cv::COLOR_BGR2GRAY);
        return result;
    }
    const AVComponentDescriptor& luma = descriptor.comp[0];
    const bool full_range = isFullRange(picture, descriptor);
    std::uint8_t* plane = picture.data[luma.plane] + luma.offset;
    const std::ptrdiff_t stride = picture.linesize[luma.plane];
    if (luma.depth == 8 && luma.step == 1 && luma.shift == 0 && stride > 0) {
        const cv::Mat samples(picture.height, picture.width, CV_8UC1, plane, static_cast<std::size_t>(stride));
        if (full_range) return samples.clone();
        if (luma_table_.empty() || table_full_ != full_range) {
            luma_table_ = cv::Mat(lumaTable(8, full_range), true).reshape(1, 1);
            table_full_ = full_range;
        }
        cv::LUT(samples, luma_table_, result);
        return result;
    }

    const std::vector<std::uint8_t> table = lumaTable(luma.depth, full_range);
    const unsigned mask = (1U << luma.depth) - 1;
    result.create(picture.height, picture.width, CV_8UC1);
    for (int y = 0; y < picture.height; ++y) {
        const std::uint8_t* sample = plane + y * stride;
        std::uint8_t* row = result.ptr<std::uint8_t>(y);
        for (int x = 0; x < picture.width; ++x, sample += luma.step) {
            unsigned value = *sample;
            if (luma.depth + luma.shift > 8) value |= static_cast<unsigned>(sample[1]) << 8;
            row[x] = table[(value >> luma.shift) & mask];
        }
    }
    return result;
}

cv::Mat PixelConversion::colour(const AVFrame& picture) {
    const AVPixFmtDescriptor& descriptor = descriptorOf(picture);
    SwsContext* scaler = sws_getCachedContext(scaler_.release(), picture.width, picture.height,
                                              static_cast<AVPixelFormat>(picture.format), picture.width, picture.height,
                                              AV_PIX_FMT_BGR24, SWS_BILINEAR | SWS_ACCURATE_RND | SWS_FULL_CHR_H_INT,
                                              nullptr, nullptr, nullptr);
    if (scaler == nullptr)
        throw Error(ErrorKind::input, "the pixel format of the video cannot be shown; convert it to H.264");
    scaler_.reset(scaler);
    const int* matrix = sws_getCoefficients(colourMatrix(picture));
    sws_setColorspaceDetails(scaler, matrix, isFullRange(picture, descriptor) ? 1 : 0, matrix, 1, 0, 1 << 16, 1 << 16);

    cv::Mat result(picture.height, picture.width, CV_8UC3);
    std::uint8_t* rows[4] = {result.data, nullptr, nullptr, nullptr};
    const int strides[4] = {static_cast<int>(result.step), 0, 0, 0};
    sws_scale(scaler, picture.data, picture.linesize, 0, picture.height, rows, strides);
    return result;
}

}  // namespace eyrie
