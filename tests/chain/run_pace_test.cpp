#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <thread>

#include "chain/chain_run.h"
#include "chain/progress_meter.h"
#include "core/values/last_frame.h"
#include "support/moving_scene.h"
#include "support/wait_until.h"

/// How far the first half of the chain runs ahead of the second, and how often what is needed to go on is kept.
namespace eyrie::run_pace_test {
namespace {

const SceneScale kScale{0.2, 25, true};

/// Hardly anything to do: grey pictures, which take their time.
struct GreyPictures : test::MemorySource {
    explicit GreyPictures(int frames, std::chrono::milliseconds each = {})
        : MemorySource(frames, {64, 48}, [](int) { return cv::Mat(48, 64, CV_8UC1, cv::Scalar(90)); }), takes(each) {}
    Frame read(FrameIndex index, bool with_colour) override {
        std::this_thread::sleep_for(takes);
        Frame frame = MemorySource::read(index, with_colour);
        ++reads;
        return frame;
    }
    std::chrono::milliseconds takes;
    std::atomic<int> reads{0};
};

struct KeepsStates : ChainObserver {
    explicit KeepsStates(std::optional<StateKeeping> how) : keeping(how) {}
    void onFrame(const std::shared_ptr<const FrameResult>& result, const Frame&) override {
        last_seen = result->motion.frame;
    }
    std::optional<StateKeeping> stateKeeping() const override { return keeping; }
    void onState(const ChainState& state) override {
        EXPECT_EQ(state.last_done, last_seen) << "after the frame's own results";
        EXPECT_FALSE(state.bytes.empty());
        if (kept.empty()) first_after = std::chrono::steady_clock::now() - begin;
        kept.push_back(state.last_done);
        std::this_thread::sleep_for(takes);
    }
    std::optional<StateKeeping> keeping;
    std::chrono::milliseconds takes{0};
    FrameIndex last_seen = -1;
    std::vector<FrameIndex> kept;
    std::chrono::steady_clock::time_point begin = std::chrono::steady_clock::now();
    std::chrono::duration<double> first_after{0};
};

int keptIn(GreyPictures& source, KeepsStates& observer, RunSummary* summary = nullptr) {
    const RunSummary done = ChainRun({}, kScale).run(source, {}, observer, {});
    EXPECT_EQ(done.outcome, RunOutcome::finished) << done.message;
    if (summary != nullptr) *summary = done;
    return static_cast<int>(observer.kept.size());
}

/// The same picture a second time, as a live stream hands it out for one that it left out.
struct RepeatingSource : test::MemorySource {
    explicit RepeatingSource(bool live)
        : MemorySource(15, test::MovingScene().size,
                       [](int index) {
                           static const test::MovingScene scene;
                           static std::map<int, cv::Mat> drawn;
                           cv::Mat& picture = drawn[index - (index == 12 ? 1 : 0)];
                           if (picture.empty()) picture = scene.draw(index);
                           return picture;
                       }),
          info_(MemorySource::info()) {
        if (live) info_.frame_count = kLastFrame + 1;
    }
    const VideoInfo& info() const override { return info_; }

