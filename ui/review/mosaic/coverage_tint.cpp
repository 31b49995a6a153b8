#include "review/mosaic/coverage_tint.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace eyrie::ui {

namespace {

constexpr double kTint = 0.45;           ///< of the colour; the rest is the ground below
constexpr double kShortestTold_s = 0.1;  ///< times are told in tenths

double shortestOf(const SheetCoverage& coverage) {
    return std::max(coverage.shortest_s, kShortestTold_s);
}

/// How many times longer the longest is than the shortest, as a logarithm.
double spreadOf(const SheetCoverage& coverage) {
    return std::log(std::max(coverage.longest_s, kShortestTold_s) / shortestOf(coverage));
}

}  // namespace

QColor coverageColour(double share) {
    constexpr std::array<std::array<double, 3>, 5> kStops{
        {{30, 15, 120}, {120, 15, 165}, {195, 60, 125}, {240, 120, 80}, {253, 190, 75}}};
    const double at = std::clamp(share, 0.0, 1.0) * (kStops.size() - 1);
    const auto below = std::min(static_cast<std::size_t>(at), kStops.size() - 2);
    const double way = at - static_cast<double>(below);
    const auto part = [&](std::size_t i) {
        return static_cast<int>(std::lround(kStops[below][i] + way * (kStops[below + 1][i] - kStops[below][i])));
    };
    return {part(0), part(1), part(2)};
}

double seenForShare(const SheetCoverage& coverage, double seconds) {
    const double spread = spreadOf(coverage);
    if (spread <= 0) return 1;
    return std::clamp(std::log(std::max(seconds, kShortestTold_s) / shortestOf(coverage)) / spread, 0.0, 1.0);
}

double secondsAtShare(const SheetCoverage& coverage, double share) {
    return shortestOf(coverage) * std::exp(std::max(0.0, spreadOf(coverage)) * share);
}

double lastSeenShare(const SheetCoverage& coverage, FrameIndex frame) {
    const auto frames = static_cast<double>(coverage.frames.last - coverage.frames.first);
    return frames <= 0 ? 1 : std::clamp(static_cast<double>(frame - coverage.frames.first) / frames, 0.0, 1.0);
}

FrameIndex frameAtShare(const SheetCoverage& coverage, double share) {
    const auto frames = static_cast<double>(coverage.frames.last - coverage.frames.first);
    return coverage.frames.first + static_cast<FrameIndex>(std::lround(frames * share));
}

QImage coverageTint(const SheetCoverage& coverage, CoverageLook look) {
    if (look == CoverageLook::none || coverage.seen_s.empty()) return {};
    constexpr int kShades = 256;
    std::array<QRgb, kShades> shades{};
    for (int i = 0; i < kShades; ++i) {
        QColor colour = coverageColour(static_cast<double>(i) / (kShades - 1));
        colour.setAlphaF(kTint);
        shades[static_cast<std::size_t>(i)] = qPremultiply(colour.rgba());
    }
    QImage tint(coverage.seen_s.cols, coverage.seen_s.rows, QImage::Format_ARGB32_Premultiplied);
    tint.fill(Qt::transparent);
    for (int row = 0; row < tint.height(); ++row) {
        const auto* seen = coverage.seen_s.ptr<double>(row);
        const auto* last = coverage.last_frame.ptr<int>(row);
        auto* line = reinterpret_cast<QRgb*>(tint.scanLine(row));
        for (int x = 0; x < tint.width(); ++x) {
            if (last[x] < 0) continue;
            const double share =
                look == CoverageLook::seen_for ? seenForShare(coverage, seen[x]) : lastSeenShare(coverage, last[x]);
            line[x] = shades[static_cast<std::size_t>(std::lround(share * (kShades - 1)))];
        }
    }
    return tint;
}

}  // namespace eyrie::ui
