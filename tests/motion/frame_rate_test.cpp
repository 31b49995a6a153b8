#include <gtest/gtest.h>

#include "motion/moving_corners.h"
#include "motion/vectors/independent_motion.h"

namespace eyrie::frame_rate_test {
namespace {

/// Pictures of a vehicle until it has vectors.
int picturesUntilSeen(const IndependentMotionOptions& options, double frame_rate_hz) {
    test::MovingCorners scene({{{300, 200}, {2, 0}}}, 0);
    IndependentMotion motion(options, {0.3, frame_rate_hz, true});
    for (int pictures = 1; pictures < 20; ++pictures) {
        const RegisteredFrame registered = scene.next();
        if (!motion.next(registered, test::flatFrame(registered.frame)).motion_vectors.empty()) return pictures;
    }
    return 0;
}

IndependentMotionOptions withoutShadows(IndependentMotionOptions options = {}) {
    options.shadow.shadow_test = false;  // flat frames are nothing but shadow or nothing but ground
    return options;
}

}  // namespace

TEST(FrameRate, FewPicturesASecondNeedFewerOfThem) {
    EXPECT_EQ(picturesUntilSeen(withoutShadows(), 60), 6);
    EXPECT_EQ(picturesUntilSeen(withoutShadows(), 25), 6) << "a corner is as old as the pictures before this one";
    EXPECT_EQ(picturesUntilSeen(withoutShadows(), 10), 6);
    EXPECT_EQ(picturesUntilSeen(withoutShadows(), 6), 4);
    EXPECT_EQ(picturesUntilSeen(withoutShadows(), 2), 3);
}

TEST(FrameRate, TheThesisCountsFramesWhateverTheRate) {
    EXPECT_EQ(picturesUntilSeen(withoutShadows(IndependentMotionOptions::thesis()), 5), 6);
    IndependentMotionOptions asked;
    asked.follow_rate = false;
    EXPECT_EQ(picturesUntilSeen(withoutShadows(asked), 5), 6);
}

TEST(FrameRate, TheBaselineIsAsLongAsAtTheUsualRateAndNeverLongerThanAskedFor) {
    IndependentMotionOptions options;
    EXPECT_EQ(options.atRate(25).baseline, 16);
    EXPECT_EQ(options.atRate(10).baseline, 16);
    EXPECT_EQ(options.atRate(5).baseline, 8);
    EXPECT_EQ(options.atRate(2).baseline, 3);
    options.baseline = 2;
    options.min_age = 1;
    EXPECT_EQ(options.atRate(2).baseline, 2);
    EXPECT_EQ(options.atRate(2).min_age, 1);
}

}  // namespace eyrie::frame_rate_test
