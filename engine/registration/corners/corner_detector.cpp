#include "registration/corners/corner_detector.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

#include "registration/corners/corner_grid.h"
#include "registration/corners/corner_strength.h"
#include "registration/corners/neighbourhood_mask.h"
#include "registration/pictures/padding_mask.h"

namespace eyrie {
namespace {

/// Share of the cap that corners away from moving objects may use.
constexpr double kOrdinaryShare = 0.85;
constexpr double kUsualArea = 1280.0 * 720;  ///< px², from which on pictures have more corners …
constexpr double kMostOfUsual = 2;           ///< … up to so many times as many

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
    int block = 0;        ///< see BlockGrid
    bool wanted = false;  ///< near a moving corner

    cv::Point2f position() const { return {static_cast<float>(peak.x), static_cast<float>(peak.y)}; }
};

/// Large squares between which the cap on the number of corners is shared.
class BlockGrid {
 public:
    /// Large enough for several corners each.
    BlockGrid(cv::Size image, double spacing_px, int max_corners)
        : side_(static_cast<int>(std::max({32.0, 6 * spacing_px, std::sqrt(8.0 * image.area() / max_corners)}))),
          across_(image.width / side_ + 1),
          down_(image.height / side_ + 1) {}
    int count() const { return across_ * down_; }
    int blockOf(cv::Point2f p) const { return static_cast<int>(p.y) / side_ * across_ + static_cast<int>(p.x) / side_; }

