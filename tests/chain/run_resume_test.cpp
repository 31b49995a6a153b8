#include "chain/recording/run_resume.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <opencv2/imgcodecs.hpp>
#include <random>
#include <regex>

#include "chain/recording/chain_state.h"
#include "chain/recording/run_recorder.h"
#include "core/error.h"
#include "detection/sliding_window/model_location.h"
#include "learning/models/vehicle_model.h"
#include "store/project/project_file.h"
#include "store/runs/result_writer.h"
#include "store/runs/run_state_store.h"
#include "support/moving_scene.h"
#include "support/run_rows.h"
#include "support/temporary_folder.h"

namespace eyrie::run_resume_test {
namespace {

using testing::HasSubstr;
using Path = std::filesystem::path;

constexpr int kFrames = 46;
constexpr int kToTheEnd = 100000;  ///< more frames than there are

constexpr int kZoomsFrom = 28;

/// The moving scene with a picture that repeats, a blank one and its repetition, and a camera that zooms in at the end.
cv::Mat picture(const test::MovingScene& scene, int frame) {
    if (frame == 17) return scene.draw(16);
    if (frame == 25 || frame == 26) return cv::Mat(scene.size, CV_8UC1, cv::Scalar(90));
    cv::Mat drawn = scene.draw(frame);
    if (frame <= kZoomsFrom) return drawn;
    const cv::Point2f middle(float(scene.size.width - 1) / 2, float(scene.size.height - 1) / 2);
    cv::Mat zoomed;
    cv::warpAffine(drawn, zoomed, cv::getRotationMatrix2D(middle, 0, std::pow(1.02, frame - kZoomsFrom)), scene.size,
                   cv::INTER_CUBIC, cv::BORDER_REFLECT);
    return zoomed;
}

const test::MovingScene& scene() {
    static const test::MovingScene made = [] {
        test::MovingScene one;
        one.frames = kFrames;
        return one;
    }();
    return made;
}

/// Drawn once.
test::MemorySource clip() {
    static const std::vector<cv::Mat> pictures = [] {
        std::vector<cv::Mat> drawn;
        for (int frame = 0; frame < kFrames; ++frame) drawn.push_back(picture(scene(), frame));
        return drawn;
    }();
    return {kFrames, scene().size, [](int frame) { return pictures.at(static_cast<std::size_t>(frame)); }};
}

/// Stops after some frames; `keeping`: how often states are kept.
struct Watcher : ChainObserver {
    std::stop_source stop;
    int frames_left;
    std::vector<FrameIndex> seen;
    std::vector<RunProgress> progress;
    explicit Watcher(int frames = kToTheEnd) : frames_left(frames) {}
    void onFrame(const std::shared_ptr<const FrameResult>& result, const Frame&) override {
        seen.push_back(result->motion.frame);
        if (--frames_left == 0) stop.request_stop();
    }
    void onProgress(const RunProgress& news) override { progress.push_back(news); }
};

RunRecord begin(const Path& project, const ChainOptions& options, int stop_after, FrameRange range = {}) {
    test::MemorySource source = clip();
    const SceneScale scale = sceneScale(source.info(), 0.2);
    Watcher watcher(stop_after);
    RunRecorder recorder(project, plannedRun(source.info(), scale, range, "default"), options, &watcher);
    return recorder.finish(ChainRun(options, scale).run(source, range, recorder, watcher.stop.get_token()));
}

struct Resumed {
    RunRecord run;
    RunSummary summary;
    FrameIndex last_done = 0;
    RestartReason restart = RestartReason::none;
    std::vector<FrameIndex> seen;
    std::vector<RunProgress> progress;
};

Resumed resume(const Path& project, int run_id, int stop_after = kToTheEnd) {
    test::MemorySource source = clip();
    ResumedRun resumed = resumedRun(project, run_id, source);
    Watcher watcher(stop_after);
    RunRecorder recorder(project, resumed, &watcher);
    Resumed result{{}, {}, resumed.last_done, resumed.restart, {}, {}};
    result.summary = ChainRun(resumed.options, resumed.run.scale)
                         .run(source, resumed.range(), recorder, watcher.stop.get_token(), false, resumed.start);
    result.run = recorder.finish(result.summary);
    result.seen = watcher.seen;
    result.progress = watcher.progress;
    return result;
}

void expectSame(const Path& a, const Path& b, int run_id = 1) {
    const std::vector<std::string> left = test::rowsOf(a, run_id);
    const std::vector<std::string> right = test::rowsOf(b, run_id);
    ASSERT_EQ(left.size(), right.size());
    for (std::size_t i = 0; i < left.size(); ++i) ASSERT_EQ(left[i], right[i]);
}

ChainOptions with(const std::vector<std::pair<std::string, std::string>>& settings, const std::string& preset = "") {
    ChainOptions options = preset.empty() ? ChainOptions{} : builtInPreset(preset);
    setParameters(describeOf(options), settings);
    return options;
}

struct Setting {
    const char* name;
    ChainOptions options;
};

std::vector<Setting> settings() {
    return {
        {"defaults", {}},
        {"stacking", with({{"stacking.enabled", "true"}, {"stacking.min_height", "4"}, {"stacking.capacity", "9"}})},
        {"accumulation", with({{"stacking.enabled", "true"},
                               {"stacking.min_height", "4"},
                               {"stacking.arrangement", "accumulation"},
                               {"stacking.initialisation", "k_means"},
                               {"stacking.area_length", "20"},
                               {"stacking.area_width", "10"}})},
        {"sliding window", with({{"detection.method", "sliding_window"}})},
        {"two frames' difference", with({{"motion.method", "two_frame_difference"}})},
        {"three frames' difference", with({{"motion.method", "three_frame_difference"}})},
        {"median background", with({{"motion.method", "median_background"}})},
        {"local background", with({{"motion.local_background", "true"}, {"detection.method", "clusters"}})},
        {"thesis", with({{"stacking.min_height", "5"}}, "thesis")}};
}

class RunResume : public testing::TestWithParam<Setting> {
 protected:
    const test::TemporaryFolder folder;
};

}  // namespace

TEST_P(RunResume, GivesWhatARunThatWasNeverStoppedGives) {
    const ChainOptions& options = GetParam().options;
    const Path whole = folder / "whole.eyrie";
    const Path stopped = folder / "stopped.eyrie";
    ASSERT_EQ(begin(whole, options, kToTheEnd).state, RunState::finished);
    // The next frame is a repeated picture, a second blank one, one like any other. What went wrong after one stop
    // shows at the end.
    ASSERT_EQ(begin(stopped, options, 17).state, RunState::stopped);
    int done = 17;
    for (const int end : {26, 33, kFrames}) {
        SCOPED_TRACE(done);
        const Resumed resumed = resume(stopped, 1, end == kFrames ? kToTheEnd : end - done);
        EXPECT_EQ(resumed.run.state, end == kFrames ? RunState::finished : RunState::stopped)
            << resumed.summary.message;
        EXPECT_EQ(resumed.restart, RestartReason::none);
        EXPECT_EQ(resumed.last_done, done - 1) << "no frame is done twice";
        done = end;
    }
    expectSame(whole, stopped);
}

INSTANTIATE_TEST_SUITE_P(Settings, RunResume, testing::ValuesIn(settings()), [](const auto& setting) {
    std::string name = setting.param.name;
    std::erase_if(name, [](char c) { return !std::isalnum(static_cast<unsigned char>(c)); });
    return name;
});

namespace {

/// A run that was never stopped and one that was, made once for all tests.
struct MadeRuns {
    MadeRuns() {
        begin(folder / "whole.eyrie", {}, kToTheEnd);
        begin(folder / "stopped.eyrie", {}, 30);
    }
    const test::TemporaryFolder folder;
};

class StoppedRun : public testing::Test {
 protected:
    void SetUp() override {
        static const MadeRuns made;
        for (const Path& project : {whole, stopped})
            std::filesystem::copy_file(made.folder.path() / project.filename(), project);
    }
    void change(const std::string& command) const {
        ProjectFile project = ProjectFile::open(stopped);
        project.database().exec(command);
    }
    const test::TemporaryFolder folder;
    const Path whole = folder / "whole.eyrie";
    const Path stopped = folder / "stopped.eyrie";
};

}  // namespace

TEST_F(StoppedRun, MayBeStoppedAgain) {
    EXPECT_EQ(resume(stopped, 1, 1).run.frames_done, 31);
    EXPECT_EQ(resume(stopped, 1, 7).run.frames_done, 38);
    const Resumed last = resume(stopped, 1);
    EXPECT_EQ(last.seen.front(), 38);
    expectSame(whole, stopped);
}

TEST_F(StoppedRun, GoesOnByTheZoomOfTheCamera) {
    resume(stopped, 1, 10);  // in the middle of the zoom
    resume(stopped, 1);
    ProjectFile project = ProjectFile::open(stopped, ProjectFile::Mode::read_only);
    const RunRecord run = RunStore(project).run(1).value();
    EXPECT_EQ(run.scale.zoom.at(kZoomsFrom), 1);
    const double zoom = std::pow(1.02, kFrames - 1 - kZoomsFrom);
    EXPECT_NEAR(run.scale.zoom.at(kFrames - 1), zoom, 0.03 * zoom);
    EXPECT_EQ(RunStore(project).frameResult(1, kFrames - 1)->motion.registration.zoom, run.scale.zoom.at(kFrames - 1));
    expectSame(whole, stopped);
}

TEST_F(StoppedRun, CountsOnFromItsFrames) {
    const Resumed resumed = resume(stopped, 1);
    ASSERT_EQ(resumed.seen.size(), 16U);
    EXPECT_EQ(resumed.progress.front().frames_done, 31);
    EXPECT_EQ(resumed.progress.back().frames_done, kFrames);
    EXPECT_EQ(resumed.summary.frames_done, kFrames);
    EXPECT_EQ(resumed.summary.frames_total, kFrames);
    EXPECT_EQ(resumed.summary.unregistered_frames, 1) << "those before the stop count, too";
    EXPECT_EQ(resumed.summary.outcome, RunOutcome::finished);
}

TEST_F(StoppedRun, GoesOnAfterItsFirstFrameAndCountsTheLastOne) {
    begin(stopped, {}, 1);
    const Resumed second = resume(stopped, 2, 25);
    EXPECT_EQ(second.restart, RestartReason::none);
    EXPECT_EQ(second.last_done, 0);
    EXPECT_EQ(second.summary.unregistered_frames, 1) << "the blank one, which is the last";
    EXPECT_EQ(resume(stopped, 2, 1).summary.unregistered_frames, 1);
}

TEST_F(StoppedRun, OfPicturesInAFolderSaysWhichOneHasChanged) {
    const auto draw = [&](int brighter) {
        for (int frame = 0; frame < 14; ++frame) {
            const cv::Mat drawn = picture(scene(), frame) + cv::Scalar(brighter);
            cv::imwrite((folder / ("clip/picture" + std::to_string(100 + frame) + ".png")).string(), drawn);
        }
    };
    std::filesystem::create_directory(folder / "clip");
    draw(0);
    SourceOptions rate;
    rate.frame_rate_hz = 25;
    const Path project = folder / "folder.eyrie";
    {
        const auto source = openSource(folder / "clip", rate);
        const SceneScale scale = sceneScale(source->info(), 0.2);
        Watcher watcher(10);
        RunRecorder recorder(project, plannedRun(source->info(), scale, {}, "default"), {}, &watcher);
        recorder.finish(ChainRun({}, scale).run(*source, {}, recorder, watcher.stop.get_token()));
        EXPECT_EQ(resumedRun(project, 1, *source).last_done, 9);
    }
    draw(1);
    const auto source = openSource(folder / "clip", rate);
    try {
        resumedRun(project, 1, *source);
        FAIL() << "other pictures";
    } catch (const Error& error) {
        const std::string told = error.what();
        std::smatch match;
        ASSERT_TRUE(std::regex_search(told, match, std::regex("frame (\\d+) \\(picture1(\\d\\d)[.]png\\) shows")))
            << told;
        EXPECT_EQ(std::stoi(match[1]), std::stoi(match[2]));
    }
}

TEST_F(StoppedRun, OfARangeEndsWithTheRange) {
    begin(whole, {}, kToTheEnd, {5, 40});
    begin(stopped, {}, 9, {5, 40});
    EXPECT_EQ(resume(stopped, 2).run.frames_done, 36);
    expectSame(whole, stopped, 2);
}

TEST_F(StoppedRun, LeavesOtherRunsAlone) {
    begin(stopped, {}, 12);
    const auto before = test::rowsOf(stopped, 1);
    resume(stopped, 2);
    EXPECT_EQ(test::rowsOf(stopped, 1), before);
}

TEST_F(StoppedRun, ThatWasKilledLaterGoesOnFromWhatWasKeptLast) {
    // As a killed program leaves it: frames beyond the kept state, tracks not finished, still running.
    const Path killed = folder / "killed.eyrie";
    {
        test::MemorySource source = clip();
        const SceneScale scale = sceneScale(source.info(), 0.2);
        Watcher watcher(20);
        RunRecorder recorder(killed, plannedRun(source.info(), scale, {}, "default"), {}, &watcher);
        ChainRun({}, scale).run(source, {}, recorder, watcher.stop.get_token());
    }
    std::optional<StoredRunState> kept;
    {
        ProjectFile project = ProjectFile::open(killed);
        kept = RunStateStore(project).newest(1);
        ASSERT_TRUE(kept);
    }
    {
        test::MemorySource source = clip();
        ResumedRun resumed = resumedRun(killed, 1, source);
        Watcher watcher(9);
        RunRecorder recorder(killed, resumed, &watcher);
        ChainRun(resumed.options, resumed.run.scale)
            .run(source, resumed.range(), recorder, watcher.stop.get_token(), false, resumed.start);
    }
    {
        ProjectFile project = ProjectFile::open(killed);
        EXPECT_EQ(RunStore(project).run(1)->frames_done, 29);
        RunStateStore(project).keep(1, kept->frame, kept->bytes);
    }
    const Resumed resumed = resume(killed, 1);
    EXPECT_EQ(resumed.last_done, 19);
    expectSame(whole, killed);
}

TEST_F(StoppedRun, WithNothingKeptBeginsAgain) {
    change("DELETE FROM run_state");
    const Resumed resumed = resume(stopped, 1);
    EXPECT_EQ(resumed.restart, RestartReason::nothing_kept);
    EXPECT_EQ(resumed.seen.front(), 0);
    expectSame(whole, stopped);
}

TEST_F(StoppedRun, WithAFrameMissingBeginsAgain) {
    change("DELETE FROM frame WHERE frame = 4");
    EXPECT_EQ(resume(stopped, 1).restart, RestartReason::damaged_state);
    expectSame(whole, stopped);
}

TEST_F(StoppedRun, WithADamagedStateBeginsAgain) {
    std::string bytes;
    {
        ProjectFile project = ProjectFile::open(stopped);
        bytes = RunStateStore(project).newest(1)->bytes;
    }
    std::mt19937 dice(5);
    for (int round = 0; round < 40; ++round) {
        std::string damaged = bytes;
        if (round % 4 == 3) {
            damaged.resize(dice() % damaged.size());
        } else {
            damaged[dice() % damaged.size()] ^= static_cast<char>(1U << dice() % 8);
        }
        ProjectFile project = ProjectFile::open(stopped);
        RunStateStore(project).keep(1, 29, damaged);
        test::MemorySource source = clip();
        EXPECT_EQ(resumedRun(stopped, 1, source).restart, RestartReason::damaged_state);
    }
    EXPECT_EQ(resume(stopped, 1).restart, RestartReason::damaged_state);
    expectSame(whole, stopped);
}

TEST_F(StoppedRun, RefusesAnotherVideo) {
    const auto refusal = [&](int frames, cv::Size size, const test::MemorySource::Draw& draw) -> std::string {
        test::MemorySource source(frames, size, draw);
        try {
            resumedRun(stopped, 1, source);
        } catch (const Error& error) {
            EXPECT_EQ(error.kind(), ErrorKind::input);
            return error.what();
        }
        return "";
    };
    const auto before = test::rowsOf(stopped, 1);
    const auto same = [](int frame) { return picture(scene(), frame); };
    EXPECT_THAT(refusal(kFrames + 1, scene().size, same), HasSubstr("47 frames now, 46 then"));
    EXPECT_THAT(refusal(kFrames, {640, 480}, same), HasSubstr("640×480 px now, 320×240 px then"));
    const auto brighter = [](int frame) -> cv::Mat { return picture(scene(), frame) + cv::Scalar(1); };
    EXPECT_THAT(refusal(kFrames, scene().size, brighter), testing::ContainsRegex("frame [0-9]+ shows something else"));
    EXPECT_EQ(test::rowsOf(stopped, 1), before) << "what was done stays";
}

TEST_F(StoppedRun, RefusesAClassifierThatHasChanged) {
    const Path classifier = folder / "own.eyriemodel";
    const VehicleModel shipped = loadModel(modelLocation(""));
    saveModel(shipped, classifier);
    const ChainOptions options = with({{"sliding_window.model", classifier.string()}});
    const Path project = folder / "classified.eyrie";
    begin(project, options, 30);
    const auto before = test::rowsOf(project, 1);

    VehicleModel retrained = shipped;
    retrained.record.data += " and more";
    saveModel(retrained, classifier);
    test::MemorySource source = clip();
    const auto refusal = [&]() -> std::string {
        try {
            resumedRun(project, 1, source);
        } catch (const Error& error) {
            EXPECT_EQ(error.kind(), ErrorKind::input);
            return error.what();
        }
        return "";
    };
    EXPECT_THAT(refusal(), AllOf(HasSubstr(classifier.string()), HasSubstr("put the old file back")));
    std::filesystem::remove(classifier);
    EXPECT_THAT(refusal(), HasSubstr(classifier.string()));
    EXPECT_EQ(test::rowsOf(project, 1), before) << "what was done stays";

    saveModel(shipped, classifier);
    const Resumed resumed = resume(project, 1);
    EXPECT_EQ(resumed.last_done, 29);
    EXPECT_EQ(resumed.run.state, RunState::finished);
}

TEST_F(StoppedRun, WithoutAClassifierDoesNotAskForOne) {
    const ChainOptions options =
        with({{"detection.method", "gradient"}, {"sliding_window.model", (folder / "never.eyriemodel").string()}});
    const Path project = folder / "unclassified.eyrie";
    begin(project, options, 30);
    EXPECT_EQ(resume(project, 1).last_done, 29);
}

TEST_F(StoppedRun, IsOfferedUnlessItCannotBeGoneOnWith) {
    const auto obstacle = [&] {
        ProjectFile project = ProjectFile::open(stopped);
        const RunStore store(project);
        EXPECT_EQ(resumableRuns(store).size(), resumeObstacle(store, *store.run(1)) == ResumeObstacle::none ? 1U : 0U);
        return resumeObstacle(store, *store.run(1));
    };
    EXPECT_EQ(obstacle(), ResumeObstacle::none);
    change("UPDATE run SET engine_version = '0.0.1'");
    EXPECT_EQ(obstacle(), ResumeObstacle::other_engine);
    test::MemorySource source = clip();
    try {
        resumedRun(stopped, 1, source);
        FAIL() << "expected an error";
    } catch (const Error& error) {
        EXPECT_EQ(error.kind(), ErrorKind::parameter);
        EXPECT_THAT(error.what(), HasSubstr("another version of Eyrie"));
    }
    change("UPDATE run SET engine_version = '" + engineVersion() + "'");
    change("UPDATE run_parameter SET name = 'motion.magic' WHERE name = 'motion.min_speed'");
    EXPECT_EQ(obstacle(), ResumeObstacle::other_parameters);
    change("UPDATE run_parameter SET name = 'motion.min_speed' WHERE name = 'motion.magic'");
    resume(stopped, 1);
    EXPECT_EQ(obstacle(), ResumeObstacle::finished);
    EXPECT_THROW(resumedRun(stopped, 7, source), Error);
}

TEST_F(StoppedRun, ThatFailedGoesOnWhenTheCauseIsGone) {
    const Path failed = folder / "failed.eyrie";
    struct FullDisk : ChainObserver {
        void onFrame(const std::shared_ptr<const FrameResult>& result, const Frame&) override {
            if (result->motion.frame == 20) throw Error(ErrorKind::output, "no space left");
        }
    } disk;
    test::MemorySource source = clip();
    const SceneScale scale = sceneScale(source.info(), 0.2);
    {
        RunRecord planned = plannedRun(source.info(), scale, {}, "default");
        planned.scale_basis = {ScaleOrigin::metadata};
        RunRecorder recorder(failed, planned, {}, &disk);
        const RunRecord run = recorder.finish(ChainRun({}, scale).run(source, {}, recorder, {}));
        EXPECT_EQ(run.state, RunState::failed);
        EXPECT_EQ(run.message, "no space left");
    }
    const Resumed resumed = resume(failed, 1);
    EXPECT_EQ(resumed.run.state, RunState::finished);
    EXPECT_EQ(resumed.run.message, "");
    EXPECT_EQ(resumed.run.scale_basis, ScaleBasis{ScaleOrigin::metadata});
    expectSame(whole, failed);
}

TEST(KeptStates, ServeEveryFrameTheyWereKeptAfter) {
    constexpr int kFollowed = 8;  ///< frames after each state; how runs go on to their end is told above
    struct Keeper : ChainObserver {
        explicit Keeper(int frames = kToTheEnd) : frames_left(frames) {}
        std::stop_source stop;
        int frames_left;
        std::vector<ChainState> states;
        std::vector<std::shared_ptr<const FrameResult>> results;
        std::optional<StateKeeping> stateKeeping() const override { return StateKeeping{0, 1}; }
        void onState(const ChainState& state) override { states.push_back(state); }
        void onFrame(const std::shared_ptr<const FrameResult>& result, const Frame&) override {
            results.push_back(result);
            if (--frames_left == 0) stop.request_stop();
        }
    };
    test::MemorySource source = clip();
    const SceneScale scale = sceneScale(source.info(), 0.2);
    Keeper whole;
    ChainRun({}, scale).run(source, {}, whole, {});
    ASSERT_GT(whole.states.size(), 3U);
    for (const ChainState& state : whole.states) {
        // Around the pictures that repeat and are blank every one; before and after, every other is enough.
        if (state.last_done % 2 == 0 && (state.last_done < 14 || state.last_done > 30)) continue;
        Keeper rest(kFollowed);
        const RunSummary summary = ChainRun({}, scale).run(source, {}, rest, rest.stop.get_token(), false,
                                                           {unpackedState(state.bytes, {}, scale, source), 0});
        ASSERT_NE(summary.outcome, RunOutcome::failed) << summary.message;
        ASSERT_EQ(static_cast<int>(rest.results.size()), std::min(kFollowed, kFrames - 1 - state.last_done));
        for (const auto& result : rest.results) {
            const FrameResult& expected = *whole.results.at(std::size_t(result->motion.frame));
            ASSERT_EQ(result->motion.corner_count, expected.motion.corner_count);
            ASSERT_EQ(result->tracks.size(), expected.tracks.size());
            for (std::size_t i = 0; i < expected.tracks.size(); ++i) {
                ASSERT_EQ(result->tracks[i].box.centre, expected.tracks[i].box.centre);
            }
        }
    }
}

TEST(KeptStates, OfOtherParametersAreNotUsed) {
    test::MemorySource source = clip();
    const SceneScale scale = sceneScale(source.info(), 0.2);
    ChainProgress progress({}, scale);
    const std::string bytes = packedState({3, progress.classifier, stateBytes(progress.motion_half),
                                           stateBytes(progress.waiting), stateBytes(progress.track_half)},
                                          {}, scale);
    EXPECT_TRUE(unpackedState(bytes, {}, scale, source));
    EXPECT_FALSE(unpackedState(bytes, with({{"tracking.min_overlap", "0.33"}}), scale, source));
    EXPECT_FALSE(unpackedState(bytes, {}, sceneScale(source.info(), 0.21), source));
}

}  // namespace eyrie::run_resume_test
