#include "evaluation/comparison/significance.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>

#include "core/error.h"
#include "evaluation/comparison/track_bootstrap.h"

namespace eyrie::significance_test {
namespace {

TEST(PairedTTest, HandWorked) {
    // Differences 1, 2, 3, 4: mean 2.5, deviation 1.291, t = 2.5 / (1.291 / 2), 3 degrees of freedom
    const PairedTTest test = pairedTTest({2, 4, 6, 8}, {1, 2, 3, 4});
    EXPECT_EQ(test.pairs, 4);
    EXPECT_DOUBLE_EQ(test.mean_difference, 2.5);
    EXPECT_NEAR(test.t, 3.872983346, 1e-9);
    EXPECT_NEAR(test.p_value, 0.030466291662, 1e-11);
}

TEST(PairedTTest, OrderOfTheMethodsTurnsTheSignOnly) {
    const PairedTTest one = pairedTTest({0.81, 0.75, 0.9}, {0.8, 0.7, 0.91});
    const PairedTTest other = pairedTTest({0.8, 0.7, 0.91}, {0.81, 0.75, 0.9});
    EXPECT_DOUBLE_EQ(one.t, -other.t);
    EXPECT_DOUBLE_EQ(one.p_value, other.p_value);
}

TEST(PairedTTest, EqualDifferences) {
    EXPECT_EQ(pairedTTest({1, 2}, {1, 2}).p_value, 1);
    EXPECT_EQ(pairedTTest({2, 3}, {1, 2}).p_value, 0);
    EXPECT_THROW(pairedTTest({1}, {1}), Error);
    EXPECT_THROW(pairedTTest({1, 2}, {1, 2, 3}), Error);
}

TEST(Student, TailsOfTheDistribution) {
    EXPECT_NEAR(studentTwoSided(0, 5), 1, 1e-12);
    EXPECT_NEAR(studentTwoSided(1, 1), 0.5, 1e-12);                         // Cauchy: quartiles at ±1
    EXPECT_NEAR(studentTwoSided(30, 2), 1 - 30 / std::sqrt(902.0), 1e-12);  // closed form for two degrees
    EXPECT_NEAR(studentTwoSided(2.5, 7), 0.040992218586, 1e-11);
    EXPECT_NEAR(studentTwoSided(0.1, 40), 0.920843853045, 1e-11);
    EXPECT_NEAR(studentTwoSided(12, 200) / 2.42213600525e-25, 1, 1e-8);
}

TEST(Bootstrap, ShareOfSuccessesHasTheBinomialInterval) {
    const int units = 400;
    const Statistic share = [&](const std::vector<int>& counts) {
        return std::accumulate(counts.begin(), counts.begin() + 100, 0) / static_cast<double>(units);
    };
    const BootstrapInterval interval = bootstrap(units, share);
    EXPECT_DOUBLE_EQ(interval.value, 0.25);
    const double half = 1.96 * std::sqrt(0.25 * 0.75 / units);
    EXPECT_NEAR(interval.low, 0.25 - half, 0.006);
    EXPECT_NEAR(interval.high, 0.25 + half, 0.006);
}

TEST(Student, SmallDegreesOfFreedomHaveClosedForms) {
    for (const double t : {0.05, 0.3, 0.9, 1.7, 4.0, 25.0}) {
        EXPECT_NEAR(studentTwoSided(t, 1), 1 - 2 / std::numbers::pi * std::atan(t), 1e-12) << t;
        EXPECT_NEAR(studentTwoSided(t, 2), 1 - t / std::sqrt(2 + t * t), 1e-12) << t;
        EXPECT_NEAR(studentTwoSided(t, 4), 1 - t * (6 + t * t) / std::pow(4 + t * t, 1.5), 1e-12) << t;
        EXPECT_EQ(studentTwoSided(t, 4), studentTwoSided(-t, 4));
    }
    EXPECT_EQ(studentTwoSided(std::numeric_limits<double>::infinity(), 3), 0);
}

TEST(Bootstrap, QuantilesAreThoseOfTheResamples) {
    // The number of draws of one of two units is 0, 1 or 2 with the chances 1/4, 1/2, 1/4.
    const Statistic first = [](const std::vector<int>& counts) { return static_cast<double>(counts[0]); };
    BootstrapOptions options;
    options.confidence = 0.6;
    EXPECT_EQ(bootstrap(2, first, options).low, 0);
    EXPECT_EQ(bootstrap(2, first, options).high, 2);
    options.confidence = 0.4;
    EXPECT_EQ(bootstrap(2, first, options).low, 1);
    EXPECT_EQ(bootstrap(2, first, options).high, 1);
    options.resamples = 1;
    EXPECT_EQ(bootstrap(1, first, options).low, 1) << "of one unit there is one sample";
    options.resamples = 0;
    EXPECT_THROW(bootstrap(1, first, options), Error);
    options.resamples = 9;
    for (const double confidence : {0.0, 1.0, -0.1}) {
        options.confidence = confidence;
        EXPECT_THROW(bootstrap(1, first, options), Error) << confidence;
    }
}

TEST(Bootstrap, QuantilesLieBetweenTheResamples) {
    double next = -1;
    BootstrapOptions options;
    options.resamples = 5;
    options.confidence = 0.9;
    const BootstrapInterval interval = bootstrap(
        3, [&](const std::vector<int>&) { return next++; }, options);
    EXPECT_EQ(interval.value, -1) << "of the units themselves";
    EXPECT_NEAR(interval.low, 0.2, 1e-12) << "of 0, 1, 2, 3, 4";
    EXPECT_NEAR(interval.high, 3.8, 1e-12);
}

TEST(Bootstrap, DrawsAsManyAsThereAreUnits) {
    bool right = true;
    bootstrap(7, [&](const std::vector<int>& counts) {
        right = right && std::accumulate(counts.begin(), counts.end(), 0) == 7 && counts.size() == 7;
        return 0.0;
    });
    EXPECT_TRUE(right);
}

TEST(TrackBootstrap, CountsMissesSwitchesAndFalsePositives) {
    TrackTallies tallies;
    tallies.truth.push_back({.id = 1, .frames = 10, .matched = 7, .switches = 2});
    tallies.truth.push_back({.id = 2, .frames = 6, .matched = 5});
    tallies.results.push_back({.id = 8, .matched = 12, .false_positives = 3});
    const TrackBootstrap b = bootstrapTracks(tallies);
    EXPECT_NEAR(b.f_score.value, 24.0 / (24 + 4 + 3), 1e-12);
    EXPECT_NEAR(b.mota.value, 1 - (4 + 3 + 2) / 16.0, 1e-12);
}

TEST(Bootstrap, SeedDecidesEverything) {
    const Statistic first = [](const std::vector<int>& counts) { return counts[0] + 0.1 * counts[3]; };
    BootstrapOptions options;
    const BootstrapInterval a = bootstrap(30, first, options);
    const BootstrapInterval b = bootstrap(30, first, options);
    EXPECT_EQ(a.low, b.low);
    EXPECT_EQ(a.high, b.high);
    EXPECT_THROW(bootstrap(0, first), Error);
    options.confidence = 1;
    EXPECT_THROW(bootstrap(30, first, options), Error);
}

TEST(TrackBootstrap, IntervalHoldsTheFigureAndWidensWithTheTracksDifference) {
    TrackTallies even;
    TrackTallies uneven;
    for (int k = 0; k < 20; ++k) {
        even.truth.push_back({.id = k, .frames = 10, .matched = 8});
        uneven.truth.push_back({.id = k, .frames = 10, .matched = k % 5 == 0 ? 0 : 10});
    }
    const TrackBootstrap a = bootstrapTracks(even);
    const TrackBootstrap b = bootstrapTracks(uneven);
    EXPECT_NEAR(a.mota.value, 0.8, 1e-12);
    EXPECT_NEAR(b.mota.value, 0.8, 1e-12);
    EXPECT_NEAR(a.mota.low, 0.8, 1e-12);
    EXPECT_LT(b.mota.low, 0.75);
    EXPECT_GT(b.mota.high, 0.85);
    EXPECT_NEAR(a.f_score.value, 2 * 0.8 / 1.8, 1e-12);
}

}  // namespace
}  // namespace eyrie::significance_test
