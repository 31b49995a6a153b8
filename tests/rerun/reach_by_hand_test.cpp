#include <gtest/gtest.h>

#include <algorithm>

#include "rerun/method_variants.h"
#include "rerun/motion_window.h"
#include "rerun/replay.h"

/// How far back parts of a run begin, and what they read: each limit from both sides.
namespace eyrie::reach_by_hand_test {
namespace {

int framesBeforeWith(MotionMethod method, int stack_capacity = 0) {
    ChainOptions options;
    options.difference.method = method;
    options.difference.gap = 4;
    options.difference.background_frames = 9;
    options.difference.background_step = 3;
    options.stacking.enabled = stack_capacity > 0;
    if (stack_capacity > 0) options.stacking.capacity = stack_capacity;
    return framesBefore(options);
}

TEST(ReplayReach, IsThatOfTheMethodAndEightToSpare) {
    EXPECT_EQ(framesBeforeWith(MotionMethod::vectors), 0);
    EXPECT_EQ(framesBeforeWith(MotionMethod::two_frame_difference), 4 + 8);
    EXPECT_EQ(framesBeforeWith(MotionMethod::difference_ghosts), 4 + 8);
    EXPECT_EQ(framesBeforeWith(MotionMethod::three_frame_difference), 8 + 8);
    EXPECT_EQ(framesBeforeWith(MotionMethod::median_background), 27 + 8);
}

TEST(ReplayReach, AStackIsFilledTwice) {
    EXPECT_EQ(framesBeforeWith(MotionMethod::vectors, 7), 14);
    EXPECT_EQ(framesBeforeWith(MotionMethod::two_frame_difference, 5), 12) << "the longer of both";
    EXPECT_EQ(framesBeforeWith(MotionMethod::two_frame_difference, 7), 14);
}

TEST(ReplayReach, NobodyWaitsForMoreThanTwoHundredFrames) {
    EXPECT_EQ(framesBeforeWith(MotionMethod::vectors, 99), 198);
    EXPECT_EQ(framesBeforeWith(MotionMethod::vectors, 101), 200);
}

IndependentMotionOptions plain() {
    IndependentMotionOptions options;
    options.baseline = 5;
    options.min_age = 3;
    options.find_slow = false;
    options.silhouettes.silhouettes = false;
    options.areas.areas = false;
    return options;
}

TEST(MotionWindowReach, IsTheLongestOfWhatMotionNeeds) {
    const SceneScale scale{0.2, 25, true};
    IndependentMotionOptions options = plain();
    EXPECT_EQ(MotionWindow::reachFor(options, scale), 5 + 12) << "and the corners settle";
    options.min_age = 9;
    EXPECT_EQ(MotionWindow::reachFor(options, scale), 9 + 12);
    options.slow_baseline = 30;
    EXPECT_EQ(MotionWindow::reachFor(options, scale), 9 + 12) << "not asked for";
    options.find_slow = true;
    EXPECT_EQ(MotionWindow::reachFor(options, scale), 30 + 12);
    options.silhouettes.silhouette_frames = 60;
    EXPECT_EQ(MotionWindow::reachFor(options, scale), 30 + 12);
    options.silhouettes.silhouettes = true;
    EXPECT_EQ(MotionWindow::reachFor(options, scale), 60);
    options = plain();
    options.baseline = options.min_age = 1;
    options.areas.areas = true;
    const int gap = options.areas.gapFrames(scale);
    EXPECT_EQ(MotionWindow::reachFor(options, scale), std::max(1 + 12, 2 * gap));
}

/// A window over empty pictures, and how many of them it has read.
struct Reading {
    MotionWindow window{RegistrationOptions{}, SceneScale{0.2, 25, true}};
    int frames = 0;

    int cover(FrameIndex first, FrameIndex last) {
        frames = 0;
        const auto pixels = [this](FrameIndex index) {
            ++frames;
            Frame frame;
            frame.index = index;
            frame.time_us = std::int64_t{index} * 40'000;
            frame.gray = cv::Mat(48, 64, CV_8UC1, cv::Scalar(90));
            return frame;
        };
        EXPECT_TRUE(window.cover(first, last, pixels, {}));
        return frames;
    }
};

TEST(MotionWindowReading, GoesOnFromWhereItIsAndReadsNothingTwice) {
    Reading reading;
    EXPECT_EQ(reading.cover(0, 5), 6);
    EXPECT_EQ(reading.cover(0, 5), 0) << "it is there";
    EXPECT_EQ(reading.cover(2, 8), 3);
    EXPECT_EQ(reading.cover(3, 8), 0) << "a part of what is there";
    EXPECT_EQ(reading.cover(1, 8), 8) << "what lay before was let go";
    EXPECT_EQ(reading.cover(1, 7), 7) << "the corners are those of the last frame";
}

TEST(MotionWindowReading, StartsAnewWhereTheWayIsLong) {
    Reading reading;
    EXPECT_EQ(reading.cover(0, 0), 1);
    EXPECT_EQ(reading.cover(0, 30), 30);
    EXPECT_EQ(reading.cover(30, 61), 32) << "31 frames on are farther than from 30 anew";
}

TEST(MotionWindowReading, TellsTheMotionOfTheLastFrames) {
    Reading reading;
    reading.cover(0, 9);
    const auto motions = reading.window.motions(plain(), 3);
    ASSERT_EQ(motions.size(), 3U);
    EXPECT_EQ(motions.front().frame, 7);
    EXPECT_EQ(motions.back().frame, 9);
    EXPECT_EQ(reading.window.motions(plain(), 10).size(), 10U);
}

TEST(VariantsByHand, ChangeWhatTheirWordSays) {
    ChainOptions base;
    base.detection.gradient.quantile = 0.9;
    base.outliers.min_vectors = 3;
    base.outliers.min_density_share = 0.5;
    EXPECT_EQ(methodVariant("gradient_simple", base).options.detection.gradient.quantile, 1) << "there is no more";
    const ChainOptions difference = methodVariant("two_frame_difference", base).options;
    EXPECT_EQ(difference.difference.method, MotionMethod::two_frame_difference);
    EXPECT_EQ(difference.detection.method, DetectionMethod::clusters);
    EXPECT_EQ(difference.outliers.min_vectors, 0);
    EXPECT_EQ(difference.outliers.min_density_share, 0);
    const ChainOptions window = methodVariant("sliding_window_length_3", base).options;
    EXPECT_EQ(window.detection.method, DetectionMethod::sliding_window);
    EXPECT_EQ(window.detection.sliding_window.rescaling, WindowRescaling::length_3);
    EXPECT_EQ(window.outliers.min_vectors, 3) << "all else is the base's";
    const MethodVariant peer = methodVariant("three_frame_difference_sort", base);
    EXPECT_TRUE(peer.options.finishing.trim_predicted);
    EXPECT_EQ(peer.options.finishing.stop_speed_m_s, 0);
    EXPECT_FALSE(peer.global_window);
    const MethodVariant without = withStacking(methodVariant("mser", base), false);
    EXPECT_EQ(without.name, "mser");
    EXPECT_FALSE(without.options.stacking.enabled);
    EXPECT_TRUE(withStacking(methodVariant("mser", base), true).options.stacking.enabled);
}

}  // namespace
}  // namespace eyrie::reach_by_hand_test
