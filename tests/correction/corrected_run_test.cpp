#include "correction/corrected_run.h"
#include "correction/made_corrections.h"

#include <gmock/gmock.h>

#include <map>
#include <set>

#include "correction/driven_states.h"
#include "store/review/review_store.h"
#include "support/run_rows.h"
#include "support/temporary_folder.h"
#include "support/written_run.h"

namespace eyrie::corrected_run_test {
namespace {

using test::drivenSightings;
using test::drivenStates;
using testing::ElementsAre;

constexpr int kFrames = 60;

/// Tracks 3 and 7 are of one vehicle; 9 stays what it is; one that has no track drives at y = 20.
class CorrectedRun : public testing::Test {
 protected:
    void SetUp() override {
        const std::vector<std::vector<TrackFrame>> tracks{early_, late_, drivenStates(9, 0, 59, 10, 90)};
        run_ = test::writeRun(path_, kFrames, [&](int frame, FrameResult& result) {
            for (const auto& states : tracks)
                for (const TrackFrame& each : states)
                    if (each.frame == frame) result.tracks.push_back(each.state);
        });
        project_.emplace(ProjectFile::open(path_));
    }
    void correct(TrackCorrection correction) {
        ReviewStore store(*project_, run_.sequence.id);
        correction.id = store.newCorrectionId();
        ReviewEdit edit{"Correct", {}, {}};
        edit.corrections.push_back({std::nullopt, std::move(correction)});
        store.apply(edit);
    }

