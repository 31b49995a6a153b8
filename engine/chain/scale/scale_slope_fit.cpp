#include "chain/scale/scale_slope_fit.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "core/robust_statistics.h"

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
constexpr double kSaved = 5;               ///< cost that a slope must save
constexpr std::size_t kFewestToPlace = 6;  ///< votes that say where a scale holds …
constexpr double kSavedByPlace = 0.5;      ///< … and cost that that must save
constexpr double kWorthwhile = 0.15;       ///< growth from the middle of the picture to an edge

// A view of which nothing is known.
constexpr double kLeastGrowth = 0.3;       ///< from the middle of the picture to its lower edge …
constexpr double kMostGrowth = 4;          ///< … up to a horizon that lies 3/8 of the picture below its upper edge
constexpr double kGrowthFactor = 1.08;     ///< from one growth to the next
constexpr double kFinestMiddle = 0.01;     ///< m/px …
constexpr double kCoarsestMiddle = 1;      ///< … between which the scale in the middle lies
constexpr std::size_t kFewestOfView = 16;  ///< votes
constexpr double kAgreeing = 0.6;          ///< share of the votes that must not be far off
constexpr double kSavedByView = 1;         ///< cost that the slope must save; the chain has to confirm it
constexpr double kAboutAsGood = 3;         ///< cost by which others may be worse than the best one …
constexpr double kApart = 1.26;            ///< … of growths that are as many times larger or smaller
constexpr double kTailBegins = 0.9;        ///< growth from which larger ones are hardly less likely

double squared(double value) {
    return value * value;
}

/// Of a vote; `off`: logarithm of how far it is off.
double costOfVote(double off) {
    return std::min(squared(off / kVoteSpread) / 2, kFarOff);
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
        for (const double of_vote : off) cost += costOfVote(of_vote - step * kGrowthStep);
        best = std::min(best, kIndependent * cost + squared(step * kGrowthStep / kMiddleError) / 2);
    }
    return best + squared(right / kLevelHorizon) / 2 + squared(down / kTilted) / 2;
}

/// The slope that the votes and the camera together make likeliest; flat unless it is far likelier than none.
ScaleSlope bestSlope(const std::vector<ScaleVote>& votes, cv::Size image, double gsd_m_per_px,
                     const CameraSlope& camera) {
    const auto costOfBoth = [&](double to_right, double downwards) {
        return costOf(to_right, downwards, votes, image, gsd_m_per_px) + camera.cost(downwards);
    };
    double least = 1e300;
    double right = 0;
    double down = 0;
    for (int aside = -kMostAside; aside <= kMostAside; ++aside) {
        for (int below = -kMostDown; below <= kMostDown; ++below) {
            const double cost = costOfBoth(aside * kGrowthStep, below * kGrowthStep);
            if (cost >= least) continue;
            least = cost;
            right = aside * kGrowthStep;
            down = below * kGrowthStep;
        }
    }
    if (std::max(std::abs(right), std::abs(down)) < kWorthwhile) return {};
    if (costOfBoth(0, 0) - least < kSaved) return {};
    return ScaleSlope::ofPicture(image, right / (image.width / 2.0), down / (image.height / 2.0));
}

/// How far votes are off a scale that changes so.
double costUnder(const ScaleSlope& slope, const std::vector<ScaleVote>& votes, double gsd_m_per_px) {
    double cost = 0;
    for (const ScaleVote& vote : votes) {
        cost += kIndependent * costOfVote(std::log(gsd_m_per_px / vote.gsd_m_per_px / slope.factorAt(vote.place)));
    }
    return cost;
}

