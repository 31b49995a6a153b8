#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <functional>
#include <limits>
#include <thread>

#include "chain/recording/run_facts.h"
#include "chain/recording/run_pictures.h"
#include "chain/recording/run_recorder.h"
#include "support/moving_scene.h"
#include "support/temporary_folder.h"

/// What is recorded, told and read again of runs whose frames are written here one by one.
namespace eyrie::recording_by_hand_test {
namespace {

using Fill = std::function<void(int frame, FrameResult&)>;

VideoInfo clipOf(int frames) {
    VideoInfo clip;
    clip.path = "/nowhere/clip.mp4";
    clip.size = {320, 240};
    clip.frame_count = frames;
    return clip;
}

/// Of a run over so many frames, all registered unless `fill` says otherwise.
RunFacts factsOf(int frames, const Fill& fill, const ChainOptions& options = {}, double frame_rate_hz = 25) {
    const test::TemporaryFolder folder;
    SceneScale scale{0.2, frame_rate_hz, true};
    RunRecorder recorder(folder / "p.eyrie", plannedRun(clipOf(frames), scale, {}, "default"), options);
    for (int frame = 0; frame < frames; ++frame) {
        const auto result = std::make_shared<FrameResult>();
        result->motion.frame = frame;
        result->motion.image_size = {320, 240};
        Registration& registration = result->motion.registration;
        registration.state = frame == 0 ? RegistrationState::first : RegistrationState::registered;
        registration.current_from_previous.from_frame = std::max(0, frame - 1);
        registration.current_from_previous.to_frame = frame;
        fill(frame, *result);
        recorder.onFrame(result, {});
    }
    RunSummary summary;
    summary.outcome = RunOutcome::finished;
    summary.message.clear();
    const RunRecord run = recorder.finish(summary);
    ProjectFile project = ProjectFile::open(folder / "p.eyrie");
    return factsOf(project, run);
}

void move(FrameResult& result) {
    MotionVector vector;
    vector.id = 1;
    vector.position = {100, 100};
    vector.velocity = {2, 0};
    vector.age = 5;
    result.motion.motion_vectors = {vector};
}

void detect(FrameResult& result, Rejection rejection) {
    Detection detection;
    detection.box = {{100, 100}, 20, 10, 0};
    detection.rejection = rejection;
    result.detections = {detection};
}

void follow(int frame, FrameResult& result, const OrientedBox& box, TrackStatus status) {
    TrackState state;
    state.id = 1;
    state.box = box;
    state.box.centre.x += 2.0 * frame;
    state.velocity = {2, 0};
    state.status = status;
    state.age = frame;
    state.hits = frame + 1;
    state.score = 1;
    result.tracks = {state};
}

/// Pictures by their number; slow, or not there at all.
struct Pictures : test::MemorySource {
    explicit Pictures(bool is_folder = false)
        : MemorySource(40, {16, 16}, [](int i) { return cv::Mat(16, 16, CV_8UC1, cv::Scalar(i)); }),
          described(MemorySource::info()) {
        described.is_image_sequence = is_folder;
    }
    const VideoInfo& info() const override { return described; }
    Frame read(FrameIndex index, bool with_colour) override {
        EXPECT_FALSE(with_colour);
        EXPECT_FALSE(at_work.exchange(true)) << "one at a time";
        std::this_thread::sleep_for(takes);
        at_work = false;
        if (index == missing) throw Error(ErrorKind::input, "gone");
        read_frames.push_back(index);
        return MemorySource::read(index, with_colour);
    }
    std::chrono::milliseconds takes{0};
    FrameIndex missing = -1;
    VideoInfo described;
    std::atomic<bool> at_work{false};
    std::vector<FrameIndex> read_frames;
};

int greyOf(const cv::Mat& picture) {
    return picture.empty() ? -1 : picture.at<unsigned char>(0, 0);
}

}  // namespace

TEST(RecordedByHand, TheFirstStepAfterWhichNothingWasLeftIsNamed) {
    const auto nothing = [](int frames, const Fill& fill) { return factsOf(frames, fill).nothing; };
    EXPECT_EQ(nothing(12, [](int, FrameResult&) {}), NothingFollowed::no_motion);
    const auto movesIn = [](int in_frame) {
        return [in_frame](int frame, FrameResult& result) {
            if (frame == in_frame) move(result);
        };
    };
    EXPECT_EQ(nothing(12, movesIn(4)), NothingFollowed::no_detections);
    const auto detectedAs = [](Rejection rejection) {
        return [rejection](int frame, FrameResult& result) {
            move(result);
            if (frame == 3) detect(result, rejection);
        };
    };
    EXPECT_EQ(nothing(12, detectedAs(Rejection::size)), NothingFollowed::all_rejected);
    EXPECT_EQ(nothing(12, detectedAs(Rejection::none)), NothingFollowed::none_confirmed);
    const auto followed = [](const OrientedBox& box, TrackStatus status) {
        return [box, status](int frame, FrameResult& result) {
            move(result);
            detect(result, Rejection::none);
            follow(frame, result, box, frame < 3 ? TrackStatus::tentative : status);
        };
    };
    const OrientedBox car{{100, 100}, 22, 10, 0}, speck{{100, 100}, 3, 2, 0};
    EXPECT_EQ(nothing(30, followed(car, TrackStatus::confirmed)), NothingFollowed::has_tracks);
    EXPECT_EQ(nothing(30, followed(car, TrackStatus::tentative)), NothingFollowed::none_confirmed);
    EXPECT_EQ(nothing(30, followed(speck, TrackStatus::confirmed)), NothingFollowed::all_dropped);
}

TEST(RecordedByHand, WithoutARegisteredFrameNoMotionCouldBeMeasured) {
    const auto factsWhere = [](int failed) {
        return factsOf(12, [failed](int frame, FrameResult& result) {
            if (frame > 0 && frame <= failed) result.motion.registration.state = RegistrationState::failed;
        });
    };
    EXPECT_EQ(factsWhere(11).nothing, NothingFollowed::not_registered);
    EXPECT_EQ(factsWhere(11).counts.unregistered, 11);
    EXPECT_EQ(factsWhere(10).nothing, NothingFollowed::no_motion);
    EXPECT_EQ(factsWhere(10).counts.frames, 12);
}

TEST(RecordedByHand, FewerFramesThanATrackIsDetectedInAreTooFew) {
    const auto still = [](int, FrameResult&) {};
    ChainOptions options;
    options.tracking.confirm_hits = 7;
    options.tracking.confirm_window = 9;
    EXPECT_EQ(factsOf(7, still, options).nothing, NothingFollowed::too_few_frames);
    EXPECT_EQ(factsOf(8, still, options).nothing, NothingFollowed::no_motion);
    EXPECT_EQ(factsOf(8, still, options).frames_needed, 8);
    const int slowly = options.tracking.atRate(5).confirm_hits;
    ASSERT_LT(slowly, 7);
    EXPECT_EQ(factsOf(8, still, options, 5).frames_needed, 3) << "two whole vehicles would do";
    options.tracking.confirm_whole = 0;
    EXPECT_EQ(factsOf(8, still, options, 5).frames_needed, slowly + 1);
    options.tracking.confirm_whole = 60;
    EXPECT_EQ(factsOf(8, still, options, 5).frames_needed, slowly + 1);
    EXPECT_EQ(factsOf(0, still).nothing, NothingFollowed::no_frames);
}

TEST(RecordedByHand, AScaleThatWasStatedIsDoubtedWhereNothingWasFoundThoughItCouldBe) {
    const std::vector<std::pair<NothingFollowed, bool>> cases{
        {NothingFollowed::has_tracks, false},     {NothingFollowed::no_frames, false},
        {NothingFollowed::too_few_frames, false}, {NothingFollowed::not_registered, false},
        {NothingFollowed::no_motion, true},       {NothingFollowed::no_detections, true},
        {NothingFollowed::all_rejected, true},    {NothingFollowed::none_confirmed, true},
        {NothingFollowed::all_dropped, true}};
    for (const auto& [nothing, doubted] : cases) {
        for (const ScaleOrigin origin :
             {ScaleOrigin::given, ScaleOrigin::metadata, ScaleOrigin::estimated, ScaleOrigin::assumed}) {
            RunFacts facts;
            facts.nothing = nothing;
            facts.scale_basis.origin = origin;
            facts.gsd_m_per_px = 5;
            const bool stated = origin == ScaleOrigin::given || origin == ScaleOrigin::metadata;
            EXPECT_EQ(doubtfulScaleOf(facts), doubted && stated ? doubtOfGsd(5) : "")
                << static_cast<int>(nothing) << nameOf(origin);
            facts.gsd_m_per_px = 0.2;
            EXPECT_EQ(doubtfulScaleOf(facts), "");
        }
    }
    EXPECT_NE(doubtOfGsd(5), "");
}

TEST(RecordedByHand, ARunThatIsPlannedSaysWhatIsKnownOfItsVideo) {
    VideoInfo video = clipOf(90);
    video.frame_rate_hz = 29.97;
    for (const bool assumed : {false, true}) {
        video.frame_rate_assumed = assumed;
        const RunRecord run = plannedRun(video, {0.3, 29.97, true}, {7, 50}, "thesis");
        EXPECT_EQ(run.sequence.path, "/nowhere/clip.mp4");
        EXPECT_EQ(run.sequence.size, cv::Size(320, 240));
        EXPECT_EQ(run.sequence.frame_count, 90);
        EXPECT_EQ(run.sequence.frame_rate_hz, 29.97);
        EXPECT_EQ(run.sequence.rate_assumed, assumed);
        EXPECT_EQ(run.rate_assumed, assumed);
        EXPECT_EQ(run.preset, "thesis");
        EXPECT_EQ(run.engine_version, engineVersion());
        EXPECT_EQ(run.scale.gsd_m_per_px, 0.3);
        EXPECT_EQ(run.scale_basis.origin, ScaleOrigin::given);
        EXPECT_EQ(run.first_frame, 7);
        EXPECT_EQ(run.last_frame, 50);
    }
    EXPECT_EQ(plannedRun(video, {}, {7, -1}, "").last_frame, 89) << "to the end";
    EXPECT_EQ(plannedRun(video, {}, {0, 0}, "").last_frame, 0);
    EXPECT_EQ(plannedRun(video, {}, {}, "").scale_basis.origin, ScaleOrigin::assumed);
}

TEST(RecordedByHand, TheScaleIsWhatIsGivenOrWhatTheSourceKnows) {
    VideoInfo video = clipOf(90);
    video.frame_rate_hz = 50;
    const auto gsd = [&](double of_source, double given) {
        video.gsd_m_per_px = of_source;
        const SceneScale scale = sceneScale(video, given);
        EXPECT_EQ(scale.frame_rate_hz, 50);
        EXPECT_TRUE(scale.slope.isFlat());
        EXPECT_TRUE(scale.gsd_known || scale.gsd_m_per_px == SceneScale().gsd_m_per_px);
        return scale.gsd_known ? scale.gsd_m_per_px : -1;
    };
    EXPECT_EQ(gsd(0, 0.4), 0.4);
    EXPECT_EQ(gsd(0.3, 0.4), 0.4);
    EXPECT_EQ(gsd(0.3, 0), 0.3);
    EXPECT_EQ(gsd(0.3, -1), 0.3);
    EXPECT_EQ(gsd(0, 0), -1) << "nobody knows";
    EXPECT_EQ(gsd(0, -1), -1);
}

TEST(RecordedByHand, RunsThatEndedEarlyAreOfferedTheNewestFirst) {
    const test::TemporaryFolder folder;
    const std::filesystem::path project = folder / "p.eyrie";
    const auto begun = [&] {
        return std::make_unique<RunRecorder>(project, plannedRun(clipOf(4), {}, {}, "default"), ChainOptions{});
    };
    for (const RunOutcome outcome : {RunOutcome::stopped, RunOutcome::finished, RunOutcome::failed}) {
        const auto recorder = begun();
        EXPECT_EQ(recorder->medianStoreMs(), 0) << "nothing is stored yet";
        const auto result = std::make_shared<FrameResult>();
        result->motion.image_size = {320, 240};
        recorder->onFrame(result, {});
        EXPECT_GT(recorder->medianStoreMs(), 0);
        RunSummary summary;
        summary.outcome = outcome;
        recorder->finish(summary);
    }
    const auto killed = [&] { return begun()->runId(); }();
    const auto written = begun();
    ProjectFile file = ProjectFile::open(project);
    const RunStore store(file);
    std::vector<int> offered;
    for (const RunRecord& run : resumableRuns(store)) offered.push_back(run.id);
    EXPECT_EQ(offered, (std::vector{killed, 3, 1}));
    EXPECT_EQ(resumeObstacle(store, *store.run(2)), ResumeObstacle::finished);
    EXPECT_EQ(resumeObstacle(store, *store.run(written->runId())), ResumeObstacle::live);
    test::MemorySource source(4, {320, 240}, [](int) { return cv::Mat(240, 320, CV_8UC1, cv::Scalar(0)); });
    const auto refused = [&](int run) {
        try {
            resumedRun(project, run, source);
            return std::pair(ErrorKind::internal, std::string("taken up"));
        } catch (const Error& error) {
            return std::pair(error.kind(), std::string(error.what()));
        }
    };
    EXPECT_EQ(refused(written->runId()).first, ErrorKind::project);
    EXPECT_THAT(refused(written->runId()).second, testing::HasSubstr("is being written by process"));
    EXPECT_EQ(refused(2).first, ErrorKind::parameter);
    EXPECT_THAT(refused(2).second,
                testing::HasSubstr("run 2 of " + project.string() + " cannot be resumed: it is fin"));
    EXPECT_THAT(refused(9).second, testing::HasSubstr("there is no such run"));
    // What has changed of the video is told, whichever side it is.
    for (const cv::Size size : {cv::Size(320, 239), {319, 240}}) {
        test::MemorySource other(4, size, [&](int) { return cv::Mat(size, CV_8UC1, cv::Scalar(0)); });
        try {
            resumedRun(project, 1, other);
            ADD_FAILURE() << size;
        } catch (const Error& error) {
            const std::string now = std::to_string(size.width) + "×" + std::to_string(size.height) + " px now";
            EXPECT_THAT(error.what(), testing::HasSubstr(now + ", 320×240 px then"));
        }
    }
}

TEST(HeldPictures, AreThoseOfTheRange) {
    RunPictures held({5, 7});
    const auto picture = [](int grey) { return cv::Mat(4, 4, CV_8UC1, cv::Scalar(grey)); };
    for (const int frame : {4, 7, 8, 5}) held.take(frame, picture(frame));
    held.take(6, {});
    for (int frame = 3; frame <= 9; ++frame)
        EXPECT_EQ(greyOf(held.at(frame)), frame == 5 || frame == 7 ? frame : -1) << frame;
    // The first one tells only how large the others are.
    held.take(6, cv::Mat(9300, 9300, CV_8UC1));
    for (int frame = 3; frame <= 9; ++frame) EXPECT_TRUE(held.at(frame).empty()) << frame;
    held.take(5, picture(5));
    EXPECT_TRUE(held.at(5).empty()) << "all or none";
}

TEST(PicturesOnceMore, AreThoseThatAreHeldAndElseReadAgain) {
    RunPictures held({10, 19});
    held.take(12, cv::Mat(16, 16, CV_8UC1, cv::Scalar(99)));
    Pictures source;
    source.missing = 14;
    std::stop_source stop;
    PicturesOnceMore again(held, source, 10, 19, nullptr, stop.get_token());
    EXPECT_EQ(greyOf(again(10)), 10);
    EXPECT_EQ(greyOf(again(12)), 99);
    EXPECT_EQ(greyOf(again(13)), 13);
    EXPECT_EQ(again.lost(), 0);
    EXPECT_TRUE(again(14).empty());
    EXPECT_TRUE(again(14).empty());
    EXPECT_EQ(again.lost(), 2);
    const std::vector<FrameIndex> read{10, 11, 13};  // 11 in vain
    EXPECT_EQ(source.read_frames, read);
    EXPECT_FALSE(again.stopped());
    stop.request_stop();
    EXPECT_FALSE(again.stopped()) << "nothing was refused yet";
    EXPECT_TRUE(again(12).empty());
    EXPECT_TRUE(again(15).empty());
    EXPECT_TRUE(again.stopped());
    EXPECT_EQ(again.lost(), 2) << "refused, not lost";
    EXPECT_EQ(source.read_frames, read);
}

TEST(PicturesOnceMore, ReadTheOneThatProbablyComesNextWhileOneIsWorkedOn) {
    const auto readFor = [](const std::vector<FrameIndex>& frames, bool is_folder) {
        Pictures source(is_folder);
        const RunPictures none;
        {
            PicturesOnceMore again(none, source, 10, 19, nullptr, {});
            for (const FrameIndex frame : frames) EXPECT_EQ(greyOf(again(frame)), frame);
            EXPECT_EQ(again.lost(), 0);
        }
        return source.read_frames;
    };
    using Frames = std::vector<FrameIndex>;
    EXPECT_EQ(readFor({10, 11, 12}, false), (Frames{10, 11, 12, 13}));
    EXPECT_EQ(readFor({10, 12, 14}, false), (Frames{10, 11, 12, 13, 14, 15})) << "a video is read in one go";
    EXPECT_EQ(readFor({10, 13, 16}, true), (Frames{10, 11, 13, 16, 19})) << "of a folder as far on as before";
    EXPECT_EQ(readFor({10, 13, 14}, true), (Frames{10, 11, 13, 16, 14, 15}));
    EXPECT_EQ(readFor({18, 19}, false), (Frames{18, 19})) << "there is none after the last";
    // What is missing is lost only where it is asked for.
    Pictures source;
    source.missing = 11;
    const RunPictures none;
    {
        PicturesOnceMore again(none, source, 10, 19, nullptr, {});
        EXPECT_EQ(greyOf(again(10)), 10);
        EXPECT_EQ(greyOf(again(12)), 12);
        EXPECT_EQ(again.lost(), 0);
    }
    PicturesOnceMore asked(none, source, 10, 19, nullptr, {});
    EXPECT_EQ(greyOf(asked(10)), 10);
    EXPECT_TRUE(asked(11).empty());
    EXPECT_EQ(asked.lost(), 1);
}

TEST(PicturesOnceMore, TellNowAndThenHowFarTheyAre) {
    using Clock = std::chrono::steady_clock;
    struct Listener : ChainObserver {
        void onFrame(const std::shared_ptr<const FrameResult>&, const Frame&) override {}
        void onProgress(const RunProgress& progress) override {
            const double passed = std::chrono::duration<double>(Clock::now() - begin).count();
            EXPECT_TRUE(progress.finishing);
            EXPECT_FALSE(progress.estimating_scale);
            EXPECT_EQ(progress.frames_total, 10);
            EXPECT_EQ(progress.frames_done, asked_for - 10) << "those before the one that is asked for";
            EXPECT_NEAR(progress.frames_per_second * passed, progress.frames_done, 0.2);
            EXPECT_NEAR(progress.seconds_left * progress.frames_per_second, 10 - progress.frames_done, 1e-6);
            told.push_back(passed);
        }
        Clock::time_point begin = Clock::now();
        FrameIndex asked_for = 0;
        std::vector<double> told;
    } listener;
    Pictures source;
    source.takes = std::chrono::milliseconds(75);
    const RunPictures none;
    PicturesOnceMore again(none, source, 10, 19, &listener, {});
    listener.begin = Clock::now();
    // The first one three times: nothing is done yet.
    for (const FrameIndex frame : {10, 10, 10, 10, 11, 12, 13, 14}) {
        listener.asked_for = frame;
        again(frame);
        if (frame > 10) continue;
        EXPECT_TRUE(listener.told.empty());
    }
    const double passed = std::chrono::duration<double>(Clock::now() - listener.begin).count();
    ASSERT_GE(listener.told.size(), 2U);
    EXPECT_GE(listener.told.front(), 0.2);
    EXPECT_LE(static_cast<double>(listener.told.size()), passed / 0.2);
}

}  // namespace eyrie::recording_by_hand_test
