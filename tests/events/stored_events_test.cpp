#include "events/stored_events.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/error.h"
#include "events/review/reviewed_run.h"
#include "support/temporary_folder.h"
#include "support/written_run.h"

namespace eyrie::stored_events_test {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

/// Frames 100 … 199; between 149 and 150 the ground is lost where `broken` says so.
Footage footageOf(bool broken) {
    Footage footage;
    footage.first_frame = 100;
    footage.last_frame = 199;
    footage.image_size = {640, 480};
    footage.scale = {0.2, 25, true};
    std::vector<Homography> steps;
    for (FrameIndex frame = 100; frame < 199; ++frame) {
        if (!broken || frame != 149) steps.push_back({cv::Matx33d::eye(), frame, frame + 1});
    }
    footage.camera = CameraMotion(steps);
    return footage;
}

Footage nothing() {
    Footage footage;
    footage.last_frame = -1;
    return footage;
}

Zone gateIn(FrameIndex frame, ZoneAnchor anchor = ZoneAnchor::ground) {
    Zone zone;
    zone.name = "gate";
    zone.anchor = anchor;
    zone.frame = frame;
    zone.points = {{0, 0}, {9, 0}, {9, 9}};
    return zone;
}

std::string refusalOf(const Zone& zone, const Footage& footage) {
    try {
        checkReach({zone}, footage);
    } catch (const Error& error) {
        EXPECT_EQ(error.kind(), ErrorKind::input);
        return error.what();
    }
    return "";
}

const std::string kBeyond = "zone \"gate\" is fixed to the ground of frame ";

}  // namespace

TEST(StoredEvents, ZonesOnTheGroundNeedAFrameThatWasSearched) {
    const Footage footage = footageOf(false);
    for (const FrameIndex frame : {100, 150, 199}) EXPECT_EQ(refusalOf(gateIn(frame), footage), "") << frame;
    for (const FrameIndex frame : {99, 200})
        EXPECT_EQ(refusalOf(gateIn(frame), footage),
                  kBeyond + std::to_string(frame) + ", but the run holds the frames 100 to 199");
    EXPECT_EQ(refusalOf(gateIn(5, ZoneAnchor::image), footage), "") << "it holds in all";
    EXPECT_EQ(refusalOf(gateIn(5), nothing()), "") << "nothing was searched";
    Footage one = footage;
    one.last_frame = 100;
    EXPECT_NE(refusalOf(gateIn(101), one), "") << "of a single frame, too";
}

TEST(StoredEvents, RemarksTellWhereZonesOnTheGroundHold) {
    EXPECT_THAT(remarksOn({gateIn(120)}, footageOf(false)), IsEmpty());
    const Footage broken = footageOf(true);
    const std::string only = " only: the ground of other frames is not connected with that of frame ";
    EXPECT_THAT(remarksOn({gateIn(5, ZoneAnchor::image), gateIn(120), gateIn(150), gateIn(99)}, broken),
                ElementsAre("zone \"gate\" counts in frames 100 to 149" + only + "120",
                            "zone \"gate\" counts in frames 150 to 199" + only + "150",
                            kBeyond + "99, but the run holds the frames 100 to 199"));
    EXPECT_THAT(remarksOn({gateIn(120)}, nothing()), IsEmpty());
}

