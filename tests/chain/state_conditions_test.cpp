#include <gtest/gtest.h>

#include <functional>

#include "chain/recording/chain_state.h"
#include "chain/recording/run_recorder.h"
#include "support/moving_scene.h"

/// What has to be the same for the kept state of a run to be gone on with.
namespace eyrie::state_conditions_test {
namespace {

SceneScale scaleOfRun() {
    return {0.2, 25, true, {0.001, 0.002, 159.5, 119.5}};
}

std::string bytesOf(const ChainOptions& options, const SceneScale& scale) {
    ChainProgress progress(options, scale);
    return packedState({3, progress.classifier, stateBytes(progress.motion_half), stateBytes(progress.waiting),
                        stateBytes(progress.track_half)},
                       options, scale);
}

test::MemorySource noPictures() {
    return {4, {320, 240}, [](int) -> cv::Mat { throw Error(ErrorKind::internal, "no picture is needed"); }};
}

}  // namespace

TEST(StateConditions, EveryPartOfTheScaleCounts) {
    test::MemorySource source = noPictures();
    const ChainOptions options;
    const std::string bytes = bytesOf(options, scaleOfRun());
    const auto progress = unpackedState(bytes, options, scaleOfRun(), source);
    ASSERT_TRUE(progress);
    EXPECT_EQ(progress->last_done, 3);
    EXPECT_TRUE(progress->waiting.empty());
    const std::vector<std::function<void(SceneScale&)>> changes{[](SceneScale& scale) { scale.gsd_m_per_px = 0.21; },
                                                                [](SceneScale& scale) { scale.frame_rate_hz = 30; },
                                                                [](SceneScale& scale) { scale.gsd_known = false; },
                                                                [](SceneScale& scale) { scale.slope = {}; },
                                                                [](SceneScale& scale) { scale.slope.right_per_px = 0.002; },
                                                                [](SceneScale& scale) { scale.slope.down_per_px = 0; },
                                                                [](SceneScale& scale) { scale.slope.centre_x = 119.5; },
                                                                [](SceneScale& scale) { scale.slope.centre_y = 0; }};
    for (std::size_t i = 0; i < changes.size(); ++i) {
        SceneScale other = scaleOfRun();
        changes[i](other);
        EXPECT_FALSE(unpackedState(bytes, options, other, source)) << i;
    }
}

TEST(StateConditions, EveryParameterCounts) {
    test::MemorySource source = noPictures();
    ChainOptions options;
    options.detection.method = DetectionMethod::gradient;
    const std::string bytes = bytesOf(options, scaleOfRun());
    ChainOptions other = options;
    other.finishing.follow_ends_s += 1;
    EXPECT_FALSE(unpackedState(bytes, other, scaleOfRun(), source)) << "the last stage's, too";
    other = options;
    other.registration.corners.corner_spacing_m += 1;
    EXPECT_FALSE(unpackedState(bytes, other, scaleOfRun(), source));
    EXPECT_TRUE(unpackedState(bytes, options, scaleOfRun(), source));
}

TEST(StateConditions, WhatIsTooShortForAStateIsNone) {
    test::MemorySource source = noPictures();
    const std::string bytes = bytesOf({}, scaleOfRun());
    for (std::size_t size = 0; size < 24; ++size) {
        EXPECT_FALSE(unpackedState(bytes.substr(0, size), {}, scaleOfRun(), source)) << size;
        EXPECT_FALSE(unpackedState(bytes.substr(0, bytes.size() - size - 1), {}, scaleOfRun(), source)) << size;
    }
    EXPECT_FALSE(unpackedState(bytes + "x", {}, scaleOfRun(), source));
}

TEST(StateConditions, WithoutAClassifierThereIsNoChecksumOfOne) {
    DetectionOptions options;
    EXPECT_NE(classifierChecksum(options), 0U);
    options.method = DetectionMethod::gradient;
    EXPECT_EQ(classifierChecksum(options), 0U);
}

}  // namespace eyrie::state_conditions_test
