#include "imaging/lbp_gradient.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <opencv2/imgproc.hpp>

namespace eyrie {
namespace {

/// Where a neighbour lies: whole steps to the upper left pixel and the remainders in [0, 1).
struct NeighbourOffset {
    int x = 0;
    int y = 0;
    float fraction_x = 0;
    float fraction_y = 0;
};

std::array<NeighbourOffset, kLbpNeighbours> circle(double radius) {
    std::array<NeighbourOffset, kLbpNeighbours> offsets;
    for (int p = 0; p < kLbpNeighbours; ++p) {
        const double angle = 2 * std::numbers::pi * p / kLbpNeighbours;
        double x = radius * std::cos(angle);
        double y = -radius * std::sin(angle);
        // Neighbours on the axes are whole pixels for whole radii; rounding errors must not blur them.
        if (std::abs(x - std::round(x)) < 1e-6) x = std::round(x);
        if (std::abs(y - std::round(y)) < 1e-6) y = std::round(y);
        const double whole_x = std::floor(x);
        const double whole_y = std::floor(y);
        offsets[static_cast<std::size_t>(p)] = {static_cast<int>(whole_x), static_cast<int>(whole_y),
                                                static_cast<float>(x - whole_x), static_cast<float>(y - whole_y)};
    }
    return offsets;
}

/// Bilinear values of a row of neighbours. Written as steps from the first pixel, so that a flat area stays exactly
/// flat.
__attribute__((noinline)) void interpolateRow(int count, const float* __restrict upper, const float* __restrict lower,
                                              float fraction_x, float fraction_y, float* __restrict out) {
    for (int x = 0; x < count; ++x) {
        const float top = upper[x] + fraction_x * (upper[x + 1] - upper[x]);
        const float bottom = lower[x] + fraction_x * (lower[x + 1] - lower[x]);
        out[x] = top + fraction_y * (bottom - top);
    }
}

using NeighbourRows = std::array<const float*, kLbpNeighbours>;

__attribute__((noinline)) void accumulateRow(int count, const float* __restrict centre, const float* __restrict n0,
                                             const float* __restrict n1, const float* __restrict n2,
                                             const float* __restrict n3, const float* __restrict n4,
                                             const float* __restrict n5, const float* __restrict n6,
                                             const float* __restrict n7, float threshold, float* __restrict sum) {
    for (int x = 0; x < count; ++x) {
        const float c = centre[x];
        const float d0 = n0[x] - c, d1 = n1[x] - c, d2 = n2[x] - c, d3 = n3[x] - c;
        const float d4 = n4[x] - c, d5 = n5[x] - c, d6 = n6[x] - c, d7 = n7[x] - c;
        const int b0 = d0 >= threshold, b1 = d1 >= threshold, b2 = d2 >= threshold, b3 = d3 >= threshold;
        const int b4 = d4 >= threshold, b5 = d5 >= threshold, b6 = d6 >= threshold, b7 = d7 >= threshold;
        const int ones = b0 + b1 + b2 + b3 + b4 + b5 + b6 + b7;
        const int changes =
            (b0 ^ b1) + (b1 ^ b2) + (b2 ^ b3) + (b3 ^ b4) + (b4 ^ b5) + (b5 ^ b6) + (b6 ^ b7) + (b7 ^ b0);
        const float mean = (((d0 + d1) + (d2 + d3)) + ((d4 + d5) + (d6 + d7))) * 0.125F;
        const float e0 = d0 - mean, e1 = d1 - mean, e2 = d2 - mean, e3 = d3 - mean;
        const float e4 = d4 - mean, e5 = d5 - mean, e6 = d6 - mean, e7 = d7 - mean;
        const float variance =
            (((e0 * e0 + e1 * e1) + (e2 * e2 + e3 * e3)) + ((e4 * e4 + e5 * e5) + (e6 * e6 + e7 * e7))) * 0.125F;
        const int accepted = (changes == 2) & (ones >= 2) & (ones <= 6);
        sum[x] += accepted ? std::sqrt(variance) : 0.0F;
    }
}

}  // namespace

void lbpGradient(const cv::Mat& gray, const LbpGradientOptions& options, cv::Mat& gradient) {
    CV_Assert(gray.empty() || gray.type() == CV_8UC1);
    gradient.create(gray.size(), CV_32FC1);
    gradient.setTo(0);
    if (gray.empty() || options.radii.empty()) return;

    const double largest = *std::max_element(options.radii.begin(), options.radii.end());
    const int pad = static_cast<int>(std::ceil(largest)) + 1;
    cv::Mat padded_gray;
    cv::copyMakeBorder(gray, padded_gray, pad, pad, pad, pad, cv::BORDER_REPLICATE);
    cv::Mat padded;
    padded_gray.convertTo(padded, CV_32F);

    const int width = gray.cols;
    std::vector<float> buffer(static_cast<std::size_t>(width) * kLbpNeighbours);
    const float threshold = static_cast<float>(options.threshold);
    for (const double radius : options.radii) {
        const auto offsets = circle(radius);
        for (int y = 0; y < gray.rows; ++y) {
            NeighbourRows rows{};
            for (std::size_t p = 0; p < offsets.size(); ++p) {
                const NeighbourOffset& offset = offsets[p];
                const float* upper = padded.ptr<float>(y + pad + offset.y) + pad + offset.x;
                if (offset.fraction_x == 0 && offset.fraction_y == 0) {
                    rows[p] = upper;
                    continue;
                }
                const float* lower = padded.ptr<float>(y + pad + offset.y + 1) + pad + offset.x;
                float* row = buffer.data() + p * static_cast<std::size_t>(width);
                interpolateRow(width, upper, lower, offset.fraction_x, offset.fraction_y, row);
                rows[p] = row;
            }
            accumulateRow(width, padded.ptr<float>(y + pad) + pad, rows[0], rows[1], rows[2], rows[3], rows[4], rows[5],
                          rows[6], rows[7], threshold, gradient.ptr<float>(y));
        }
    }
}

}  // namespace eyrie