    const std::vector<TrackFrame> early_ = drivenStates(3, 0, 20, 10), late_ = drivenStates(7, 25, 50, 10);
    test::TemporaryFolder folder_;
    std::filesystem::path path_ = folder_ / "clip.eyrie";
    RunRecord run_;
    std::optional<ProjectFile> project_;
};

TEST_F(CorrectedRun, IsReadAlikeInEveryWay) {
    const RunStore store(*project_);
    EXPECT_TRUE(readCorrectedTracks(*project_, run_).empty());
    correct(joinOf(early_, late_));
    correct(additionOf(drivenSightings(5, 58, 10, 20), 30));
    const CorrectedTracks corrected = readCorrectedTracks(*project_, run_);
    EXPECT_EQ(corrected.states.at(1), CorrectionState::applied);
    EXPECT_EQ(corrected.states.at(2), CorrectionState::applied);
    EXPECT_EQ(correctionsInWords(corrected), "1 track added, 1 join");

    std::map<TrackId, std::vector<FrameIndex>> visited;
    std::pair<FrameIndex, TrackId> before{-1, 0};
    visitTrackStates(store, run_.id, corrected, [&](FrameIndex frame, const TrackState& state) {
        EXPECT_LT(before, std::pair(frame, state.id)) << "ordered by frame, then track";
        before = {frame, state.id};
        visited[state.id].push_back(frame);
    });
    ASSERT_EQ(visited.size(), 3U);
    EXPECT_EQ(visited[3].size(), 51U);
    EXPECT_EQ(visited[9].size(), 60U);
    const TrackId added = 11;  // 9 is the highest of the run, 2 the number of the correction
    EXPECT_EQ(visited[added].size(), 54U);

    const std::vector<TrackSummary> summaries = trackSummaries(store, run_.id, corrected);
    ASSERT_EQ(summaries.size(), 3U);
    for (const TrackSummary& track : summaries) {
        const std::vector<TrackFrame> states = trackStates(store, run_.id, track.id, corrected);
        EXPECT_EQ(states.size(), visited[track.id].size());
        EXPECT_EQ(track.first_frame, states.front().frame);
        EXPECT_EQ(track.last_frame, states.back().frame);
        EXPECT_EQ(track.frames, static_cast<int>(states.size()));
        EXPECT_NEAR(track.mean_speed_px, 2, 1e-4);
        EXPECT_NEAR(track.mean_length_px, 10, 1e-4);
        EXPECT_NEAR(track.mean_width_px, 5, 1e-4);
        if (!track.corrected) continue;
        EXPECT_NEAR(track.place.x, (states.front().state.box.centre.x + states.back().state.box.centre.x) / 2, 0.01);
    }
    EXPECT_EQ(summaries[0].corrected, CorrectionKind::join);
    EXPECT_EQ(summaries[1].corrected, std::nullopt);
    EXPECT_EQ(summaries[2].corrected, CorrectionKind::add);
    EXPECT_TRUE(trackStates(store, run_.id, 7, corrected).empty()) << "it is a part of 3 now";

    const auto trails = trackStatesUpTo(store, run_.id, 30, 10, corrected);
    EXPECT_EQ(trails.size(), 30U);
    EXPECT_EQ(trails.front().frame, 21);

    std::map<std::optional<StateOrigin>, int> origins;
    visitTrackBoxes(store, run_.id, corrected, [&](FrameIndex frame, const BoxRecord& box) {
        EXPECT_EQ(box.frame, frame);
        ++origins[box.origin];
    });
    EXPECT_EQ(origins[StateOrigin::by_hand], 54);
    EXPECT_EQ(origins[StateOrigin::predicted], 4);
    EXPECT_EQ(origins[StateOrigin::detected], 21 + 26 + 60);
}

TEST_F(CorrectedRun, TheRunItselfIsNeverTouched) {
    const auto rows = test::rowsOf(path_, run_.id);
    correct(joinOf(early_, late_));
    correct(splitOf(drivenStates(9, 0, 59, 10, 90), 30));
    EXPECT_FALSE(readCorrectedTracks(*project_, run_).empty());
    EXPECT_EQ(test::rowsOf(path_, run_.id), rows);
    EXPECT_EQ(RunStore(*project_).trackStates(run_.id, 7).size(), 26U);
}

TEST_F(CorrectedRun, WhatATrackOfOtherFramesIsAddedToIsThereToo) {
    // Frames in which the run has no state at all still tell those of people.
    correct(additionOf(drivenSightings(55, 58, 10, 20), 56));
    const CorrectedTracks corrected = readCorrectedTracks(*project_, run_);
    std::vector<FrameIndex> frames;
    visitTrackStates(RunStore(*project_), run_.id, corrected, [&](FrameIndex frame, const TrackState& state) {
        if (state.origin == StateOrigin::by_hand) frames.push_back(frame);
    });
    EXPECT_THAT(frames, ElementsAre(55, 56, 57, 58));
}

TEST_F(CorrectedRun, WhatWasDrawnBeyondTheRunIsLeftOut) {
    std::map<int, TrackCorrection> corrections;
    corrections[1] = additionOf(drivenSightings(0, 80, 10, 20), 30);
    corrections[1].id = 1;
    const auto framesIn = [&](const RunRecord& run) {
        const CorrectedTracks corrected = correctedTracksOf(RunStore(*project_), run, corrections);
        std::vector<FrameIndex> frames;
        for (const auto& [id, track] : corrected.tracks)
            frames.insert(frames.end(), {track.states.front().frame, track.states.back().frame});
        return frames;
    };
    EXPECT_THAT(framesIn(run_), ElementsAre(0, 59));
    RunRecord part = run_;
    part.first_frame = 10;
    part.frames_done = 20;
    EXPECT_THAT(framesIn(part), ElementsAre(10, 29));
    part.frames_done = 1;
    EXPECT_THAT(framesIn(part), ElementsAre(10, 10));
    part.frames_done = 0;
    EXPECT_THAT(framesIn(part), ElementsAre());
    part = run_;
    part.live = true;
    EXPECT_THAT(framesIn(part), ElementsAre()) << "it is being written";
}

TEST_F(CorrectedRun, PartsOfATrackAreSummedUpAsTracksOfARunAre) {
    std::vector<TrackFrame> faster = drivenStates(2, 0, 59, 10);
    for (TrackFrame& each : faster) {
        each.state.score = 0.01 * each.frame;
        each.state.velocity = {3.0 * each.frame, 4.0 * each.frame};
        each.state.box.length = 10 + each.frame;
        each.state.box.width = 5 + 0.1 * each.frame;
    }
    const RunRecord run = test::writeRun(path_, kFrames, [&](int frame, FrameResult& result) {
        result.tracks.push_back(faster[static_cast<std::size_t>(frame)].state);
    });
    const RunStore store(*project_);
    const TrackSummary whole = trackSummaries(store, run.id, {}).at(0);
    EXPECT_NEAR(whole.score, 0.59, 1e-4) << "that of its last frame";
    EXPECT_NEAR(whole.mean_speed_px, 5 * 29.5, 1e-4);
    correct(splitOf(faster, 40));
    const auto parts = trackSummaries(store, run.id, readCorrectedTracks(*project_, run));
    ASSERT_EQ(parts.size(), 2U);
    EXPECT_EQ(parts[0].id, 2);
    EXPECT_EQ(parts[0].last_frame, 39);
    EXPECT_EQ(parts[1].first_frame, 40);
    EXPECT_EQ(parts[1].frames, 20);
    EXPECT_NEAR(parts[0].score, 0.39, 1e-4);
    EXPECT_NEAR(parts[1].score, 0.59, 1e-4);
    EXPECT_NEAR(parts[0].mean_speed_px, 5 * 19.5, 1e-3);
    EXPECT_NEAR(parts[0].mean_length_px, 10 + 19.5, 1e-3);
    EXPECT_NEAR(parts[0].mean_width_px, 5 + 1.95, 1e-3);
    EXPECT_NEAR(parts[1].place.x, 10 + 2 * 49.5, 1e-3);
    EXPECT_NEAR(parts[1].place.y, 50, 1e-3);
    EXPECT_TRUE(parts[0].confirmed);
}

TEST_F(CorrectedRun, ARejectedTrackIsInNothingButItsOwnList) {
    const auto rows = test::rowsOf(path_, run_.id);
    const RunStore store(*project_);
    correct(rejectionOf(late_));
    const CorrectedTracks corrected = readCorrectedTracks(*project_, run_);
    const auto idsOf = [](const std::vector<TrackSummary>& summaries) {
        std::vector<TrackId> ids;
        for (const TrackSummary& each : summaries) ids.push_back(each.id);
        return ids;
    };
    EXPECT_THAT(idsOf(trackSummaries(store, run_.id, corrected)), ElementsAre(3, 9));
    const std::vector<TrackSummary> rejected = rejectedSummaries(store, run_.id, corrected);
    ASSERT_THAT(idsOf(rejected), ElementsAre(7));
    EXPECT_EQ(rejected[0].corrected, CorrectionKind::reject);
    EXPECT_FALSE(rejected[0].confirmed);
    EXPECT_EQ(rejected[0].first_frame, 25);
    EXPECT_EQ(rejected[0].last_frame, 50);
    EXPECT_TRUE(trackStates(store, run_.id, 7, corrected).empty());
    EXPECT_EQ(trackStatesUpTo(store, run_.id, 30, 10, corrected).size(), 10U) << "that of 9 alone";
    std::map<TrackId, int> visited;
    visitTrackStates(store, run_.id, corrected, [&](FrameIndex, const TrackState& state) { ++visited[state.id]; });
    EXPECT_EQ(visited, (std::map<TrackId, int>{{3, 21}, {9, 60}}));
    int boxes = 0;
    visitTrackBoxes(store, run_.id, corrected, [&](FrameIndex, const BoxRecord&) { ++boxes; });
    EXPECT_EQ(boxes, 81);
    EXPECT_EQ(test::rowsOf(path_, run_.id), rows) << "the run keeps it";
    EXPECT_EQ(trackSummaries(store, run_.id, {}).size(), 3U);
    EXPECT_TRUE(rejectedSummaries(store, run_.id, {}).empty());
    ReviewStore(*project_, run_.sequence.id).undo();
    EXPECT_TRUE(readCorrectedTracks(*project_, run_).empty());
}

TEST_F(CorrectedRun, AnAddedTrackThatIsRejectedLeavesTheRunAsItIs) {
    const RunStore store(*project_);
    correct(additionOf(drivenSightings(5, 58, 10, 20), 30));
    const TrackId added = 10;  // 9 is the highest of the run, 1 the number of the correction
    correct(rejectionOf(trackStates(store, run_.id, added, readCorrectedTracks(*project_, run_))));
    const CorrectedTracks corrected = readCorrectedTracks(*project_, run_);
    EXPECT_EQ(trackSummaries(store, run_.id, corrected).size(), 3U);
    ASSERT_EQ(rejectedSummaries(store, run_.id, corrected).size(), 1U);
    EXPECT_EQ(rejectedSummaries(store, run_.id, corrected)[0].id, added);
    std::set<TrackId> visited;
    visitTrackStates(store, run_.id, corrected, [&](FrameIndex, const TrackState& state) { visited.insert(state.id); });
    EXPECT_THAT(visited, ElementsAre(3, 7, 9));
}

TEST_F(CorrectedRun, ANewRunCarriesRejectionsOver) {
    correct(rejectionOf(early_));
    const RunRecord second = test::writeRun(path_, kFrames, [&](int frame, FrameResult& result) {
        for (const auto& states : {drivenStates(2, 0, 22, 11), drivenStates(4, 0, 59, 10, 90)})
            for (const TrackFrame& each : states)
                if (each.frame == frame) result.tracks.push_back(each.state);
    });
    const CorrectedTracks carried = readCorrectedTracks(*project_, second);
    EXPECT_EQ(carried.states.at(1), CorrectionState::applied);
    EXPECT_THAT(carried.replaced, ElementsAre(2));
    const RunRecord third = test::writeRun(path_, kFrames, [](int, FrameResult&) {});
    EXPECT_EQ(readCorrectedTracks(*project_, third).states.at(1), CorrectionState::absent);
}

TEST_F(CorrectedRun, TheTrackBesideARejectedOneIsThatOfTheResultThatLiesBestOnIt) {
    std::vector<TrackFrame> tentative = drivenStates(5, 0, 59, 10, 50);
    for (TrackFrame& each : tentative) each.state.status = TrackStatus::tentative;
    const auto twin = drivenStates(6, 10, 40, 10);
    const RunRecord run = test::writeRun(path_, kFrames, [&](int frame, FrameResult& result) {
        for (const auto& states : {drivenStates(2, 0, 59, 13), drivenStates(4, 0, 59, 11), tentative, twin,
                                   drivenStates(8, 0, 12, 10), drivenStates(9, 0, 59, 10, 90)})
            for (const TrackFrame& each : states)
                if (each.frame == frame) result.tracks.push_back(each.state);
    });
    const RunStore store(*project_);
    const auto besideBut = [&](const std::set<TrackId>& but) {
        const auto beside = trackBeside(store, run.id, rejectionOf(twin), but, {});
        return beside.empty() ? 0 : beside.front().state.id;
    };
    EXPECT_EQ(besideBut({6}), 4);
    EXPECT_EQ(besideBut({4, 6}), 2);
    EXPECT_EQ(besideBut({2, 4, 6}), 0) << "one is tentative, one there for less than half of it, one elsewhere";
    const TrackCorrection rejection = rejectionOf(twin, trackBeside(store, run.id, rejectionOf(twin), {6}, {}));
    ASSERT_FALSE(rejection.other.empty());
    EXPECT_GE(rejection.other.front().frame, 10);
    EXPECT_LE(rejection.other.back().frame, 40);
}

TEST_F(CorrectedRun, WhatIsThereForHalfOfItIsBesideItAndForLessIsNot) {
    const auto twin = drivenStates(1, 10, 39, 10);
    const std::vector<Sighting> seen = rejectionOf(twin).track;
    ASSERT_EQ(seen.size() % 2, 0U);
    for (const std::size_t shared : {seen.size() / 2, seen.size() / 2 - 1}) {
        const auto part = drivenStates(2, 10, seen[shared - 1].frame, 10);
        const RunRecord run = test::writeRun(path_, kFrames, [&](int frame, FrameResult& result) {
            for (const auto& states : {twin, part})
                for (const TrackFrame& each : states)
                    if (each.frame == frame) result.tracks.push_back(each.state);
        });
        const auto beside = trackBeside(RunStore(*project_), run.id, rejectionOf(twin), {1}, {});
        EXPECT_EQ(beside.empty(), 2 * shared < seen.size()) << shared;
    }
}

TEST_F(CorrectedRun, WhatIsAtThePlaceAFrameEarlierIsNotBeside) {
    // Both go 30 px a frame, three times their length; one is where the other will be a frame later.
    const auto twin = drivenStates(1, 10, 40, 0, 20, 30), ahead = drivenStates(2, 9, 39, 30, 20, 30);
    ASSERT_EQ(ahead.front().state.box.centre, twin.front().state.box.centre);
    const RunRecord run = test::writeRun(path_, kFrames, [&](int frame, FrameResult& result) {
        for (const auto& states : {twin, ahead})
            for (const TrackFrame& each : states)
                if (each.frame == frame) result.tracks.push_back(each.state);
    });
    EXPECT_TRUE(trackBeside(RunStore(*project_), run.id, rejectionOf(twin), {1}, {}).empty());
}

TEST_F(CorrectedRun, ANewRunOfTheVideoCarriesThemOver) {
    correct(joinOf(early_, late_));
    correct(additionOf(drivenSightings(5, 58, 10, 20), 30));
    const auto found_now = drivenStates(1, 3, 59, 10, 20);
    const RunRecord second = test::writeRun(path_, kFrames, [&](int frame, FrameResult& result) {
        for (const auto& states : {found_now, drivenStates(2, 0, 20, 10), drivenStates(4, 24, 50, 11)})
            for (const TrackFrame& each : states)
                if (each.frame == frame) result.tracks.push_back(each.state);
    });
    const CorrectedTracks corrected = readCorrectedTracks(*project_, second);
    EXPECT_EQ(corrected.states.at(1), CorrectionState::applied);
    EXPECT_THAT(corrected.replaced, ElementsAre(2, 4));
    EXPECT_EQ(corrected.states.at(2), CorrectionState::covered);
    EXPECT_EQ(corrected.covering.at(2), 1);
    const RunRecord third = test::writeRun(path_, kFrames, [](int, FrameResult&) {});
    const CorrectedTracks left = readCorrectedTracks(*project_, third);
    EXPECT_EQ(left.states.at(1), CorrectionState::no_track);
    EXPECT_EQ(left.states.at(2), CorrectionState::applied);
    EXPECT_EQ(correctionsInWords(left), "1 track added; 1 correction could not be carried over");
}

}  // namespace
}  // namespace eyrie::corrected_run_test