TEST(StoredEvents, TracksAreReadAsTheRunFoundThemAndAsPeopleCorrectedThem) {
    const test::TemporaryFolder folder;
    const RunRecord run = test::writeRun(folder / "p.eyrie", 4, [](int frame, FrameResult& result) {
        result.motion.time_us = frame * std::int64_t{40'000};
        if (frame == 2) result.motion.registration.state = RegistrationState::failed;
        for (const TrackId id : {1, 2, 3}) {
            TrackState state;
            state.id = id;
            state.box = {{10.0 * id + frame, 5}, 8, 4, 0};
            // The third is not sure in any frame, so it is no track of the result.
            state.status = id == 3 ? TrackStatus::tentative : TrackStatus::confirmed;
            state.score = 0.25 * id;
            if (frame == 3) state.origin = StateOrigin::predicted;
            if (id != 2 || frame > 1) result.tracks.push_back(state);
        }
    });
    ProjectFile project = ProjectFile::open(folder / "p.eyrie");
    const RunStore store(project);
    const StoredTracks found = readTracks(store, run);
    EXPECT_EQ(found.footage.last_frame, 3);
    EXPECT_EQ(found.unregistered, 1);
    EXPECT_THAT(found.shown_s, ElementsAre(0, 0.04, 0.08, 0.12));
    ASSERT_EQ(found.tracks.size(), 2U);
    EXPECT_EQ(found.tracks[1].id, 2);
    ASSERT_EQ(found.tracks[1].boxes.size(), 2U);
    EXPECT_EQ(found.tracks[1].boxes[1].frame, 3);
    EXPECT_EQ(found.tracks[1].boxes[1].box.centre, cv::Point2d(23, 5));
    for (const EventTrack& track : found.tracks) EXPECT_EQ(track.seen_until, 2) << track.id;
    EXPECT_THAT(found.scores, ElementsAre(testing::Pair(1, 0.25), testing::Pair(2, 0.5)));

    CorrectedTracks corrected;  // the first is rejected, the second is another, and there is a new one
    corrected.replaced = {1, 2};
    for (const TrackId id : {2, 7}) {
        TrackFrame at;
        at.frame = 1;
        at.state.id = id;
        at.state.box = {{100.0 * id, 5}, 8, 4, 0};
        at.state.score = 1;
        corrected.tracks[id].states = {at};
        if (id == 2) continue;
        at.frame = 2;
        at.state.origin = StateOrigin::predicted;
        corrected.tracks[id].states.push_back(at);
    }
    const StoredTracks mended = readTracks(store, run, corrected);
    ASSERT_EQ(mended.tracks.size(), 2U);
    for (const EventTrack& track : mended.tracks) {
        ASSERT_EQ(track.boxes.size(), track.id == 2 ? 1U : 2U) << track.id;
        EXPECT_EQ(track.boxes[0].frame, 1);
        EXPECT_EQ(track.seen_until, 1) << track.id;
        EXPECT_EQ(track.boxes[0].box.centre.x, 100.0 * track.id);
    }
    EXPECT_THAT(mended.scores, ElementsAre(testing::Pair(2, 1), testing::Pair(7, 1)));
    EXPECT_EQ(mended.corrections.replaced, corrected.replaced);
}

TEST(StoredEvents, AnEventIsAPersonsWhereOneOfItsTracksIs) {
    StoredTracks stored;
    stored.corrections.tracks[7].kind = CorrectionKind::join;
    stored.corrections.tracks[9].kind = CorrectionKind::add;
    Event event;
    event.tracks = {1, 7, 9};
    EXPECT_EQ(correctionOf(event, stored), CorrectionKind::join) << "the first that was";
    event.tracks = {1, 2};
    EXPECT_EQ(correctionOf(event, stored), std::nullopt);
    EXPECT_EQ(makerText(CorrectionKind::add), "person: added");
    EXPECT_EQ(makerText(std::nullopt), "machine");
}

TEST(EventChoice, WantsWhatItNamesOrAllWhereItNamesNothing) {
    Verdict relevant;
    relevant.judgement = Judgement::relevant;
    EventChoice choice;
    EXPECT_TRUE(choice.wants(EventKind::stops, nullptr, 1));
    EXPECT_TRUE(choice.wants(std::nullopt, &relevant, 0));
    choice.kinds = {EventKind::stops, EventKind::starts};
    EXPECT_TRUE(choice.wants(EventKind::starts, nullptr, 1));
    EXPECT_FALSE(choice.wants(EventKind::stands, nullptr, 1));
    EXPECT_TRUE(choice.wants(std::nullopt, nullptr, 1)) << "kinds are those of events";
    choice.judgements = {Judgement::relevant};
    EXPECT_FALSE(choice.wants(EventKind::stops, nullptr, 1)) << "not judged is open";
    EXPECT_TRUE(choice.wants(EventKind::stops, &relevant, 1));
    choice.judgements = {Judgement::open};
    EXPECT_TRUE(choice.wants(EventKind::stops, nullptr, 1));
    EXPECT_FALSE(choice.wants(EventKind::stops, &relevant, 1));
    choice.numbers = {3, 5};
    EXPECT_TRUE(choice.wants(EventKind::stops, nullptr, 5));
    EXPECT_FALSE(choice.wants(EventKind::stops, nullptr, 4));
}

TEST(EventChoice, OfSeveralTagsOneIsEnough) {
    Verdict tagged;
    tagged.tags = {"lorry", "gate 3"};
    EventChoice choice;
    choice.tags = {"bus", "gate 3"};
    EXPECT_TRUE(choice.wants(EventKind::stops, &tagged, 1)) << "also of what nobody judged";
    EXPECT_FALSE(choice.wants(EventKind::stops, nullptr, 1));
    choice.judgements = {Judgement::relevant};
    EXPECT_FALSE(choice.wants(EventKind::stops, &tagged, 1));
    choice = {};
    choice.tags = {"bus", "Lorry", "gate"};
    EXPECT_FALSE(choice.wants(EventKind::stops, &tagged, 1)) << "whole words, as they are spelled";
}

TEST(ReviewedRun, VerdictsAreFoundByWhatTheyWereCarriedTo) {
    ReviewedRun run;
    run.review.verdicts[4].id = 4;
    run.review.verdicts[6].id = 6;
    run.carried.of_event = {0, 6, 9};
    run.carried.of_stretch = {4, 0};
    EXPECT_EQ(run.verdictOn(0), nullptr);
    ASSERT_NE(run.verdictOn(1), nullptr);
    EXPECT_EQ(run.verdictOn(1)->id, 6);
    EXPECT_EQ(run.verdictOn(2), nullptr) << "there is no such verdict";
    ASSERT_NE(run.verdictOnStretch(0), nullptr);
    EXPECT_EQ(run.verdictOnStretch(0)->id, 4);
    EXPECT_EQ(run.verdictOnStretch(1), nullptr);
}

}  // namespace eyrie::stored_events_test
