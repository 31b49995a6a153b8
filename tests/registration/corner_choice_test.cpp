// The choice of corners against a slow one that follows the words of its description.
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <tuple>

#include "registration/corners/corner_detector.h"
#include "registration/corners/corner_strength.h"
#include "registration/corners/neighbourhood_mask.h"
#include "registration/flight.h"
#include "registration/pictures/padding_mask.h"

namespace eyrie::corner_choice_test {
namespace {

struct Chosen {
    StrengthPeak peak;
    bool wanted = false;
};

/// What is to be done with one picture, and the slow way to do it.
struct Choice {
    CornerOptions options;
    double spacing = 2;
    CornerSurroundings surroundings;

    std::vector<cv::Point2f> slowly(const PaddedPicture& picture) const;

 private:
    double share() const { return options.favour_movers ? 0.85 : 1.0; }
    bool nearMover(cv::Point2f at) const;
    std::vector<Chosen> candidates(const PaddedPicture& picture, const std::vector<StrengthPeak>& peaks, bool wanted,
                                   double apart) const;
    std::vector<Chosen> shared(const std::vector<Chosen>& from, cv::Size size, int ordinary, int room) const;
};

/// In the same cell of a grid of 2.5 spacings, at least 6 px, as a mover, or in a neighbouring one.
bool Choice::nearMover(cv::Point2f at) const {
    if (!options.favour_movers) return false;
    const auto cell = static_cast<float>(std::max(6.0, 2.5 * spacing));
    for (const cv::Point2f& mover : surroundings.movers) {
        if (std::abs(int(mover.x / cell) - int(at.x / cell)) <= 1 &&
            std::abs(int(mover.y / cell) - int(at.y / cell)) <= 1)
            return true;
    }
    return false;
}

std::vector<Chosen> Choice::candidates(const PaddedPicture& picture, const std::vector<StrengthPeak>& peaks,
                                       bool wanted, double step) const {
    NeighbourhoodMask occupied({picture.width(), picture.height()}, 0.8 * step);
    for (const cv::Point2f& corner : surroundings.living) occupied.add(corner);
    const PaddingMask padding(picture);
    // The strongest of each cell, in the order in which cells are met.
    std::vector<std::pair<std::pair<int, int>, StrengthPeak>> best;
    for (const StrengthPeak& peak : peaks) {
        const cv::Point2f at(float(peak.x), float(peak.y));
        if (occupied.contains(at) || padding.contains(peak.x, peak.y) || nearMover(at) != wanted) continue;
        const std::pair cell(int(at.y / float(step)), int(at.x / float(step)));
        const auto held = std::find_if(best.begin(), best.end(), [&](const auto& one) { return one.first == cell; });
        if (held == best.end()) {
            best.emplace_back(cell, peak);
        } else if (peak.strength > held->second.strength) {
            held->second = peak;
        }
    }
    std::vector<Chosen> result;
    for (const auto& [cell, peak] : best) {
        bool alone = true;
        for (const auto& [other_cell, rival] : best) {
            if (std::hypot(rival.x - peak.x, rival.y - peak.y) >= 0.8 * step) continue;
            // Of two as strong as each other the one that was met first, row by row.
            if (std::tuple(-rival.strength, rival.y, rival.x) < std::tuple(-peak.strength, peak.y, peak.x))
                alone = false;
        }
        if (alone) result.push_back({peak, wanted});
    }
    return result;
}

/// Blocks get corners in turn, each its strongest, those with living ones later; the last round by strength.
std::vector<Chosen> Choice::shared(const std::vector<Chosen>& from, cv::Size size, int ordinary, int room) const {
    const int side = int(std::max({32.0, 6 * spacing, std::sqrt(8.0 * size.area() / options.max_corners)}));
    struct Block {
        int living = 0;
        std::vector<int> waiting;  // the weakest first
    };
    std::map<std::pair<int, int>, Block> blocks;
    for (const cv::Point2f& p : surroundings.living) ++blocks[{int(p.y) / side, int(p.x) / side}].living;
    std::vector<bool> keep;
    int wanted = 0;
    for (std::size_t i = 0; i < from.size(); ++i) {
        keep.push_back(from[i].wanted);
        wanted += from[i].wanted;
        if (!from[i].wanted) blocks[{from[i].peak.y / side, from[i].peak.x / side}].waiting.push_back(int(i));
    }
    const auto strength = [&](int i) { return from[std::size_t(i)].peak.strength; };
    for (auto& [place, block] : blocks) {
        std::sort(block.waiting.begin(), block.waiting.end(), [&](int a, int b) { return strength(a) < strength(b); });
    }
    int left = std::min(ordinary, room - wanted);
    for (int round = 0; left > 0 && round < 1000; ++round) {
        std::vector<int> next;
        for (auto& [place, block] : blocks) {
            if (block.waiting.empty() || block.living > round) continue;
            next.push_back(block.waiting.back());
            block.waiting.pop_back();
        }
        std::sort(next.begin(), next.end(), [&](int a, int b) { return strength(a) > strength(b); });
        for (std::size_t i = 0; i < next.size() && left > 0; ++i, --left) keep[std::size_t(next[i])] = true;
    }
    std::vector<Chosen> result;
    for (std::size_t i = 0; i < from.size() && int(result.size()) < room; ++i) {
        if (keep[i]) result.push_back(from[i]);
    }
    return result;
}

std::vector<cv::Point2f> Choice::slowly(const PaddedPicture& picture) const {
    StrengthLimits limits;
    limits.window_radius = options.tensor_window / 2;
    limits.min_strength = float(std::pow(surroundings.noise / options.corner_deviation, 2));
    limits.min_roundness = float(options.min_roundness);
    limits.margin = std::max(surroundings.margin, limits.window_radius + 3);
    std::vector<StrengthPeak> peaks;
    findStrengthPeaks(picture, 0, picture.height(), limits, peaks);
    const int living = int(surroundings.living.size());
    const int room = options.max_corners - living;
    const double cap = share() * options.max_corners;
    const int ordinary = int(cap) - living;
    if (room <= 0) return {};
    std::vector<Chosen> chosen = candidates(picture, peaks, true, spacing);
    if (ordinary > 0) {
        const double filled = std::clamp((living / cap - 0.6) / 0.3, 0.0, 1.0);
        const double even = std::max(spacing, 0.75 * std::sqrt(picture.width() * picture.height() / cap));
        const auto others = candidates(picture, peaks, false, (1 - filled) * spacing + filled * even);
        chosen.insert(chosen.end(), others.begin(), others.end());
    }
    if (int(chosen.size()) > std::min(room, ordinary))
        chosen = shared(chosen, {picture.width(), picture.height()}, ordinary, room);
    std::vector<cv::Point2f> corners;
    for (const Chosen& one : chosen) corners.push_back(refineCorner(picture, one.peak.x, one.peak.y));
    return corners;
}

PaddedPicture groundOf(cv::Size size, unsigned seed, bool padded) {
    cv::Mat gray = test::TexturedGround(seed, 1.2).picture(size, cv::Matx33d::eye(), 2, seed);
    if (padded) gray.colRange(0, 24) = 0;
    PaddedPicture picture;
    picture.copyFrom(gray);
    return picture;
}

/// Compares for one picture; returns how many corners there are.
int compared(Choice& choice, double gsd, const PaddedPicture& picture) {
    const CornerDetector detector(choice.options, test::scaleOf(gsd));
    choice.spacing = detector.spacing();
    const auto corners = detector.detect(picture, choice.surroundings);
    EXPECT_EQ(corners, choice.slowly(picture));
    return int(corners.size());
}

}  // namespace

TEST(CornerChoice, InAnEmptyPictureFollowsTheSlowOne) {
    for (const double gsd : {0.3, 0.15, 0.1, 0.07}) {
        for (const int most : {100, 150, 230, 400, 12000}) {
            for (const bool favour : {true, false}) {
                Choice choice;
                choice.options.max_corners = most;
                choice.options.favour_movers = favour;
                choice.options.tensor_window = gsd > 0.1 ? 3 : 5;
                choice.surroundings.noise = 1 + gsd;
                choice.surroundings.margin = favour ? 5 : 9;
                EXPECT_GT(compared(choice, gsd, groundOf({160, 117}, 7, most == 150)), 50) << gsd << " " << most;
            }
        }
    }
}

TEST(CornerChoice, AmongLivingCornersFollowsTheSlowOne) {
    const PaddedPicture picture = groundOf({177, 120}, 8, false);
    Choice choice;
    choice.options.min_roundness = 0.2;
    choice.options.corner_deviation = 0.4;
    const auto all = CornerDetector(choice.options, test::scaleOf(0.2)).detect(picture, choice.surroundings);
    ASSERT_GT(all.size(), 300U);
    for (const int most : {100, 260, 350}) {
        choice.options.max_corners = most;
        // Few, some, nearly all that may be ordinary, more than those, and as many as may be.
        for (const double share : {0.2, 0.55, 0.65, 0.8, 0.84, 0.9, 0.97, 1.0}) {
            choice.surroundings.living.assign(all.begin(), all.begin() + int(share * most));
            for (const double gsd : {0.3, 0.12}) {
                choice.surroundings.movers.clear();
                const int without = compared(choice, gsd, picture);
                if (share >= 0.85) {
                    EXPECT_EQ(without, 0) << share;
                }
                choice.surroundings.movers = {{40, 30}, {44, 31}, {120.5F, 80.25F}, {171, 115}};
                const int with = compared(choice, gsd, picture);
                EXPECT_LE(with, most - int(choice.surroundings.living.size()));
            }
        }
    }
}

TEST(CornerChoice, PicturesWithoutRoomForACornerHaveNone) {
    // A corner keeps its margin, here 4 px, on both sides: of 9 px one is left, of 8 px none.
    Choice choice;
    choice.surroundings.margin = 4;
    choice.surroundings.noise = 0.1;
    choice.options.min_roundness = 0;
    for (const cv::Size size : {cv::Size(8, 60), cv::Size(60, 8), cv::Size(1, 1)})
        EXPECT_EQ(compared(choice, 0.3, groundOf(size, 9, false)), 0);
    int some = 0;
    for (unsigned seed = 1; seed <= 5; ++seed) {
        some += compared(choice, 0.3, groundOf({9, 90}, seed, false));
        some += compared(choice, 0.3, groundOf({90, 9}, seed, false));
    }
    EXPECT_GT(some, 0);
}

}  // namespace eyrie::corner_choice_test
