// What headlights light ahead of vehicles: how it is seen, and what is taken out of boxes.
#include "tracking/pictures/headlight_beams.h"

#include <gtest/gtest.h>

namespace eyrie::headlight_beams_test {
namespace {

const OrientedBox kBox{{59.5, 39.5}, 30, 10, 0};
const SilhouetteGrid kGrid(kBox, 6, 1);

/// A dark vehicle in the rear two thirds of the box, its lamps at x = 63, and ground that is lit ahead of them.
cv::Mat night(int vehicle, int lamps, int lit) {
    cv::Mat picture(80, 120, CV_8UC1, cv::Scalar(50));
    picture(cv::Rect(45, 35, 19, 10)).setTo(vehicle);
    picture(cv::Rect(64, 33, 40, 14)).setTo(lit);
    picture(cv::Rect(62, 35, 3, 10)).setTo(lamps);
    return picture;
}

double beamOf(const cv::Mat& picture) {
    const cv::Mat ground(80, 120, CV_8UC1, cv::Scalar(50));
    return kGrid.beamInBox(kGrid.sampled(picture), {kGrid.sampled(ground)});
}

/// Looks at tracks 1, 2, …, two of each, that say so much of their beams.
std::vector<SilhouetteLook> looksAt(const std::vector<double>& beams, int looks_each = 2, double darkness = 0) {
    std::vector<SilhouetteLook> looks;
    for (std::size_t i = 0; i < beams.size(); ++i) {
        for (int k = 0; k < looks_each; ++k) {
            looks.emplace_back();
            looks.back().track = static_cast<TrackId>(i + 1);
            looks.back().beam = beams[i];
            looks.back().darkness = darkness;
        }
    }
    return looks;
}

/// The box of track 1, 20 × 11 px at (100, 60), after beams were taken out.
OrientedBox after(const std::vector<SilhouetteLook>& looks, double heading = 0, double width = 11) {
    TrackState state;
    state.id = 1;
    state.box = {{100, 60}, 20, width, heading};
    std::vector<TrackPath> paths{{1, {{0, PathState(state)}, {5, PathState(state)}}}};
    takeOutBeams(paths, looks);
    EXPECT_EQ(paths[0].states[0].second.box.length, paths[0].states[1].second.box.length);
    return paths[0].states[0].second.box;
}

}  // namespace

TEST(HeadlightBeams, BeginAtTheBrightestPlaceAndLightWhatIsAhead) {
    EXPECT_NEAR(beamOf(night(60, 220, 150)), 11 / 30.0, 0.05);
    EXPECT_DOUBLE_EQ(beamOf(night(60, 220, 60)), 0) << "nothing is lit ahead";
    EXPECT_DOUBLE_EQ(beamOf(night(145, 220, 150)), 0) << "the vehicle is as bright";
    EXPECT_DOUBLE_EQ(beamOf(night(50, 85, 70)), 0) << "too dim for lamps";
    EXPECT_DOUBLE_EQ(beamOf(night(60, 153, 150)), 0) << "a bright bonnet: no lamps stand out";
    cv::Mat backwards;
    cv::flip(night(60, 220, 150), backwards, 1);
    EXPECT_DOUBLE_EQ(beamOf(backwards), 0) << "lit behind it: the lamps of another";
    cv::Mat short_box = night(60, 220, 150)(cv::Rect(0, 0, 120, 80)).clone();
    short_box(cv::Rect(66, 0, 54, 80)).setTo(50);
    EXPECT_DOUBLE_EQ(beamOf(short_box), 0) << "it ends at its lamps";
}

TEST(HeadlightBeams, AreWhatIsBrighterThanTheGroundWithoutThem) {
    // A street lamp lights the ground there at all times.
    cv::Mat lit_street(80, 120, CV_8UC1, cv::Scalar(50));
    lit_street(cv::Rect(64, 0, 56, 80)).setTo(150);
    const cv::Mat vehicle = night(60, 220, 150);
    EXPECT_DOUBLE_EQ(kGrid.beamInBox(kGrid.sampled(vehicle), {kGrid.sampled(lit_street)}), 0);
    // Of several pictures of the ground the darkest is without the light of others.
    const cv::Mat dark(80, 120, CV_8UC1, cv::Scalar(50));
    EXPECT_NEAR(kGrid.beamInBox(kGrid.sampled(vehicle), {kGrid.sampled(lit_street), kGrid.sampled(dark)}), 11 / 30.0,
                0.05);
}

TEST(HeadlightBeams, AreTakenOutOfTheFrontOfBoxes) {
    const OrientedBox box = after(looksAt({0.36, 0.2, 0.2}));
    EXPECT_NEAR(box.length, 14, 1e-4) << "but for the lamps' own place";
    EXPECT_NEAR(box.centre.x, 97, 1e-4);
    EXPECT_NEAR(box.centre.y, 60, 1e-4);
    EXPECT_NEAR(box.width, 11, 1e-4);
    const OrientedBox down = after(looksAt({0.36, 0.2, 0.2}), 1.57079632679);
    EXPECT_NEAR(down.centre.x, 100, 1e-4);
    EXPECT_NEAR(down.centre.y, 57, 1e-4);
    EXPECT_NEAR(after(looksAt({0.9, 0.2, 0.2})).length, 10, 1e-4) << "half of it stays";
    EXPECT_NEAR(after(looksAt({0.03, 0.2, 0.2, 0.2})).length, 20, 1e-4);
    EXPECT_NEAR(after(looksAt({0, 0.2, 0.2, 0.2})).length, 20, 1e-4) << "its lamps are off";
}

TEST(HeadlightBeams, TellThatItIsDarkWhereSomeTracksHaveThem) {
    EXPECT_TRUE(driveWithHeadlights(looksAt({0.36, 0.2, 0.2})));
    EXPECT_FALSE(driveWithHeadlights(looksAt({0.36, 0.2}))) << "two are not enough";
    EXPECT_FALSE(driveWithHeadlights(looksAt({0.36, 0.2, 0.09}))) << "nor is what is hardly one";
    EXPECT_TRUE(driveWithHeadlights(looksAt({0.36, 0.2, 0.2, 0, 0, 0, 0, 0, 0, 0, 0, 0}))) << "a quarter has them";
    EXPECT_FALSE(driveWithHeadlights(looksAt({0.36, 0.2, 0.2, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0}))) << "as by day";
    EXPECT_FALSE(driveWithHeadlights(looksAt({0.36, 0.2, 0.2}, 1))) << "one look is chance";
}

TEST(HeadlightBeams, AreToldWithWhatWasTakenOutOfWhichBoxes) {
    std::vector<TrackPath> paths;
    for (const TrackId id : {1, 2, 9}) {
        TrackState state;
        state.id = id;
        state.box = {{100, 60}, 20, 8, 0};
        paths.push_back({id, {{0, PathState(state)}}});
    }
    const BeamFinding found = takeOutBeams(paths, looksAt({0.36, 0.02, 0.2, 0.2}));
    EXPECT_EQ(found.vehicles, 3);
    ASSERT_EQ(found.trims.size(), 1U) << "the second is hardly lit, the last was not looked at";
    EXPECT_EQ(found.trims.at(1).what, LightOutcome::beams);
    EXPECT_NEAR(found.trims.at(1).taken, 0.3, 1e-9);
    EXPECT_EQ(takeOutBeams(paths, looksAt({0.36, 0.2})).vehicles, 0);
}

TEST(HeadlightBeams, NeedSomeTracksThatHaveThem) {
    EXPECT_NEAR(after(looksAt({0.36, 0.2})).length, 20, 1e-4) << "two are not enough";
    EXPECT_NEAR(after(looksAt({0.36, 0.2, 0.09})).length, 20, 1e-4) << "nor is what is hardly one";
    EXPECT_NEAR(after(looksAt({0.36, 0.2, 0.2, 0, 0, 0, 0, 0, 0, 0, 0, 0})).length, 14, 1e-4) << "a quarter has them";
    EXPECT_NEAR(after(looksAt({0.36, 0.2, 0.2, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0})).length, 20, 1e-4) << "as by day";
    EXPECT_NEAR(after(looksAt({0.36, 0.2, 0.2}, 1)).length, 20, 1e-4) << "one look is chance";
}

TEST(HeadlightBeams, TheDarkerItIsTheMoreOfABoxIsGroundThatTheyLight) {
    const OrientedBox night = after(looksAt({0.36, 0.2, 0.2}, 2, 1));
    EXPECT_NEAR(night.length, 20 * (1 - 0.3 - 0.12), 1e-4);
    EXPECT_NEAR(night.width, 11 * 0.75, 1e-4);
    EXPECT_NEAR(night.centre.x, 100 - 20 * 0.42 / 2, 1e-4) << "its rear stays";
    EXPECT_NEAR(night.centre.y, 60, 1e-4) << "on both sides alike";
    const OrientedBox dusk = after(looksAt({0.36, 0.2, 0.2}, 2, 0.5));
    EXPECT_NEAR(dusk.length, 20 * (1 - 0.3 - 0.06), 1e-4);
    EXPECT_NEAR(dusk.width, 11 * 0.875, 1e-4);
    EXPECT_NEAR(after(looksAt({0.9, 0.2, 0.2}, 2, 1)).length, 10, 1e-4) << "half of it stays";
    const OrientedBox lamps_off = after(looksAt({0, 0.2, 0.2}, 2, 1));
    EXPECT_NEAR(lamps_off.length, 20 * 0.88, 1e-4) << "others light it";
    EXPECT_NEAR(lamps_off.width, 11 * 0.75, 1e-4);
}

TEST(HeadlightBeams, ANarrowBoxHoldsAPartOfAVehicleAndStaysAsWide) {
    const auto widthOf = [](double width) { return after(looksAt({0.36, 0.2, 0.2}, 2, 1), 0, width).width; };
    EXPECT_NEAR(widthOf(10.4), 10.4 * 0.75, 1e-3);
    EXPECT_NEAR(widthOf(9), 20 / 2.6, 1e-3) << "not slenderer than this";
    EXPECT_NEAR(widthOf(7.6), 7.6, 1e-3);
    EXPECT_NEAR(widthOf(5), 5, 1e-3);
}

TEST(HeadlightBeams, InTheDarkOneTrackThatHasThemSaysThatAllDo) {
    EXPECT_TRUE(driveWithHeadlights(looksAt({0.36, 0, 0}, 2, 0.6)));
    EXPECT_FALSE(driveWithHeadlights(looksAt({0.36, 0, 0}, 2, 0.5))) << "not in the half dark";
    EXPECT_FALSE(driveWithHeadlights(looksAt({0, 0, 0}, 2, 1)))
        << "a dark picture without lamps, as of an infrared camera";
    EXPECT_TRUE(driveWithHeadlights(looksAt({0.36, 0, 0, 0, 0, 0, 0, 0, 0, 0}, 2, 1))) << "a tenth has them";
    EXPECT_FALSE(driveWithHeadlights(looksAt({0.36, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0}, 2, 1)));
    EXPECT_FALSE(driveWithHeadlights({}));
}

TEST(HeadlightBeams, HowDarkItIsIsWhatMostPicturesSay) {
    std::vector<SilhouetteLook> looks = looksAt({0.36, 0.2, 0.2}, 2, 0);
    for (std::size_t i = 0; i < 2; ++i) looks[i].darkness = 1;
    EXPECT_NEAR(after(looks).width, 11, 1e-4);
}

TEST(HeadlightBeams, InTheDarkEveryTrackIsToldOf) {
    std::vector<TrackPath> paths;
    for (const TrackId id : {1, 9}) {
        TrackState state;
        state.id = id;
        state.box = {{100, 60}, 20, 11, 0};
        paths.push_back({id, {{0, PathState(state)}}});
    }
    const BeamFinding found = takeOutBeams(paths, looksAt({0.36, 0.2, 0.2}, 2, 1));
    ASSERT_EQ(found.trims.size(), 2U) << "one was not looked at";
    EXPECT_NEAR(found.trims.at(1).along, 0.42, 1e-9);
    EXPECT_NEAR(found.trims.at(1).across, 0.25, 1e-9);
    EXPECT_NEAR(found.trims.at(1).taken, 1 - 0.58 * 0.75, 1e-9);
    EXPECT_NEAR(found.trims.at(9).along, 0.12, 1e-9);
}

}  // namespace eyrie::headlight_beams_test
