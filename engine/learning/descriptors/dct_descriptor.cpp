#include "learning/descriptors/dct_descriptor.h"

#include <array>
#include <cmath>

#include "core/geometry/angle.h"
#include "learning/models/window.h"

namespace eyrie {
namespace {

constexpr int kDctBlock = 8;
constexpr int kStride = 4;
constexpr int kKept = 6;  // frequencies 0 … 5 in each direction can occur among the first 21

using Basis = std::array<std::array<double, kDctBlock>, kKept>;

Basis makeBasis() {
    Basis basis{};
    for (int u = 0; u < kKept; ++u) {
        for (int x = 0; x < kDctBlock; ++x) {
            basis[u][x] =
                std::sqrt((u == 0 ? 1.0 : 2.0) / kDctBlock) * std::cos((2 * x + 1) * u * kPi / (2 * kDctBlock));
        }
    }
    return basis;
}

/// Column and row frequency of the first 21 coefficients along the zigzag.
std::array<std::array<int, 2>, 21> makeZigzag() {
    std::array<std::array<int, 2>, 21> order{};
    std::size_t at = 0;
    for (int diagonal = 0; diagonal < kKept; ++diagonal) {
        for (int i = 0; i <= diagonal; ++i) {
            const bool up = diagonal % 2 == 0;  // even diagonals run from the lower left to the upper right
            order[at++] = {up ? i : diagonal - i, up ? diagonal - i : i};
        }
    }
    return order;
}

}  // namespace

void DctDescriptor::compute(const cv::Mat& window, std::span<float> values) const {
    static const Basis basis = makeBasis();
    static const auto zigzag = makeZigzag();
    requireWindow(window);
    auto out = values.begin();
    for (int top = 0; top + kDctBlock <= kWindowHeight; top += kStride) {
        for (int left = 0; left + kDctBlock <= kWindowWidth; left += kStride) {
            double rows[kKept][kDctBlock] = {};  // transformed along x
            for (int y = 0; y < kDctBlock; ++y) {
                const uchar* pixels = window.ptr<uchar>(top + y) + left;
                for (int u = 0; u < kKept; ++u) {
                    for (int x = 0; x < kDctBlock; ++x) rows[u][y] += basis[u][x] * pixels[x];
                }
            }
            for (const auto& [u, v] : zigzag) {
                double sum = 0;
                for (int y = 0; y < kDctBlock; ++y) sum += basis[v][y] * rows[u][y];
                *out++ = static_cast<float>(sum);
            }
        }
    }
}

}  // namespace eyrie