 private:
    VideoInfo info_;
};

}  // namespace

TEST(RunPace, IsToldOverTheLastFiveSecondsOrTheLastTwoFrames) {
    ProgressMeter meter(100, 10);
    const auto at = [&](int milliseconds) {
        return meter.frameDone(ProgressMeter::Moment() + std::chrono::milliseconds(milliseconds));
    };
    const RunProgress first = at(0);
    EXPECT_EQ(first.frames_done, 11);
    EXPECT_EQ(first.frames_total, 100);
    EXPECT_EQ(first.frames_per_second, 0);
    EXPECT_EQ(first.seconds_left, 0);
    EXPECT_NEAR(at(8000).frames_per_second, 1 / 8.0, 1e-9) << "slow, but two frames";
    EXPECT_NEAR(at(9000).frames_per_second, 1, 1e-9) << "the first one is too long ago";
    EXPECT_NEAR(at(9500).frames_per_second, 2 / 1.5, 1e-9);
    const RunProgress fifth = at(13000);
    EXPECT_NEAR(fifth.frames_per_second, 3 / 5.0, 1e-9) << "five seconds are not too long";
    EXPECT_EQ(fifth.frames_done, 15);
    EXPECT_NEAR(fifth.seconds_left, 85 * 5 / 3.0, 1e-9);
    EXPECT_NEAR(at(13100).frames_per_second, 3 / 4.1, 1e-9);
}

TEST(RunPace, TheFirstHalfIsFourFramesAheadAtMost) {
    GreyPictures source(40);
    struct Holds : ChainObserver {
        explicit Holds(const GreyPictures& of) : source(of) {}
        void onFrame(const std::shared_ptr<const FrameResult>& result, const Frame&) override {
            if (result->motion.frame != 5) return;
            test::waitUntil("three frames wait, and one more is registered", [&] { return source.reads >= 10; });
            std::this_thread::sleep_for(std::chrono::milliseconds(30));
            EXPECT_EQ(source.reads, 10) << "frames 6 to 9 beside the one at work";
        }
        const GreyPictures& source;
    } observer(source);
    EXPECT_EQ(ChainRun({}, kScale).run(source, {}, observer, {}).frames_done, 40);
}

TEST(RunPace, WhereResultsCannotBeStoredTheRestIsNotRead) {
    GreyPictures source(300);
    struct FullDisk : ChainObserver {
        void onFrame(const std::shared_ptr<const FrameResult>& result, const Frame&) override {
            if (result->motion.frame == 3) throw Error(ErrorKind::output, "no space left");
        }
    } observer;
    EXPECT_EQ(ChainRun({}, kScale).run(source, {}, observer, {}).outcome, RunOutcome::failed);
    EXPECT_GE(source.reads, 4);
    EXPECT_LE(source.reads, 9) << "four that waited, and one that was being read";
}

TEST(RunPace, OfAShortRunAStateIsKeptAfterAFifthOfTheTimeBetweenStates) {
    GreyPictures source(40, std::chrono::milliseconds(8));
    KeepsStates observer(StateKeeping{1, 1});
    RunSummary summary;
    const int kept = keptIn(source, observer, &summary);
    ASSERT_GE(kept, 1) << "the run takes 0.32 s at least, and the first state is kept after 0.2 s";
    EXPECT_LE(kept, 1 + static_cast<int>(summary.seconds));
    EXPECT_GE(observer.first_after.count(), 0.2);
    GreyPictures few(6);
    KeepsStates never(StateKeeping{1000, 1}), not_asked(std::nullopt);
    EXPECT_EQ(keptIn(few, never), 0);
    EXPECT_EQ(keptIn(few, not_asked), 0);
}

TEST(RunPace, KeepingStatesTakesItsShareOfTheTimeAtMost) {
    GreyPictures source(50, std::chrono::milliseconds(6)), quick(20);
    KeepsStates always(StateKeeping{0, 1000});
    EXPECT_GE(keptIn(quick, always), 15);
    KeepsStates seldom(StateKeeping{0, 0.1});
    seldom.takes = std::chrono::milliseconds(12);
    RunSummary summary;
    const int kept = keptIn(source, seldom, &summary);
    EXPECT_GE(kept, 2);
    EXPECT_LE(kept, 2 + summary.seconds / 0.12) << "12 ms are a tenth of 120 ms";
}

TEST(RunPace, AStateIsKeptWhereARunStopsUnlessNothingIsDoneOrNobodyAsks) {
    const auto keptWhenStopped = [](int after, std::optional<StateKeeping> how) {
        struct Stops : KeepsStates {
            using KeepsStates::KeepsStates;
            void onFrame(const std::shared_ptr<const FrameResult>& result, const Frame& frame) override {
                KeepsStates::onFrame(result, frame);
                if (result->motion.frame + 1 == after) stop.request_stop();
            }
            int after = 0;
            std::stop_source stop;
        } observer(how);
        observer.after = after;
        if (after == 0) observer.stop.request_stop();
        GreyPictures source(20);
        const RunSummary done = ChainRun({}, kScale).run(source, {}, observer, observer.stop.get_token());
        EXPECT_EQ(done.outcome, after < 20 ? RunOutcome::stopped : RunOutcome::finished);
        EXPECT_EQ(done.frames_done, after);
        return observer.kept;
    };
    constexpr StateKeeping kSeldom{1000, 1};
    EXPECT_EQ(keptWhenStopped(3, kSeldom), std::vector<FrameIndex>{2});
    EXPECT_EQ(keptWhenStopped(3, std::nullopt), std::vector<FrameIndex>{});
    EXPECT_EQ(keptWhenStopped(0, kSeldom), std::vector<FrameIndex>{});
    EXPECT_EQ(keptWhenStopped(20, kSeldom), std::vector<FrameIndex>{}) << "it is finished";
}

TEST(RunPace, NothingIsLookedForInAPictureThatALiveSourceRepeats) {
    struct Collector : ChainObserver {
        void onFrame(const std::shared_ptr<const FrameResult>& result, const Frame&) override {
            vectors.push_back(result->motion.motion_vectors.size());
            states.push_back(result->motion.registration.state);
        }
        std::vector<std::size_t> vectors;
        std::vector<RegistrationState> states;
    };
    for (const bool live : {false, true}) {
        RepeatingSource source(live);
        Collector collector;
        ChainRun({}, kScale).run(source, {0, 14}, collector, {});
        ASSERT_EQ(collector.vectors.size(), 15U);
        EXPECT_GT(collector.vectors[11], 0U);
        EXPECT_EQ(collector.states[12], RegistrationState::frozen);
        EXPECT_EQ(collector.vectors[12] == 0, live);
        EXPECT_GT(collector.vectors[14], 0U) << "it goes on";
    }
}

}  // namespace eyrie::run_pace_test
