#include "tracking/finishing/flow_comparison.h"

#include <gtest/gtest.h>

#include "tracking/frame_summaries.h"

namespace eyrie::flow_comparison_test {
namespace {

constexpr double kGround = 2;      // px/frame along x
constexpr double kNoise = 0.05;    // px/frame that registration is taken to err by
constexpr double kNearly = 0.001;  // paths hold floats

GroundMotion movingGround(int frames) {
    GroundMotion ground;
    for (FrameIndex frame = 0; frame < frames; ++frame) ground.add(test::summaryOfFrame(frame, kGround));
    return ground;
}

/// A track that rests on the ground until `from`, then moves over it.
TrackPath pathOf(int frames, cv::Point2d own, int from = 0, StateOrigin origin = StateOrigin::detected) {
    TrackPath path;
    for (FrameIndex frame = 0; frame < frames; ++frame) {
        TrackState state;
        state.box = {cv::Point2d(100 + kGround * frame, 180) + own * double(std::max(0, frame - from)), 20, 10, 0};
        state.origin = origin;
        path.states.emplace_back(frame, PathState(state));
    }
    return path;
}

}  // namespace

TEST(FlowComparison, isOwnMotionOverThatOfTheGround) {
    const auto across = comparedWithFlow(pathOf(49, {0, 1}), movingGround(49));
    ASSERT_TRUE(across);
    EXPECT_NEAR(across->ratio, 1 / (kGround + kNoise), kNearly);
    EXPECT_NEAR(across->fastest, 1 / (kGround + kNoise), kNearly);
    EXPECT_NEAR(across->alignment, 0, kNearly);
    EXPECT_NEAR(across->flow, kGround, kNearly);
    EXPECT_NEAR(comparedWithFlow(pathOf(49, {3, 0}), movingGround(49))->alignment, 1, kNearly);
    const auto against = comparedWithFlow(pathOf(49, {-1.5, 0}), movingGround(49));
    EXPECT_NEAR(against->alignment, -1, kNearly);
    EXPECT_NEAR(against->ratio, 1.5 / (kGround + kNoise), kNearly);
}

TEST(FlowComparison, whatMovesAtLastIsFastestThere) {
    const auto late = comparedWithFlow(pathOf(111, {0, 3}, 80), movingGround(111));
    ASSERT_TRUE(late);
    EXPECT_NEAR(late->ratio, 0, kNearly);
    EXPECT_NEAR(late->fastest, 3 / (kGround + kNoise), kNearly);
}

TEST(FlowComparison, needsTwoFramesOfSomethingThatDoesNotStand) {
    EXPECT_FALSE(comparedWithFlow(pathOf(1, {0, 1}), movingGround(1)));
    EXPECT_TRUE(comparedWithFlow(pathOf(2, {0, 1}), movingGround(2)));
    EXPECT_FALSE(comparedWithFlow(pathOf(49, {0, 1}, 0, StateOrigin::standing), movingGround(49)));
    EXPECT_FALSE(comparedWithFlow(pathOf(49, {0, 1}), movingGround(1))) << "the ground's motion is unknown";
}

}  // namespace eyrie::flow_comparison_test
