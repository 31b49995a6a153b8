#include "learning/descriptors/integral_channels.h"

#include <algorithm>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "learning/descriptors/integral_channels.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace eyrie::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

/// Magnitude and channel (1 … 6) of `count` pixels. Rows start one pixel to the left of the first of them and end one
/// to the right of the last. Orientations are decided by comparing the components, the gradient's axis being folded
/// into the lower half plane; the bins' borders lie at 15°, 45° and 75° so that mirroring maps bins to bins.
void gradientRow(const std::uint8_t* above, const std::uint8_t* row, const std::uint8_t* below, int count,
                 std::uint8_t* magnitude, std::uint8_t* channel) {
    const hn::ScalableTag<float> real;
    const hn::Rebind<std::uint8_t, decltype(real)> bytes;
    const hn::Rebind<std::int32_t, decltype(real)> whole;
    const auto lanes = static_cast<int>(hn::Lanes(real));
    const auto load = [&](const std::uint8_t* from) {
        return hn::ConvertTo(real, hn::PromoteTo(whole, hn::LoadU(bytes, from)));
    };
    const auto zero = hn::Zero(real);
    const auto one = hn::Set(real, 1.F);
    for (int x = 0; x < count; x += lanes) {
        const auto gx = hn::Sub(load(row + x + 2), load(row + x));
        const auto gy = hn::Sub(load(below + x + 1), load(above + x + 1));
        const auto length = hn::Sqrt(hn::Add(hn::Mul(gx, gx), hn::Mul(gy, gy)));
        const auto half = hn::Min(hn::Mul(length, hn::Set(real, 0.5F)),
                                  hn::Set(real, static_cast<float>(IntegralChannels::kLargestMagnitude)));
        hn::StoreU(hn::DemoteTo(bytes, hn::NearestInt(half)), bytes, magnitude + x);
        const auto down = hn::Abs(gy);
        const auto side = hn::Abs(gx);
        const auto step = [&](float tangent) {
            return hn::IfThenElseZero(hn::Gt(down, hn::Mul(side, hn::Set(real, tangent))), one);
        };
        const auto bin = hn::Add(step(0.267949192F), hn::Add(step(1.F), step(3.732050808F)));  // 0 … 3
        const auto leans_back = hn::Lt(hn::Mul(gx, gy), zero);
        const auto number = hn::IfThenElse(leans_back, hn::Sub(hn::Set(real, 7.F), bin), hn::Add(bin, one));
        // A component so steep that it counts as 0° leans nowhere.
        const auto folded = hn::IfThenElse(hn::Gt(number, hn::Set(real, 6.F)), one, number);
        hn::StoreU(hn::DemoteTo(bytes, hn::ConvertTo(whole, folded)), bytes, channel + x);
    }
}

/// One row of an integral channel: out[x + 1] = up[x + 1] + Σ magnitudes of pixels 0 … x in the channel (0: all).
/// Works in steps of 8 pixels and writes up to 7 values beyond the row.
#if HWY_TARGET == HWY_SCALAR
void integralRow(const std::uint8_t* magnitude, const std::uint8_t* channels, int channel, int count,
                 const std::uint16_t* up, std::uint16_t* out) {
    unsigned sum = 0;
    out[0] = 0;
    for (int x = 0; x < count; ++x) {
        if (channel == 0 || channels[x] == channel) sum += magnitude[x];
        out[x + 1] = static_cast<std::uint16_t>(up[x + 1] + sum);
    }
}
#else
void integralRow(const std::uint8_t* magnitude, const std::uint8_t* channels, int channel, int count,
                 const std::uint16_t* up, std::uint16_t* out) {
    const hn::FixedTag<std::uint16_t, 8> words;
    const hn::FixedTag<std::uint8_t, 8> bytes;
    const auto wanted = hn::Set(bytes, static_cast<std::uint8_t>(channel));
    auto carried = hn::Zero(words);
    out[0] = 0;
    for (int x = 0; x < count; x += 8) {
        auto here = hn::LoadU(bytes, magnitude + x);
        if (channel > 0) here = hn::IfThenElseZero(hn::Eq(hn::LoadU(bytes, channels + x), wanted), here);
        auto sums = hn::PromoteTo(words, here);
        sums = hn::Add(sums, hn::ShiftLeftLanes<1>(words, sums));
        sums = hn::Add(sums, hn::ShiftLeftLanes<2>(words, sums));
        sums = hn::Add(sums, hn::ShiftLeftLanes<4>(words, sums));
        sums = hn::Add(sums, carried);
        carried = hn::Broadcast<7>(sums);
        hn::StoreU(hn::Add(sums, hn::LoadU(words, up + x + 1)), words, out + x + 1);
    }
}
#endif

}  // namespace eyrie::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE

namespace eyrie {

HWY_EXPORT(gradientRow);
HWY_EXPORT(integralRow);

IntegralChannels::IntegralChannels(const cv::Mat& gray) : width_(gray.cols), height_(gray.rows) {
    CV_Assert(gray.type() == CV_8UC1 && !gray.empty());
    const auto padded = static_cast<std::size_t>(width_ + kPadding);
    stride_ = (padded + 31) / 32 * 32;
    sums_.assign(stride_ * static_cast<std::size_t>(height_ + 1) * kChannels + kPadding, 0);
    // Rows are copied with padding, as the kernels read whole vectors.
    std::vector<std::uint8_t> rows(3 * padded);
    std::vector<std::uint8_t> magnitude(padded);
    std::vector<std::uint8_t> channel(padded);
    for (int y = 0; y < height_; ++y) {
        std::fill(magnitude.begin(), magnitude.end(), std::uint8_t{0});
        std::fill(channel.begin(), channel.end(), std::uint8_t{0});
        if (y > 0 && y + 1 < height_ && width_ > 2) {
            const std::uint8_t* from[3];
            for (int k = 0; k < 3; ++k) {
                std::uint8_t* copy = rows.data() + static_cast<std::size_t>(k) * padded;
                std::copy_n(gray.ptr<std::uint8_t>(y - 1 + k), width_, copy);
                from[k] = copy;
            }
            HWY_DYNAMIC_DISPATCH(gradientRow)
            (from[0], from[1], from[2], width_ - 2, magnitude.data() + 1, channel.data() + 1);
            // The vectors ran over the row's end.
            std::fill(magnitude.begin() + width_ - 1, magnitude.end(), std::uint8_t{0});
        }
        for (int c = 0; c < kChannels; ++c) {
            HWY_DYNAMIC_DISPATCH(integralRow)
            (magnitude.data(), channel.data(), c, width_, sums_.data() + offset(c, 0, y),
             sums_.data() + offset(c, 0, y + 1));
        }
    }
}

std::uint16_t IntegralChannels::sum(int channel, const cv::Rect& area) const {
    const int right = area.x + area.width;
    const int bottom = area.y + area.height;
    const int value = sums_[offset(channel, right, bottom)] - sums_[offset(channel, area.x, bottom)] -
                      sums_[offset(channel, right, area.y)] + sums_[offset(channel, area.x, area.y)];
    return static_cast<std::uint16_t>(value);
}

}  // namespace eyrie
#endif
