#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <numeric>
#include <vector>

#include "chain/chain.h"
#include "support/moving_scene.h"

/// What the time of a frame is booked as.
namespace eyrie::stage_times_test {
namespace {

struct TimedFrame {
    StageTimes stages{};
    double whole_ms = 0;
};

/// The chain of the thesis, whose stacks replace search areas from so many layers on.
std::vector<TimedFrame> timed(int min_height) {
    test::MovingScene scene;
    scene.frames = 50;
    scene.camera_per_frame = {0.4, 0.2};
    scene.vehicles = {{{40, 60}, {2, 0}, {24, 11}}, {{250, 130}, {-2, 0}, {40, 12}}, {{60, 190}, {2, 0}, {24, 11}}};
    test::MemorySource source(scene.frames, scene.size, [&](int frame) { return scene.draw(frame); });
    ChainOptions options = builtInPreset("thesis");
    options.stacking.min_height = min_height;
    Chain chain(options, {0.2, 25, true});
    std::vector<TimedFrame> frames;
    for (int i = 0; i < scene.frames; ++i) {
        const Frame frame = source.read(i, false);
        const auto start = std::chrono::steady_clock::now();
        const StageTimes stages = chain.next(frame).stage_ms;
        frames.push_back(
            {stages, std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count()});
    }
    return frames;
}

/// The least of the last ten frames, which nothing else on the machine lengthened.
double leastStacking_ms(const std::vector<TimedFrame>& frames) {
    const auto ms = [](const TimedFrame& frame) { return frame.stages[static_cast<std::size_t>(Stage::stacking)]; };
    return static_cast<double>(ms(*std::min_element(frames.end() - 10, frames.end(),
                                                    [&](const auto& a, const auto& b) { return ms(a) < ms(b); })));
}

}  // namespace

TEST(StageTimes, AddUpToNoMoreThanTheFrameTook) {
    for (const TimedFrame& frame : timed(5)) {
        const float sum = std::accumulate(frame.stages.begin(), frame.stages.end(), 0.F);
        EXPECT_LE(static_cast<double>(sum), frame.whole_ms * 1.001);
        EXPECT_GT(sum, 0.F);
    }
}

TEST(StageTimes, MergingTheLayersOfAStackIsStacking) {
    // A circular stack merges its layers where it is searched. It costs many times what keeping them does.
    EXPECT_GT(leastStacking_ms(timed(5)), 1.5 * leastStacking_ms(timed(500)));
}

}  // namespace eyrie::stage_times_test
