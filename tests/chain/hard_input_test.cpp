#include <gtest/gtest.h>

#include "chain/chain_run.h"
#include "support/moving_scene.h"

/// Frames no chain likes. Each must go through without a crash, be marked for what it is, and leave the chain able to
/// recover by itself.
namespace eyrie::hard_input_test {
namespace {

struct Collector : ChainObserver {
    std::vector<std::shared_ptr<const FrameResult>> results;
    void onFrame(const std::shared_ptr<const FrameResult>& result, const Frame&) override { results.push_back(result); }
    RegistrationState stateAt(int frame) const { return results.at(std::size_t(frame))->motion.registration.state; }
    int confirmedAt(int frame) const {
        int count = 0;
        for (const auto& track : results.at(std::size_t(frame))->tracks)
            count += track.status != TrackStatus::tentative;
        return count;
    }
};

SceneScale scale() {
    SceneScale s;
    s.gsd_m_per_px = 0.2;
    s.gsd_known = true;
    return s;
}

Collector runOver(int frames, cv::Size size, const test::MemorySource::Draw& draw) {
    test::MemorySource source(frames, size, draw);
    Collector collector;
    const RunSummary summary = ChainRun(ChainOptions{}, scale()).run(source, {}, collector, {});
    EXPECT_EQ(summary.outcome, RunOutcome::finished) << summary.message;
    return collector;
}

}  // namespace

TEST(HardInput, oneFrame) {
    const test::MovingScene scene;
    const Collector result = runOver(1, scene.size, [&](int i) { return scene.draw(i); });
    EXPECT_EQ(result.stateAt(0), RegistrationState::first);
    EXPECT_TRUE(result.results[0]->tracks.empty());
}

TEST(HardInput, tinyAndHugeFrames) {
    runOver(8, {16, 16}, [](int i) {
        cv::Mat image(16, 16, CV_8U);
        cv::RNG(std::uint64_t(i) + 1).fill(image, cv::RNG::UNIFORM, 0, 255);
        return image;
    });
    test::MovingScene scene;
    scene.size = {7680, 4320};
    scene.frames = 2;
    const Collector result = runOver(2, scene.size, [&](int i) { return scene.draw(i); });
    EXPECT_EQ(result.stateAt(1), RegistrationState::registered);
}

TEST(HardInput, everyPictureTwiceIsFollowedAndSaysWhatItsSpeedsAre) {
    const test::MovingScene scene;
    test::MemorySource source(2 * scene.frames, scene.size, [&](int i) { return scene.draw(i / 2); });
    Collector result;
    const RunSummary summary = ChainRun(ChainOptions{}, scale()).run(source, {}, result, {});
    EXPECT_EQ(summary.message,
              "40 of 80 pictures repeat the one before, so that speeds are told 2 times as high as they are; for true "
              "ones make the video anew without repeats, with 12.5 pictures a second");
    EXPECT_EQ(result.confirmedAt(2 * scene.frames - 2), 2);
    test::MemorySource stalled(2 * scene.frames, scene.size,
                               [&](int i) { return scene.draw(std::max(0, i - scene.frames)); });
    EXPECT_EQ(ChainRun(ChainOptions{}, scale()).run(stalled, {}, result, {}).message, "")
        << "one picture for half the time is no rate";
    const RunSummary usual = [&] {
        test::MemorySource once(scene);
        return ChainRun(ChainOptions{}, scale()).run(once, {}, result, {});
    }();
    EXPECT_EQ(usual.message, "");
}

TEST(HardInput, blackFramesCoastAndRecover) {
    test::MovingScene scene;
    scene.frames = 60;
    const Collector result = runOver(scene.frames, scene.size, [&](int i) {
        return i >= 25 && i < 28 ? cv::Mat(scene.size, CV_8U, cv::Scalar(0)) : scene.draw(i);
    });
    EXPECT_EQ(result.stateAt(25), RegistrationState::failed);
    EXPECT_NE(result.stateAt(26), RegistrationState::registered) << "black after black shows nothing of the ground";
    EXPECT_EQ(result.stateAt(35), RegistrationState::registered);
    EXPECT_GE(result.confirmedAt(24), 2);
    EXPECT_GE(result.confirmedAt(26), 1) << "tracks coast through";
    EXPECT_GE(result.confirmedAt(55), 2);
}

TEST(HardInput, aFrozenPictureMovesNothing) {
    test::MovingScene scene;
    scene.frames = 50;
    const Collector result = runOver(scene.frames, scene.size, [&](int i) {
        return scene.draw(i < 25 ? i : i < 30 ? 24 : i - 5);
    });
    for (int frame = 25; frame < 29; ++frame) EXPECT_EQ(result.stateAt(frame), RegistrationState::frozen) << frame;
    EXPECT_EQ(result.stateAt(31), RegistrationState::registered);
    EXPECT_GE(result.confirmedAt(33), 2);
}

TEST(HardInput, droppedFramesRegister) {
    test::MovingScene scene;
    scene.frames = 60;
    const Collector result = runOver(50, scene.size, [&](int i) { return scene.draw(i < 25 ? i : i + 6); });
    EXPECT_EQ(result.stateAt(25), RegistrationState::registered);
    EXPECT_GE(result.confirmedAt(45), 2);
}

TEST(HardInput, aCutStartsAnew) {
    const test::MovingScene scene;
    test::MovingScene other;
    other.size = scene.size;
    const Collector result = runOver(60, scene.size, [&](int i) {
        if (i < 30) return scene.draw(i);
        cv::Mat image = other.draw(i - 30);
        cv::flip(image, image, -1);
        cv::rotate(image, image, cv::ROTATE_180);
        cv::transpose(image, image);
        cv::resize(image, image, scene.size);
        return image;
    });
    EXPECT_EQ(result.stateAt(30), RegistrationState::failed);
    EXPECT_EQ(result.stateAt(32), RegistrationState::registered);
    EXPECT_GE(result.confirmedAt(58), 2);
}

TEST(HardInput, framesThatChangeSizeAreRefusedByName) {
    test::MemorySource source(4, {64, 64}, [](int i) {
        cv::Mat image(i < 2 ? cv::Size(64, 64) : cv::Size(48, 64), CV_8U);
        cv::RNG(7).fill(image, cv::RNG::UNIFORM, 0, 255);
        return image;
    });
    Collector collector;
    const RunSummary summary = ChainRun(ChainOptions{}, scale()).run(source, {}, collector, {});
    EXPECT_EQ(summary.outcome, RunOutcome::failed);
    EXPECT_NE(summary.message.find("48"), std::string::npos) << summary.message;
    EXPECT_EQ(collector.results.size(), 2U);
}

}  // namespace eyrie::hard_input_test
