#include "registration/corners/corner_strength.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <opencv2/core/types.hpp>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "registration/corners/corner_strength.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace eyrie {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

using Floats = hn::CappedTag<float, 16>;
using Shorts = hn::Rebind<std::int16_t, Floats>;
using Ints = hn::Rebind<std::int32_t, Floats>;
using Bytes = hn::Rebind<std::uint8_t, Floats>;
constexpr int kPad = 32;  // room for whole vectors at both ends of a row buffer

/// The products of the gradient of one row: xx, xy, yy.
struct GradientRow {
    float* xx;
    float* xy;
    float* yy;
};

HWY_ATTR void gradientProducts(const std::uint8_t* above, const std::uint8_t* here, const std::uint8_t* below,
                               int width, std::int16_t* HWY_RESTRICT smooth, std::int16_t* HWY_RESTRICT slope,
                               const GradientRow& out) {
    const Shorts shorts;
    const Ints ints;
    const Floats floats;
    const Bytes bytes;
    const int lanes = static_cast<int>(hn::Lanes(floats));
    for (int x = 0; x < width; x += lanes) {
        const auto a = hn::PromoteTo(shorts, hn::LoadU(bytes, above + x));
        const auto b = hn::PromoteTo(shorts, hn::LoadU(bytes, here + x));
        const auto c = hn::PromoteTo(shorts, hn::LoadU(bytes, below + x));
        hn::StoreU(hn::Add(hn::Add(a, c), hn::Add(b, b)), shorts, smooth + x);
        hn::StoreU(hn::Sub(c, a), shorts, slope + x);
    }
    for (int x = 1; x < width - 1; x += lanes) {
        const auto gx16 = hn::Sub(hn::LoadU(shorts, smooth + x + 1), hn::LoadU(shorts, smooth + x - 1));
        const auto centre = hn::LoadU(shorts, slope + x);
        const auto gy16 = hn::Add(hn::Add(hn::LoadU(shorts, slope + x - 1), hn::LoadU(shorts, slope + x + 1)),
                                  hn::Add(centre, centre));
        const auto gx = hn::ConvertTo(floats, hn::PromoteTo(ints, gx16));
        const auto gy = hn::ConvertTo(floats, hn::PromoteTo(ints, gy16));
        hn::StoreU(hn::Mul(gx, gx), floats, out.xx + x);
        hn::StoreU(hn::Mul(gx, gy), floats, out.xy + x);
        hn::StoreU(hn::Mul(gy, gy), floats, out.yy + x);
    }
}

HWY_ATTR void sumRows(const GradientRow* rows, int count, int width, const GradientRow& sum) {
    const Floats floats;
    const int lanes = static_cast<int>(hn::Lanes(floats));
    for (int x = 1; x < width - 1; x += lanes) {
        auto xx = hn::LoadU(floats, rows[0].xx + x);
        auto xy = hn::LoadU(floats, rows[0].xy + x);
        auto yy = hn::LoadU(floats, rows[0].yy + x);
        for (int row = 1; row < count; ++row) {
            xx = hn::Add(xx, hn::LoadU(floats, rows[row].xx + x));
            xy = hn::Add(xy, hn::LoadU(floats, rows[row].xy + x));
            yy = hn::Add(yy, hn::LoadU(floats, rows[row].yy + x));
        }
        hn::StoreU(xx, floats, sum.xx + x);
        hn::StoreU(xy, floats, sum.xy + x);
        hn::StoreU(yy, floats, sum.yy + x);
    }
}

template <class Tag>
HWY_ATTR HWY_INLINE hn::Vec<Tag> sumAcross(Tag tag, const float* centre, int radius) {
    auto sum = hn::LoadU(tag, centre);
    for (int k = 1; k <= radius; ++k)
        sum = hn::Add(sum, hn::Add(hn::LoadU(tag, centre - k), hn::LoadU(tag, centre + k)));
    return sum;
}

HWY_ATTR void strengthRow(const GradientRow& sum, int width, int radius, float min_roundness,
                          float* HWY_RESTRICT strength) {
    const Floats floats;
    const int lanes = static_cast<int>(hn::Lanes(floats));
    const auto tiny = hn::Set(floats, 1e-3F);
    const auto roundness = hn::Set(floats, min_roundness * 0.25F);
    for (int x = radius + 1; x < width - 1 - radius; x += lanes) {
        const auto xx = sumAcross(floats, sum.xx + x, radius);
        const auto xy = sumAcross(floats, sum.xy + x, radius);
        const auto yy = sumAcross(floats, sum.yy + x, radius);
        const auto determinant = hn::Sub(hn::Mul(xx, yy), hn::Mul(xy, xy));
        const auto trace = hn::Add(xx, yy);
        const auto weight = hn::Div(determinant, hn::Max(trace, tiny));
        const auto round = hn::Ge(weight, hn::Mul(roundness, trace));
        hn::StoreU(hn::IfThenElseZero(round, weight), floats, strength + x);
    }
}

