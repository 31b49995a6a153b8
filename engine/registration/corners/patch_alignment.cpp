#include "registration/corners/patch_alignment.h"

#include <algorithm>
#include <cmath>

#include "registration/vector_lanes.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "registration/corners/patch_alignment.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace eyrie {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

/// One row of pixels as floats, interpolated between columns.
template <class Tag>
HWY_ATTR HWY_INLINE hn::Vec<Tag> interpolatedRow(Tag floats, const std::uint8_t* pixels, hn::Vec<Tag> fraction) {
    const hn::Rebind<std::uint8_t, Tag> bytes;
    const hn::Rebind<std::int32_t, Tag> ints;
    const auto left = hn::ConvertTo(floats, hn::PromoteTo(ints, hn::LoadU(bytes, pixels)));
    const auto right = hn::ConvertTo(floats, hn::PromoteTo(ints, hn::LoadU(bytes, pixels + 1)));
    return hn::MulAdd(hn::Sub(right, left), fraction, left);
}

template <class Tag>
HWY_ATTR HWY_INLINE float sumOf(Tag floats, hn::Vec<Tag> v) {
    return hn::GetLane(hn::SumOfLanes(floats, v));
}

HWY_ATTR bool prepareRows(const std::int16_t* samples, PatchTemplate& patch) {
    using Floats = hn::CappedTag<float, kVectorLanes>;
    const Floats floats;
    const hn::Rebind<std::int16_t, Floats> shorts;
    const hn::Rebind<std::int32_t, Floats> ints;
    const int lanes = static_cast<int>(hn::Lanes(floats));
    const int window = patch.window_;
    const int pitch = window + 2;
    const auto unit = hn::Set(floats, 1.0F / 64);
    const auto slope = hn::Set(floats, 1.0F / 128);
    auto xx = hn::Zero(floats);
    auto xy = xx;
    auto yy = xx;
    auto mean_x = xx;
    auto mean_y = xx;
    auto mean = xx;
    auto square = xx;
    // The squares lose nothing to cancellation when a grey level from inside the patch is taken off first.
    const auto middle = hn::Set(floats, float(samples[(window / 2 + 1) * pitch + window / 2 + 1]) / 64);
    const auto load = [&](const std::int16_t* from)
                          HWY_ATTR { return hn::ConvertTo(floats, hn::PromoteTo(ints, hn::LoadU(shorts, from))); };
    for (int column = 0; column < window; column += lanes) {
        for (int row = 0; row < window; ++row) {
            const std::int16_t* at = samples + (row + 1) * pitch + column + 1;
            const int cell = row * PatchTemplate::kPitch + column;
            const auto weight = hn::LoadU(floats, patch.weights_ + cell);
            const auto value = hn::Mul(load(at), unit);
            const auto gx = hn::Mul(hn::Sub(load(at + 1), load(at - 1)), slope);
            const auto gy = hn::Mul(hn::Sub(load(at + pitch), load(at - pitch)), slope);
            const auto wx = hn::Mul(weight, gx);
            const auto wy = hn::Mul(weight, gy);
            hn::StoreU(value, floats, patch.values_ + cell);
            hn::StoreU(wx, floats, patch.weighted_gx_ + cell);
            hn::StoreU(wy, floats, patch.weighted_gy_ + cell);
            xx = hn::MulAdd(wx, gx, xx);
            xy = hn::MulAdd(wx, gy, xy);
            yy = hn::MulAdd(wy, gy, yy);
            mean_x = hn::Add(mean_x, wx);
            mean_y = hn::Add(mean_y, wy);
            const auto above = hn::Sub(value, middle);
            const auto weighted = hn::Mul(weight, above);
            mean = hn::Add(mean, weighted);
            square = hn::MulAdd(weighted, above, square);
        }
    }
    patch.mean_gx_ = sumOf(floats, mean_x);
    patch.mean_gy_ = sumOf(floats, mean_y);
    const float m = sumOf(floats, mean);
    patch.contrast_ = std::max(0.0F, sumOf(floats, square) - m * m);
    const float a = sumOf(floats, xx) - patch.mean_gx_ * patch.mean_gx_;
    const float b = sumOf(floats, xy) - patch.mean_gx_ * patch.mean_gy_;
    const float c = sumOf(floats, yy) - patch.mean_gy_ * patch.mean_gy_;
    const float determinant = a * c - b * b;
    if (!(determinant > 1e-3F * a * c) || !(determinant > 1e-4F)) return false;
    patch.inverse_xx_ = c / determinant;
    patch.inverse_xy_ = -b / determinant;
    patch.inverse_yy_ = a / determinant;
    return true;
}

