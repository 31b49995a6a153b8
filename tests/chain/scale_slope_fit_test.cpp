#include "chain/scale/scale_slope_fit.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "chain/scale/slope_estimation.h"
#include "chain/scale/view_estimation.h"
#include "support/moving_scene.h"
#include "support/shared_data.h"

namespace eyrie::scale_slope_fit_test {
namespace {

const cv::Size kImage{1000, 600};
constexpr double kGsd = 0.1;

/// Votes all over the picture, of vehicles that differ by `spread` (of the logarithm) under a true slope.
std::vector<ScaleVote> votesUnder(double right, double down, int count, double spread = 0.12, unsigned seed = 1) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> x(20, kImage.width - 20);
    std::uniform_real_distribution<double> y(20, kImage.height - 20);
    std::normal_distribution<double> off(0, spread);
    const ScaleSlope slope = ScaleSlope::ofPicture(kImage, right, down);
    std::vector<ScaleVote> votes;
    for (int i = 0; i < count; ++i) {
        const cv::Point2d place(x(random), y(random));
        votes.push_back({place, kGsd / slope.factorAt(place) * std::exp(off(random)), 8});
    }
    return votes;
}

TEST(ScaleSlopeFit, FindsTheSlopeOfAnObliqueView) {
    for (const double down : {0.0008, 0.0015, 0.0025}) {
        const ScaleSlope found = fitSlope(votesUnder(0, down, 120), kImage, kGsd, CameraSlope(kImage));
        EXPECT_NEAR(found.down_per_px, down, 0.15 * down + 0.0001);
        EXPECT_NEAR(found.right_per_px, 0, 0.00015);
        EXPECT_EQ(found.centre(), cv::Point2d(499.5, 299.5));
    }
    EXPECT_NEAR(fitSlope(votesUnder(0, -0.0015, 120), kImage, kGsd, CameraSlope(kImage)).down_per_px, -0.0015, 0.0003)
        << "upside down";
}

TEST(ScaleSlopeFit, AHorizonThatIsNotLevelIsFoundToo) {
    const ScaleSlope found = fitSlope(votesUnder(0.0005, 0.0015, 200), kImage, kGsd, CameraSlope(kImage));
    EXPECT_NEAR(found.right_per_px, 0.0005, 0.0002);
    EXPECT_NEAR(found.down_per_px, 0.0015, 0.0003);
}

TEST(ScaleSlopeFit, ANadirViewIsFlatHoweverManyVehiclesVote) {
    for (unsigned seed = 1; seed <= 20; ++seed) {
        for (const int count : {15, 60, 300})
            EXPECT_TRUE(fitSlope(votesUnder(0, 0, count, 0.25, seed), kImage, kGsd, CameraSlope(kImage)).isFlat())
                << count << ", " << seed;
    }
}

TEST(ScaleSlopeFit, PartsAndPairsOfCarsTellNothing) {
    std::vector<ScaleVote> votes = votesUnder(0, 0.002, 120);
    std::vector<ScaleVote> astray = votesUnder(0, 0, 60, 0.1, 2);
    for (std::size_t i = 0; i < astray.size(); ++i) {
        astray[i].gsd_m_per_px *= i % 2 == 0 ? 2.5 : 0.4;
        votes.push_back(astray[i]);
    }
    EXPECT_NEAR(fitSlope(votes, kImage, kGsd, CameraSlope(kImage)).down_per_px, 0.002, 0.0004);
}

TEST(ScaleSlopeFit, TheMiddleNeedNotBeExactlyTheGivenScale) {
    std::vector<ScaleVote> votes = votesUnder(0, 0.002, 120);
    for (ScaleVote& vote : votes) vote.gsd_m_per_px *= 0.85;
    EXPECT_NEAR(fitSlope(votes, kImage, kGsd, CameraSlope(kImage)).down_per_px, 0.002, 0.0004);
}

/// Votes without noise, spread evenly over the picture; growth is that from its middle to an edge.
ScaleSlope fitOf(double right, double down, int count) {
    const ScaleSlope slope = ScaleSlope::ofPicture(kImage, right / 500, down / 300);
    std::vector<ScaleVote> votes;
    for (int i = 0; i < count; ++i) {
        const cv::Point2d place(20 + 960.0 * (i * 7 % count) / (count - 1), 20 + 560.0 * i / (count - 1));
        votes.push_back({place, kGsd / slope.factorAt(place), 8});
    }
    return fitSlope(votes, kImage, kGsd, CameraSlope(kImage));
}

TEST(ScaleSlopeFit, TwelveVotesAreEnoughAndElevenAreNot) {
    EXPECT_NEAR(fitOf(0, 0.6, 12).down_per_px, 0.6 / 300, 1e-9);
    EXPECT_NEAR(fitOf(0, -0.6, 12).down_per_px, -0.6 / 300, 1e-9);
    EXPECT_TRUE(fitOf(0, 0.6, 11).isFlat());
}

TEST(ScaleSlopeFit, AGrowthByLessThanASeventhIsNotWorthIt) {
    EXPECT_NEAR(fitOf(0, 0.15, 300).down_per_px, 0.15 / 300, 1e-9);
    EXPECT_NEAR(fitOf(0.15, 0, 300).right_per_px, 0.15 / 500, 1e-9);
    EXPECT_TRUE(fitOf(0, 0.1, 300).isFlat());
    EXPECT_TRUE(fitOf(0.1, 0, 300).isFlat());
}

TEST(ScaleSlopeFit, AHorizonThatLeansIsBelievedReluctantly) {
    EXPECT_NEAR(fitOf(0, 0.9, 40).down_per_px, 0.9 / 300, 1e-9) << "the most that is looked for";
    EXPECT_NEAR(fitOf(0.3, 0, 40).right_per_px, 0.25 / 500, 1e-9) << "a step less than the votes say";
}

TEST(ScaleSlopeFit, StrongerGrowthsAreNotLookedFor) {
    for (const double sign : {-1.0, 1.0}) {
        EXPECT_NEAR(fitOf(0, 0.98 * sign, 400).down_per_px, 0.9 * sign / 300, 1e-9);
        EXPECT_NEAR(fitOf(0.5 * sign, 0, 400).right_per_px, 0.3 * sign / 500, 1e-9);
    }
}

TEST(ScaleSlopeFit, FewVotesOrVotesInOnePlaceTellNoSlope) {
    EXPECT_TRUE(fitSlope({}, kImage, kGsd, CameraSlope(kImage)).isFlat());
    EXPECT_TRUE(fitSlope(votesUnder(0, 0.002, 11), kImage, kGsd, CameraSlope(kImage)).isFlat());
    std::vector<ScaleVote> together = votesUnder(0, 0.002, 200);
    for (ScaleVote& vote : together) vote.place = {500, 300 + (vote.place.y - 300) / 100};
    EXPECT_TRUE(fitSlope(together, kImage, kGsd, CameraSlope(kImage)).isFlat());
}

/// Votes of one vehicle that drives from the far end of a view towards the camera.
std::vector<ScaleVote> votesOnTheWay(double horizon_y, int count, double spread = 0.12) {
    std::mt19937 random(3);
    std::normal_distribution<double> off(0, spread);
    const double middle_y = (kImage.height - 1) / 2.0;
    std::vector<ScaleVote> votes;
    for (int i = 0; i < count; ++i) {
        const cv::Point2d place(480 + i, 230 + 150.0 * i / (count - 1));
        const double farther = (middle_y - horizon_y) / (place.y - horizon_y);
        votes.push_back({place, kGsd * farther * std::exp(off(random)), 8});
    }
    return votes;
}

TEST(ViewFit, OneVehicleThatComesNearerTellsScaleAndHorizonTogether) {
    for (const double horizon_y : {180.0, 100.0}) {
        const auto found = fitView(votesOnTheWay(horizon_y, 30), kImage, CameraSlope(kImage));
        ASSERT_FALSE(found.empty()) << horizon_y;
        const auto& [gsd, slope] = found.front();
        EXPECT_NEAR(gsd, kGsd, 0.15 * kGsd);
        EXPECT_EQ(slope.right_per_px, 0);
        const double told = slope.centre_y - 1 / slope.down_per_px;
        EXPECT_NEAR(told, horizon_y, 0.35 * (300 - horizon_y)) << "in the picture, where fitSlope() does not look";
    }
}

TEST(ViewFit, PartsOfTheVehicleDoNotMislead) {
    std::vector<ScaleVote> votes = votesOnTheWay(180, 30);
    for (std::size_t i = 0; i < votes.size(); i += 4) votes[i].gsd_m_per_px *= 2.5;
    const auto found = fitView(votes, kImage, CameraSlope(kImage));
    ASSERT_FALSE(found.empty());
    EXPECT_NEAR(found.front().gsd_m_per_px, kGsd, 0.2 * kGsd);
}

TEST(ViewFit, OthersThatFitAboutAsWellAreTold) {
    const auto few = fitView(votesOnTheWay(180, 20), kImage, CameraSlope(kImage));
    ASSERT_GE(few.size(), 2U);
    EXPECT_NE(few[0].slope, few[1].slope);
    EXPECT_EQ(fitView(votesOnTheWay(180, 400, 0.05), kImage, CameraSlope(kImage)).size(), 1U) << "where many agree";
}

TEST(ViewFit, NothingIsToldByFewVotesByOneScaleForAllOrByVotesThatDisagree) {
    EXPECT_FALSE(fitView(votesOnTheWay(180, 16), kImage, CameraSlope(kImage)).empty());
    EXPECT_TRUE(fitView(votesOnTheWay(180, 15), kImage, CameraSlope(kImage)).empty());
    for (unsigned seed = 1; seed <= 20; ++seed)
        EXPECT_TRUE(fitView(votesUnder(0, 0, 60, 0.12, seed), kImage, CameraSlope(kImage)).empty()) << seed;
    std::vector<ScaleVote> scattered = votesOnTheWay(180, 30);
    for (std::size_t i = 0; i < scattered.size(); ++i)
        scattered[i].gsd_m_per_px *= i % 2 == 0 ? 1 : 3.0 + double(i % 7);
    EXPECT_TRUE(fitView(scattered, kImage, CameraSlope(kImage)).empty());
}

TEST(ViewEstimation, ACarThatGrowsOnItsWayShowsTheHorizonOfALowFlight) {
    EYRIE_NEED_SHARED_DATA("uav123_car16");
    SourceOptions low;
    low.frame_rate_hz = 10;
    const auto source = openSource(test::sharedData("uav123_car16/frames"), low);
    std::vector<RunProgress> told;
    const auto view = estimateView(*source, {36, 78}, ChainOptions{}, 10, {},
                                   [&](const RunProgress& progress) { told.push_back(progress); });
    ASSERT_TRUE(view);
    EXPECT_EQ(std::count_if(told.begin(), told.end(),
                            [](const RunProgress& at) { return at.frames_done == at.frames_total; }),
              2)
        << "one look for what moves, one at what fits it";
    for (const RunProgress& at : told) EXPECT_LE(at.frames_done, at.frames_total);
    EXPECT_EQ(told.back().frames_done, told.back().frames_total);
    // The horizon lies at y = 108 when the car is at y = 175, where it is 60 px long.
    EXPECT_NEAR(view->slope.centre_y - 1 / view->slope.down_per_px, 108, 15);
    EXPECT_NEAR(view->middle.gsd_m_per_px, 0.075, 0.02);
    EXPECT_GE(view->middle.vehicles, 1);
    // The error of the look, and that of the lengths of what was seen at once, parts of one car counting once.
    const double of_lengths = std::pow(std::log(view->middle.uncertainty) / 1.645, 2) - 0.11 * 0.11;
    const double at_once = 0.15 * 0.15 / of_lengths;
    EXPECT_NEAR(at_once, std::round(at_once), 1e-9);
    EXPECT_GE(std::round(at_once), 1);
    EXPECT_LE(std::round(at_once), view->middle.vehicles);
    std::stop_source stopped;
    stopped.request_stop();
    EXPECT_FALSE(estimateView(*source, {36, 78}, ChainOptions{}, 10, stopped.get_token()));
}

TEST(SlopeEstimation, ARealObliqueViewHasASlopeWhichIsOnlyLookedForWhereAsked) {
    EYRIE_NEED_SHARED_DATA("uavdt_m1303");
    SourceOptions rate;
    rate.frame_rate_hz = 30;
    const auto source = openSource(test::sharedData("uavdt_m1303/img1"), rate);
    ChainOptions options;
    setParameter(describeOf(options), "view.oblique", "false");
    EXPECT_TRUE(chooseScale(*source, {}, options, {0.08}, {}).scale.slope.isFlat());
    EXPECT_FALSE(builtInPreset("thesis").view.oblique) << "the thesis looks straight down";
    options.view.oblique = true;
    // Labelled vehicles there grow by .28 % a pixel.
    const ScaleSlope oblique = chooseScale(*source, {}, options, {0.08}, {}).scale.slope;
    EXPECT_NEAR(oblique.down_per_px, 0.0028, 0.0008);
    EXPECT_NEAR(oblique.right_per_px, 0, 0.0005);
    std::stop_source stopped;
    stopped.request_stop();
    EXPECT_TRUE(estimateSlope(*source, {}, options, SceneScale{0.08, 30, true}, stopped.get_token()).isFlat());
}

TEST(SlopeEstimation, ARealNadirViewHasNoneAndItIsToldHowFarTheLookIs) {
    EYRIE_NEED_SHARED_DATA("collage_day");
    const auto source = openSource(test::sharedData("collage_day/frames"));
    std::vector<RunProgress> told;
    EXPECT_TRUE(
        estimateSlope(*source, {}, ChainOptions{}, SceneScale{0.2, 25, true}, {}, [&](const RunProgress& progress) {
            told.push_back(progress);
        }).isFlat());
    ASSERT_GE(told.size(), 34U);
    EXPECT_TRUE(told.front().estimating_scale);
    EXPECT_EQ(told.front().frames_done, 1);
    EXPECT_LE(told.back().frames_done, told.back().frames_total);
}

}  // namespace
}  // namespace eyrie::scale_slope_fit_test
