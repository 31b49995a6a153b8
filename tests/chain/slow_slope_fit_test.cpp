#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "chain/scale/scale_slope_fit.h"

/// Slopes of the scale against slow fits that follow the words of their description, where the camera tells nothing.
namespace eyrie::slow_slope_fit_test {
namespace {

const cv::Size kImage{800, 600};

double square(double value) {
    return value * value;
}

/// The scale grows by such shares from the middle of the picture to its right and lower edge.
double growthAt(cv::Point2d place, double right, double down) {
    return ScaleSlope::ofPicture(kImage, right / 400, down / 300).factorAt(place);
}

/// Half the sum of what votes are off by, of which none costs more than 2.5.
double costOfVotes(const std::vector<double>& logarithms, double middle) {
    double cost = 0;
    for (const double of_vote : logarithms) cost += std::min(2.5, square((of_vote - middle) / 0.18) / 2);
    return cost / 2;
}

ScaleSlope slowSlope(const std::vector<ScaleVote>& votes, double gsd) {
    const auto costOf = [&](double right, double down) {
        std::vector<double> off;
        off.reserve(votes.size());
        for (const ScaleVote& vote : votes)
            off.push_back(std::log(gsd / (vote.gsd_m_per_px * growthAt(vote.place, right, down))));
        double best = 1e9;
        for (int step = -8; step <= 8; ++step)
            best = std::min(best, costOfVotes(off, 0.05 * step) + square(0.05 * step / 0.15) / 2);
        return best + square(right / 0.12) / 2 + square(down / 0.6) / 2;
    };
    double least = 1e9;
    std::pair<int, int> found;
    for (int right = -6; right <= 6; ++right) {
        for (int down = -18; down <= 18; ++down) {
            const double cost = costOf(0.05 * right, 0.05 * down);
            if (cost < least) {
                least = cost;
                found = {right, down};
            }
        }
    }
    const bool worthwhile = std::abs(found.first) >= 3 || std::abs(found.second) >= 3;
    if (votes.size() < 12 || !worthwhile || costOf(0, 0) - least < 5) return {};
    return ScaleSlope::ofPicture(kImage, 0.05 * found.first / 400, 0.05 * found.second / 300);
}

std::vector<ViewFit> slowViews(const std::vector<ScaleVote>& votes) {
    struct Fit {
        double gsd = 0, cost = 1e9;
        int agreeing = 0;
    };
    const auto fitOf = [&](double down) {
        std::vector<double> middles;
        middles.reserve(votes.size());
        for (const ScaleVote& vote : votes)
            middles.push_back(std::log(vote.gsd_m_per_px * growthAt(vote.place, 0, down)));
        const double usual = square(std::min(down, 0.9) / 0.6) / 2;
        const double steep = down > 0.9 ? 2.25 * std::log(down / 0.9) : 0;  // as steep as the former ends
        Fit best;
        for (int step = 0; step * 0.05 <= std::log(100); ++step) {
            const double middle = std::log(0.01) + 0.05 * step;
            const double cost = costOfVotes(middles, middle) + usual + steep;
            if (cost >= best.cost) continue;
            const auto agrees = [&](double of_vote) { return square((of_vote - middle) / 0.18) / 2 < 2.5; };
            best = {std::exp(middle), cost, int(std::count_if(middles.begin(), middles.end(), agrees))};
        }
        return best;
    };
    if (votes.size() < 16) return {};
    Fit best;
    double growth = 0;
    for (int i = 0; 0.3 * std::pow(1.08, i) <= 4; ++i) {
        const double down = 0.3 * std::pow(1.08, i);
        const Fit fit = fitOf(down);
        if (fit.cost < best.cost) {
            best = fit;
            growth = down;
        }
    }
    std::vector<ViewFit> views;
    for (const double down : {growth, growth / 1.26, growth * 1.26}) {
        const Fit fit = fitOf(down);
        if (fit.agreeing >= 0.6 * double(votes.size()) && fitOf(0).cost - fit.cost >= 1 && fit.cost - best.cost <= 3)
            views.push_back({fit.gsd, ScaleSlope::ofPicture(kImage, 0, down / 300)});
    }
    return views;
}

/// Votes all over the picture, some of them astray.
std::vector<ScaleVote> votesUnder(double gsd, double right, double down, int count, double astray,
                                  std::mt19937& random) {
    std::uniform_real_distribution<double> x(0, kImage.width), y(0, kImage.height), chance(0, 1);
    std::normal_distribution<double> off(0, 0.15);
    std::vector<ScaleVote> votes;
    for (int i = 0; i < count; ++i) {
        const cv::Point2d place(x(random), y(random));
        const double wrong = chance(random) < astray ? 0.3 + 3 * chance(random) : 1;
        votes.push_back({place, wrong * gsd / growthAt(place, right, down) * std::exp(off(random)), 8});
    }
    return votes;
}

}  // namespace

TEST(SlowSlopeFit, ASlopeIsTheCheapestOfAllAndSavesEnough) {
    std::mt19937 random(7);
    int flat = 0, sloped = 0;
    for (int i = 0; i < 60; ++i) {
        const double right = 0.05 * (i % 7 - 3), down = 0.13 * (i % 13 - 6);
        const auto votes = votesUnder(0.1, right, down, 10 + 3 * (i % 11), 0.1 * (i % 4), random);
        const double gsd = 0.1 * std::exp((i < 40 ? 0.1 : 0.25) * (i % 5 - 2));  // .4 is the most that is believed
        const ScaleSlope slow = slowSlope(votes, gsd), found = fitSlope(votes, kImage, gsd, CameraSlope(kImage));
        EXPECT_NEAR(found.right_per_px, slow.right_per_px, 1e-12) << i;
        EXPECT_NEAR(found.down_per_px, slow.down_per_px, 1e-12) << i;
        ++(slow.isFlat() ? flat : sloped);
    }
    EXPECT_GT(flat, 15);
    EXPECT_GT(sloped, 15);
}

/// How many views are told, which have to be those of the slow fit.
std::size_t comparedViews(const std::vector<ScaleVote>& votes) {
    const auto slow = slowViews(votes), found = fitView(votes, kImage, CameraSlope(kImage));
    EXPECT_EQ(found.size(), slow.size());
    for (std::size_t k = 0; k < std::min(slow.size(), found.size()); ++k) {
        EXPECT_NEAR(found[k].gsd_m_per_px, slow[k].gsd_m_per_px, 1e-9);
        EXPECT_NEAR(found[k].slope.down_per_px, slow[k].slope.down_per_px, 1e-12);
        EXPECT_EQ(found[k].slope.right_per_px, 0);
    }
    return slow.size();
}

TEST(SlowSlopeFit, ViewsAreTheCheapestAndThoseAboutAsGood) {
    std::mt19937 random(9);
    std::vector<int> by_number(4, 0);
    for (int i = 0; i < 60; ++i) {
        const double down = std::array{0.0, 0.3, 0.6, 0.9, 1.4, 2.2}[std::size_t(i % 6)];
        const int count = i % 8 == 7 ? 500 : 18 + 5 * (i % 9);
        auto votes =
            votesUnder(std::array{0.011, 0.05, 0.2, 1.3}[std::size_t(i % 4)], 0, down, count, 0.08 * (i % 5), random);
        // A view is told by what is below its horizon.
        std::erase_if(votes, [](const ScaleVote& vote) { return vote.place.y < 200; });
        SCOPED_TRACE(i);
        ++by_number[comparedViews(votes)];
    }
    EXPECT_GE(*std::min_element(by_number.begin(), by_number.end()), 2) << testing::PrintToString(by_number);
}

TEST(SlowSlopeFit, TheSteepestViewGrowsByFourFromTheMiddleToTheLowerEdge) {
    std::mt19937 random(11);
    for (const double down : {2.5, 3.2, 6.0}) {
        SCOPED_TRACE(down);
        auto votes = votesUnder(0.2, 0, down, 150, 0, random);
        std::erase_if(votes, [](const ScaleVote& vote) { return vote.place.y < 290; });
        EXPECT_GE(comparedViews(votes), 1U);
        if (down < 5) continue;
        EXPECT_NEAR(fitView(votes, kImage, CameraSlope(kImage)).front().slope.down_per_px * 300, 3.8, 0.05);
    }
}

}  // namespace eyrie::slow_slope_fit_test
