#include <gtest/gtest.h>

#include <chrono>
#include <thread>

#include "chain/chain.h"
#include "chain/scale/look_progress.h"
#include "chain/scale/scale_trial.h"
#include "chain/scale/slope_estimation.h"
#include "chain/scale/view_estimation.h"
#include "core/robust_statistics.h"
#include "support/moving_scene.h"

/// Which frames are looked at for the scale, and what of them counts.
namespace eyrie::scale_looks_test {
namespace {

test::MemorySource sceneOf(int frames, cv::Size size = {160, 120}) {
    test::MovingScene scene;
    scene.frames = frames;
    scene.size = size;
    scene.vehicles = {{{60, 70}, {1.6, 0.3}, {24, 11}}};
    return test::MemorySource(scene);
}

/// Frames that a look for a slope reads, and says that it may read.
std::pair<std::size_t, int> looksForASlope(int frames, FrameRange range = {}) {
    test::MemorySource source = sceneOf(frames, {64, 48});
    std::vector<RunProgress> told;
    estimateSlope(source, range, ChainOptions{}, SceneScale{0.2, 25, true}, {},
                  [&](const RunProgress& progress) { told.push_back(progress); });
    return {told.size(), told.empty() ? 0 : told.front().frames_total};
}

/// Grey pictures, which cost next to nothing; from one on they cannot be read. Keeps which were asked for.
struct GreySource : test::MemorySource {
    explicit GreySource(int frames, int broken_from = 1000)
        : MemorySource(frames, {64, 48}, [](int) { return cv::Mat(48, 64, CV_8UC1, cv::Scalar(90)); }),
          broken(broken_from) {}
    Frame read(FrameIndex index, bool with_colour) override {
        EXPECT_FALSE(with_colour) << "which takes its time";
        if (index >= broken) throw Error(ErrorKind::input, "broken");
        asked_for.push_back(index);
        return MemorySource::read(index, with_colour);
    }
    int broken;
    std::vector<FrameIndex> asked_for;
};

/// The frames from one to another and from one to another …
std::vector<FrameIndex> framesOf(const std::vector<std::pair<int, int>>& stretches) {
    std::vector<FrameIndex> frames;
    for (const auto& [first, last] : stretches)
        for (int frame = first; frame <= last; ++frame) frames.push_back(frame);
    return frames;
}

/// Says its scale itself, as a rendered scene does.
struct KnownSource : test::MemorySource {
    KnownSource() : MemorySource(sceneOf(20, {64, 48})), known(MemorySource::info()) { known.gsd_m_per_px = 0.2; }
    const VideoInfo& info() const override { return known; }
    VideoInfo known;
};

/// Frames that are looked at for a slope before a run.
int looks(FrameSource& source, const SceneScale& scale, bool oblique = true) {
    ChainOptions options;
    options.view.oblique = oblique;
    int frames = 0;
    slopeFor(source, {}, options, scale, {}, [&](const RunProgress&) { ++frames; });
    return frames;
}

}  // namespace

TEST(ScaleLooks, ForASlopeAreSparedWhereThereIsNoneOrNothingIsKnown) {
    test::MemorySource source = sceneOf(20, {64, 48});
    const SceneScale scale{0.2, 25, true};
    EXPECT_EQ(looks(source, scale), 20);
    EXPECT_EQ(looks(source, {0.2, 25, false}), 20) << "an estimate";
    EXPECT_EQ(looks(source, scale, false), 0) << "straight down, as it is said";
    EXPECT_EQ(looks(source, SceneScale()), 0) << "a scale that is only assumed";
    KnownSource rendered;
    EXPECT_EQ(looks(rendered, scale), 0) << "a rendered scene, seen from above";
}

TEST(ScaleLooks, EndWithTheRangeOrTheVideo) {
    const test::MemorySource source = sceneOf(20);
    EXPECT_EQ(lastOfLook(source, {0, -1}), 19);
    EXPECT_EQ(lastOfLook(source, {0, 0}), 0);
    EXPECT_EQ(lastOfLook(source, {3, 7}), 7);
    EXPECT_EQ(lastOfLook(source, {7, 7}), 7);
    EXPECT_EQ(lastOfLook(source, {19, 99}), 19);
    EXPECT_FALSE(lastOfLook(source, {20, 99}));
    EXPECT_FALSE(lastOfLook(source, {8, 7}));
    EXPECT_FALSE(lastOfLook(source, {-1, 7}));
}

TEST(ScaleLooks, BeginAtTheStartInTheMiddleAndSoThatTheyEndAtTheEnd) {
    using Starts = std::array<FrameIndex, 3>;
    EXPECT_EQ(startsOfLooks(0, 119, 40), (Starts{0, 40, 80}));
    EXPECT_EQ(startsOfLooks(10, 149, 40), (Starts{10, 60, 110}));
    EXPECT_EQ(startsOfLooks(0, 40, 40), (Starts{0, 0, 1}));
    EXPECT_EQ(startsOfLooks(5, 44, 40), (Starts{5, 5, 5}));
    EXPECT_EQ(startsOfLooks(5, 9, 40), (Starts{5, 5, 5})) << "a short one";
}

TEST(ScaleLooks, ForASlopeTakeTheStartTheMiddleAndTheEndOfAVideo) {
    EXPECT_EQ(looksForASlope(35), std::pair(std::size_t{34}, 35)) << "what was looked at is not looked at again";
    EXPECT_EQ(looksForASlope(68), std::pair(std::size_t{68}, 68)) << "the start and the end";
    EXPECT_EQ(looksForASlope(120), std::pair(std::size_t{102}, 102));
    EXPECT_EQ(looksForASlope(60, {10, 49}), std::pair(std::size_t{34}, 40));
}

TEST(ScaleLooks, ForAViewTakeFortyFramesOfTheStartTheMiddleAndTheEnd) {
    const auto looks = [](int frames, FrameRange range, const std::vector<std::pair<int, int>>& stretches,
                          int broken = 1000) {
        GreySource source(frames, broken);
        int told = 0, total = 0;
        EXPECT_FALSE(estimateView(source, range, {}, 25, {}, [&](const RunProgress& progress) {
            ++told;
            total = progress.frames_total;
        }));
        EXPECT_EQ(source.asked_for, framesOf(stretches)) << frames;
        EXPECT_EQ(told, static_cast<int>(source.asked_for.size()));
        EXPECT_EQ(total == told, broken >= frames) << frames;
    };
    looks(30, {}, {{0, 29}});
    looks(41, {}, {{0, 40}});
    looks(120, {}, {{0, 119}});
    looks(121, {}, {{0, 79}, {81, 120}});
    looks(122, {}, {{0, 39}, {41, 80}, {82, 121}});
    looks(140, {}, {{0, 39}, {50, 89}, {100, 139}});
    looks(160, {10, 149}, {{10, 49}, {60, 99}, {110, 149}});
    looks(140, {}, {{0, 39}, {50, 59}}, 60);
}

TEST(ScaleLooks, ForTheTrafficGoOnInTheMiddleAndAtTheEndWhereNothingDrivesAtFirst) {
    const auto looks = [](int frames, FrameRange range, const std::vector<std::pair<int, int>>& stretches) {
        GreySource source(frames);
        ChainOptions options;
        options.view.oblique = false;
        std::vector<RunProgress> told;
        const ChosenScale chosen =
            chooseScale(source, range, options, {}, {}, [&](const RunProgress& progress) { told.push_back(progress); });
        EXPECT_EQ(chosen.basis.origin, ScaleOrigin::assumed);
        EXPECT_EQ(source.asked_for, framesOf(stretches)) << frames;
        EXPECT_EQ(told.size(), kScaleAssumptions * source.asked_for.size());
        EXPECT_EQ(told.front().frames_total, kScaleAssumptions * (stretches[0].second - stretches[0].first + 1));
    };
    looks(30, {}, {{0, 29}});
    looks(79, {}, {{0, 39}});  // nothing is looked at twice
    looks(80, {}, {{0, 39}, {40, 79}});
    looks(140, {}, {{0, 39}, {50, 89}, {100, 139}});
    looks(160, {10, 149}, {{10, 49}, {60, 99}, {110, 149}});
}

TEST(ScaleLooks, TellHowFastTheyAre) {
    const auto begin = std::chrono::steady_clock::now();
    int told = 0;
    const ScaleProgress listener = [&](const RunProgress& progress) {
        const double passed = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
        EXPECT_TRUE(progress.estimating_scale);
        EXPECT_EQ(progress.frames_total, 10);
        EXPECT_EQ(progress.frames_done, ++told);
        EXPECT_NEAR(progress.frames_per_second * passed, told, 0.3);
        EXPECT_NEAR(progress.seconds_left * progress.frames_per_second, 10 - told, 1e-6);
    };
    LookProgress progress(listener, 10);
    for (int i = 0; i < 3; ++i) {
        std::this_thread::sleep_for(std::chrono::milliseconds(20));
        progress.step();
    }
    EXPECT_EQ(told, 3);
    LookProgress({}, 10).step();
}

TEST(ScaleLooks, CountWhatTheChainFindsAndTracksThatHaveSettled) {
    ChainOptions options = lookingOptions({});
    const SceneScale scale{0.2, 25, false};
    test::MemorySource source = sceneOf(60);
    const auto outcomeOf = [&](int count) {
        int told = 0;
        const auto outcome = outcomeUnder(
            count, [&](int i) { return source.read(i, false); }, options, scale, {}, [&] { ++told; });
        EXPECT_EQ(told, count);
        return outcome;
    };
    Chain chain(options, scale);
    double detections = 0, whole = 0, decision = 0;
    struct Seen {
        std::vector<double> lengths, widths, speeds;
        bool looked_whole = false;
    };
    std::map<TrackId, Seen> seen;
    for (int i = 0; i < 60; ++i) {
        const FrameResult result = chain.next(source.read(i, false));
        for (const Detection& detection : result.detections) {
            ++detections;
            whole += detection.complete;
            decision += detection.complete ? detection.score : 0;
        }
        for (const auto& track : result.tracks) {
            if (i < 14 || track.status != TrackStatus::confirmed) continue;
            seen[track.id].lengths.push_back(0.2 * track.box.length);
            seen[track.id].widths.push_back(0.2 * track.box.width);
            seen[track.id].speeds.push_back(0.2 * 25 * std::hypot(track.velocity.x, track.velocity.y));
            for (const Detection& detection : result.detections) {
                const cv::Point2d off = detection.box.centre - track.box.centre;
                if (detection.complete && std::hypot(off.x, off.y) < track.box.length / 2)
                    seen[track.id].looked_whole = true;
            }
        }
    }
    double tracks = 0, cars = 0;
    std::vector<double> speeds;
    for (const auto& [id, of_track] : seen) {
        if (of_track.lengths.size() < 8) continue;
        ++tracks;
        if (!isCarSized(medianOf(of_track.lengths), medianOf(of_track.widths))) continue;
        ++cars;
        if (of_track.looked_whole) speeds.push_back(medianOf(of_track.speeds));
    }
    const ScaleOutcome outcome = outcomeOf(60);
    EXPECT_GT(outcome.detections, 10);
    EXPECT_EQ(outcome.detections, detections);
    EXPECT_EQ(outcome.looks, whole);
    EXPECT_NEAR(outcome.decision, decision, 1e-9);
    EXPECT_EQ(outcome.tracks, tracks);
    EXPECT_EQ(outcome.cars, cars);
    ASSERT_EQ(outcome.car_speeds_m_s.size(), speeds.size());
    ASSERT_FALSE(speeds.empty());
    for (std::size_t i = 0; i < speeds.size(); ++i) EXPECT_NEAR(outcome.car_speeds_m_s[i], speeds[i], 1e-9);
    EXPECT_GT(speeds.front(), 2);
    EXPECT_GE(outcome.tracks, 1);
    EXPECT_GE(outcomeOf(16).tracks, 1) << "three frames from the seventh on";
    EXPECT_EQ(outcomeOf(7).tracks, 0);
    std::stop_source stopped;
    stopped.request_stop();
    const auto frame_of = [&](int i) { return source.read(i, false); };
    EXPECT_EQ(outcomeUnder(60, frame_of, options, scale, stopped.get_token(), [] {}).detections, 0);
}

TEST(ScaleLooks, SpeedsAreThoseOfWhatTheClassifierTookForVehicles) {
    ChainOptions options = lookingOptions({});
    options.detection.sliding_window.decision_threshold = 1000;  // it takes nothing for one
    test::MemorySource source = sceneOf(30);
    const ScaleOutcome outcome = outcomeUnder(
        30, [&](int i) { return source.read(i, false); }, options, {0.2, 25, false}, {}, [] {});
    EXPECT_EQ(outcome.looks, 0);
    EXPECT_GE(outcome.cars, 1) << "vectors tell where they are";
    EXPECT_TRUE(outcome.car_speeds_m_s.empty());
}

TEST(ScaleLooks, SearchAreasHaveTheSameSizeInMetresAtAnyScale) {
    ChainOptions options;
    options.detection.min_roi_length_px = options.detection.min_roi_width_px = 77;
    options.detection.method = DetectionMethod::gradient;
    options.detection.sliding_window.model = "own.eyriemodel";
    const ChainOptions looking = lookingOptions(options);
    EXPECT_EQ(looking.detection.min_roi_length_px, 0);
    EXPECT_EQ(looking.detection.min_roi_width_px, 0);
    EXPECT_EQ(looking.detection.method, DetectionOptions().method) << "whatever the run is to use";
    EXPECT_EQ(looking.detection.sliding_window.model, "own.eyriemodel");
}

}  // namespace eyrie::scale_looks_test
