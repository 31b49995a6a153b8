#include "learning/descriptors/hog_descriptor.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/geometry/angle.h"
#include "learning/models/window.h"

namespace eyrie {
namespace {

constexpr int kBins = 9;
constexpr int kCell = 4;
constexpr int kCellsAcross = kWindowWidth / kCell;
constexpr int kCellsDown = kWindowHeight / kCell;
constexpr float kCut = 0.2F;         // Dalal and Triggs' clipping against single strong edges
constexpr float kSmallSquare = 1.F;  // grey values², keeps flat blocks at 0 instead of amplifying their noise

using Cells = std::array<std::array<float, kBins>, static_cast<std::size_t>(kCellsAcross* kCellsDown)>;

Cells cellHistograms(const cv::Mat& window) {
    Cells cells{};
    for (int y = 0; y < kWindowHeight; ++y) {
        const uchar* above = window.ptr<uchar>(std::max(y - 1, 0));
        const uchar* row = window.ptr<uchar>(y);
        const uchar* below = window.ptr<uchar>(std::min(y + 1, kWindowHeight - 1));
        for (int x = 0; x < kWindowWidth; ++x) {
            const int gx = row[std::min(x + 1, kWindowWidth - 1)] - row[std::max(x - 1, 0)];
            const int gy = below[x] - above[x];
            if (gx == 0 && gy == 0) continue;
            const float magnitude = std::sqrt(static_cast<float>(gx * gx + gy * gy));
            double turn = std::atan2(gy, gx) / kPi;  // half turns
            if (turn < 0) turn += 1;
            const double position = turn * kBins - 0.5;  // bin centres lie at 10°, 30° …
            const double lower = std::floor(position);
            const auto share = static_cast<float>(position - lower);
            const int bin = (static_cast<int>(lower) + kBins) % kBins;
            auto& cell = cells[static_cast<std::size_t>(y / kCell * kCellsAcross + x / kCell)];
            cell[static_cast<std::size_t>(bin)] += magnitude * (1 - share);
            cell[static_cast<std::size_t>((bin + 1) % kBins)] += magnitude * share;
        }
    }
    return cells;
}

void normalise(std::span<float> block) {
    for (const bool cut : {true, false}) {
        float squares = cut ? kSmallSquare : 1e-12F;
        for (const float value : block) squares += value * value;
        const float factor = 1 / std::sqrt(squares);
        for (float& value : block) value = cut ? std::min(value * factor, kCut) : value * factor;
    }
}

}  // namespace

void HogDescriptor::compute(const cv::Mat& window, std::span<float> values) const {
    requireWindow(window);
    const Cells cells = cellHistograms(window);
    std::size_t at = 0;
    for (int row = 0; row + 1 < kCellsDown; ++row) {
        for (int column = 0; column + 1 < kCellsAcross; ++column) {
            const std::size_t begin = at;
            for (const int cell : {row * kCellsAcross + column, row * kCellsAcross + column + 1,
                                   (row + 1) * kCellsAcross + column, (row + 1) * kCellsAcross + column + 1}) {
                for (const float value : cells[static_cast<std::size_t>(cell)]) values[at++] = value;
            }
            normalise(values.subspan(begin, at - begin));
        }
    }
}

}  // namespace eyrie