 private:
    int side_;
    int across_;
    int down_;
};

/// Keeps at most `ordinary` unwanted and `all` candidates: the strongest of each block, blocks filled up evenly.
void shareOut(std::vector<Candidate>& candidates, const std::vector<int>& living_in_block, int ordinary, int all) {
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
    const auto stronger = [&](int a, int b) {
        const float of_a = candidates[std::size_t(a)].peak.strength;
        const float of_b = candidates[std::size_t(b)].peak.strength;
        return of_a > of_b || (of_a == of_b && a < b);
    };
    std::vector<unsigned char> keep(candidates.size(), 0);
    std::vector<int> next_best;  // of the blocks that have more than their quota
    int accepted = 0;
    for (std::size_t b = 0; b < by_block.size(); ++b) {
        auto& members = by_block[b];
        const auto quota = static_cast<std::size_t>(std::max(0, low - living_in_block[b]));
        if (members.size() > quota) {
            std::nth_element(members.begin(), members.begin() + std::ptrdiff_t(quota), members.end(), stronger);
            if (living_in_block[b] <= low) next_best.push_back(members[quota]);
            members.resize(quota);
        }
        for (const int member : members) keep[std::size_t(member)] = 1;
        accepted += static_cast<int>(members.size());
    }
    std::sort(next_best.begin(), next_best.end(), stronger);
    for (std::size_t i = 0; i < next_best.size() && accepted < ordinary; ++i, ++accepted) {
        keep[std::size_t(next_best[i])] = 1;
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

/// Of the peaks that `eligible` lets pass, those far enough from living corners and from stronger peaks, in a fixed
/// order.
template <class Eligible>
void appendCandidates(const std::vector<StrengthPeak>& peaks, cv::Size size, const std::vector<cv::Point2f>& living,
                      double spacing_px, Eligible eligible, bool wanted, std::vector<Candidate>& candidates) {
    const double apart = 0.8 * spacing_px;
    NeighbourhoodMask occupied(size, apart);
    for (const cv::Point2f& corner : living) occupied.add(corner);

    // The strongest peak of each cell that is not too near a living corner …
    const CornerGrid cells(size, static_cast<float>(spacing_px), {});
    std::vector<int> best(std::size_t(cells.cells()), -1);
    std::vector<int> filled;
    for (int i = 0; i < static_cast<int>(peaks.size()); ++i) {
        const StrengthPeak& peak = peaks[std::size_t(i)];
        const cv::Point2f at(static_cast<float>(peak.x), static_cast<float>(peak.y));
        if (occupied.contains(at) || !eligible(peak, at)) continue;
        const int cell = cells.cellOf(at);
        int& winner = best[std::size_t(cell)];
        if (winner < 0) filled.push_back(cell);
        if (winner < 0 || peak.strength > peaks[std::size_t(winner)].strength) winner = i;
    }
    // … unless a stronger one stands just across the cell's border.
    for (const int cell : filled) {
        const int winner = best[std::size_t(cell)];
        const StrengthPeak& peak = peaks[std::size_t(winner)];
        bool suppressed = false;
        cells.forNeighbours(cell, [&](int neighbour) {
            const int other = best[std::size_t(neighbour)];
            if (other < 0 || other == winner) return;
            const StrengthPeak& rival = peaks[std::size_t(other)];
            const int dx = rival.x - peak.x;
            const int dy = rival.y - peak.y;
            const bool stronger = rival.strength > peak.strength || (rival.strength == peak.strength && other < winner);
            if (stronger && dx * dx + dy * dy < apart * apart) suppressed = true;
        });
        if (suppressed) continue;
        Candidate candidate;
        candidate.peak = peak;
        candidate.wanted = wanted;
        candidates.push_back(candidate);
    }
}

}  // namespace

void CornerOptions::describe(ParameterVisitor& visitor) {
    const ParameterDeclarer declare(visitor, ChainStage::registration);
    declare.real(
        "registration.corner_spacing", corner_spacing_m, 0.05, 20,
        {"m", "Distance between corners. Smaller: more motion vectors on each vehicle, more time.", "Teutsch §4.2"});
    declare.real("registration.min_corner_distance", min_corner_distance, 1.5, 50,
                 {"px", "Corners are never closer than this, however coarse the picture.", ""});
    declare.integer(
        "registration.max_corners", max_corners, 100, 50000,
        {"",
         "Largest number of corners tracked at a time in a picture of up to 1280×720; a larger one has more "
         "by its area, twice as many at the most. Above it they are thinned out evenly, least near moving "
         "ones.",
         ""});
    declare.real(
        "registration.corner_deviation", corner_deviation, 0.05, 5,
        {"px",
         "A corner is strong enough when the picture's noise moves it by no more than this standard deviation. "
         "Larger: weaker corners too.",
         "Förstner and Gülch 1987"});
    declare.real(
        "registration.min_roundness", min_roundness, 0, 0.95,
        {"", "0 accepts points on edges as corners, 1 only texture without a direction.", "Förstner and Gülch 1987"});
    declare.flag("registration.favour_movers", favour_movers,
                 {"",
                  "Where vehicles were seen to move, corners stay as dense as they can be, whatever the largest number "
                  "of corners.",
                  ""});
    declare.integer("registration.tensor_window", tensor_window, 3, 7,
                    {"px", "Side of the window over which the structure tensor is summed; even numbers round up.", ""});
}

int CornerOptions::mostCorners(cv::Size image) const {
    return cvRound(max_corners * std::clamp(image.area() / kUsualArea, 1.0, kMostOfUsual));
}

CornerDetector::CornerDetector(const CornerOptions& options, const SceneScale& scale)
    : options_(options),
      spacing_px_(std::clamp(scale.px(options.corner_spacing_m), options.min_corner_distance, 64.0)) {}

std::vector<cv::Point2f> CornerDetector::detect(const PaddedPicture& picture,
                                                const CornerSurroundings& surroundings) const {
    StrengthLimits limits;
    limits.window_radius = options_.tensor_window / 2;
    const double ratio = surroundings.noise / options_.corner_deviation;
    limits.min_strength = static_cast<float>(ratio * ratio);
    limits.min_roundness = static_cast<float>(options_.min_roundness);
    limits.margin = std::max(surroundings.margin, limits.window_radius + 3);
    const cv::Size size(picture.width(), picture.height());
    std::vector<cv::Point2f> corners;
    const int most = options_.mostCorners(size);
    const int room = most - static_cast<int>(surroundings.living.size());
    if (room <= 0 || size.width <= 2 * limits.margin || size.height <= 2 * limits.margin) return corners;

    const double cap = (options_.favour_movers ? kOrdinaryShare : 1.0) * most;
    const int ordinary = static_cast<int>(cap) - static_cast<int>(surroundings.living.size());
    const std::vector<cv::Point2f> moving = options_.favour_movers ? surroundings.movers : std::vector<cv::Point2f>{};
    if (ordinary <= 0 && moving.empty()) return corners;
    const std::vector<StrengthPeak> peaks = allPeaks(picture, limits);
    const PaddingMask padding(picture);
    const auto covered = [&](const StrengthPeak& peak) {
        return padding.contains(peak.x, peak.y) || surroundings.graphics.marks(cv::Point2d(peak.x, peak.y));
    };
    const CornerGrid movers(size, static_cast<float>(std::max(6.0, 2.5 * spacing_px_)), moving);
    std::vector<Candidate> candidates;
    if (!moving.empty()) {
        appendCandidates(
            peaks, size, surroundings.living, spacing_px_,
            [&](const StrengthPeak& peak, cv::Point2f at) { return movers.anyInOrAround(at) && !covered(peak); }, true,
            candidates);
    }
    if (ordinary > 0) {
        // Near the cap, corners are put where there are none rather than where texture is best.
        const double filled = std::clamp((double(surroundings.living.size()) / cap - 0.6) / 0.3, 0.0, 1.0);
        const double even = std::max(spacing_px_, 0.75 * std::sqrt(size.area() / cap));
        appendCandidates(
            peaks, size, surroundings.living, spacing_px_ + filled * (even - spacing_px_),
            [&](const StrengthPeak& peak, cv::Point2f at) { return !covered(peak) && !movers.anyInOrAround(at); },
            false, candidates);
    }
    if (static_cast<int>(candidates.size()) > std::min(room, ordinary)) {
        const BlockGrid blocks(size, spacing_px_, most);
        std::vector<int> living_in_block(std::size_t(blocks.count()), 0);
        for (const cv::Point2f& corner : surroundings.living) ++living_in_block[std::size_t(blocks.blockOf(corner))];
        for (Candidate& candidate : candidates) candidate.block = blocks.blockOf(candidate.position());
        shareOut(candidates, living_in_block, ordinary, room);
    }
    corners.reserve(candidates.size());
    for (const Candidate& candidate : candidates) {
        corners.push_back(refineCorner(picture, candidate.peak.x, candidate.peak.y));
    }
    return corners;
}

}  // namespace eyrie
