#include "imaging/following/box_follower.h"

#include <gtest/gtest.h>

#include <functional>

#include "annotation/scenes.h"

/// How vehicles may move from picture to picture, on ground at rest.
namespace eyrie::box_follower_test {
namespace {

/// A car 24 × 14 px whose middle is at `x`.
cv::Mat pictureOf(double x) {
    static const cv::Mat ground = test::groundTexture({320, 80}, 3, 4, 90, 160);
    static const cv::Mat car = test::groundTexture({24, 14}, 8, 1.5, 20, 235);
    cv::Mat picture = ground.clone();
    cv::warpAffine(car, picture, cv::Matx23d(1, 0, x - 11.5, 0, 1, 33.5), picture.size(), cv::INTER_LINEAR,
                   cv::BORDER_TRANSPARENT);
    return picture;
}

/// What became of it after so many pictures.
struct Outcome {
    std::optional<FollowEnd> end;
    int steps = 0;   ///< that were sure
    double off = 0;  ///< px, at most
};

Outcome follow(const std::function<double(int)>& place, int frames) {
    BoxFollower follower({{place(0), 40}, 24, 14, 0}, pictureOf(place(0)));
    follower.startsWith({place(1) - place(0), 0});
    Outcome outcome;
    for (int frame = 1; frame < frames; ++frame) {
        const BoxFollower::Step step = follower.advance(pictureOf(place(frame - 1)), pictureOf(place(frame)), {});
        outcome.end = step.end;
        if (step.end) return outcome;
        ++outcome.steps;
        outcome.off = std::max(outcome.off, std::abs(step.box.centre.x - place(frame)));
    }
    return outcome;
}

}  // namespace

TEST(BoxFollower, FollowsEvenAndUnevenSteps) {
    const Outcome even = follow([](int frame) { return 40 + 4 * frame; }, 30);
    EXPECT_FALSE(even.end);
    EXPECT_LT(even.off, 0.7);
    const Outcome fast = follow([](int frame) { return 40 + 12 * frame; }, 20);
    EXPECT_FALSE(fast.end) << "corners are sought where it drives to";
    EXPECT_LT(fast.off, 0.7);
    // As where pictures were taken at uneven times.
    const Outcome uneven = follow([](int frame) { return 40 + 4 * frame + frame % 2; }, 30);
    EXPECT_FALSE(uneven.end);
    EXPECT_LT(uneven.off, 0.7);
}

TEST(BoxFollower, FollowsWhatBrakes) {
    const Outcome brakes =
        follow([](int frame) { return 40 + 3 * frame - 0.05 * std::pow(std::clamp(frame - 10, 0, 30), 2); }, 40);
    EXPECT_FALSE(brakes.end);
    EXPECT_LT(brakes.off, 0.7);
}

TEST(BoxFollower, AVehicleNeitherStopsNorSetsOffAtOnce) {
    const Outcome stops = follow([](int frame) { return 60 + 3 * std::min(frame, 12); }, 30);
    ASSERT_TRUE(stops.end);
    EXPECT_EQ(*stops.end, FollowEnd::jump);
    EXPECT_GE(stops.steps, 12);
    EXPECT_LE(stops.steps, 14);
    const Outcome sets_off = follow([](int frame) { return 60 + 3.5 * std::max(0, frame - 12); }, 30);
    ASSERT_TRUE(sets_off.end);
    EXPECT_EQ(*sets_off.end, FollowEnd::jump);
    EXPECT_EQ(sets_off.steps, 12);
}

}  // namespace eyrie::box_follower_test
