#include "annotation/keyframes/keyframe_reduction.h"

#include <gtest/gtest.h>

#include <random>

#include "annotation/scenes.h"

namespace eyrie::keyframe_reduction_test {
namespace {

using test::seen;

const CameraMotion flying(test::stepsOf(test::flyingView, 400));

/// Dense boxes of something that moves over the ground.
std::vector<FrameBox> dense(const std::function<OrientedBox(double)>& on_ground, int first, int last) {
    std::vector<FrameBox> boxes;
    for (int frame = first; frame <= last; ++frame) {
        boxes.push_back({frame, seen(on_ground(frame), test::flyingView(frame))});
    }
    return boxes;
}

LabelledObject objectOf(std::vector<Keyframe> keyframes, const std::vector<FrameBox>& boxes) {
    return test::object(1, std::move(keyframes), boxes.back().frame);
}

TEST(KeyframeReduction, NeedsOneKeyframeForAParkedCarAndTwoForConstantSpeed) {
    const auto parked = dense([](double) { return OrientedBox{{90, 80}, 20, 9, 0.3}; }, 10, 300);
    EXPECT_EQ(reduceToKeyframes(parked, flying).size(), 1U);
    const auto driving = dense(
        [](double t) {
            return OrientedBox{{90 + 2 * t, 80 - t}, 20, 9, std::atan2(-1, 2)};
        },
        10, 300);
    const auto keyframes = reduceToKeyframes(driving, flying);
    ASSERT_EQ(keyframes.size(), 2U);
    EXPECT_FALSE(keyframes[0].heading_set);
    EXPECT_LT(reductionError(objectOf(keyframes, driving), driving, flying).corner_px, 1.5);
    EXPECT_GT(reduceToKeyframes(driving, CameraMotion()).size(), 6U) << "in the image the camera's motion must be told";
}

TEST(KeyframeReduction, WhatStandsAtTheEndNeedsNoLastKeyframe) {
    const auto stopping = dense(
        [](double t) {
            return OrientedBox{{90 + 2 * std::min(t, 100.0), 80}, 20, 9, 0};
        },
        0, 300);
    const auto keyframes = reduceToKeyframes(stopping, flying);
    EXPECT_LE(keyframes.size(), 3U);
    EXPECT_LT(keyframes.back().frame, 150);
}

TEST(KeyframeReduction, StaysWithinTheToleranceWhateverMoves) {
    std::mt19937 dice(2);
    std::normal_distribution<double> noise(0, 0.3);
    for (const double tolerance : {0.8, 1.5, 4.0}) {
        std::size_t fewest = 1000;
        for (const bool noisy : {true, false}) {
            auto boxes = dense(
                [](double t) {
                    const double angle = 0.02 * t + std::sin(t / 30);
                    return OrientedBox{
                        {100 * std::sin(t / 40) + t, 80 * std::cos(t / 55)}, 20 + 3 * std::sin(t / 60), 9, angle};
                },
                5, 350);
            if (noisy) {
                for (auto& box : boxes) box.box.centre += cv::Point2d(noise(dice), noise(dice));
            }
            ReductionOptions options;
            options.tolerance_px = tolerance;
            const auto keyframes = reduceToKeyframes(boxes, flying, options);
            const auto error = reductionError(objectOf(keyframes, boxes), boxes, flying);
            EXPECT_LE(error.corner_px, tolerance + 1e-9);
            EXPECT_LT(keyframes.size(), boxes.size());
            fewest = std::min(fewest, keyframes.size());
        }
        if (tolerance >= 1.5) {
            EXPECT_LT(fewest, 40U);
        }
    }
}

TEST(KeyframeReduction, KeyframesStandWhereTheyServeBest) {
    const CameraMotion standing = CameraMotion::standing(0, 400);
    const auto reducedTo = [&](const std::function<OrientedBox(double)>& at, int last, double tolerance_px) {
        std::vector<FrameBox> boxes;
        for (int frame = 0; frame <= last; ++frame) boxes.push_back({frame, at(frame)});
        ReductionOptions options;
        options.tolerance_px = tolerance_px;
        const LabelledObject object = objectOf(reduceToKeyframes(boxes, standing, options), boxes);
        return std::pair(object.keyframes.size(), reductionError(object, boxes, standing).corner_px);
    };
    // Where a speed changes at once, the keyframes about that frame tell all.
    const auto stops = [](double t) { return OrientedBox{{20 + 3 * std::min(t, 37.0), 80}, 20, 9, 0}; };
    EXPECT_EQ(reducedTo(stops, 100, 1.5).first, 3U);
    EXPECT_LT(reducedTo(stops, 100, 1.5).second, 0.1);
    const auto speedsUp = [](double t) { return OrientedBox{{20 + t + 3 * std::max(0.0, t - 37), 80}, 20, 9, 0}; };
    EXPECT_EQ(reducedTo(speedsUp, 100, 0.5).first, 5U);
    EXPECT_LT(reducedTo(speedsUp, 100, 0.5).second, 0.1);
    // Where it changes all the time, some three for a turn to either side.
    const auto winds = [](double t) {
        return OrientedBox{
            {20 + 3 * t, 80 + 20 * std::sin(t / 17)}, 20, 9, std::atan2(20 / 17.0 * std::cos(t / 17), 3)};
    };
    EXPECT_LE(reducedTo(winds, 200, 0.5).first, 11U);
    EXPECT_LE(reducedTo(winds, 200, 1.5).first, 7U);
    const auto turnsOnItself = [](double t) {
        return OrientedBox{{100 * std::sin(t / 40) + t, 80 * std::cos(t / 55)}, 20, 9, 0.02 * t};
    };
    EXPECT_LE(reducedTo(turnsOnItself, 300, 4).first, 14U);
}

TEST(KeyframeReduction, KeepsAnOverlapWhereThatIsAskedFor) {
    const auto boxes = dense(
        [](double t) {
            return OrientedBox{{3 * t, 50 * std::sin(t / 30)}, 20, 9, std::atan2(50 / 30.0 * std::cos(t / 30), 3)};
        },
        0, 200);
    ReductionOptions options;
    options.tolerance_px = 0;
    options.min_overlap = 0.7;
    const auto keyframes = reduceToKeyframes(boxes, flying, options);
    EXPECT_GE(reductionError(objectOf(keyframes, boxes), boxes, flying).min_overlap, 0.7);
    EXPECT_LE(keyframes.size(), 9U);
}

TEST(KeyframeReduction, GoesThroughGaps) {
    auto boxes = dense([](double t) { return OrientedBox{{2 * t, 80}, 20, 9, 0}; }, 0, 100);
    boxes.erase(boxes.begin() + 30, boxes.begin() + 60);
    EXPECT_EQ(reduceToKeyframes(boxes, flying).size(), 2U);
}

TEST(KeyframeReduction, SetsHeadingsThatThePathDoesNotHave) {
    // A car driven backwards.
    const auto boxes = dense([](double t) { return OrientedBox{{-2 * t, 80}, 20, 9, 0}; }, 0, 100);
    const auto keyframes = reduceToKeyframes(boxes, flying);
    EXPECT_LE(keyframes.size(), 3U);
    EXPECT_TRUE(keyframes[0].heading_set);
    EXPECT_LE(reductionError(objectOf(keyframes, boxes), boxes, flying).corner_px, 1.5);
}

TEST(KeyframeReduction, TakesNothingAndLittle) {
    EXPECT_TRUE(reduceToKeyframes({}, flying).empty());
    EXPECT_EQ(reduceToKeyframes({{7, {{1, 1}, 20, 9, 0}}}, flying).size(), 1U);
    EXPECT_EQ(reduceToKeyframes({{7, {{1, 1}, 0, 0, 0}}, {8, {{50, 1}, 0, 0, 0}}}, CameraMotion()).size(), 2U);
}

}  // namespace
}  // namespace eyrie::keyframe_reduction_test
