#include "registration/corner_detector.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

#include "registration/corner_grid.h"
#include "registration/corner_strength.h"
#include "registration/padding_mask.h"

namespace eyrie {
namespace {

/// Share of the cap that corners away from moving objects may use.
constexpr double kOrdinaryShare = 0.85;

std::vector<StrengthPeak> allPeaks(const PaddedPicture& picture, const StrengthLimits& limits) {
    constexpr int kRowsPerStrip = 48;
    const int strips = (picture.height() + kRowsPerStrip - 1) / kRowsPerStrip;
    std::vector<std::vector<StrengthPeak>> parts(static_cast<std::size_t>(strips));
    tbb::parallel_for(tbb::blocked_range<int>(0, strips, 1), [&](const tbb::blocked_range<int>& range) {
        for (int strip = range.begin(); strip < range.end(); ++strip) {
            findStrengthPeaks(picture, strip * kRowsPerStrip, std::min((strip + 1) * kRowsPerStrip, picture.height()),
                              limits, parts[std::size_t(strip)]);
        }
    });
    std::size_t count = 0;
    for (const auto& part : parts) count += part.size();
    std::vector<StrengthPeak> peaks;
    peaks.reserve(count);
    for (const auto& part : parts) peaks.insert(peaks.end(), part.begin(), part.end());
    return peaks;
}

/// A peak that may become a corner.
struct Candidate {
    StrengthPeak peak;
    int block = 0;        ///< of the grid that shares out the cap
    bool wanted = false;  ///< near a moving corner
};

/// Keeps at most `ordinary` unwanted and `all` candidates: the strongest of each block, blocks filled up evenly.
void shareOut(std::vector<Candidate>& candidates, std::vector<int> living_in_block, int ordinary, int all) {
    std::vector<std::vector<int>> by_block(living_in_block.size());
    int wanted = 0;
    for (int i = 0; i < static_cast<int>(candidates.size()); ++i) {
        const Candidate& candidate = candidates[std::size_t(i)];
        if (candidate.wanted) {
            ++wanted;
        } else {
            by_block[std::size_t(candidate.block)].push_back(i);
        }
    }
    ordinary = std::max(0, std::min(ordinary, all - wanted));
    const auto acceptedAt = [&](int level) {
        long sum = 0;
        for (std::size_t b = 0; b < by_block.size(); ++b) {
            sum += std::min<long>(static_cast<long>(by_block[b].size()), std::max(0, level - living_in_block[b]));
        }
        return sum;
    };
    int low = 0;
    int high = 1 << 16;
    while (high - low > 1) {
        const int middle = (low + high) / 2;
        (acceptedAt(middle) <= ordinary ? low : high) = middle;
    }
    std::vector<unsigned char> keep(candidates.size(), 0);
    for (std::size_t b = 0; b < by_block.size(); ++b) {
        auto& members = by_block[b];
        const auto quota = static_cast<std::size_t>(std::max(0, low - living_in_block[b]));
        if (members.size() > quota) {
            std::nth_element(members.begin(), members.begin() + std::ptrdiff_t(quota), members.end(),
                             [&](int a, int c) {
                                 const float sa = candidates[std::size_t(a)].peak.strength;
                                 const float sc = candidates[std::size_t(c)].peak.strength;
                                 return sa > sc || (sa == sc && a < c);
                             });
            members.resize(quota);
        }
        for (const int member : members) keep[std::size_t(member)] = 1;
    }
    std::size_t kept = 0;
    int room = all;
    for (std::size_t i = 0; i < candidates.size() && room > 0; ++i) {
        if (!candidates[i].wanted && keep[i] == 0) continue;
        candidates[kept++] = candidates[i];
        --room;
    }
    candidates.resize(kept);
}

}  // namespace

void CornerOptions::describe(ParameterVisitor& visitor) {
    visitor.real(
        "registration.corner_spacing", spacing_m, 0.05, 20,
        {"m", "Distance between corners. Smaller: more motion vectors on each vehicle, more time.", "Teutsch §4.2"});
    visitor.real("registration.min_corner_distance", min_distance_px, 1.5, 50,
                 {"px", "Corners are never closer than this, however coarse the picture.", ""});
    visitor.integer("registration.max_corners", max_corners, 100, 50000,
                    {"", "Most corners tracked at a time; they then thin out evenly, least near moving ones.", ""});
    visitor.real(
        "registration.corner_deviation", max_deviation_px, 0.05, 5,
        {"px",
         "A corner is strong enough when the picture's noise moves it by no more than this standard deviation. "
         "Larger: weaker corners too.",
         "Förstner and Gülch 1987"});
    visitor.real(
        "registration.min_roundness", min_roundness, 0, 0.95,
        {"", "0 accepts points on edges as corners, 1 only texture without a direction.", "Förstner and Gülch 1987"});
    visitor.integer("registration.tensor_window", tensor_window, 3, 7,
                    {"px", "Side of the window over which the structure tensor is summed; even numbers round up.", ""});
}

CornerDetector::CornerDetector(const CornerOptions& options, const SceneScale& scale)
    : options_(options), spacing_px_(std::clamp(scale.px(options.spacing_m), options.min_distance_px, 64.0)) {}

std::vector<cv::Point2f> CornerDetector::detect(const PaddedPicture& picture,
                                                const CornerSurroundings& surroundings) const {
    StrengthLimits limits;
    limits.window_radius = options_.tensor_window / 2;
    const double ratio = surroundings.noise / options_.max_deviation_px;
    limits.min_strength = static_cast<float>(ratio * ratio);
    limits.min_roundness = static_cast<float>(options_.min_roundness);
    limits.margin = std::max(surroundings.margin, limits.window_radius + 3);
    const cv::Size size(picture.width(), picture.height());
    std::vector<cv::Point2f> corners;
    const int room = options_.max_corners - static_cast<int>(surroundings.living.size());
    if (room <= 0 || size.width <= 2 * limits.margin || size.height <= 2 * limits.margin) return corners;

    const std::vector<StrengthPeak> peaks = allPeaks(picture, limits);
    const PaddingMask padding(picture);
    const CornerGrid living(size, static_cast<float>(spacing_px_), surroundings.living);
    const auto apart = static_cast<float>(0.8 * spacing_px_);

    // The strongest peak of each cell that is not too near a living corner …
    std::vector<int> best(std::size_t(living.cells()), -1);
    for (int i = 0; i < static_cast<int>(peaks.size()); ++i) {
        const StrengthPeak& peak = peaks[std::size_t(i)];
        const cv::Point2f at(static_cast<float>(peak.x), static_cast<float>(peak.y));
        int& winner = best[std::size_t(living.cellOf(at))];
        if (winner >= 0 && peaks[std::size_t(winner)].strength >= peak.strength) continue;
        if (padding.contains(peak.x, peak.y) || living.anyWithin(at, apart)) continue;
        winner = i;
    }
    // … unless a stronger one stands just across the cell's border.
    const int block_px = std::max(32, static_cast<int>(6 * spacing_px_));
    const int blocks_across = size.width / block_px + 1;
    const auto blockOf = [&](cv::Point2f p) {
        return static_cast<int>(p.y) / block_px * blocks_across + static_cast<int>(p.x) / block_px;
    };
    const CornerGrid movers(size, static_cast<float>(std::max(6.0, 2.5 * spacing_px_)), surroundings.movers);
    std::vector<Candidate> candidates;
    for (int cell = 0; cell < living.cells(); ++cell) {
        const int winner = best[std::size_t(cell)];
        if (winner < 0) continue;
        const StrengthPeak& peak = peaks[std::size_t(winner)];
        bool suppressed = false;
        living.forNeighbours(cell, [&](int neighbour) {
            const int other = best[std::size_t(neighbour)];
            if (other < 0 || other == winner) return;
            const StrengthPeak& rival = peaks[std::size_t(other)];
            const auto dx = static_cast<float>(rival.x - peak.x);
            const auto dy = static_cast<float>(rival.y - peak.y);
            const bool stronger = rival.strength > peak.strength || (rival.strength == peak.strength && other < winner);
            if (stronger && dx * dx + dy * dy < apart * apart) suppressed = true;
        });
        if (suppressed) continue;
        const cv::Point2f at(static_cast<float>(peak.x), static_cast<float>(peak.y));
        candidates.push_back({peak, blockOf(at), movers.anyInOrAround(at)});
    }

    if (static_cast<int>(candidates.size()) > std::min(room, static_cast<int>(kOrdinaryShare * options_.max_corners) -
                                                                 static_cast<int>(surroundings.living.size()))) {
        std::vector<int> living_in_block(std::size_t(blocks_across) * std::size_t(size.height / block_px + 1), 0);
        for (const cv::Point2f& corner : surroundings.living) ++living_in_block[std::size_t(blockOf(corner))];
        const int ordinary =
            static_cast<int>(kOrdinaryShare * options_.max_corners) - static_cast<int>(surroundings.living.size());
        shareOut(candidates, std::move(living_in_block), ordinary, room);
    }
    corners.reserve(candidates.size());
    for (const Candidate& candidate : candidates) {
        corners.push_back(refineCorner(picture, candidate.peak.x, candidate.peak.y));
    }
    return corners;
}

}  // namespace eyrie
