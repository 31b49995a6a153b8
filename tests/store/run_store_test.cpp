#include "store/runs/run_store.h"

#include <SQLiteCpp/SQLiteCpp.h>
#include <gmock/gmock.h>

#include <cmath>
#include <functional>
#include <limits>

#include "core/error.h"
#include "core/time/utc_time.h"
#include "store/runs/result_writer.h"
#include "store/samples.h"
#include "support/replaced_tracks.h"
#include "support/temporary_folder.h"

namespace eyrie::run_store_test {
namespace {

using test::sampleFrame;
using test::sampleRun;
using test::twoTracks;

class RunStoreTest : public testing::Test {
 protected:
    test::TemporaryFolder folder_;
    std::filesystem::path path_ = folder_ / "clip.eyrie";
};

TEST_F(RunStoreTest, FramesReadBackAsTheyWereWritten) {
    const int run = test::writeSampleProject(path_, 9);
    ProjectFile project = ProjectFile::open(path_);
    const RunStore store(project);
    for (int frame = 0; frame < 9; ++frame) {
        const auto read = store.frameResult(run, frame);
        ASSERT_TRUE(read.has_value());
        test::expectSame(*read, sampleFrame(frame));
    }
    EXPECT_FALSE(store.frameResult(run, 9).has_value());
    EXPECT_FALSE(store.frameResult(run, -1).has_value());
    EXPECT_FALSE(store.frameResult(run + 1, 0).has_value());
}

TEST_F(RunStoreTest, AFrameWithNothingInItReadsBackEmpty) {
    ProjectFile project = ProjectFile::create(path_);
    ResultWriter writer(path_, sampleRun(), {});
    writer.write(FrameResult{});
    const auto read = RunStore(project).frameResult(writer.runId(), 0);
    ASSERT_TRUE(read.has_value());
    test::expectSame(*read, FrameResult{});
}

TEST_F(RunStoreTest, KeepsWhatIsNoNumberAndAllOfA64BitTime) {
    FrameResult odd = sampleFrame(1);
    odd.motion.time_us = std::numeric_limits<std::int64_t>::max() - 1;
    odd.motion.background_speed_sigma = std::numeric_limits<double>::quiet_NaN();
    odd.tracks[0].box.length = std::numeric_limits<double>::infinity();
    ProjectFile project = ProjectFile::create(path_);
    ResultWriter writer(path_, sampleRun(), {});
    writer.write(odd);
    const auto read = RunStore(project).frameResult(writer.runId(), 1);
    ASSERT_TRUE(read.has_value());
    EXPECT_EQ(read->motion.time_us, odd.motion.time_us);
    EXPECT_TRUE(std::isnan(read->motion.background_speed_sigma));
    EXPECT_TRUE(std::isinf(read->tracks[0].box.length));
}

TEST_F(RunStoreTest, RunsKeepWhatTheyWereStartedWith) {
    const int id = test::writeSampleProject(path_, 3);
    ProjectFile project = ProjectFile::open(path_);
    const RunStore store(project);
    const auto run = store.run(id);
    ASSERT_TRUE(run.has_value());
    EXPECT_EQ(run->sequence.path, "/videos/street.mp4");
    EXPECT_EQ(run->sequence.size, cv::Size(768, 576));
    EXPECT_EQ(run->sequence.frame_count, 100);
    EXPECT_EQ(run->sequence.frame_rate_hz, 29.97);
    EXPECT_TRUE(run->sequence.rate_assumed && run->rate_assumed);
    EXPECT_EQ(run->sequence.rememberedRate(), 0) << "what nobody said is not remembered as if somebody had";
    EXPECT_EQ(run->name, "first try");
    EXPECT_EQ(run->engine_version, "0.1.0");
    EXPECT_EQ(run->preset, "thesis");
    EXPECT_EQ(run->scale.gsd_m_per_px, 0.345);
    EXPECT_EQ(run->scale.frame_rate_hz, 29.97);
    EXPECT_TRUE(run->scale.gsd_known);
    EXPECT_EQ(run->first_frame, 0);
    EXPECT_EQ(run->last_frame, 99);
    EXPECT_EQ(run->frames_done, 3);
    EXPECT_EQ(run->state, RunState::finished);
    EXPECT_THAT(run->started_utc, testing::MatchesRegex("20[0-9]{2}-[0-9]{2}-[0-9]{2}T[0-9:]{8}Z"));
    EXPECT_THAT(store.parameters(id), testing::ElementsAre(testing::Pair("motion.min_speed", "0.5"),
                                                           testing::Pair("detection.method", "gradient")));
    EXPECT_FALSE(store.run(id + 1).has_value());
    EXPECT_FALSE(store.run(0).has_value());
    EXPECT_FALSE(store.run(-3).has_value());
}

TEST_F(RunStoreTest, RunsKnowTheMicrosecondTheyBeganInAndTellTheSecond) {
    ProjectFile project = ProjectFile::create(path_);
    const RunStore store(project);
    const std::int64_t before = nowUtcMicroseconds();
    { const ResultWriter now(path_, sampleRun(), {}); }
    const std::int64_t after = nowUtcMicroseconds();
    const auto began = store.run(1)->started_us;
    ASSERT_TRUE(began.has_value());
    EXPECT_TRUE(before <= *began && *began <= after) << before << " " << *began << " " << after;
    EXPECT_EQ(store.run(1)->started_utc, utcText(*began).substr(0, 19) + "Z");

    RunRecord told = sampleRun();
    told.started_us = utcOf("2026-11-21T08:00:00.987654Z");
    { const ResultWriter writer(path_, told, {}); }
    EXPECT_EQ(store.run(2)->started_us, told.started_us);
    EXPECT_EQ(store.run(2)->started_utc, "2026-11-21T08:00:00Z");

    RunRecord to_the_second = sampleRun();
    to_the_second.started_utc = "2026-11-21T08:00:00Z";
    { const ResultWriter writer(path_, to_the_second, {}); }
    EXPECT_EQ(store.run(3)->started_us, std::nullopt);
    EXPECT_EQ(store.run(3)->started_utc, "2026-11-21T08:00:00Z");
}

TEST_F(RunStoreTest, RunsKeepWhereTheirScaleComesFromAndHowSureItIs) {
    ProjectFile project = ProjectFile::create(path_);
    const RunStore store(project);
    const std::pair<SceneScale, ScaleBasis> cases[] = {
        {{0.3, 25, true}, {ScaleOrigin::given}},
        {{0.0335, 25, true}, {ScaleOrigin::metadata}},
        {{0.21, 25, false}, {ScaleOrigin::estimated, 1.198, 14}},
        {{0.25, 25, false}, {ScaleOrigin::estimated, 1.5, 3}},  // as much as is assumed elsewhere
        {{0.25, 25, false}, {ScaleOrigin::assumed}}};
    for (const auto& [scale, basis] : cases) {
        RunRecord run = sampleRun();
        run.scale = scale;
        run.scale_basis = basis;
        run.scale.slope = ScaleSlope::ofPicture(run.sequence.size, -0.0004, 0.003);
        const ResultWriter writer(path_, run, {});
        EXPECT_EQ(store.run(writer.runId())->scale_basis, basis) << nameOf(basis.origin);
        EXPECT_EQ(store.run(writer.runId())->scale.slope, run.scale.slope)
            << "about the middle of the video's pictures";
    }
}

TEST_F(RunStoreTest, ARunThatDoesNotSayWhereAKnownScaleComesFromWasGivenIt) {
    const int run = test::writeSampleProject(path_, 1);
    ProjectFile project = ProjectFile::open(path_);
    EXPECT_EQ(RunStore(project).run(run)->scale_basis, ScaleBasis{ScaleOrigin::given});
}

TEST_F(RunStoreTest, SummariesAgreeWithTheFrames) {
    const int run = test::writeSampleProject(path_, 5);
    ProjectFile project = ProjectFile::open(path_);
    const auto summaries = RunStore(project).frameSummaries(run);
    ASSERT_EQ(summaries.size(), 5U);
    for (int frame = 0; frame < 5; ++frame) {
        const FrameSummary& read = summaries[static_cast<std::size_t>(frame)];
        const FrameSummary expected = summaryOf(sampleFrame(frame));
        EXPECT_EQ(read.frame, frame);
        EXPECT_EQ(read.time_us, expected.time_us);
        EXPECT_EQ(read.state, expected.state);
        EXPECT_EQ(read.inliers, expected.inliers);
        EXPECT_EQ(read.rms_px, expected.rms_px);
        EXPECT_EQ(read.corners, 103);
        EXPECT_EQ(read.motion_vectors, 40);
        EXPECT_EQ(read.detections, 2) << "of seven, those at 0 and 4 were kept";
        EXPECT_EQ(read.tracks, 3) << "of five, those at 0 and 3 are tentative";
        EXPECT_EQ(test::ofTheChain(read.stage_ms), test::ofTheChain(expected.stage_ms));
        const float storing = read.stage_ms[static_cast<std::size_t>(Stage::store)];
        EXPECT_GT(storing, 0) << "the writer measures itself, to the last frame";
        EXPECT_NE(storing, expected.stage_ms[static_cast<std::size_t>(Stage::store)]);
    }
}

TEST_F(RunStoreTest, HomographiesAreReadFromAFrameOn) {
    const int run = test::writeSampleProject(path_, 5);
    ProjectFile project = ProjectFile::open(path_);
    const auto homographies = RunStore(project).homographies(run, 3);
    ASSERT_EQ(homographies.size(), 2U);
    for (int i = 0; i < 2; ++i) {
        const Homography& read = homographies[static_cast<std::size_t>(i)];
        const FrameResult written = sampleFrame(3 + i);
        EXPECT_EQ(read.to_frame, 3 + i);
        EXPECT_EQ(read.matrix, written.motion.registration.current_from_previous.matrix);
    }
    const auto some = RunStore(project).homographies(run, 1, 2);
    ASSERT_EQ(some.size(), 2U);
    EXPECT_EQ(some.front().to_frame, 1);
    EXPECT_EQ(some.back().to_frame, 2);
    EXPECT_TRUE(RunStore(project).homographies(run, 3, 2).empty());
}

TEST_F(RunStoreTest, RegistrationsSayHowTheyEnded) {
    const int run = test::writeSampleProject(path_, 6);
    ProjectFile project = ProjectFile::open(path_);
    const auto registrations = RunStore(project).registrations(run);
    ASSERT_EQ(registrations.size(), 6U);
    for (int i = 0; i < 6; ++i) {
        const Registration& read = registrations[static_cast<std::size_t>(i)];
        const Registration written = test::sampleFrame(i).motion.registration;
        EXPECT_EQ(read.state, written.state);
        EXPECT_EQ(read.failure, written.failure);
        EXPECT_EQ(read.current_from_previous.matrix, written.current_from_previous.matrix);
    }
}

TEST_F(RunStoreTest, TracksAreSummed) {
    ProjectFile project = ProjectFile::create(path_);
    ResultWriter writer(path_, sampleRun(), {});
    for (const FrameResult& frame : twoTracks()) writer.write(frame);
    const RunStore store(project);
    const auto tracks = store.tracks(writer.runId());
    ASSERT_EQ(tracks.size(), 2U);
    EXPECT_EQ(tracks[0].id, 1);
    EXPECT_EQ(tracks[0].first_frame, 4);
    EXPECT_EQ(tracks[0].last_frame, 6);
    EXPECT_EQ(tracks[0].frames, 3);
    EXPECT_TRUE(tracks[0].confirmed);
    EXPECT_DOUBLE_EQ(tracks[0].mean_speed_px, 5);
    EXPECT_DOUBLE_EQ(tracks[0].mean_length_px, 13);
    EXPECT_DOUBLE_EQ(tracks[0].mean_width_px, 6);
    EXPECT_FALSE(tracks[1].confirmed);

    const auto states = store.trackStates(writer.runId(), 1);
    ASSERT_EQ(states.size(), 3U);
    EXPECT_EQ(states[0].frame, 4);
    EXPECT_EQ(states[2].state.box.centre, cv::Point2d(16, 28));

    const auto trail = store.trackStatesUpTo(writer.runId(), 5, 1);
    ASSERT_EQ(trail.size(), 2U) << "frame 5 alone, both tracks";
    EXPECT_EQ(trail[1].state.id, 2);
    EXPECT_EQ(store.trackStatesUpTo(writer.runId(), 6, 100).size(), 4U);
}

TEST_F(RunStoreTest, TracksHaveTheClassThatTheRunsLimitsGiveThem) {
    ProjectFile project = ProjectFile::create(path_);
    const auto classOf = [&](const RunRecord& run, const std::vector<std::pair<std::string, std::string>>& limits) {
        ResultWriter writer(path_, run, limits);
        for (const FrameResult& frame : twoTracks()) writer.write(frame);
        const RunStore store(project);
        EXPECT_EQ(store.tracks(writer.runId())[1].track_class, TrackClass::unknown) << "it has no size";
        const TrackClass told = store.tracks(writer.runId())[0].track_class;
        for (const auto& [frame, records] : store.trackBoxes(writer.runId()))
            EXPECT_EQ(records[0].object_class, wordOf(told)) << "frame " << frame;
        return told;
    };
    RunRecord run = sampleRun();
    run.scale = {0.15, 25, true};  // 13 × 6 px on average are 1.95 × 0.9 m
    EXPECT_EQ(classOf(run, {}), TrackClass::unknown) << "three frames are too short for what is smaller than a car";
    EXPECT_EQ(classOf(run, {{"classes.min_life", "0.1"}}), TrackClass::two_wheeler);
    EXPECT_EQ(classOf(run, {{"classes.two_wheeler_length", "1.9"}}), TrackClass::vehicle);
    EXPECT_EQ(
        classOf(run, {{"classes.min_life", "0.1"}, {"classes.two_wheeler_length", "long"}, {"classes.no_such", "1"}}),
        TrackClass::two_wheeler)
        << "what this version does not take has its default";
    run.scale = {0.345, 25, true};
    EXPECT_EQ(classOf(run, {}), TrackClass::vehicle);
    run.scale = SceneScale();
    EXPECT_EQ(classOf(run, {}), TrackClass::unknown) << "nobody knows the scale";
}

TEST_F(RunStoreTest, ResultsAsBoxesHoldConfirmedTracksAndKeptDetections) {
    ProjectFile project = ProjectFile::create(path_);
    ResultWriter writer(path_, sampleRun(), {});
    auto frames = twoTracks();
    Detection kept;
    kept.box = {{50, 60}, 20, 10, 1.5};
    kept.score = 0.7;
    kept.velocity = {1, 2};
    Detection rejected = kept;
    rejected.rejection = Rejection::outlier;
    frames[1].detections = {rejected, kept};
    for (const FrameResult& frame : frames) writer.write(frame);

    const RunStore store(project);
    const BoxesByFrame tracks = store.trackBoxes(writer.runId());
    ASSERT_EQ(tracks.size(), 3U);
    ASSERT_EQ(tracks.at(5).size(), 1U) << "the tentative track is no part of the result";
    const BoxRecord& track = tracks.at(5).front();
    EXPECT_EQ(track.frame, 5);
    EXPECT_EQ(track.id, 1);
    EXPECT_EQ(track.score, 0.25);
    EXPECT_EQ(track.velocity, cv::Point2d(3, 4));
    EXPECT_EQ(track.origin, StateOrigin::detected);
    EXPECT_EQ(track.box.heading, 0.5);

    const BoxesByFrame detections = store.detectionBoxes(writer.runId());
    ASSERT_EQ(detections.size(), 1U);
    ASSERT_EQ(detections.at(5).size(), 1U);
    EXPECT_EQ(detections.at(5).front().id, std::nullopt);
    EXPECT_EQ(detections.at(5).front().score, 0.7);
    EXPECT_EQ(detections.at(5).front().box.centre, cv::Point2d(50, 60));
}

TEST_F(RunStoreTest, ReplacedTracksShowEverywhere) {
    ProjectFile project = ProjectFile::create(path_);
    ResultWriter writer(path_, sampleRun(), {});
    for (const FrameResult& frame : twoTracks()) writer.write(frame);
    RunStore store(project);
    auto states = store.trackStates(writer.runId(), 1);
    states.pop_back();
    for (TrackFrame& state : states) state.state.status = TrackStatus::confirmed;
    test::replaceTrackStates(store, writer.runId(), states);

    ASSERT_EQ(store.tracks(writer.runId()).size(), 1U);
    EXPECT_EQ(store.tracks(writer.runId())[0].last_frame, 5);
    EXPECT_TRUE(store.frameResult(writer.runId(), 6)->tracks.empty());
    EXPECT_EQ(store.frameResult(writer.runId(), 5)->tracks.size(), 1U);
    const auto summaries = store.frameSummaries(writer.runId());
    EXPECT_EQ(summaries[0].tracks, 1);
    EXPECT_EQ(summaries[2].tracks, 0);
}

/// Frames 4, 5 and 7 of a track; its states have score and beginning in common.
std::vector<TrackFrame> finishedTrack() {
    std::vector<TrackFrame> states;
    for (const FrameIndex frame : {4, 5, 7}) {
        TrackState state;
        state.id = 3;
        state.box = {{10.0 + frame, 20}, 12, 6, 0.5};
        state.velocity = {1, 0};
        state.status = frame == 5 ? TrackStatus::coasting : TrackStatus::confirmed;
        state.origin = frame == 4   ? StateOrigin::detected
                       : frame == 5 ? StateOrigin::reconstructed
                                    : StateOrigin::predicted;
        state.age = frame - 4;
        state.hits = 1;
        state.score = 0.75;
        states.push_back({frame, state});
    }
    return states;
}

TEST_F(RunStoreTest, WhatTheStatesOfAFinishedTrackHaveInCommonIsStoredOnceAndReadWithEach) {
    const int run = test::writeSampleProject(path_, 8);
    ProjectFile project = ProjectFile::open(path_);
    RunStore store(project);
    const std::vector<TrackFrame> written = finishedTrack();
    test::replaceTrackStates(store, run, written);
    SQLite::Database& database = project.database();
    EXPECT_EQ(database.execAndGet("SELECT count(*) FROM track_state WHERE score IS NULL AND age = 0").getInt(), 3);
    EXPECT_EQ(database.execAndGet("SELECT score FROM track").getDouble(), 0.75);
    EXPECT_EQ(database.execAndGet("SELECT x_sum FROM track").getDouble(), 14 + 15 + 17);
    EXPECT_EQ(database.execAndGet("SELECT group_concat(status, '|') FROM track_state").getString(), "|c|");
    EXPECT_EQ(database.execAndGet("SELECT group_concat(origin, '|') FROM track_state").getString(), "|r|p");

    std::vector<TrackFrame> visited;
    store.visitTrackStates(run, [&](FrameIndex frame, const TrackState& state) { visited.push_back({frame, state}); });
    for (const auto& read : {store.trackStates(run, 3), store.trackStatesUpTo(run, 7, 100), visited}) {
        ASSERT_EQ(read.size(), written.size());
        for (std::size_t i = 0; i < read.size(); ++i) {
            EXPECT_EQ(read[i].frame, written[i].frame);
            EXPECT_EQ(read[i].state.score, 0.75);
            EXPECT_EQ(read[i].state.age, written[i].state.age);
            EXPECT_EQ(read[i].state.status, written[i].state.status);
            EXPECT_EQ(read[i].state.origin, written[i].state.origin);
        }
    }
    std::size_t place = 0;
    store.visitTrackPlaces(run, [&](FrameIndex frame, TrackId track, const OrientedBox& box, bool seen) {
        ASSERT_LT(place, written.size());
        EXPECT_EQ(frame, written[place].frame);
        EXPECT_EQ(track, 3);
        EXPECT_EQ(box.centre, written[place].state.box.centre);
        EXPECT_EQ(box.length, written[place].state.box.length);
        EXPECT_EQ(box.heading, written[place].state.box.heading);
        EXPECT_EQ(seen, frame != 7);
        ++place;
    });
    EXPECT_EQ(place, written.size());
    const TrackState alone = store.frameResult(run, 7)->tracks.at(0);
    EXPECT_EQ(alone.score, 0.75);
    EXPECT_EQ(alone.age, 3);
    EXPECT_EQ(store.tracks(run).at(0).score, 0.75);
    EXPECT_EQ(store.trackBoxes(run).at(5).at(0).score, 0.75);
    EXPECT_TRUE(store.trackStates(run, 4).empty()) << "there is no such track";
}

TEST_F(RunStoreTest, StatesThatDifferKeepWhatIsTheirs) {
    const int run = test::writeSampleProject(path_, 8);
    ProjectFile project = ProjectFile::open(path_);
    RunStore store(project);
    for (const auto& change : std::vector<std::function<void(TrackState&)>>{
             [](TrackState& state) { state.score = 0.5; }, [](TrackState& state) { state.age = 9; },
             [](TrackState& state) { state.score = std::numeric_limits<double>::quiet_NaN(); }}) {
        std::vector<TrackFrame> written = finishedTrack();
        change(written[1].state);
        test::replaceTrackStates(store, run, written);
        const auto read = store.trackStates(run, 3);
        ASSERT_EQ(read.size(), written.size());
        for (std::size_t i = 0; i < read.size(); ++i) {
            EXPECT_EQ(read[i].state.age, written[i].state.age);
            if (std::isnan(written[i].state.score))
                EXPECT_TRUE(std::isnan(read[i].state.score));
            else
                EXPECT_EQ(read[i].state.score, written[i].state.score);
        }
    }
}

TEST_F(RunStoreTest, WhatFinishingLeftOutIsReadWithItsFrame) {
    ProjectFile project = ProjectFile::create(path_);
    ResultWriter writer(path_, sampleRun(), {});
    for (const FrameResult& frame : twoTracks()) writer.write(frame);
    RunStore store(project);
    EXPECT_TRUE(store.frameResult(writer.runId(), 5)->dropped.empty());
    const DroppedState shadow{7, {{50, 60}, 18, 7, 0.5}, TrackDrop::shadow, 1};
    const DroppedState small{8, {{10, 20}, 4, 2, 0}, TrackDrop::too_small, 0};
    test::replaceTrackStates(store, writer.runId(), {}, {{5, small}, {5, shadow}, {6, small}});
    const auto dropped = store.frameResult(writer.runId(), 5)->dropped;
    ASSERT_EQ(dropped.size(), 2U);
    EXPECT_EQ(dropped[0].id, 7);
    EXPECT_EQ(dropped[0].why, TrackDrop::shadow);
    EXPECT_EQ(dropped[0].beside, 1);
    EXPECT_EQ(dropped[0].box.centre, cv::Point2d(50, 60));
    EXPECT_EQ(dropped[0].box.heading, 0.5);
    EXPECT_EQ(store.frameResult(writer.runId(), 6)->dropped.size(), 1U);
    test::replaceTrackStates(store, writer.runId(), {});
    EXPECT_TRUE(store.frameResult(writer.runId(), 5)->dropped.empty());
    test::replaceTrackStates(store, writer.runId(), {}, {{5, small}});
    EXPECT_EQ(store.frameResult(writer.runId(), 5)->dropped.size(), 1U);
}

TEST_F(RunStoreTest, OfFramesWithoutDetailsOnlyWhereATrackWasLeftOutFirstIsKept) {
    ProjectFile project = ProjectFile::create(path_);
    ResultWriter writer(path_, sampleRun(), {});
    for (const FrameResult& frame : twoTracks()) writer.write(frame);
    SQLite::Database(path_.string(), SQLite::OPEN_READWRITE).exec("UPDATE frame SET details = 0 WHERE frame > 4");
    RunStore store(project);
    const DroppedState shadow{7, {{50, 60}, 18, 7, 0.5}, TrackDrop::shadow, 1};
    const DroppedState small{8, {{10, 20}, 4, 2, 0}, TrackDrop::too_small, 0};
    test::replaceTrackStates(store, writer.runId(), {}, {{6, small}, {5, small}, {5, shadow}, {4, shadow}});
    const auto left = [&](FrameIndex frame) { return store.frameResult(writer.runId(), frame)->dropped.size(); };
    EXPECT_EQ(left(4), 1U) << "with its details";
    ASSERT_EQ(left(5), 1U);
    EXPECT_EQ(store.frameResult(writer.runId(), 5)->dropped.front().id, 8) << "the first of it, whatever comes first";
    EXPECT_EQ(left(6), 0U);
}

TEST_F(RunStoreTest, ADetectionIsToldByItsProbabilityWhereItHasOne) {
    ProjectFile project = ProjectFile::create(path_);
    ResultWriter writer(path_, sampleRun(), {});
    FrameResult frame = twoTracks().front();
    Detection detection;
    detection.box = {{50, 60}, 18, 7, 0};
    detection.score = 1.7;
    frame.detections = {detection, detection};
    frame.detections.front().probability = 0.875;
    writer.write(frame);
    const RunStore store(project);
    const auto read = store.frameResult(writer.runId(), frame.motion.frame)->detections;
    ASSERT_EQ(read.size(), 2U);
    EXPECT_EQ(read[0].probability, 0.875);
    EXPECT_EQ(read[0].score, 1.7);
    EXPECT_TRUE(std::isnan(read[1].probability));
    const auto boxes = store.detectionBoxes(writer.runId()).at(frame.motion.frame);
    EXPECT_EQ(boxes[0].score, 0.875);
    EXPECT_EQ(boxes[1].score, 1.7);
}

TEST_F(RunStoreTest, ARemovedRunTakesEverythingOfItAndNothingElse) {
    const int first = test::writeSampleProject(path_, 4);
    const int second = test::writeSampleProject(path_, 3);
    ProjectFile project = ProjectFile::open(path_);
    RunStore store(project);
    store.remove(first);
    store.purgeRemoved();
    EXPECT_FALSE(store.run(first).has_value());
    EXPECT_TRUE(store.parameters(first).empty());
    EXPECT_TRUE(store.frameSummaries(first).empty());
    EXPECT_FALSE(store.frameResult(first, 0).has_value());
    EXPECT_TRUE(store.tracks(first).empty());
    EXPECT_TRUE(store.trackStatesUpTo(first, 3, 10).empty());
    EXPECT_TRUE(store.detectionBoxes(first).empty());
    test::expectSame(*store.frameResult(second, 2), sampleFrame(2));
    EXPECT_GT(test::writeSampleProject(path_, 1), second) << "numbers of runs are never used again";
}

TEST_F(RunStoreTest, RunsOverTheSameVideoShareItsSequence) {
    const int first = test::writeSampleProject(path_, 1);
    const int second = test::writeSampleProject(path_, 1);
    RunRecord other = sampleRun();
    other.sequence.path = "/videos/other.mp4";
    const int third = ResultWriter(path_, other, {}).runId();
    ProjectFile project = ProjectFile::open(path_);
    const RunStore store(project);
    EXPECT_EQ(store.run(first)->sequence.id, store.run(second)->sequence.id);
    EXPECT_NE(store.run(first)->sequence.id, store.run(third)->sequence.id);
    EXPECT_THAT(store.runs(), testing::SizeIs(3));
}

TEST_F(RunStoreTest, RenamesAndRefusesToChangeWhatIsNotThere) {
    const int run = test::writeSampleProject(path_, 1);
    ProjectFile project = ProjectFile::open(path_);
    RunStore store(project);
    store.rename(run, "it's “good”");
    EXPECT_EQ(store.run(run)->name, "it's “good”");
    for (const auto& change :
         {std::function<void()>([&] { store.rename(99, "x"); }), std::function<void()>([&] { store.remove(99); })}) {
        try {
            change();
            FAIL() << "expected an error";
        } catch (const Error& error) {
            EXPECT_EQ(error.kind(), ErrorKind::project);
            EXPECT_THAT(error.what(), testing::HasSubstr("no run 99"));
        }
    }
}

TEST_F(RunStoreTest, HowARunEndedIsKept) {
    ProjectFile project = ProjectFile::create(path_);
    const RunStore store(project);
    ResultWriter failed(path_, sampleRun(), {});
    EXPECT_EQ(store.run(failed.runId())->state, RunState::running);
    failed.finish(RunState::failed, "the video ends at frame 12");
    EXPECT_EQ(store.run(failed.runId())->state, RunState::failed);
    EXPECT_EQ(store.run(failed.runId())->message, "the video ends at frame 12");
    int unfinished = 0;
    {
        ResultWriter writer(path_, sampleRun(), {});
        writer.write(sampleFrame(0));
        unfinished = writer.runId();
    }
    EXPECT_EQ(store.run(unfinished)->state, RunState::running);
    EXPECT_EQ(store.run(unfinished)->frames_done, 1);
}

}  // namespace
}  // namespace eyrie::run_store_test
