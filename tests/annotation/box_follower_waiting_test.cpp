#include <gtest/gtest.h>

#include <opencv2/imgproc.hpp>

#include "annotation/scenes.h"
#include "imaging/following/box_follower.h"

/// What waits, what hides it, and whom its box believes.
namespace eyrie::box_follower_waiting_test {
namespace {

const cv::Size kPicture(240, 180);
const OrientedBox kStart{{120, 90}, 40, 24, 0};

FollowOptions strict() {
    FollowOptions options;
    options.min_certainty = 0.9;
    options.max_speed_change_px = 1000;
    return options;
}

cv::Mat groundOf(int seed) {
    return test::groundTexture(kPicture, seed, 1.5, 20, 235);
}

/// The ground, seen where the camera has moved so far.
cv::Mat groundAt(cv::Point2d shift) {
    cv::Mat result;
    cv::warpAffine(groundOf(5), result, cv::Matx23d(1, 0, shift.x, 0, 1, shift.y), kPicture, cv::INTER_CUBIC,
                   cv::BORDER_REFLECT);
    return result;
}

/// Something else lies in front of a part.
cv::Mat covered(cv::Mat picture, const cv::Rect& part) {
    groundOf(9)(part).copyTo(picture(part));
    return picture;
}

cv::Mat hiddenAt(cv::Point2d shift) {
    return covered(groundAt(shift), {60, 40, 120, 100});
}

Homography pan(cv::Point2d by) {
    Homography map;
    map.matrix(0, 2) = by.x;
    map.matrix(1, 2) = by.y;
    return map;
}

double between(cv::Point2d a, cv::Point2d b) {
    return std::hypot(a.x - b.x, a.y - b.y);
}

/// After one step as it moved before, it is hidden: whether it is waited for.
bool waits(cv::Point2d speed, const FollowOptions& options) {
    BoxFollower follower(kStart, groundAt({0, 0}), options);
    follower.startsWith(speed);
    EXPECT_FALSE(follower.advance(groundAt({0, 0}), groundAt(speed), {}).end) << speed;
    const BoxFollower::Step step = follower.advance(groundAt(speed), hiddenAt(speed), {});
    EXPECT_TRUE(step.end) << speed;
    if (step.hidden) {
        EXPECT_LT(between(step.box.centre, kStart.centre + speed), 0.15) << speed;
    }
    return step.hidden;
}

}  // namespace

TEST(BoxFollowerWaiting, WaitsForWhatMovesByLessThanTwoFifthsOfAPixel) {
    EXPECT_TRUE(waits({0, 0}, strict()));
    EXPECT_TRUE(waits({0.33, 0}, strict()));
    EXPECT_TRUE(waits({0, -0.33}, strict()));
    EXPECT_FALSE(waits({0.5, 0}, strict()));
    EXPECT_FALSE(waits({0, -0.5}, strict()));
    FollowOptions patient = strict();
    patient.max_standing_px = 0.6;
    EXPECT_TRUE(waits({0.5, 0}, patient));
}

TEST(BoxFollowerWaiting, WaitsWithinAQuarterOfItsLengthOfWhereItWasDrawn) {
    FollowOptions patient = strict();
    patient.max_standing_px = 100;
    EXPECT_TRUE(waits({9.7, 0}, patient));
    EXPECT_FALSE(waits({10.3, 0}, patient));
    EXPECT_TRUE(waits({0, -9.7}, patient));
    EXPECT_FALSE(waits({0, -10.3}, patient));
}

TEST(BoxFollowerWaiting, HasWaitedAfterSixSteps) {
    for (const int steps : {5, 6}) {
        BoxFollower follower(kStart, groundAt({0, 0}), strict());
        for (int i = 0; i < steps; ++i) follower.advance(groundAt({0, 0}), groundAt({0, 0}), {});
        const BoxFollower::Step step = follower.advance(groundAt({0, 0}), hiddenAt({0, 0}), {});
        EXPECT_TRUE(step.end);
        EXPECT_EQ(step.hidden, steps == 6) << steps;
    }
}

TEST(BoxFollowerWaiting, IsHiddenWhereLessThanHalfOfItIsSeen) {
    int hidden = 0, seen_in_part = 0;
    for (const double least : {0.5, 0.3}) {
        for (int across = 4; across <= 40; across += 4) {
            FollowOptions options = strict();
            options.min_certainty = 0.99;
            options.min_seen = least;
            BoxFollower follower(kStart, groundAt({0, 0}), options);
            follower.startsWith({0, 0});
            ASSERT_FALSE(follower.advance(groundAt({0, 0}), groundAt({0, 0}), {}).end);
            // Under a camera that pans.
            const cv::Mat next = covered(groundAt({3, -2}), {100 + 3, 60, across, 60});
            OrientedBox there = kStart;
            there.centre += cv::Point2d(3, -2);
            const cv::Size samples = BoxPatch::samplesFor(kStart);
            const double seen = BoxPatch(next, there, samples).seenOf({groundAt({0, 0}), kStart, samples});
            const BoxFollower::Step step = follower.advance(groundAt({0, 0}), next, pan({3, -2}));
            EXPECT_EQ(step.hidden, seen < least) << across;
            EXPECT_EQ(step.end.has_value(), step.hidden) << across;
            EXPECT_LT(between(step.box.centre, there.centre), 0.15) << across;
            if (!step.hidden) {
                EXPECT_NEAR(step.certainty, seen, 1e-6) << across;
            }
            (step.hidden ? hidden : seen_in_part)++;
        }
    }
    EXPECT_GE(hidden, 5);
    EXPECT_GE(seen_in_part, 5);
}

TEST(BoxFollowerWaiting, IsWaitedForWhereItLastLookedLikeItself) {
    FollowOptions options = strict();
    options.min_certainty = 0.3;
    BoxFollower follower(kStart, groundAt({0, 0}), options);
    follower.startsWith({0.3, 0});
    follower.advance(groundAt({0, 0}), groundAt({0.3, 0}), {});
    cv::Mat dim;
    cv::addWeighted(groundAt({2.3, 0}), 0.45, groundOf(9), 0.55, 0, dim);
    const BoxFollower::Step unsure = follower.advance(groundAt({0.3, 0}), dim, {});
    ASSERT_FALSE(unsure.end);
    EXPECT_GT(unsure.box.centre.x, 121) << "it is believed";
    const BoxFollower::Step step = follower.advance(dim, hiddenAt({0, 0}), pan({4, 1}));
    EXPECT_TRUE(step.hidden);
    EXPECT_LT(between(step.box.centre, {124.3, 91}), 0.15) << "but for the time being only";
}

TEST(BoxFollowerWaiting, TheLookDecidesBetweenCornersAndPrediction) {
    // Three marks, whose corners are the clearest, move within what stands.
    const OrientedBox box{{120, 90}, 90, 60, 0};
    const auto picture = [](cv::Point by, double contrast) {
        cv::Mat made = test::groundTexture(kPicture, 5, 0.9, 128 - contrast, 128 + contrast);
        for (const cv::Point place : {cv::Point(94, 74), {140, 80}, {112, 100}}) {
            cv::Mat mark = made(cv::Rect(place + by, cv::Size(8, 8)));
            mark.setTo(0);
            mark(cv::Rect(0, 0, 4, 4)).setTo(255);
            mark(cv::Rect(4, 4, 4, 4)).setTo(255);
        }
        return made;
    };
    FollowOptions options = strict();
    options.max_corners = 3;
    const cv::Size samples = BoxPatch::samplesFor(box);
    int stayed = 0, went = 0, a_little_better = 0;
    for (int contrast = 68; contrast <= 79; ++contrast) {
        const cv::Mat current = picture({0, 0}, contrast), next = picture({4, 3}, contrast);
        const BoxPatch look(current, box, samples);
        // Before the speed is known corners are believed.
        const OrientedBox by_corners = BoxFollower(box, current, options).advance(current, next, {}).box;
        EXPECT_LT(between(by_corners.centre, {124, 93}), 1.5) << contrast;
        BoxFollower follower(box, current, options);
        follower.startsWith({0, 0});
        const cv::Point2d centre = follower.advance(current, next, {}).box.centre;
        double standing = 0;
        for (int right = -2; right <= 2; ++right) {
            for (int down = -2; down <= 2; ++down) {
                OrientedBox there = box;
                there.centre += cv::Point2d(0.25 * right, 0.25 * down);
                standing = std::max(standing, BoxPatch(next, there, samples).correlation(look));
            }
        }
        const double better = standing - BoxPatch(next, by_corners, samples).correlation(look);
        EXPECT_EQ(between(centre, box.centre) < 1, better > 0.05) << contrast << " " << better;
        a_little_better += better > 0 && better < 0.05;
        (better > 0.05 ? stayed : went)++;
    }
    EXPECT_GE(stayed, 3);
    EXPECT_GE(went, 3);
    EXPECT_GE(a_little_better, 2);
}

}  // namespace eyrie::box_follower_waiting_test