/// The same slope, counted from where the vehicles are if they say that the scale holds there rather than in the
/// middle: whoever reads a scale off vehicles, as people and estimates do, reads that of their place.
ScaleSlope heldWhereVehiclesAre(const ScaleSlope& slope, const std::vector<ScaleVote>& votes, double gsd_m_per_px) {
    if (votes.size() < kFewestToPlace) return slope;
    std::vector<double> across;
    std::vector<double> down;
    for (const ScaleVote& vote : votes) {
        across.push_back(vote.place.x);
        down.push_back(vote.place.y);
    }
    const ScaleSlope there = slope.countedFrom({medianOf(across), medianOf(down)});
    const double saved = costUnder(slope, votes, gsd_m_per_px) - costUnder(there, votes, gsd_m_per_px);
    return saved >= kSavedByPlace ? there : slope;
}

/// What a growth of a view costs before any vote: as that of fitSlope(), but steep views are not ruled out.
double tiltCost(double down) {
    const double usual = std::min(down, kTailBegins);
    return squared(usual / kTilted) / 2 + squared(kTailBegins / kTilted) * std::log(std::max(1.0, down / kTailBegins));
}

/// The best scale in the middle for a growth downwards, what it costs, and how many votes are not far off.
struct MiddleFit {
    double gsd_m_per_px = 0;
    double cost = 1e300;
    std::size_t agreeing = 0;
};

MiddleFit bestMiddle(double down, const std::vector<ScaleVote>& votes, cv::Size image, const CameraSlope& camera) {
    const ScaleSlope slope = ScaleSlope::ofPicture(image, 0, down / (image.height / 2.0));
    std::vector<double> middles;  // logarithm of the scale that each vote asks for in the middle
    middles.reserve(votes.size());
    for (const ScaleVote& vote : votes) middles.push_back(std::log(vote.gsd_m_per_px * slope.factorAt(vote.place)));
    MiddleFit best;
    for (double middle = std::log(kFinestMiddle); middle <= std::log(kCoarsestMiddle); middle += kGrowthStep) {
        double cost = 0;
        std::size_t agreeing = 0;
        for (const double of_vote : middles) {
            const double of_this = costOfVote(of_vote - middle);
            cost += of_this;
            agreeing += of_this < kFarOff;
        }
        cost = kIndependent * cost + tiltCost(down) + camera.cost(down);
        if (cost < best.cost) best = {std::exp(middle), cost, agreeing};
    }
    return best;
}

}  // namespace

std::vector<ViewFit> fitView(const std::vector<ScaleVote>& votes, cv::Size image, const CameraSlope& camera) {
    if (votes.size() < kFewestOfView) return {};
    MiddleFit best;
    double growth = 0;
    for (double down = kLeastGrowth; down <= kMostGrowth; down *= kGrowthFactor) {
        const MiddleFit fit = bestMiddle(down, votes, image, camera);
        if (fit.cost >= best.cost) continue;
        best = fit;
        growth = down;
    }
    const double flat = bestMiddle(0, votes, image, camera).cost;
    std::vector<ViewFit> views;
    for (const double down : {growth, growth / kApart, growth * kApart}) {
        const MiddleFit fit = bestMiddle(down, votes, image, camera);
        const bool agree = static_cast<double>(fit.agreeing) >= kAgreeing * static_cast<double>(votes.size());
        if (agree && flat - fit.cost >= kSavedByView && fit.cost - best.cost <= kAboutAsGood)
            views.push_back({fit.gsd_m_per_px, ScaleSlope::ofPicture(image, 0, down / (image.height / 2.0))});
    }
    return views;
}

ScaleSlope fitSlope(const std::vector<ScaleVote>& all_votes, cv::Size image, double gsd_m_per_px,
                    const CameraSlope& camera) {
    const std::vector<ScaleVote> votes = all_votes.size() < kFewestVotes ? std::vector<ScaleVote>() : all_votes;
    const ScaleSlope slope = bestSlope(votes, image, gsd_m_per_px, camera);
    if (slope.isFlat()) return slope;
    const bool by_camera = bestSlope(votes, image, gsd_m_per_px, CameraSlope(image)).isFlat();
    return by_camera ? heldWhereVehiclesAre(slope, all_votes, gsd_m_per_px) : slope;
}

}  // namespace eyrie
