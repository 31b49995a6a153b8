#include <gtest/gtest.h>

#include <cmath>

#include "chain/scale/scale_outcomes.h"
#include "chain/scale/view_estimation.h"

/// Which scale outcomes tell, worked out by hand.
namespace eyrie::scale_outcomes_by_hand_test {
namespace {

/// Traffic of four cars that is seen under assumptions with some strength, and nothing under the others.
std::optional<ScaleEstimate> estimate(const std::vector<std::pair<int, double>>& strengths, double looks = 8) {
    std::vector<ScaleOutcome> outcomes(kScaleAssumptions);
    for (const auto& [i, strength] : strengths)
        outcomes.at(static_cast<std::size_t>(i)) = {looks, looks, strength, 4, 4};
    return estimateOfScale(outcomes);
}

TEST(ScaleOutcomes, AssumptionsGrowByTwoFifths) {
    EXPECT_DOUBLE_EQ(assumedGsd(0), 0.04);
    EXPECT_DOUBLE_EQ(assumedGsd(1), 0.056);
    EXPECT_NEAR(assumedGsd(8), 0.04 * 14.75789, 1e-6);
}

TEST(ScaleOutcomes, ScoreIsOfWhatLooksLikeVehiclesAndLittleElse) {
    // 5 of 80 detections look like vehicles, 2 of 3 tracks have a car's size: 6 · (5/80)^¾ · (3/5)⁴.
    EXPECT_NEAR((ScaleOutcome{80, 5, 6, 3, 2}).score(), 0.0972, 1e-12);
    EXPECT_EQ((ScaleOutcome{10, 0, 6, 3, 2}).score(), 0);
    EXPECT_EQ(ScaleOutcome().score(), 0);
    const ScaleOutcome both = ScaleOutcome{10, 5, 6, 3, 2, 1.5, 1} + ScaleOutcome{1, 2, 3, 4, 5, 0.5, 0.25};
    EXPECT_EQ(both.whole_tracks, 2);
    EXPECT_EQ(both.whole_cars, 1.25);
    EXPECT_EQ(both.detections, 11);
    EXPECT_EQ(both.looks, 7);
    EXPECT_EQ(both.decision, 9);
    EXPECT_EQ(both.tracks, 7);
    EXPECT_EQ(both.cars, 7);
    ScaleOutcome slow, fast;
    slow.car_speeds_m_s = {3, 4};
    fast.car_speeds_m_s = {20};
    EXPECT_EQ((slow + fast).car_speeds_m_s, (std::vector<double>{3, 4, 20}));
}

TEST(ScaleOutcomes, ManyCarSizedTracksSayMoreThanAFewThatLookTheMoreLikeVehicles) {
    // Too fine an assumption: every other window looks like a vehicle, but half of the tracks are none of a car's size.
    const ScaleOutcome too_fine{40, 20, 10, 8, 4};
    const ScaleOutcome right{100, 20, 10, 8, 7};
    EXPECT_GT(right.score(), too_fine.score());
}

TEST(ScaleOutcomes, AmidReliefTracksCountThatGoOnLookingLikeCars) {
    // Five windows look like vehicles, by 6 in all; of what does so for one and a half tracks one is as large as a car:
    // 6/5 · 1 · (2/3.5)³.
    EXPECT_NEAR((ScaleOutcome{80, 5, 6, 3, 2, 1.5, 1}).scoreAmidRelief(), 1.2 * std::pow(2 / 3.5, 3), 1e-12);
    EXPECT_EQ((ScaleOutcome{10, 0, 6, 3, 2, 1.5, 1}).scoreAmidRelief(), 0);
    EXPECT_EQ((ScaleOutcome{10, 5, 6, 3, 2, 1.5, 0}).scoreAmidRelief(), 0);
    EXPECT_EQ(ScaleOutcome().scoreAmidRelief(), 0);
    const ScaleOutcome street{100, 50, 500, 6, 5, 4, 4};
    const ScaleOutcome street_with_relief{4500, 50, 500, 90, 45, 4, 4};
    EXPECT_EQ(street.scoreAmidRelief(), street_with_relief.scoreAmidRelief());
    EXPECT_GT(street.score(), 10 * street_with_relief.score());
}

/// Two cars, which too fine an assumption shows beside hardly anything else, and six under the right one, which shows
/// so many other things, too.
std::vector<ScaleOutcome> amidRelief(double others) {
    std::vector<ScaleOutcome> outcomes(kScaleAssumptions);
    outcomes.at(1) = {30, 15, 120, 2, 2, 1.5, 1.5};
    outcomes.at(4) = {100 + others, 100, 900, 8 + others / 50, 6, 6, 6};
    return outcomes;
}

TEST(ScaleOutcomes, WhereMostOfWhatIsDetectedIsReliefItHasNoSay) {
    for (const double others : {0.0, 240.0, 3000.0}) {
        const auto found = estimateOfScale(amidRelief(others));
        ASSERT_TRUE(found) << others;
        EXPECT_GT(found->gsd_m_per_px, 0.9 * assumedGsd(4)) << others;
        EXPECT_EQ(found->vehicles, 6) << others;
    }
    // Shares of what is detected would take the finer one for right.
    const std::vector<ScaleOutcome> relief = amidRelief(3000);
    EXPECT_GT(relief[1].score(), relief[4].score());
    LooksTogether together;
    together.add(relief);
    EXPECT_EQ(together.estimate()->vehicles, 6);
    together.add(relief);
    EXPECT_EQ(together.estimate()->vehicles, 12);
    EXPECT_GT(together.estimate()->gsd_m_per_px, 0.9 * assumedGsd(4));
}

TEST(ScaleOutcomes, FromThreeOfTenDetectionsOnThatLookLikeVehiclesTheirShareCounts) {
    // Half as much goes on looking like a car under the finer assumption, which shows little else.
    const auto vehicles = [](double detections, std::size_t coarser = 4) {
        std::vector<ScaleOutcome> outcomes(kScaleAssumptions);
        outcomes.at(1) = {30, 30, 270, 5, 5, 3, 3};
        outcomes.at(coarser) = {detections, 30, 270, 30, 7, 6, 6};
        return estimateOfScale(outcomes).value().vehicles;
    };
    EXPECT_EQ(vehicles(99), 5);
    EXPECT_EQ(vehicles(101), 7);
    EXPECT_EQ(vehicles(101, 0), 5) << "a finer one is not believed";
    // Where nothing goes on looking like a car, shares alone say something; where nothing scores, nothing does.
    std::vector<ScaleOutcome> outcomes(kScaleAssumptions);
    outcomes.at(0) = {99, 20, 200, 5, 5};
    EXPECT_EQ(estimateOfScale(outcomes).value().vehicles, 5);
    outcomes.at(0).decision = 0;
    EXPECT_FALSE(estimateOfScale(outcomes));
}

TEST(ScaleOutcomes, InTheDarkSizesAreThoseOfVehiclesWithWhatTheyLight) {
    const auto found = [](double in_dark) {
        std::vector<ScaleOutcome> outcomes(kScaleAssumptions);
        outcomes.at(4) = {24, 24, 200, 4, 4};
        outcomes.at(4).in_dark = in_dark;
        return estimateOfScale(outcomes).value().gsd_m_per_px;
    };
    EXPECT_NEAR(found(0), assumedGsd(4), 1e-12);
    EXPECT_NEAR(found(24), assumedGsd(4) * std::exp(0.3), 1e-12);
    EXPECT_NEAR(found(6), assumedGsd(4) * std::exp(0.3 / 4), 1e-12) << "a quarter of the pictures, or a quarter dark";
    ScaleOutcome day{30, 8, 1, 4, 4};
    ScaleOutcome night{10, 8, 1, 4, 4};
    night.in_dark = 10;
    EXPECT_DOUBLE_EQ((day + night).darkness(), 0.25);
    EXPECT_EQ(ScaleOutcome().darkness(), 0);
}

TEST(ScaleOutcomes, EightLooksAndACarAreTraffic) {
    EXPECT_TRUE((ScaleOutcome{100, 8, 1, 9, 1}).showsTraffic());
    EXPECT_FALSE((ScaleOutcome{100, 7, 1, 9, 1}).showsTraffic());
    EXPECT_FALSE((ScaleOutcome{100, 8, 1, 9, 0}).showsTraffic());
}

TEST(ScaleOutcomes, ACarIsNeitherShorterNorWiderThanCarsAre) {
    EXPECT_TRUE(isCarSized(3.61, 1.51));
    EXPECT_TRUE(isCarSized(6.59, 3.79));
    for (const auto& [length, width] : {std::pair(3.6, 2.0), {6.6, 2.0}, {5.0, 1.5}, {5.0, 3.8}})
        EXPECT_FALSE(isCarSized(length, width)) << length << " x " << width;
}

TEST(ScaleOutcomes, AViewIsAsSureAsTheLengthsOfWhatDrivesThere) {
    EXPECT_NEAR(uncertaintyOfView(1), std::exp(1.645 * std::sqrt(0.0121 + 0.0225)), 1e-12);
    EXPECT_NEAR(uncertaintyOfView(4), std::exp(1.645 * std::sqrt(0.0121 + 0.0225 / 4)), 1e-12);
    EXPECT_EQ(uncertaintyOfView(0), uncertaintyOfView(1));
}

TEST(ScaleOutcomes, OneAssumptionAloneIsTheScale) {
    for (const int i : {0, 4, 8}) {
        const auto found = estimate({{i, 1}});
        ASSERT_TRUE(found) << i;
        EXPECT_NEAR(found->gsd_m_per_px, assumedGsd(i), 1e-12);
        EXPECT_EQ(found->vehicles, 4);
        // The logarithm's variance: its own, and a twelfth of a step's square for each of four cars.
        const double step = std::log(1.4);
        EXPECT_NEAR(found->uncertainty, std::exp(1.645 * std::sqrt(0.11 * 0.11 + step * step / 12 / 4)), 1e-9);
    }
}

TEST(ScaleOutcomes, WhereLittleLooksLikeVehiclesTheAssumedScaleHasASay) {
    // 24 of so many detections look like vehicles; relief makes the others.
    const auto found = [](double detections) {
        std::vector<ScaleOutcome> outcomes(kScaleAssumptions);
        outcomes.at(1) = {detections, 24, 200, 4, 4};
        return estimateOfScale(outcomes).value();
    };
    const double of_a_step = std::pow(std::log(1.4), 2) / 12 / 4;
    const struct {
        double detections, doubt, drawn;
    } cases[] = {{24, 0, 0},  {24 / 0.45, 0, 0},   {24 / 0.325, 0.5, 0}, {120, 1, 0},
                 {150, 1, 0}, {24 / 0.13, 1, 0.5}, {240, 1, 1},          {999, 1, 1}};
    for (const auto& one : cases) {
        const double by_sizes = 0.056 * std::exp(0.2 * one.doubt);
        EXPECT_NEAR(found(one.detections).gsd_m_per_px, by_sizes * std::pow(0.25 / by_sizes, 0.36 * one.drawn), 1e-9)
            << one.detections;
        const double own = 0.11 + one.doubt * (0.45 - 0.11);
        EXPECT_NEAR(found(one.detections).uncertainty, std::exp(1.645 * std::sqrt(own * own + of_a_step)), 1e-9);
    }
}

TEST(ScaleOutcomes, SpeedsSayTheMoreTheLessSureSizesAre) {
    // Of four cars that are seen at .056 m/px three drive at no more than 22 m/s, twice the 11 m/s of towns: .028 m/px.
    const auto found = [](double detections, const std::vector<double>& speeds) {
        std::vector<ScaleOutcome> outcomes(kScaleAssumptions);
        outcomes.at(1) = {detections, 24, 200, 4, 4, 0, 0, speeds};
        outcomes.at(3).car_speeds_m_s = {99, 99, 99, 99};  // of an assumption that says nothing
        return estimateOfScale(outcomes).value();
    };
    for (const auto& [detections, doubt] : {std::pair(24.0, 0.0), {80, 0.6}, {120, 1}}) {
        const double own = 0.11 + doubt * (0.45 - 0.11);
        const double of_sizes = own * own + std::pow(std::log(1.4), 2) / 12 / 4;
        const double pull = of_sizes / (of_sizes + 0.45 * 0.45);
        const ScaleEstimate told = found(detections, {30, 5, 22, 10});
        const double by_sizes = 0.056 * std::exp(0.2 * doubt);
        EXPECT_NEAR(told.gsd_m_per_px, by_sizes * std::pow(0.028 / by_sizes, pull), 1e-9) << detections;
        EXPECT_NEAR(told.uncertainty, std::exp(1.645 * std::sqrt(pull) * 0.45), 1e-9) << detections;
        EXPECT_LT(told.uncertainty, found(detections, {}).uncertainty);
        EXPECT_GT(found(detections, {2, 2, 2, 2}).gsd_m_per_px, by_sizes)
            << "slow ones are farther away than they seem";
        for (const std::vector<double>& nothing : {std::vector<double>{}, {0, 0, 0, 0}})
            EXPECT_NEAR(found(detections, nothing).gsd_m_per_px, by_sizes, 1e-9);
    }
}

TEST(ScaleOutcomes, NeighboursPullAsTheSquaresOfTheirScores) {
    EXPECT_NEAR(estimate({{4, 1}, {5, 1}})->gsd_m_per_px, assumedGsd(4) * std::sqrt(1.4), 1e-12);
    EXPECT_NEAR(estimate({{4, 1}, {5, 0.5}})->gsd_m_per_px, assumedGsd(4) * std::pow(1.4, 0.2), 1e-12);
    EXPECT_NEAR(estimate({{3, 0.5}, {4, 1}})->gsd_m_per_px, assumedGsd(4) * std::pow(1.4, -0.2), 1e-12);
    const double step = std::log(1.4);
    EXPECT_NEAR(estimate({{4, 1}, {5, 1}})->uncertainty,
                std::exp(1.645 * std::sqrt(0.11 * 0.11 + (step * step / 4 + step * step / 12) / 4)), 1e-9);
}

TEST(ScaleOutcomes, OnlyTwoAssumptionsOnEitherSideHaveASay) {
    EXPECT_NEAR(estimate({{4, 1}, {6, 1}})->gsd_m_per_px, assumedGsd(5), 1e-12);
    EXPECT_NEAR(estimate({{2, 0.9999}, {4, 1}})->gsd_m_per_px, assumedGsd(3), 1e-4);
    EXPECT_NEAR(estimate({{4, 1}, {7, 0.9}})->gsd_m_per_px, assumedGsd(4), 1e-12);
    EXPECT_NEAR(estimate({{1, 0.9}, {4, 1}})->gsd_m_per_px, assumedGsd(4), 1e-12);
    EXPECT_NEAR(estimate({{0, 1}, {2, 1}})->gsd_m_per_px, assumedGsd(1), 1e-12);
    EXPECT_NEAR(estimate({{6, 1}, {8, 1}})->gsd_m_per_px, assumedGsd(7), 1e-12);
}

TEST(ScaleOutcomes, ChanceIsNoTraffic) {
    EXPECT_TRUE(estimate({{4, 1}}, 8));
    EXPECT_FALSE(estimate({{4, 1}}, 7));
    EXPECT_FALSE(estimate({}));
    std::vector<ScaleOutcome> outcomes(kScaleAssumptions);
    outcomes[4] = {20, 20, 5, 4, 1};
    EXPECT_TRUE(estimateOfScale(outcomes));
    outcomes[4].cars = 0;
    EXPECT_FALSE(estimateOfScale(outcomes)) << "nothing has a car's size";
}

/// Of a look at so many cars, which are seen under one assumption.
std::vector<ScaleOutcome> lookAt(int assumption, double cars, double looks = 20) {
    std::vector<ScaleOutcome> outcomes(kScaleAssumptions);
    outcomes.at(static_cast<std::size_t>(assumption)) = {looks, looks, 5, cars, cars};
    return outcomes;
}

TEST(LooksTogether, TenVehiclesAreEnoughInOneLookOrInSeveral) {
    for (const auto& [first, second] : {std::pair(10, 0), {9, 0}, {5, 5}, {5, 4}, {9, 1}}) {
        LooksTogether together;
        EXPECT_FALSE(together.suffice());
        together.add(lookAt(4, first));
        if (second > 0) together.add(lookAt(4, second));
        ASSERT_TRUE(together.estimate());
        EXPECT_EQ(together.estimate()->vehicles, first + second);
        EXPECT_EQ(together.suffice(), first + second >= 10) << first << " and " << second;
    }
}

TEST(LooksTogether, OneThatTellsScalesApartCountsMoreThanOneThatDoesNot) {
    // The first look says one thing clearly; in the second something else looks a little more like vehicles, of which
    // there are many more.
    std::vector<ScaleOutcome> clear(kScaleAssumptions);
    clear[4] = {20, 20, 100, 4, 4};
    std::vector<ScaleOutcome> blurred(kScaleAssumptions);
    blurred[4] = {40, 20, 20, 30, 3};
    blurred[7] = {60, 35, 40, 30, 20};
    LooksTogether together;
    together.add(clear);
    together.add(blurred);
    EXPECT_NEAR(together.estimate()->gsd_m_per_px, assumedGsd(4), 1e-3 * assumedGsd(4));
    EXPECT_EQ(together.estimate()->vehicles, 7);
}

TEST(LooksTogether, TellWhatTheSumOfThemTells) {
    LooksTogether together;
    together.add(lookAt(4, 2));
    EXPECT_NEAR(together.estimate()->gsd_m_per_px, assumedGsd(4), 1e-12);
    together.add(lookAt(5, 2));
    EXPECT_NEAR(together.estimate()->gsd_m_per_px, assumedGsd(4) * std::sqrt(1.4), 1e-12);
    together.add(lookAt(8, 0));
    EXPECT_NEAR(together.estimate()->gsd_m_per_px, assumedGsd(4) * std::sqrt(1.4), 1e-12) << "no traffic";
}

TEST(LooksTogether, ChanceDoesNotAddUpToTraffic) {
    LooksTogether together;
    for (int i = 0; i < 5; ++i) together.add(lookAt(4, 1, 7));
    EXPECT_FALSE(together.estimate());
    together.add(lookAt(2, 1, 8));
    EXPECT_NEAR(together.estimate()->gsd_m_per_px, assumedGsd(2), 1e-12);
}

TEST(ViewOutcomes, TheBestIsOneThatShowsTrafficAndMostlyCars) {
    // Tracks, and those of them that are as large as a car, of what else looks the same.
    const auto view = [](double tracks, double cars, double decision = 5) {
        return ScaleOutcome{20, 20, decision, tracks, cars};
    };
    EXPECT_EQ(bestOfViews({}), std::nullopt);
    EXPECT_EQ(bestOfViews({view(1, 1)}), 0U);
    EXPECT_EQ(bestOfViews({view(1, 0)}), std::nullopt) << "no car";
    EXPECT_EQ(bestOfViews({view(2, 1)}), 0U);
    EXPECT_EQ(bestOfViews({view(3, 1)}), std::nullopt) << "less than half of the tracks";
    EXPECT_EQ(bestOfViews({view(10, 5)}), 0U);
    EXPECT_EQ(bestOfViews({view(11, 5)}), std::nullopt);
    EXPECT_EQ(bestOfViews({view(1, 1, -5)}), std::nullopt) << "surely none";
    // Whatever comes before or after it.
    EXPECT_EQ(bestOfViews({view(1, 1, 5), view(1, 0, 9), view(1, 1, 4), view(1, 1, 6), view(1, 1, 3)}), 3U);
    EXPECT_EQ(bestOfViews({view(1, 1, 5), view(1, 1, 5)}), 0U);
}

}  // namespace
}  // namespace eyrie::scale_outcomes_by_hand_test
