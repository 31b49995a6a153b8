#include "chain/scale/scale_slope_fit.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace eyrie {
namespace {

constexpr std::size_t kFewestVotes = 12;
constexpr double kVoteSpread = 0.18;    ///< of the logarithm of a vote: cars differ by half of it, looks by the rest
constexpr double kFarOff = 2.5;         ///< cost of votes that say nothing
constexpr double kIndependent = 0.5;    ///< share of votes: vehicles are seen in several frames
constexpr double kMiddleError = 0.15;   ///< usual error of the logarithm of the scale in the middle …
constexpr double kLevelHorizon = 0.12;  ///< … growth from there to the side of the picture …
constexpr double kTilted = 0.6;         ///< … and to its lower edge
constexpr double kGrowthStep = 0.05;    ///< of growths and of the logarithm
constexpr int kMostAside = 6;           ///< steps
constexpr int kMostDown = 18;
constexpr int kMostOff = 8;
constexpr double kSaved = 5;          ///< cost that a slope must save
constexpr double kWorthwhile = 0.15;  ///< growth from the middle of the picture to an edge

double squared(double value) {
    return value * value;
}

/// Of a growth to the right and downwards, with the best scale in the middle.
double costOf(double right, double down, const std::vector<ScaleVote>& votes, cv::Size image, double gsd_m_per_px) {
    const cv::Point2d half(image.width / 2.0, image.height / 2.0);
    const ScaleSlope slope = ScaleSlope::ofPicture(image, right / half.x, down / half.y);
    std::vector<double> off;  // logarithm of how much finer the vote is than the slope and the GSD say
    for (const ScaleVote& vote : votes)
        off.push_back(std::log(gsd_m_per_px / vote.gsd_m_per_px / slope.factorAt(vote.place)));
    double best = 1e300;
    for (int step = -kMostOff; step <= kMostOff; ++step) {
        double cost = 0;
        for (const double of_vote : off)
            cost += std::min(squared((of_vote - step * kGrowthStep) / kVoteSpread) / 2, kFarOff);
        best = std::min(best, kIndependent * cost + squared(step * kGrowthStep / kMiddleError) / 2);
    }
    return best + squared(right / kLevelHorizon) / 2 + squared(down / kTilted) / 2;
}

}  // namespace

ScaleSlope fitSlope(const std::vector<ScaleVote>& votes, cv::Size image, double gsd_m_per_px) {
    if (votes.size() < kFewestVotes) return {};
    double least = 1e300;
    double right = 0;
    double down = 0;
    for (int aside = -kMostAside; aside <= kMostAside; ++aside) {
        for (int below = -kMostDown; below <= kMostDown; ++below) {
            const double cost = costOf(aside * kGrowthStep, below * kGrowthStep, votes, image, gsd_m_per_px);
            if (cost >= least) continue;
            least = cost;
            right = aside * kGrowthStep;
            down = below * kGrowthStep;
        }
    }
    if (std::max(std::abs(right), std::abs(down)) < kWorthwhile) return {};
    if (costOf(0, 0, votes, image, gsd_m_per_px) - least < kSaved) return {};
    return ScaleSlope::ofPicture(image, right / (image.width / 2.0), down / (image.height / 2.0));
}

}  // namespace eyrie
