/// Limits of corrections on both sides, and what is computed from them, worked out by hand.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "correction/drawn_vehicle.h"
#include "correction/driven_states.h"
#include "correction/joined_states.h"
#include "correction/made_corrections.h"
#include "correction/track_frames.h"

namespace eyrie::corrections_by_hand_test {
namespace {

using test::drivenBox;
using test::drivenSightings;
using test::drivenStates;
using test::numbered;
using test::runOf;
using testing::ElementsAre;

const CameraMotion kStill = CameraMotion::standing(0, 99);

CorrectionState stateOf(const TracksToCorrect& run, const TrackCorrection& made) {
    return correctTracks(run, numbered({made}), kStill).states.at(1);
}

std::vector<FrameIndex> framesOf(const std::vector<Sighting>& sightings) {
    std::vector<FrameIndex> frames;
    for (const Sighting& each : sightings) frames.push_back(each.frame);
    return frames;
}

std::vector<Sighting> movingBoxes(cv::Point2d way, int frames, double along, double across) {
    std::vector<Sighting> seen;
    for (int frame = 0; frame < frames; ++frame)
        seen.push_back({frame, {cv::Point2d(50, 50) + way * frame, along, across, 0}});
    return seen;
}

}  // namespace

TEST(CorrectionsByHand, LikenessIsTheOverlapAndATenthForTheCentre) {
    const OrientedBox box = drivenBox(0, 0, 0, 0);  // 10 × 5
    EXPECT_NEAR(*likenessOf(box, box), 1.1, 1e-6);
    // 8 × 5 of 60 are shared; the centre is a fifth of a length away.
    EXPECT_NEAR(*likenessOf(box, drivenBox(0, 2, 0, 0)), 40.0 / 60 + 0.1 * 0.8, 1e-6);
    EXPECT_NEAR(*likenessOf(box, drivenBox(0, 0, 2, 0)), 30.0 / 70 + 0.1 * 0.8, 1e-6);
}

TEST(CorrectionsByHand, WhatHardlyOverlapsMustHaveItsCentreNear) {
    // Bars across each other share 1 of 19.
    const OrientedBox lying{{0, 0}, 10, 1, 0};
    const auto across = [&](double x) { return likenessOf(lying, {{x, 0}, 10, 1, std::numbers::pi / 2}); };
    ASSERT_TRUE(across(3.4).has_value());
    EXPECT_NEAR(*across(3.4), 1.0 / 19 + 0.1 * 0.66, 1e-6);
    EXPECT_FALSE(across(3.6).has_value()) << "0.35 of a length";
}

TEST(CorrectionsByHand, ManyBoxesAreComparedByAFewDozenEvenly) {
    EXPECT_EQ(framesOf(comparedOf(drivenSightings(0, 47, 0))), framesOf(drivenSightings(0, 47, 0)));
    const auto some = framesOf(comparedOf(drivenSightings(0, 94, 0)));
    ASSERT_EQ(some.size(), 48U);
    for (std::size_t i = 0; i < some.size(); ++i) EXPECT_EQ(some[i], static_cast<int>(2 * i));
    // A track is found again by twelve.
    const TrackCorrection rejection = rejectionOf(drivenStates(3, 10, 32, 0));
    EXPECT_THAT(framesOf(rejection.track), ElementsAre(10, 12, 14, 16, 18, 20, 22, 24, 26, 28, 30, 32));
}

TEST(CorrectionsByHand, OfTheTrackThatIsKeptTheBoxesBesideTheRejectedOneAreHeld) {
    const auto kept = drivenStates(5, 0, 59, 0);
    const TrackCorrection rejection = rejectionOf(drivenStates(3, 10, 32, 0), kept);
    EXPECT_EQ(rejection.frame, 10);
    EXPECT_THAT(framesOf(rejection.other), ElementsAre(10, 12, 14, 16, 18, 20, 22, 24, 26, 28, 30, 32));
    EXPECT_THAT(framesOf(rejectionOf(drivenStates(3, 10, 12, 0), kept).other), ElementsAre(10, 11, 12));
    EXPECT_THAT(framesOf(rejectionOf(drivenStates(3, 58, 70, 0), kept).other), ElementsAre(58, 59));
    EXPECT_THAT(framesOf(rejectionOf(drivenStates(3, 60, 70, 0), kept).other), ElementsAre());
}

TEST(CorrectionsByHand, OnlyTheGapBetweenTwoTracksIsFilled) {
    const auto framesJoined = [](const std::vector<TrackFrame>& one, const std::vector<TrackFrame>& other) {
        std::vector<FrameIndex> frames;
        for (const TrackFrame& each : joinedStates(one, other, kStill, 100)) frames.push_back(each.frame);
        return frames;
    };
    const auto broken = [](FrameIndex first, FrameIndex last, FrameIndex again, FrameIndex end) {
        auto states = drivenStates(3, first, last, 0);
        for (const TrackFrame& each : drivenStates(3, again, end, 0)) states.push_back(each);
        return states;
    };
    EXPECT_THAT(framesJoined(drivenStates(3, 0, 1, 0), drivenStates(7, 4, 5, 0)), ElementsAre(0, 1, 2, 3, 4, 5));
    EXPECT_THAT(framesJoined(broken(0, 0, 3, 3), drivenStates(7, 5, 5, 0)), ElementsAre(0, 3, 4, 5));
    EXPECT_THAT(framesJoined(drivenStates(3, 0, 0, 0), broken(2, 2, 5, 5)), ElementsAre(0, 1, 2, 5));
    // One lives within a gap, or before a gap, of the other.
    EXPECT_THAT(framesJoined(broken(0, 1, 9, 9), drivenStates(7, 4, 5, 0)), ElementsAre(0, 1, 4, 5, 9));
    EXPECT_THAT(framesJoined(broken(0, 2, 9, 9), drivenStates(7, 1, 3, 0)), ElementsAre(0, 1, 2, 3, 9));
}

TEST(CorrectionsByHand, HalfOfTheBoxesMustLieOnATrack) {
    const TrackCorrection rejection = rejectionOf(drivenStates(3, 0, 11, 10));  // twelve boxes
    EXPECT_EQ(stateOf(runOf({{5, drivenStates(5, 0, 5, 10)}}), rejection), CorrectionState::applied);
    EXPECT_EQ(stateOf(runOf({{5, drivenStates(5, 0, 4, 10)}}), rejection), CorrectionState::absent);
    EXPECT_EQ(stateOf(runOf({{5, drivenStates(5, 0, 2, 10)}, {6, drivenStates(6, 3, 5, 10)}}), rejection),
              CorrectionState::no_track)
        << "half of it is there in pieces";
    EXPECT_EQ(stateOf(runOf({{5, drivenStates(5, 0, 2, 10)}, {6, drivenStates(6, 3, 4, 10)}}), rejection),
              CorrectionState::absent);
}

TEST(CorrectionsByHand, ATrackIsRejectedThatLivesForHalfOfItsBoxesWithIt) {
    const TrackCorrection rejection = rejectionOf(drivenStates(3, 0, 11, 10));
    // Of its twelve boxes six are of the frames 0 to 11: 0, 2, 4, 6, 8, 10; then five: 0, 2, 4, 7, 9.
    EXPECT_EQ(stateOf(runOf({{5, drivenStates(5, 0, 23, 10)}}), rejection), CorrectionState::applied);
    EXPECT_EQ(stateOf(runOf({{5, drivenStates(5, 0, 27, 10)}}), rejection), CorrectionState::no_track);
}

TEST(CorrectionsByHand, SixTenthsOfAnAddedTrackMayNotBeThereAlready) {
    const TrackCorrection added = additionOf(drivenSightings(0, 9, 10), 3);
    EXPECT_EQ(stateOf(runOf({{5, drivenStates(5, 0, 5, 10)}}), added), CorrectionState::covered);
    EXPECT_EQ(stateOf(runOf({{5, drivenStates(5, 0, 4, 10)}}), added), CorrectionState::applied);
}

TEST(CorrectionsByHand, TwoAreApartWhereMostSharedFramesShowThemALengthFromEachOther) {
    const auto joined = [](int displaced, double by) {
        const auto one = drivenStates(3, 0, 9, 10);
        auto other = drivenStates(7, 6, 15, 10);  // four frames are shared
        for (int i = 0; i < displaced; ++i) other[static_cast<std::size_t>(i)].state.box.centre.y += by;
        return stateOf(runOf({{3, one}, {7, other}}), joinOf(one, other));
    };
    EXPECT_EQ(joined(2, 30), CorrectionState::applied) << "half of them are not most";
    EXPECT_EQ(joined(3, 30), CorrectionState::apart);
    EXPECT_EQ(joined(4, 9.9), CorrectionState::applied);
    EXPECT_EQ(joined(4, 10.1), CorrectionState::apart);
}

TEST(CorrectionsByHand, VelocitiesOfDrawnBoxesAreThoseOfTwoFramesOnEitherSide) {
    std::vector<Sighting> seen;
    for (int t = 0; t < 10; ++t) seen.push_back({t, {{1.0 * t * t * t, 5.0 * t}, 10, 5, 0}});
    const auto states = statesByHand(seen, kStill);
    // ((t + 2)³ − (t − 2)³) / 4 = 3 t² + 4; at the ends of two frames on one side.
    EXPECT_NEAR(states[4].state.velocity.x, 52, 1e-9);
    EXPECT_NEAR(states[4].state.velocity.y, 5, 1e-9);
    EXPECT_NEAR(states[0].state.velocity.x, 8 / 2.0, 1e-9);
    EXPECT_NEAR(states[9].state.velocity.x, (729 - 343) / 2.0, 1e-9);
    EXPECT_NEAR(states[1].state.velocity.x, 27 / 3.0, 1e-9);
    const auto lone = statesByHand({seen[0], seen[3], seen[5]}, kStill);
    EXPECT_EQ(lone[0].state.velocity, cv::Point2d(0, 0)) << "three frames away tells nothing";
    EXPECT_NEAR(lone[1].state.velocity.x, (125 - 27) / 2.0, 1e-9);
    EXPECT_NEAR(statesByHand(seen, CameraMotion())[4].state.velocity.x, 0, 1e-12) << "nothing connects the frames";
}

TEST(CorrectionsByHand, HitsAndAgesCountFromTheFirstState) {
    auto states = drivenStates(3, 10, 13, 0);
    states[1].state.origin = StateOrigin::predicted;
    states[2].state.status = TrackStatus::coasting;
    renumber(states, 9);
    const int hits[] = {1, 1, 1, 2};
    for (int i = 0; i < 4; ++i) {
        const TrackState& state = states[static_cast<std::size_t>(i)].state;
        EXPECT_EQ(state.id, 9);
        EXPECT_EQ(state.age, i);
        EXPECT_EQ(state.hits, hits[i]) << i;
    }
}

TEST(CorrectionsByHand, AnUprightBoxAroundATurnedVehicleTellsItsSides) {
    // 20 × 10 at 30 degrees fills 20 cos + 10 sin by 20 sin + 10 cos.
    const double c = std::cos(std::numbers::pi / 6), s = 0.5;
    for (const int side : {1, -1}) {
        const auto turned =
            turnedIntoMotion(movingBoxes({5 * c, 5 * s * side}, 30, 20 * c + 10 * s, 20 * s + 10 * c), kStill);
        for (const Sighting& each : turned) {
            EXPECT_NEAR(each.box.heading, side * std::numbers::pi / 6, 1e-9);
            EXPECT_NEAR(each.box.length, 20, 1e-9);
            EXPECT_NEAR(each.box.width, 10, 1e-9);
        }
    }
}

TEST(CorrectionsByHand, NeitherNeedlesNorVehiclesThatDriveSidewaysAreMade) {
    const Sighting needle = turnedIntoMotion(movingBoxes({5, 0}, 30, 27, 3), kStill).front();
    EXPECT_NEAR(needle.box.length, 24, 1e-9) << "four fifths of both sides";
    EXPECT_NEAR(needle.box.width, 6, 1e-9);
    const Sighting sideways = turnedIntoMotion(movingBoxes({5, 0}, 30, 10, 20), kStill).front();
    EXPECT_NEAR(sideways.box.length, 15, 1e-9) << "half of both";
    EXPECT_NEAR(sideways.box.width, 15, 1e-9);
}

TEST(CorrectionsByHand, OnlyAWayOfABoxLengthTellsADirection) {
    const auto headingAfter = [](double way) {
        return turnedIntoMotion(movingBoxes({0, way}, 2, 12, 24), kStill).front().box.heading;
    };
    EXPECT_EQ(headingAfter(23.9), 0);
    EXPECT_NEAR(headingAfter(24.1), std::numbers::pi / 2, 1e-9);
    // Longer ways count more: 30 right, 60 down.
    std::vector<Sighting> bent = movingBoxes({30, 0}, 2, 24, 12);
    bent.push_back({2, {{80, 110}, 24, 12, 0}});
    EXPECT_NEAR(turnedIntoMotion(bent, kStill).front().box.heading, std::atan2(60, 30), 1e-9);
}

}  // namespace eyrie::corrections_by_hand_test
