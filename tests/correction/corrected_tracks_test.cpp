#include "correction/corrected_tracks.h"
#include "correction/made_corrections.h"

#include <gmock/gmock.h>

#include <cmath>

#include "core/error.h"
#include "core/geometry/angle.h"
#include "core/review/track_correction.h"
#include "correction/driven_states.h"

namespace eyrie::corrected_tracks_test {
namespace {

using test::drivenBox;
using test::drivenSightings;
using test::drivenStates;
using test::numbered;
using test::runOf;
using testing::ElementsAre;

const CameraMotion kStanding = CameraMotion::standing(0, 99);

CorrectedTracks corrected(const TracksToCorrect& run, std::vector<TrackCorrection> made,
                          const CameraMotion& camera = kStanding) {
    return correctTracks(run, numbered(std::move(made)), camera);
}

void expectWhole(const CorrectedTrack& track, TrackId id, FrameIndex first, FrameIndex last) {
    ASSERT_EQ(track.states.size(), static_cast<std::size_t>(last - first + 1));
    for (std::size_t i = 0; i < track.states.size(); ++i) {
        EXPECT_EQ(track.states[i].frame, first + static_cast<int>(i));
        EXPECT_EQ(track.states[i].state.id, id);
        EXPECT_EQ(track.states[i].state.age, static_cast<int>(i));
    }
}

// ---- nothing --------------------------------------------------------------------------------------------------------

TEST(CorrectedTracks, WithoutCorrectionsNothingIsAnotherTrack) {
    const CorrectedTracks result = corrected(runOf({{3, drivenStates(3, 0, 40, 10)}}), {});
    EXPECT_TRUE(result.empty());
    EXPECT_TRUE(result.states.empty());
    const std::vector<TrackState> of_run{drivenStates(3, 7, 7, 10).front().state};
    EXPECT_EQ(result.in(7, of_run).size(), 1U);
}

// ---- join -----------------------------------------------------------------------------------------------------------

TEST(CorrectedTracks, AJoinOverAGapIsOneTrackThatGoesStraightOnTheGroundMeanwhile) {
    const auto early = drivenStates(3, 0, 20, 10), late = drivenStates(7, 31, 50, 10);
    for (const auto& join : {joinOf(early, late), joinOf(late, early)}) {  // whichever was selected first
        const CorrectedTracks result = corrected(runOf({{3, early}, {7, late}}), {join});
        EXPECT_EQ(result.states.at(1), CorrectionState::applied);
        EXPECT_THAT(result.replaced, ElementsAre(3, 7));
        ASSERT_EQ(result.tracks.size(), 1U);
        const CorrectedTrack& track = *result.track(3);
        expectWhole(track, 3, 0, 50);
        EXPECT_EQ(track.kind, CorrectionKind::join);
        EXPECT_THAT(track.corrections, ElementsAre(1));
        for (const TrackFrame& each : track.states) {
            const bool between = each.frame > 20 && each.frame < 31;
            EXPECT_EQ(each.state.origin, between ? StateOrigin::predicted : StateOrigin::detected) << each.frame;
            EXPECT_EQ(each.state.status, between ? TrackStatus::coasting : TrackStatus::confirmed) << each.frame;
            EXPECT_NEAR(each.state.box.centre.x, 10 + 2 * each.frame, 1e-9);
            EXPECT_NEAR(each.state.velocity.x, 2, 1e-9);
            EXPECT_NEAR(each.state.box.length, 10, 1e-9);
            EXPECT_DOUBLE_EQ(each.state.score, 0.57) << "the surer part tells";
        }
        EXPECT_EQ(track.states.back().state.hits, 41) << "ten frames were not seen";
    }
}

TEST(CorrectedTracks, TheSurerPartTellsWhicheverComesFirst) {
    auto early = drivenStates(3, 0, 20, 10), late = drivenStates(7, 31, 50, 10);
    for (TrackFrame& each : early) each.state.score = 0.9;
    const CorrectedTracks result = corrected(runOf({{3, early}, {7, late}}), {joinOf(early, late)});
    for (const TrackFrame& each : result.track(3)->states) EXPECT_EQ(each.state.score, 0.9) << each.frame;
}

TEST(CorrectedTracks, InAGapTheBoxGrowsAndTurnsEvenly) {
    auto early = drivenStates(3, 0, 20, 10), late = drivenStates(7, 31, 50, 10);
    for (TrackFrame& each : early) each.state.box.heading = 3.1;
    for (TrackFrame& each : late) {
        each.state.box.length = 10 + 11;
        each.state.box.width = 5 + 2.2;
        each.state.box.heading = wrapPi(3.1 + 0.22);
    }
    const CorrectedTracks result = corrected(runOf({{3, early}, {7, late}}), {joinOf(early, late)});
    for (const TrackFrame& each : result.track(3)->states) {
        const double gone = std::clamp<double>(each.frame - 20, 0, 11);
        EXPECT_NEAR(each.state.box.length, 10 + gone, 1e-9) << each.frame;
        EXPECT_NEAR(each.state.box.width, 5 + 0.2 * gone, 1e-9) << each.frame;
        EXPECT_NEAR(turnBetween(3.1, each.state.box.heading), 0.02 * gone, 1e-9) << each.frame;
    }
}

TEST(CorrectedTracks, AGapIsFilledOverTheGroundWhereTheCameraMoves) {
    // The camera drifts 3 px a frame to the left: what stands moves so in the picture.
    std::vector<Homography> steps;
    for (int frame = 0; frame < 99; ++frame) {
        Homography step;
        step.from_frame = frame;
        step.to_frame = frame + 1;
        step.matrix = cv::Matx33d(1, 0, -3, 0, 1, 0, 0, 0, 1);
        steps.push_back(step);
    }
    const auto early = drivenStates(3, 0, 20, 300, 50, -3), late = drivenStates(7, 31, 50, 300, 50, -3);
    const auto result = corrected(runOf({{3, early}, {7, late}}), {joinOf(early, late)}, CameraMotion(steps));
    for (const TrackFrame& each : result.track(3)->states) {
        EXPECT_NEAR(each.state.box.centre.x, 300 - 3 * each.frame, 1e-6);
        if (each.state.origin != StateOrigin::predicted) continue;
        EXPECT_NEAR(each.state.velocity.x, 0, 1e-6) << "it stands";
    }
}

TEST(CorrectedTracks, AGapThatTheCameraDoesNotBridgeOrThatIsLongStaysOne) {
    const auto early = drivenStates(3, 0, 20, 10), late = drivenStates(7, 31, 50, 10);
    const auto torn = corrected(runOf({{3, early}, {7, late}}), {joinOf(early, late)}, CameraMotion());
    EXPECT_EQ(torn.states.at(1), CorrectionState::applied);
    EXPECT_EQ(torn.track(3)->states.size(), 41U);
    TracksToCorrect slow = runOf({{3, early}, {7, late}});
    slow.frame_rate_hz = 1;  // ten frames are ten seconds
    EXPECT_EQ(corrected(slow, {joinOf(early, late)}).track(3)->states.size(), 51U);
    for (const double rate_hz : {0.9, 0.95, 0.99}) {
        slow.frame_rate_hz = rate_hz;
        EXPECT_EQ(corrected(slow, {joinOf(early, late)}).track(3)->states.size(), 41U) << rate_hz;
    }
}

TEST(CorrectedTracks, WhereBothAreWhatWasSeenCountsBeforeWhatWasPredicted) {
    auto early = drivenStates(3, 0, 30, 10);
    const auto late = drivenStates(7, 21, 50, 11);  // one px ahead
    for (TrackFrame& each : early) {
        if (each.frame <= 25) continue;
        each.state.status = TrackStatus::coasting;
        each.state.origin = StateOrigin::predicted;
    }
    const CorrectedTracks result = corrected(runOf({{3, early}, {7, late}}), {joinOf(early, late)});
    expectWhole(*result.track(3), 3, 0, 50);
    for (const TrackFrame& each : result.track(3)->states) {
        EXPECT_NEAR(each.state.box.centre.x, 2 * each.frame + (each.frame <= 25 ? 10 : 11), 1e-9);
        EXPECT_EQ(each.state.status, TrackStatus::confirmed);
    }
}

TEST(CorrectedTracks, TwoTracksOfOneVehicleOfWhichOneHoldsTheOtherAreJoined) {
    const auto all = drivenStates(3, 0, 50, 10), part = drivenStates(7, 20, 30, 11);
    for (const TrackCorrection& join : {joinOf(part, all), joinOf(all, part)}) {  // whichever was selected first
        EXPECT_EQ(join.frame, 20) << "where the other one begins";
        EXPECT_EQ(join.track.front().frame, 0);
    }
    const CorrectedTracks result = corrected(runOf({{3, all}, {7, part}}), {joinOf(part, all)});
    EXPECT_THAT(result.replaced, ElementsAre(3, 7));
    expectWhole(*result.track(3), 3, 0, 50);
    for (const TrackFrame& each : result.track(3)->states)
        EXPECT_NEAR(each.state.box.centre.x, 10 + 2 * each.frame, 1e-9);
}

TEST(CorrectedTracks, TheIdIsThatOfTheOneThatBeganFirstInThisRun) {
    // When they were joined track 3 began first; another run saw it later.
    const auto all = drivenStates(3, 0, 50, 10), part = drivenStates(7, 18, 30, 11);
    const auto late = drivenStates(3, 22, 50, 10);
    const CorrectedTracks result = corrected(runOf({{3, late}, {7, part}}), {joinOf(all, part)});
    EXPECT_THAT(result.replaced, ElementsAre(3, 7));
    ASSERT_NE(result.track(7), nullptr);
    expectWhole(*result.track(7), 7, 18, 50);
}

TEST(CorrectedTracks, TwoThatAreInDifferentPlacesAtOneTimeAreNotJoined) {
    const auto one = drivenStates(3, 0, 30, 10), other = drivenStates(7, 10, 50, 10, 80);
    const CorrectedTracks result = corrected(runOf({{3, one}, {7, other}}), {joinOf(one, other)});
    EXPECT_EQ(result.states.at(1), CorrectionState::apart);
    EXPECT_TRUE(result.empty());
    EXPECT_TRUE(isLeft(result.states.at(1)));
}

// ---- split ----------------------------------------------------------------------------------------------------------

TEST(CorrectedTracks, ASplitLeavesTheIdToTheEarlierPart) {
    const auto whole = drivenStates(3, 5, 60, 10);
    const CorrectedTracks result = corrected(runOf({{3, whole}}), {splitOf(whole, 30)});
    EXPECT_EQ(result.states.at(1), CorrectionState::applied);
    EXPECT_THAT(result.replaced, ElementsAre(3));
    ASSERT_EQ(result.tracks.size(), 2U);
    expectWhole(*result.track(3), 3, 5, 29);
    expectWhole(*result.track(21), 21, 30, 60);
    EXPECT_EQ(result.track(21)->kind, CorrectionKind::split);
    EXPECT_DOUBLE_EQ(result.track(21)->states.front().state.score, 0.53);
    EXPECT_EQ(result.track(21)->states.front().state.hits, 1);
}

TEST(CorrectedTracks, ATrackIsSplitAtItsEndsIntoOneFrameAndTheRest) {
    const auto whole = drivenStates(3, 5, 60, 10);
    expectWhole(*corrected(runOf({{3, whole}}), {splitOf(whole, 6)}).track(3), 3, 5, 5);
    expectWhole(*corrected(runOf({{3, whole}}), {splitOf(whole, 60)}).track(21), 21, 60, 60);
    for (const FrameIndex frame : {0, 5, 61, 99}) {
        try {
            splitOf(whole, frame);
            ADD_FAILURE() << frame;
        } catch (const Error& error) {
            EXPECT_EQ(error.kind(), ErrorKind::parameter);
        }
    }
}

// ---- one after the other --------------------------------------------------------------------------------------------

TEST(CorrectedTracks, EachCorrectionWorksOnWhatThoseBeforeItMade) {
    const auto whole = drivenStates(3, 0, 40, 10), rest = drivenStates(7, 45, 60, 10);
    const TracksToCorrect run = runOf({{3, whole}, {7, rest}});
    const auto split = splitOf(whole, 20);
    const CorrectedTracks once = corrected(run, {split});
    const auto join = joinOf(once.track(21)->states, rest);
    const CorrectedTracks twice = corrected(run, {split, join});
    EXPECT_EQ(twice.states.at(2), CorrectionState::applied);
    expectWhole(*twice.track(3), 3, 0, 19);
    expectWhole(*twice.track(21), 21, 20, 60);
    EXPECT_THAT(twice.track(21)->corrections, ElementsAre(1, 2));
    EXPECT_EQ(twice.track(21)->kind, CorrectionKind::join);
    // The other way round the join finds the whole track, of which half is what it means.
    const CorrectedTracks turned = corrected(run, {join, split});
    expectWhole(*turned.track(3), 3, 0, 19);
    expectWhole(*turned.track(22), 22, 20, 60);
    EXPECT_EQ(turned.track(22)->kind, CorrectionKind::split);
}

TEST(CorrectedTracks, WhatIsSplitAndJoinedAgainIsAsBefore) {
    const auto whole = drivenStates(3, 0, 40, 10);
    const TracksToCorrect run = runOf({{3, whole}});
    const auto split = splitOf(whole, 20);
    const CorrectedTracks once = corrected(run, {split});
    const CorrectedTracks twice = corrected(run, {split, joinOf(once.track(21)->states, once.track(3)->states)});
    ASSERT_EQ(twice.tracks.size(), 1U);
    expectWhole(*twice.track(3), 3, 0, 40);
    for (std::size_t i = 0; i < whole.size(); ++i)
        EXPECT_EQ(twice.track(3)->states[i].state.box.centre, whole[i].state.box.centre);
}

// ---- add ------------------------------------------------------------------------------------------------------------

TEST(CorrectedTracks, AnAddedTrackIsByHandSureAndKnowsItsSpeed) {
    const auto other = drivenStates(3, 0, 99, 10, 80);
    const CorrectedTracks result = corrected(runOf({{3, other}}), {additionOf(drivenSightings(10, 40, 10), 20)});
    EXPECT_EQ(result.states.at(1), CorrectionState::applied);
    EXPECT_TRUE(result.replaced.empty());
    const CorrectedTrack& track = *result.track(21);
    expectWhole(track, 21, 10, 40);
    for (const TrackFrame& each : track.states) {
        EXPECT_EQ(each.state.origin, StateOrigin::by_hand);
        EXPECT_EQ(each.state.status, TrackStatus::confirmed);
        EXPECT_EQ(each.state.score, 1);
        EXPECT_NEAR(each.state.velocity.x, 2, 1e-9);
        EXPECT_NEAR(each.state.velocity.y, 0, 1e-9);
    }
    const auto in_frame = result.in(10, {other[10].state});
    ASSERT_EQ(in_frame.size(), 2U);
    EXPECT_EQ(in_frame[0].id, 3);
    EXPECT_EQ(in_frame[1].id, 21);
    EXPECT_EQ(result.in(9, {other[9].state}).size(), 1U);
}

TEST(CorrectedTracks, AnAddedTrackCanBeJoinedWithOneOfTheRun) {
    const auto of_run = drivenStates(3, 50, 80, 10);
    const TracksToCorrect run = runOf({{3, of_run}});
    const auto add = additionOf(drivenSightings(10, 44, 10), 20);
    const CorrectedTracks added = corrected(run, {add});
    const CorrectedTracks result = corrected(run, {add, joinOf(of_run, added.track(21)->states)});
    EXPECT_THAT(result.replaced, ElementsAre(3));
    ASSERT_EQ(result.tracks.size(), 1U);
    expectWhole(*result.track(21), 21, 10, 80);
    EXPECT_EQ(result.track(21)->states[0].state.origin, StateOrigin::by_hand);
    EXPECT_EQ(result.track(21)->states.back().state.origin, StateOrigin::detected)
        << "machine and person are told apart";
}

TEST(CorrectedTracks, AnAddedTrackThatTheRunHasOverMostOfItsLifeIsCovered) {
    const auto add = additionOf(drivenSightings(0, 49, 10), 20);
    const auto covered = corrected(runOf({{3, drivenStates(3, 0, 39, 12)}}), {add});
    EXPECT_EQ(covered.states.at(1), CorrectionState::covered);
    EXPECT_EQ(covered.covering.at(1), 3);
    EXPECT_TRUE(covered.empty());
    EXPECT_FALSE(isLeft(CorrectionState::covered));
    const auto in_parts = corrected(runOf({{3, drivenStates(3, 0, 19, 12)}, {4, drivenStates(4, 24, 45, 9)}}), {add});
    EXPECT_EQ(in_parts.states.at(1), CorrectionState::covered) << "several may cover it";
    EXPECT_EQ(in_parts.covering.at(1), 4);
    const auto half = corrected(runOf({{3, drivenStates(3, 0, 24, 12)}}), {add});
    EXPECT_EQ(half.states.at(1), CorrectionState::applied);
    const auto beside = corrected(runOf({{3, drivenStates(3, 0, 49, 10, 57)}}), {add});
    EXPECT_EQ(beside.states.at(1), CorrectionState::applied) << "the next lane is another vehicle";
}

// ---- reject ---------------------------------------------------------------------------------------------------------

TEST(CorrectedTracks, ARejectedTrackIsLeftOutButStillKnown) {
    const auto shadow = drivenStates(3, 5, 40, 10), vehicle = drivenStates(7, 0, 60, 10, 80);
    const TrackCorrection rejection = rejectionOf(shadow);
    EXPECT_EQ(rejection.kind, CorrectionKind::reject);
    EXPECT_EQ(rejection.frame, 5);
    const CorrectedTracks result = corrected(runOf({{3, shadow}, {7, vehicle}}), {rejection});
    EXPECT_EQ(result.states.at(1), CorrectionState::applied);
    EXPECT_TRUE(result.tracks.empty());
    EXPECT_THAT(result.replaced, ElementsAre(3));
    ASSERT_EQ(result.rejected.size(), 1U);
    EXPECT_EQ(result.rejected.at(3).kind, CorrectionKind::reject);
    EXPECT_EQ(result.rejected.at(3).states.size(), 36U);
    EXPECT_FALSE(result.empty());
    EXPECT_EQ(result.track(3), nullptr);
    EXPECT_EQ(result.touched(3), &result.rejected.at(3));
    EXPECT_EQ(result.touched(7), nullptr);
    const auto in_frame = result.in(10, {shadow[5].state, vehicle[10].state});
    ASSERT_EQ(in_frame.size(), 1U);
    EXPECT_EQ(in_frame[0].id, 7);
    EXPECT_EQ(correctionsInWords(result), "1 track rejected");
}

TEST(CorrectedTracks, WhatPeopleMadeIsRejectedAndComesBackAsTheyMadeIt) {
    const auto early = drivenStates(3, 0, 20, 10), late = drivenStates(7, 25, 50, 10);
    const TracksToCorrect run = runOf({{3, early}, {7, late}});
    const auto join = joinOf(early, late);
    const auto rejection = rejectionOf(corrected(run, {join}).track(3)->states);
    const CorrectedTracks result = corrected(run, {join, rejection});
    EXPECT_TRUE(result.tracks.empty());
    EXPECT_THAT(result.replaced, ElementsAre(3, 7));
    EXPECT_THAT(result.rejected.at(3).corrections, ElementsAre(1, 2)) << "the last is taken back first";
    expectWhole(result.rejected.at(3), 3, 0, 50);

    const auto add = additionOf(drivenSightings(10, 60, 10, 20), 30);
    const CorrectedTracks added = corrected(run, {add});
    const CorrectedTracks without = corrected(run, {add, rejectionOf(added.track(21)->states)});
    EXPECT_TRUE(without.tracks.empty());
    EXPECT_TRUE(without.replaced.empty());
    EXPECT_THAT(without.rejected.at(21).corrections, ElementsAre(1, 2));
    EXPECT_EQ(without.applied.at(CorrectionKind::reject), 1);

    const auto split = splitOf(late, 40);
    const CorrectedTracks cut = corrected(run, {split});
    const CorrectedTracks half = corrected(run, {split, rejectionOf(cut.track(21)->states)});
    ASSERT_EQ(half.tracks.size(), 1U);
    expectWhole(*half.track(7), 7, 25, 39);
    expectWhole(half.rejected.at(21), 21, 40, 50);
    EXPECT_THAT(half.replaced, ElementsAre(7));
}

TEST(CorrectedTracks, OfTwoOnOneVehicleTheOneThatIsMeantIsRejected) {
    const auto one = drivenStates(3, 0, 30, 10), twin = drivenStates(7, 0, 30, 12);
    const TracksToCorrect run = runOf({{3, one}, {7, twin}});
    EXPECT_THAT(corrected(run, {rejectionOf(one)}).replaced, ElementsAre(3));
    EXPECT_THAT(corrected(run, {rejectionOf(twin)}).replaced, ElementsAre(7));
    const CorrectedTracks both = corrected(run, {rejectionOf(twin), rejectionOf(one)});
    EXPECT_THAT(both.replaced, ElementsAre(3, 7));
    EXPECT_THAT(both.rejected.at(7).corrections, ElementsAre(1));
    EXPECT_THAT(both.rejected.at(3).corrections, ElementsAre(2));
    EXPECT_EQ(correctionsInWords(both), "2 tracks rejected");
}

TEST(CorrectedTracks, ATrackThatWasHardlySeenIsRejectedByWhatWasSeen) {
    auto shadow = drivenStates(3, 0, 40, 10);
    for (TrackFrame& each : shadow)
        if (each.frame > 4) each.state.origin = StateOrigin::predicted;
    const TrackCorrection rejection = rejectionOf(shadow);
    EXPECT_EQ(rejection.track.size(), 5U);
    EXPECT_EQ(corrected(runOf({{3, shadow}}), {rejection}).states.at(1), CorrectionState::applied);
}

// ---- another run of the same video ----------------------------------------------------------------------------------

TEST(CarriedCorrections, FindTheirTracksInAnotherRunByPlaceAndTime) {
    const auto early = drivenStates(3, 0, 20, 10), late = drivenStates(7, 25, 50, 10);
    const auto whole = drivenStates(4, 0, 60, 10, 80);
    const std::vector<TrackCorrection> made{joinOf(early, late), splitOf(whole, 30),
                                            additionOf(drivenSightings(0, 30, 10, 20), 3)};
    // Other numbers, other ends, a px or two off, a larger box.
    auto longer = drivenStates(12, 28, 70, 12);
    for (TrackFrame& each : longer) each.state.box.length = 13;
    TracksToCorrect run =
        runOf({{5, drivenStates(5, 3, 19, 9, 51)}, {12, longer}, {9, drivenStates(9, 2, 57, 11, 79)}});
    run.last_id = 50;
    const CorrectedTracks result = corrected(run, made);
    for (const int id : {1, 2, 3}) EXPECT_EQ(result.states.at(id), CorrectionState::applied) << id;
    EXPECT_THAT(result.replaced, ElementsAre(5, 9, 12));
    expectWhole(*result.track(5), 5, 3, 70);
    expectWhole(*result.track(9), 9, 2, 29);
    expectWhole(*result.track(52), 52, 30, 57);
    expectWhole(*result.track(53), 53, 0, 30);
}

TEST(CarriedCorrections, ARunThatHasItSoByItselfIsLeftAsItIs) {
    const auto early = drivenStates(3, 0, 20, 10), late = drivenStates(7, 25, 50, 10);
    const auto whole = drivenStates(4, 0, 60, 10, 80);
    const TracksToCorrect run = runOf(
        {{1, drivenStates(1, 0, 50, 10)}, {2, drivenStates(2, 0, 28, 10, 80)}, {6, drivenStates(6, 31, 60, 10, 80)}});
    const CorrectedTracks result = corrected(run, {joinOf(early, late), splitOf(whole, 30)});
    EXPECT_EQ(result.states.at(1), CorrectionState::covered);
    EXPECT_EQ(result.states.at(2), CorrectionState::covered);
    EXPECT_EQ(result.covering.at(1), 1);
    EXPECT_TRUE(result.empty());
}

TEST(CarriedCorrections, WhatHasNoTrackOrNoFramesIsSaid) {
    const auto early = drivenStates(3, 0, 20, 10), late = drivenStates(7, 25, 50, 10);
    const auto whole = drivenStates(4, 0, 60, 10, 80);
    const std::vector<TrackCorrection> made{joinOf(early, late), splitOf(whole, 30),
                                            additionOf(drivenSightings(10, 60, 10, 20), 30)};
    const CorrectedTracks without = corrected(runOf({{1, drivenStates(1, 0, 20, 10)}}), made);
    EXPECT_EQ(without.states.at(1), CorrectionState::no_track);
    EXPECT_EQ(without.states.at(2), CorrectionState::no_track);
    EXPECT_EQ(without.states.at(3), CorrectionState::applied);
    TracksToCorrect half = runOf({{1, drivenStates(1, 0, 20, 10)}, {2, drivenStates(2, 0, 24, 10, 80)}});
    half.last_frame = 24;
    const CorrectedTracks of_half = corrected(half, made);
    EXPECT_EQ(of_half.states.at(1), CorrectionState::not_searched);
    EXPECT_EQ(of_half.states.at(2), CorrectionState::not_searched);
    EXPECT_EQ(of_half.states.at(3), CorrectionState::applied);
    expectWhole(*of_half.track(23), 23, 10, 24);
    half.last_frame = 9;
    EXPECT_EQ(corrected(half, made).states.at(3), CorrectionState::not_searched);
    for (const auto state : {CorrectionState::no_track, CorrectionState::not_searched}) EXPECT_TRUE(isLeft(state));
}

TEST(CarriedCorrections, ARejectionFindsItsTrackAgainOrSaysThatItDidNot) {
    const auto shadow = drivenStates(3, 0, 60, 10);
    const auto vehicle = drivenStates(9, 0, 99, 10, 80);
    const auto of = [&](std::vector<std::pair<FrameIndex, FrameIndex>> lives) {
        TracksToCorrect run = runOf({{9, vehicle}});
        TrackId id = 11;
        for (const auto& [first, last] : lives) {
            run.tracks[id] = drivenStates(id, first, last, 11, 51);
            ++id;
        }
        return corrected(run, {rejectionOf(shadow)});
    };
    const CorrectedTracks again = of({{3, 57}});
    EXPECT_EQ(again.states.at(1), CorrectionState::applied);
    EXPECT_THAT(again.replaced, ElementsAre(11));
    EXPECT_EQ(again.rejected.at(11).states.size(), 55U);
    // What is not found any more needs no rejection.
    const CorrectedTracks gone = of({});
    EXPECT_EQ(gone.states.at(1), CorrectionState::absent);
    EXPECT_FALSE(isLeft(CorrectionState::absent));
    EXPECT_TRUE(gone.empty());
    EXPECT_EQ(correctionsInWords(gone), "");
    // In pieces it is there still.
    const CorrectedTracks pieces = of({{0, 19}, {22, 40}, {45, 60}});
    EXPECT_EQ(pieces.states.at(1), CorrectionState::no_track);
    EXPECT_TRUE(pieces.empty());
    EXPECT_EQ(correctionsInWords(pieces), "1 correction could not be carried over");
}

TEST(CarriedCorrections, ATrackThatLivesForLongerThanTheRejectedOneIsLeftToThePerson) {
    const TrackCorrection rejection = rejectionOf(drivenStates(3, 20, 30, 10));
    const auto longer = corrected(runOf({{5, drivenStates(5, 0, 99, 10)}}), {rejection});
    EXPECT_EQ(longer.states.at(1), CorrectionState::no_track);
    EXPECT_TRUE(longer.empty());
    const auto twice = corrected(runOf({{5, drivenStates(5, 15, 35, 10)}}), {rejection});
    EXPECT_EQ(twice.states.at(1), CorrectionState::applied);
    TracksToCorrect before = runOf({{5, drivenStates(5, 0, 9, 10)}});
    before.last_frame = 9;
    EXPECT_EQ(corrected(before, {rejection}).states.at(1), CorrectionState::not_searched);
}

TEST(CarriedCorrections, TheOnlyTrackOfAVehicleThatHadTwoIsNotRejected) {
    const auto kept = drivenStates(3, 0, 90, 10), twin = drivenStates(7, 20, 60, 12);
    const TrackCorrection rejection = rejectionOf(twin, kept);
    EXPECT_THAT(corrected(runOf({{3, kept}, {7, twin}}), {rejection}).replaced, ElementsAre(7)) << "where it was made";
    const TracksToCorrect one = runOf({{11, drivenStates(11, 15, 65, 11.5)}});
    const CorrectedTracks alone = corrected(one, {rejection});
    EXPECT_EQ(alone.states.at(1), CorrectionState::alone);
    EXPECT_TRUE(alone.empty());
    EXPECT_TRUE(isLeft(CorrectionState::alone));
    EXPECT_EQ(correctionsInWords(alone), "1 correction could not be carried over");
    EXPECT_THAT(corrected(one, {rejectionOf(twin)}).replaced, ElementsAre(11)) << "nobody knows of another";
    // Of two the nearer is meant again.
    const auto two = runOf({{11, drivenStates(11, 15, 65, 11.5)}, {12, drivenStates(12, 3, 88, 9.5)}});
    EXPECT_THAT(corrected(two, {rejection}).replaced, ElementsAre(11));
    // What is not part of the result does not stand for the vehicle.
    auto doubtful = drivenStates(12, 3, 88, 9.5);
    for (TrackFrame& each : doubtful) each.state.status = TrackStatus::tentative;
    const auto with_doubtful = runOf({{11, drivenStates(11, 15, 65, 11.5)}, {12, doubtful}});
    EXPECT_EQ(corrected(with_doubtful, {rejection}).states.at(1), CorrectionState::alone);
}

TEST(CarriedCorrections, WhatLiesOnTheRejectedTrackAloneIsRejectedThoughTheVehicleIsNotFound) {
    const auto kept = drivenStates(3, 0, 90, 10), shadow = drivenStates(7, 20, 60, 16);
    const auto found = runOf({{11, drivenStates(11, 18, 62, 21)}});  // a length and more from the vehicle
    EXPECT_THAT(corrected(found, {rejectionOf(shadow, kept)}).replaced, ElementsAre(11));
}

TEST(CarriedCorrections, AVehicleThatPassesWhereATrackWasRejectedStays) {
    const TrackCorrection rejection = rejectionOf(drivenStates(3, 0, 60, 100, 50, 0));
    const auto passing = corrected(runOf({{5, drivenStates(5, 0, 99, 0)}}), {rejection});
    EXPECT_EQ(passing.states.at(1), CorrectionState::absent);
    EXPECT_TRUE(passing.empty());
}

TEST(CarriedCorrections, OfTwoThatAreNearTheNearerIsMeant) {
    const auto one = drivenStates(3, 0, 20, 10), next = drivenStates(4, 0, 20, 16);
    const auto late = drivenStates(7, 25, 50, 10);
    const TracksToCorrect run = runOf({{1, drivenStates(1, 0, 20, 15)}, {2, drivenStates(2, 0, 20, 11)}, {7, late}});
    EXPECT_THAT(corrected(run, {joinOf(one, late)}).replaced, ElementsAre(2, 7));
    EXPECT_THAT(corrected(run, {joinOf(next, late)}).replaced, ElementsAre(1, 7));
}

TEST(Likeness, BoxesBesideEachOtherAreTwoVehicles) {
    const OrientedBox box = drivenBox(0, 0, 0, 0);
    EXPECT_TRUE(likenessOf(box, box).has_value());
    EXPECT_GT(*likenessOf(box, box), *likenessOf(box, drivenBox(0, 2, 0, 0)));
    EXPECT_FALSE(likenessOf(box, drivenBox(0, 0, 6, 0)).has_value());
    EXPECT_FALSE(likenessOf(box, drivenBox(0, 11, 0, 0)).has_value());
    EXPECT_TRUE(likenessOf({{0, 0}, 3, 2, 0}, {{0.9, 0}, 3, 2, 1.5}).has_value()) << "headings of tiny boxes are vague";
}

}  // namespace
}  // namespace eyrie::corrected_tracks_test