HWY_ATTR void appendPeaks(const float* above, const float* here, const float* below, int y, int first, int end,
                          float threshold, float unit, std::vector<StrengthPeak>& peaks) {
    const Floats floats;
    const int lanes = static_cast<int>(hn::Lanes(floats));
    const auto limit = hn::Set(floats, threshold);
    alignas(64) std::uint8_t bits[8];
    for (int x = first; x < end; x += lanes) {
        const auto value = hn::LoadU(floats, here + x);
        const auto strong = hn::Gt(value, limit);
        if (hn::AllFalse(floats, strong)) continue;
        const auto before = hn::Max(hn::Max(hn::LoadU(floats, above + x - 1), hn::LoadU(floats, above + x)),
                                    hn::Max(hn::LoadU(floats, above + x + 1), hn::LoadU(floats, here + x - 1)));
        const auto after = hn::Max(hn::Max(hn::LoadU(floats, below + x - 1), hn::LoadU(floats, below + x)),
                                   hn::Max(hn::LoadU(floats, below + x + 1), hn::LoadU(floats, here + x + 1)));
        const auto peak = hn::And(strong, hn::And(hn::Gt(value, before), hn::Ge(value, after)));
        hn::StoreMaskBits(floats, peak, bits);
        unsigned found = bits[0] | (lanes > 8 ? unsigned(bits[1]) << 8U : 0U);
        if (lanes < 8) found &= (1U << unsigned(lanes)) - 1U;
        for (; found != 0; found &= found - 1) {
            const int at = x + __builtin_ctz(found);
            if (at >= end) break;
            peaks.push_back({at, y, here[at] * unit});
        }
    }
}

HWY_ATTR void findPeaks(const PaddedPicture& picture, int first_row, int end_row, const StrengthLimits& limits,
                        std::vector<StrengthPeak>& peaks) {
    const int width = picture.width();
    const int height = picture.height();
    const int radius = limits.window_radius;
    const int margin = std::max(limits.margin, radius + 2);
    const int count = 2 * radius + 1;
    first_row = std::max(first_row, margin);
    end_row = std::min(end_row, height - margin);
    if (first_row >= end_row || width <= 2 * margin) return;

    const auto row_floats = static_cast<std::size_t>(width + 2 * kPad);
    std::vector<float> memory(row_floats * std::size_t(3 * count + 3 + 3), 0.0F);
    float* next = memory.data() + kPad;
    const auto take = [&] {
        float* row = next;
        next += row_floats;
        return row;
    };
    std::vector<GradientRow> ring(static_cast<std::size_t>(count));
    for (GradientRow& row : ring) {
        row.xx = take();
        row.xy = take();
        row.yy = take();
    }
    GradientRow sum{};
    sum.xx = take();
    sum.xy = take();
    sum.yy = take();
    float* strength[3] = {take(), take(), take()};
    std::vector<std::int16_t> shorts(2 * row_floats, 0);
    std::int16_t* smooth = shorts.data() + kPad;
    std::int16_t* slope = smooth + row_floats;

    // A Sobel gradient is 8 times the grey level per px, so the strength is 64 times too large.
    constexpr float kUnit = 1.0F / 64;
    const float threshold = limits.min_strength / kUnit;
    const int first_product = first_row - 1 - radius;
    const int end_product = end_row + 1 + radius;
    for (int y = first_product; y < end_product; ++y) {
        gradientProducts(picture.row(y - 1), picture.row(y), picture.row(y + 1), width, smooth, slope,
                         ring[std::size_t(y - first_product) % std::size_t(count)]);
        if (y - first_product + 1 < count) continue;
        const int strength_row = y - radius;
        sumRows(ring.data(), count, width, sum);
        strengthRow(sum, width, radius, limits.min_roundness, strength[strength_row % 3]);
        const int peak_row = strength_row - 1;
        if (peak_row < first_row) continue;
        appendPeaks(strength[(peak_row + 2) % 3], strength[peak_row % 3], strength[(peak_row + 1) % 3], peak_row,
                    margin, width - margin, threshold, kUnit, peaks);
    }
}

}  // namespace HWY_NAMESPACE
}  // namespace eyrie
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace eyrie {

HWY_EXPORT(findPeaks);

void findStrengthPeaks(const PaddedPicture& picture, int first_row, int end_row, const StrengthLimits& limits,
                       std::vector<StrengthPeak>& peaks) {
    HWY_DYNAMIC_DISPATCH(findPeaks)(picture, first_row, end_row, limits, peaks);
}

cv::Point2f refineCorner(const PaddedPicture& picture, int x, int y) {
    constexpr int kRadius = 3;
    constexpr double kFarthest = 1.5;
    double xx = 0;
    double xy = 0;
    double yy = 0;
    double bx = 0;
    double by = 0;
    for (int dy = -kRadius; dy <= kRadius; ++dy) {
        const std::uint8_t* a = picture.row(y + dy - 1) + x;
        const std::uint8_t* b = picture.row(y + dy) + x;
        const std::uint8_t* c = picture.row(y + dy + 1) + x;
        for (int dx = -kRadius; dx <= kRadius; ++dx) {
            const double gx = (a[dx + 1] - a[dx - 1]) + 2 * (b[dx + 1] - b[dx - 1]) + (c[dx + 1] - c[dx - 1]);
            const double gy = (c[dx - 1] - a[dx - 1]) + 2 * (c[dx] - a[dx]) + (c[dx + 1] - a[dx + 1]);
            xx += gx * gx;
            xy += gx * gy;
            yy += gy * gy;
            bx += gx * gx * dx + gx * gy * dy;
            by += gx * gy * dx + gy * gy * dy;
        }
    }
    const double determinant = xx * yy - xy * xy;
    const cv::Point2f whole(static_cast<float>(x), static_cast<float>(y));
    if (determinant <= 1e-4 * xx * yy) return whole;
    const double sx = (yy * bx - xy * by) / determinant;
    const double sy = (xx * by - xy * bx) / determinant;
    if (std::abs(sx) > kFarthest || std::abs(sy) > kFarthest) return whole;
    return {whole.x + static_cast<float>(sx), whole.y + static_cast<float>(sy)};
}

}  // namespace eyrie
#endif