HWY_ATTR Alignment alignRows(const PatchTemplate& patch, const PaddedPicture& picture, cv::Point2f start,
                             const AlignmentLimits& limits) {
    using Floats = hn::CappedTag<float, kVectorLanes>;
    const Floats floats;
    const int lanes = static_cast<int>(hn::Lanes(floats));
    const int window = patch.window_;
    const auto half = float(window / 2);
    const float right = float(picture.width() - 1 - window / 2);
    const float bottom = float(picture.height() - 1 - window / 2);
    const std::ptrdiff_t stride = picture.stride();
    Alignment result;
    result.position = start;
    for (int i = 0; i < limits.max_iterations; ++i) {
        cv::Point2f& p = result.position;
        if (!(p.x >= half && p.y >= half && p.x < right && p.y < bottom)) return result;
        const float left_edge = p.x - half;
        const float top_edge = p.y - half;
        const int x = static_cast<int>(left_edge);
        const int y = static_cast<int>(top_edge);
        const auto fx = hn::Set(floats, left_edge - float(x));
        const auto fy = hn::Set(floats, top_edge - float(y));
        auto sum = hn::Zero(floats);
        auto square = sum;
        auto bx = sum;
        auto by = sum;
        for (int column = 0; column < window; column += lanes) {
            const std::uint8_t* pixels = picture.row(y) + x + column;
            auto upper = interpolatedRow(floats, pixels, fx);
            for (int row = 0; row < window; ++row) {
                pixels += stride;
                const auto lower = interpolatedRow(floats, pixels, fx);
                const int cell = row * PatchTemplate::kPitch + column;
                const auto value = hn::MulAdd(hn::Sub(lower, upper), fy, upper);
                upper = lower;
                const auto error = hn::Sub(value, hn::LoadU(floats, patch.values_ + cell));
                const auto weighted = hn::Mul(error, hn::LoadU(floats, patch.weights_ + cell));
                sum = hn::Add(sum, weighted);
                square = hn::MulAdd(weighted, error, square);
                bx = hn::MulAdd(error, hn::LoadU(floats, patch.weighted_gx_ + cell), bx);
                by = hn::MulAdd(error, hn::LoadU(floats, patch.weighted_gy_ + cell), by);
            }
        }
        const float offset = sumOf(floats, sum);
        const float ex = sumOf(floats, bx) - offset * patch.mean_gx_;
        const float ey = sumOf(floats, by) - offset * patch.mean_gy_;
        const float dx = patch.inverse_xx_ * ex + patch.inverse_xy_ * ey;
        const float dy = patch.inverse_xy_ * ex + patch.inverse_yy_ * ey;
        p.x -= dx;
        p.y -= dy;
        result.residual = std::max(0.0F, sumOf(floats, square) - offset * offset);
        result.iterations = i + 1;
        const float away_x = p.x - start.x;
        const float away_y = p.y - start.y;
        if (!(away_x * away_x + away_y * away_y <= limits.max_shift_px * limits.max_shift_px)) return result;
        if (dx * dx + dy * dy < limits.converged_px * limits.converged_px) {
            result.found = true;
            return result;
        }
    }
    // A step this small is noise about the optimum, not a search that goes on.
    const cv::Point2f& p = result.position;
    result.found = limits.max_iterations > 0 && p.x >= half && p.y >= half && p.x < right && p.y < bottom;
    return result;
}

}  // namespace HWY_NAMESPACE
}  // namespace eyrie
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace eyrie {

HWY_EXPORT(prepareRows);
HWY_EXPORT(alignRows);

bool patchFits(const PaddedPicture& picture, cv::Point2f centre, int window) {
    const auto reach = float(window / 2 + 1);
    return centre.x >= reach && centre.y >= reach && centre.x < float(picture.width() - 1) - reach &&
           centre.y < float(picture.height() - 1) - reach;
}

void cutPatch(const PaddedPicture& picture, cv::Point2f centre, int window, std::int16_t* samples) {
    const int side = window + 2;
    const float left = centre.x - float(window / 2 + 1);
    const float top = centre.y - float(window / 2 + 1);
    const int x = static_cast<int>(left);
    const int y = static_cast<int>(top);
    // Weights in 1/64 in each direction, rounded such that whole positions copy the pixels.
    const int fx = static_cast<int>(std::lround((left - float(x)) * 64));
    const int fy = static_cast<int>(std::lround((top - float(y)) * 64));
    for (int row = 0; row < side; ++row) {
        const std::uint8_t* upper = picture.row(y + row) + x;
        const std::uint8_t* lower = picture.row(y + row + 1) + x;
        for (int column = 0; column < side; ++column) {
            const int a = upper[column] * (64 - fx) + upper[column + 1] * fx;
            const int b = lower[column] * (64 - fx) + lower[column + 1] * fx;
            samples[row * side + column] = static_cast<std::int16_t>((a * (64 - fy) + b * fy + 32) >> 6);
        }
    }
    std::fill(samples + side * side, samples + patchSamples(window), std::int16_t(0));
}

void cutSurrounding(const PaddedPicture& picture, cv::Point centre, int window, std::int16_t* samples) {
    const int reach = surroundingReach(window);
    for (int dy = -reach; dy <= reach; ++dy) {
        const std::uint8_t* row = picture.row(std::clamp(centre.y + dy, 0, picture.height() - 1));
        for (int dx = -reach; dx <= reach; ++dx) {
            *samples++ = static_cast<std::int16_t>(64 * row[std::clamp(centre.x + dx, 0, picture.width() - 1)]);
        }
    }
}

bool turnPatch(const std::int16_t* surrounding, int window, const LocalTurn& present_from_stored,
               std::int16_t* samples) {
    const LocalTurn& t = present_from_stored;
    const float determinant = t.xx * t.yy - t.xy * t.yx;
    if (!(determinant > 0 && determinant < 4)) return false;
    const float xx = t.yy / determinant;
    const float xy = -t.xy / determinant;
    const float yx = -t.yx / determinant;
    const float yy = t.xx / determinant;
    const int reach = surroundingReach(window);
    const int side = window + 2;
    const int half = side / 2;
    const auto farthest = float(half) * std::max(std::abs(xx) + std::abs(xy), std::abs(yx) + std::abs(yy));
    if (!(farthest < float(reach))) return false;
    const int pitch = 2 * reach + 1;
    std::int16_t* out = samples;
    for (int row = -half; row <= half; ++row) {
        // Stays positive, so that truncation rounds down.
        float x = float(reach) - xx * float(half) + xy * float(row);
        float y = float(reach) - yx * float(half) + yy * float(row);
        for (int column = -half; column <= half; ++column, x += xx, y += yx) {
            const int ix = static_cast<int>(x);
            const int iy = static_cast<int>(y);
            const float fx = x - float(ix);
            const float fy = y - float(iy);
            const std::int16_t* at = surrounding + iy * pitch + ix;
            const float upper = float(at[0]) + fx * float(at[1] - at[0]);
            const float lower = float(at[pitch]) + fx * float(at[pitch + 1] - at[pitch]);
            *out++ = static_cast<std::int16_t>(upper + fy * (lower - upper) + 0.5F);
        }
    }
    std::fill(out, samples + patchSamples(window), std::int16_t(0));
    return true;
}

PatchTemplate::PatchTemplate(int window)
    : values_{}, weighted_gx_{}, weighted_gy_{}, weights_{}, window_(window), weight_scale_(0) {
    float sum = 0;
    float squares = 0;
    const auto half = float(window / 2);
    for (int row = 0; row < window; ++row) {
        for (int column = 0; column < window; ++column) {
            const float x = (float(column) - half) / (half + 1);
            const float y = (float(row) - half) / (half + 1);
            const float weight = std::exp(-1.5F * (x * x + y * y));
            weights_[row * kPitch + column] = weight;
            sum += weight;
            squares += weight * weight;
        }
    }
    for (float& weight : weights_) weight /= sum;
    weight_scale_ = sum * sum / squares;
}

bool PatchTemplate::prepare(const std::int16_t* samples) {
    return HWY_DYNAMIC_DISPATCH(prepareRows)(samples, *this);
}

Alignment align(const PatchTemplate& patch, const PaddedPicture& picture, cv::Point2f start,
                const AlignmentLimits& limits) {
    return HWY_DYNAMIC_DISPATCH(alignRows)(patch, picture, start, limits);
}

}  // namespace eyrie
#endif
