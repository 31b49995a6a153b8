#include "registration/estimation/normal_equations.h"

#include <algorithm>

#include "registration/vector_lanes.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "registration/estimation/normal_equations.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace eyrie {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

using Floats = hn::CappedTag<float, kVectorLanes>;
using Vector = hn::Vec<Floats>;

/// The homography's numbers, one in each lane of a vector.
struct SpreadHomography {
    Vector h0, h1, h2, h3, h4, h5, h6, h7;
};

HWY_ATTR HWY_INLINE SpreadHomography spread(const HomographyParameters& h) {
    const Floats f;
    return {hn::Set(f, h[0]), hn::Set(f, h[1]), hn::Set(f, h[2]), hn::Set(f, h[3]),
            hn::Set(f, h[4]), hn::Set(f, h[5]), hn::Set(f, h[6]), hn::Set(f, h[7])};
}

struct Projected {
    Vector u, v, inverse_w;
};

HWY_ATTR HWY_INLINE Projected project(const SpreadHomography& h, Vector x, Vector y) {
    const Floats f;
    const auto w = hn::MulAdd(h.h6, x, hn::MulAdd(h.h7, y, hn::Set(f, 1.0F)));
    const auto inverse = hn::Div(hn::Set(f, 1.0F), w);
    const auto u = hn::Mul(hn::MulAdd(h.h0, x, hn::MulAdd(h.h1, y, h.h2)), inverse);
    const auto v = hn::Mul(hn::MulAdd(h.h3, x, hn::MulAdd(h.h4, y, h.h5)), inverse);
    return {u, v, inverse};
}

/// Sums of a stretch short enough for single precision; `count` is a multiple of the vector length or ends the data, in
/// which case the missing lanes are filled from `tail`.
HWY_ATTR void addStretch(const float* px, const float* py, const float* pu, const float* pv, const float* pw, int count,
                         const HomographyParameters& homography, float cutoff, NormalSums& sums) {
    const Floats f;
    const int lanes = static_cast<int>(hn::Lanes(f));
    const SpreadHomography h = spread(homography);
    const auto one = hn::Set(f, 1.0F);
    const auto inverse_cutoff = hn::Set(f, 1.0F / (cutoff * cutoff));
    const auto zero = hn::Zero(f);
    Vector m0 = zero, m1 = zero, m2 = zero, m3 = zero, m4 = zero, m5 = zero;
    Vector u0 = zero, u1 = zero, u2 = zero, u3 = zero, u4 = zero;
    Vector v0 = zero, v1 = zero, v2 = zero, v3 = zero, v4 = zero;
    Vector s0 = zero, s1 = zero, s3 = zero;
    Vector rx0 = zero, rx1 = zero, rx2 = zero, ry0 = zero, ry1 = zero, ry2 = zero, rp0 = zero, rp1 = zero;
    Vector total = zero;
    for (int i = 0; i < count; i += lanes) {
        const auto x = hn::LoadU(f, px + i);
        const auto y = hn::LoadU(f, py + i);
        const Projected p = project(h, x, y);
        const auto ex = hn::Sub(p.u, hn::LoadU(f, pu + i));
        const auto ey = hn::Sub(p.v, hn::LoadU(f, pv + i));
        const auto square = hn::MulAdd(ex, ex, hn::Mul(ey, ey));
        const auto q = hn::Max(zero, hn::NegMulAdd(square, inverse_cutoff, one));
        const auto weight = hn::Mul(hn::Mul(q, q), hn::LoadU(f, pw + i));
        const auto kr = hn::Mul(weight, p.inverse_w);
        const auto k = hn::Mul(kr, p.inverse_w);
        const auto kx = hn::Mul(k, x);
        const auto ky = hn::Mul(k, y);
        const auto kxx = hn::Mul(kx, x);
        const auto kxy = hn::Mul(kx, y);
        const auto kyy = hn::Mul(ky, y);
        m0 = hn::Add(m0, kxx);
        m1 = hn::Add(m1, kxy);
        m2 = hn::Add(m2, kx);
        m3 = hn::Add(m3, kyy);
        m4 = hn::Add(m4, ky);
        m5 = hn::Add(m5, k);
        u0 = hn::MulAdd(kxx, p.u, u0);
        u1 = hn::MulAdd(kxy, p.u, u1);
        u2 = hn::MulAdd(kx, p.u, u2);
        u3 = hn::MulAdd(kyy, p.u, u3);
        u4 = hn::MulAdd(ky, p.u, u4);
        v0 = hn::MulAdd(kxx, p.v, v0);
        v1 = hn::MulAdd(kxy, p.v, v1);
        v2 = hn::MulAdd(kx, p.v, v2);
        v3 = hn::MulAdd(kyy, p.v, v3);
        v4 = hn::MulAdd(ky, p.v, v4);
        const auto radius = hn::MulAdd(p.u, p.u, hn::Mul(p.v, p.v));
        s0 = hn::MulAdd(kxx, radius, s0);
        s1 = hn::MulAdd(kxy, radius, s1);
        s3 = hn::MulAdd(kyy, radius, s3);
        const auto gx = hn::Mul(kr, ex);
        const auto gy = hn::Mul(kr, ey);
        rx0 = hn::MulAdd(gx, x, rx0);
        rx1 = hn::MulAdd(gx, y, rx1);
        rx2 = hn::Add(rx2, gx);
        ry0 = hn::MulAdd(gy, x, ry0);
        ry1 = hn::MulAdd(gy, y, ry1);
        ry2 = hn::Add(ry2, gy);
        const auto along = hn::MulAdd(gx, p.u, hn::Mul(gy, p.v));
        rp0 = hn::MulAdd(along, x, rp0);
        rp1 = hn::MulAdd(along, y, rp1);
        total = hn::Add(total, weight);
    }
    const auto add = [&](double& sum, Vector v) HWY_ATTR { sum += double(hn::GetLane(hn::SumOfLanes(f, v))); };
    add(sums.plain[0], m0);
    add(sums.plain[1], m1);
    add(sums.plain[2], m2);
    add(sums.plain[3], m3);
    add(sums.plain[4], m4);
    add(sums.plain[5], m5);
    add(sums.times_u[0], u0);
    add(sums.times_u[1], u1);
    add(sums.times_u[2], u2);
    add(sums.times_u[3], u3);
    add(sums.times_u[4], u4);
    add(sums.times_v[0], v0);
    add(sums.times_v[1], v1);
    add(sums.times_v[2], v2);
    add(sums.times_v[3], v3);
    add(sums.times_v[4], v4);
    add(sums.times_square[0], s0);
    add(sums.times_square[1], s1);
    add(sums.times_square[2], s3);
    add(sums.right_x[0], rx0);
    add(sums.right_x[1], rx1);
    add(sums.right_x[2], rx2);
    add(sums.right_y[0], ry0);
    add(sums.right_y[1], ry1);
    add(sums.right_y[2], ry2);
    add(sums.right_projective[0], rp0);
    add(sums.right_projective[1], rp1);
    add(sums.weight, total);
}

HWY_ATTR void sumAll(const Correspondences& points, const HomographyParameters& homography, float cutoff,
                     NormalSums& sums) {
    constexpr int kStretch = 2048;
    const int lanes = static_cast<int>(hn::Lanes(Floats()));
    const int whole = points.size() / lanes * lanes;
    for (int first = 0; first < whole; first += kStretch) {
        const int count = std::min(kStretch, whole - first);
        addStretch(points.from_x.data() + first, points.from_y.data() + first, points.to_x.data() + first,
                   points.to_y.data() + first, points.weight.data() + first, count, homography, cutoff, sums);
    }
    if (whole == points.size()) return;
    float tail[5][16] = {};  // lanes without a point weigh nothing
    for (int i = whole; i < points.size(); ++i) {
        const auto at = std::size_t(i);
        tail[0][i - whole] = points.from_x[at];
        tail[1][i - whole] = points.from_y[at];
        tail[2][i - whole] = points.to_x[at];
        tail[3][i - whole] = points.to_y[at];
        tail[4][i - whole] = points.weight[at];
    }
    addStretch(tail[0], tail[1], tail[2], tail[3], tail[4], lanes, homography, cutoff, sums);
}

HWY_ATTR void squares(const Correspondences& points, const HomographyParameters& homography, float* out) {
    const Floats f;
    const int lanes = static_cast<int>(hn::Lanes(f));
    const SpreadHomography h = spread(homography);
    int i = 0;
    for (; i + lanes <= points.size(); i += lanes) {
        const Projected p = project(h, hn::LoadU(f, points.from_x.data() + i), hn::LoadU(f, points.from_y.data() + i));
        const auto ex = hn::Sub(p.u, hn::LoadU(f, points.to_x.data() + i));
        const auto ey = hn::Sub(p.v, hn::LoadU(f, points.to_y.data() + i));
        hn::StoreU(hn::MulAdd(ex, ex, hn::Mul(ey, ey)), f, out + i);
    }
    for (; i < points.size(); ++i) {
        const auto at = std::size_t(i);
        const float x = points.from_x[at];
        const float y = points.from_y[at];
        const float inverse = 1.0F / (homography[6] * x + homography[7] * y + 1.0F);
        const float ex = (homography[0] * x + homography[1] * y + homography[2]) * inverse - points.to_x[at];
        const float ey = (homography[3] * x + homography[4] * y + homography[5]) * inverse - points.to_y[at];
        out[i] = ex * ex + ey * ey;
    }
}

}  // namespace HWY_NAMESPACE
}  // namespace eyrie
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace eyrie {

HWY_EXPORT(sumAll);
HWY_EXPORT(squares);

NormalSums sumNormalEquations(const Correspondences& points, const HomographyParameters& homography, float cutoff) {
    NormalSums sums;
    HWY_DYNAMIC_DISPATCH(sumAll)(points, homography, cutoff, sums);
    return sums;
}

void squaredResiduals(const Correspondences& points, const HomographyParameters& homography, std::vector<float>& out) {
    out.resize(std::size_t(points.size()));
    HWY_DYNAMIC_DISPATCH(squares)(points, homography, out.data());
}

}  // namespace eyrie
#endif
