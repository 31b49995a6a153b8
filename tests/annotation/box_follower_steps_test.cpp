#include <gtest/gtest.h>

#include <opencv2/imgproc.hpp>

#include "annotation/scenes.h"
#include "core/geometry/angle.h"
#include "imaging/following/box_follower.h"

/// What a box that is followed carries from step to step, worked out beside it; and when it ends, each limit from both
/// sides.
namespace eyrie::box_follower_steps_test {
namespace {

const cv::Size kPicture(240, 180);
const OrientedBox kStart{{120, 90}, 40, 24, 0.3};

/// Nothing ends it but what the test is about.
FollowOptions endless() {
    FollowOptions options;
    options.min_certainty = -1;
    options.min_start_likeness = -2;
    options.max_speed_change_px = 1000;
    return options;
}

FollowOptions withoutCorners(FollowOptions options = endless()) {
    options.max_forward_backward_px = -1;
    return options;
}

cv::Mat ground(double blur = 1.5) {
    return test::groundTexture(kPicture, 5, blur, 20, 235);
}

cv::Mat grey() {
    return {kPicture, CV_8UC1, cv::Scalar(90)};
}

/// About the middle of the box: a turn, a scale and a shift.
Homography motion(double turn, double scale, cv::Point2d shift) {
    const double c = scale * std::cos(turn), s = scale * std::sin(turn);
    const cv::Point2d middle = kStart.centre;
    Homography map;
    map.matrix = {c, -s, middle.x + shift.x - c * middle.x + s * middle.y,
                  s, c,  middle.y + shift.y - s * middle.x - c * middle.y,
                  0, 0,  1};
    return map;
}

cv::Mat moved(const cv::Mat& picture, const Homography& by) {
    cv::Mat result;
    cv::warpAffine(picture, result, by.matrix.get_minor<2, 3>(0, 0), picture.size(), cv::INTER_CUBIC,
                   cv::BORDER_REFLECT);
    return result;
}

cv::Mat shifted(const cv::Mat& picture, cv::Point2d by) {
    return moved(picture, motion(0, 1, by));
}

/// The more of another picture, the less it looks like itself.
cv::Mat faded(const cv::Mat& picture, double share) {
    cv::Mat result;
    cv::addWeighted(picture, 1 - share, test::groundTexture(kPicture, 9, 1.5, 20, 235), share, 0, result);
    return result;
}

double length(cv::Point2d way) {
    return std::hypot(way.x, way.y);
}

BoxPatch lookOf(const cv::Mat& picture, const OrientedBox& box) {
    return {picture, box, BoxPatch::samplesFor(kStart)};
}

/// The first step, from a picture into one in which all has moved.
BoxFollower::Step firstStep(cv::Point2d velocity, cv::Point2d movement, const FollowOptions& options) {
    BoxFollower follower(kStart, ground(), options);
    follower.startsWith(velocity);
    return follower.advance(ground(), shifted(ground(), movement), {});
}

bool jumps(cv::Point2d velocity, cv::Point2d movement, const FollowOptions& options) {
    const BoxFollower::Step step = firstStep(velocity, movement, options);
    EXPECT_LT(length(step.box.centre - kStart.centre - movement), 0.15) << velocity << movement;
    return step.end == FollowEnd::jump;
}

}  // namespace

TEST(BoxFollowerSteps, WhatIsNotSeenIsWhereTheGroundAndItsSpeedTakeIt) {
    for (const auto& [scale, believed] : {std::pair(1.0, 1.0), {0.9, 0.9}, {1.2, 1.2}, {0.7, 0.8}, {1.4, 1.25}}) {
        const Homography map = motion(0.1, scale, {5, -3});
        BoxFollower follower(kStart, ground(), endless());
        follower.startsWith({3, -2});
        const OrientedBox box = follower.advance(ground(), grey(), map).box;
        EXPECT_LT(length(box.centre - map.apply(cv::Point2d(123, 88))), 1e-9) << scale;
        EXPECT_NEAR(box.heading, 0.4, 1e-9);
        EXPECT_NEAR(box.length, 40 * believed, 1e-9);
        EXPECT_NEAR(box.width, 24 * believed, 1e-9);
    }
}

TEST(BoxFollowerSteps, TheSpeedFollowsEachStepByHalfAndTheUsualOneByAnEighth) {
    const std::vector<cv::Point2d> steps{{3, 1}, {4, 1.5}, {3, 0}, {5, 2},  {4, 1}, {4, -1}, {3, 0},
                                         {2, 0}, {3, 2},   {4, 1}, {3, -1}, {2, 0}, {1, 1},  {2, 2}};
    const Homography camera = motion(0.02, 1.01, {2, -1});
    BoxFollower follower(kStart, ground(), endless());
    cv::Mat picture = ground();
    OrientedBox box = kStart;
    const BoxPatch start = lookOf(picture, box);
    BoxPatch lately = start;
    cv::Point2d speed(0, 0), usual(0, 0), truth = kStart.centre;
    for (std::size_t i = 0; i < steps.size(); ++i) {
        truth = camera.apply(truth) + steps[i];
        const double so_far = static_cast<double>(i + 1);
        cv::Mat next = moved(ground(), motion(0.02 * so_far, std::pow(1.01, so_far), truth - kStart.centre));
        if (i == 8) next = faded(next, 0.55);
        OrientedBox predicted = box;
        predicted.centre = camera.apply(box.centre + speed);
        predicted.heading = camera.turned(box.centre, box.heading);
        predicted.length *= camera.scaleAt(box.centre);
        predicted.width *= camera.scaleAt(box.centre);
        const int agreeing = flowOf(picture, next, box, predicted, {}).agreeing;
        const BoxFollower::Step step = follower.advance(picture, next, camera);
        const BoxPatch look = lookOf(next, step.box);
        const double alike = look.correlation(lately);
        EXPECT_NEAR(step.certainty, 0.55 * alike + 0.25 * look.correlation(start) + 0.05 * std::min(agreeing, 4), 1e-4)
            << i;
        if (i == 8) {
            EXPECT_GT(alike, 0.5);
            EXPECT_LT(alike, 0.75) << "too little to learn from";
        } else {
            EXPECT_GT(alike, 0.75) << i;
            lately.learn(look, 0.25);
        }
        const cv::Point2d movement = step.box.centre - camera.apply(box.centre);
        EXPECT_LT(length(step.box.centre - truth), 1) << i;
        const cv::Point2d before = camera.applyToVector(box.centre, speed);
        const cv::Point2d usual_before = camera.applyToVector(box.centre, usual);
        speed = i == 0 ? movement : (before + movement) * 0.5;
        const double share = std::max(0.12, 1.0 / static_cast<double>(i + 1));
        usual = usual_before * (1 - share) + movement * share;
        EXPECT_LT(length(follower.usualVelocity() - usual), 1e-9) << i;
        box = step.box;
        picture = next;
    }
    const OrientedBox last = follower.advance(picture, grey(), {}).box;
    EXPECT_LT(length(last.centre - box.centre - speed), 1e-9);
}

TEST(BoxFollowerSteps, AStepMayDifferByFourPixelsFromTheSpeed) {
    FollowOptions options = endless();
    options.max_speed_change_px = 4;
    EXPECT_FALSE(jumps({9, 0}, {12.7, 0}, options));
    EXPECT_TRUE(jumps({9, 0}, {13.3, 0}, options));
    EXPECT_FALSE(jumps({9, 0}, {9, -3.7}, options));
    EXPECT_TRUE(jumps({9, 0}, {9, -4.3}, options));
    // … or by a share of the root of its area, 31 px, if that is more.
    options.max_speed_change_share = 0.2;
    EXPECT_FALSE(jumps({13, 0}, {18.9, 0}, options));
    EXPECT_TRUE(jumps({13, 0}, {19.5, 0}, options));
    options.max_speed_change_share = 0.1;
    EXPECT_FALSE(jumps({9, 0}, {12.7, 0}, options));
}

TEST(BoxFollowerSteps, WhatStandsMaySetOffByTwoFifthsAndWhatDrivesChangeByHalfOfItsSpeed) {
    FollowOptions options = endless();
    options.max_speed_change_px = 4;
    // The mean of two steps, 1.4 px.
    EXPECT_FALSE(jumps({0, 0}, {2.6, 0}, options));
    EXPECT_TRUE(jumps({0, 0}, {3.0, 0}, options));
    options.max_speed_change_px = 10;  // 3.5 px
    EXPECT_FALSE(jumps({8, 0}, {15.6, 0}, options));
    EXPECT_TRUE(jumps({8, 0}, {16.4, 0}, options));
    EXPECT_FALSE(jumps({0, 8}, {0, 0.4}, options));
    EXPECT_TRUE(jumps({0, 8}, {0, -0.4}, options));
}

TEST(BoxFollowerSteps, TheFirstTwoStepsMayBeAny) {
    FollowOptions options = endless();
    options.max_speed_change_px = 4;
    const auto endOf = [&](const std::vector<double>& steps) {
        BoxFollower follower(kStart, ground(), options);
        double at = 0;
        std::optional<FollowEnd> end;
        for (const double step : steps) {
            EXPECT_FALSE(end) << "before the last";
            const cv::Mat picture = shifted(ground(), {at, 0});
            at += step;
            end = follower.advance(picture, shifted(ground(), {at, 0}), {}).end;
        }
        return end;
    };
    EXPECT_EQ(endOf({6}), std::nullopt);
    EXPECT_EQ(endOf({6, 0}), std::nullopt);
    EXPECT_EQ(endOf({6, 0, 8}), FollowEnd::jump);
    EXPECT_EQ(endOf({0, 0, 0, 0, 0, 3.5}), std::nullopt) << "nothing is usual yet";
    EXPECT_EQ(endOf({0, 0, 0, 0, 0, 0, 3.5}), FollowEnd::jump);
}

TEST(BoxFollowerSteps, ItEndsWhereItIsLessLikeItselfThanAsked) {
    int ended = 0, went_on = 0;
    for (const int corners : {1, 2, 3, 40}) {
        for (int i = 0; i < 13; ++i) {
            const double share = 0.08 * i;
            FollowOptions options = endless();
            options.max_corners = corners;
            const cv::Mat next = faded(shifted(ground(), {2, 1}), share);
            const BoxFlow flow = flowOf(ground(), next, kStart, kStart, {.max_corners = corners});
            const auto step = [&] { return BoxFollower(kStart, ground(), options).advance(ground(), next, {}); };
            const BoxFollower::Step plain = step();
            const double alike = lookOf(next, plain.box).correlation(lookOf(ground(), kStart));
            const FollowEnd why = flow.agreeing < 2 ? FollowEnd::few_corners : FollowEnd::appearance;
            EXPECT_EQ(plain.end, alike < 0.5 ? std::optional(why) : std::nullopt) << corners << " " << share;
            EXPECT_NEAR(plain.certainty, 0.8 * std::max(0.0, alike) + 0.05 * std::min(flow.agreeing, 4), 1e-4);
            (plain.end ? ended : went_on)++;
            if (plain.end) continue;
            options.min_certainty = plain.certainty + 0.001;
            EXPECT_EQ(step().end, why) << corners << " " << share;
            options.min_certainty = plain.certainty - 0.001;
            EXPECT_FALSE(step().end);
            options.min_start_likeness = alike + 0.001;
            EXPECT_EQ(step().end, FollowEnd::appearance);
            options.min_start_likeness = alike - 0.001;
            EXPECT_FALSE(step().end);
        }
    }
    EXPECT_GE(ended, 10);
    EXPECT_GE(went_on, 10);
}

TEST(BoxFollowerSteps, ThreeCornersThatAgreeAreBelieved) {
    // Too far for the look of something so fine.
    const cv::Mat fine = ground(1);
    const cv::Point2d way(6, -5);
    const cv::Mat next = shifted(fine, way);
    const auto off = [&](int corners) {
        FollowOptions options = endless();
        options.max_corners = corners;
        EXPECT_EQ(flowOf(fine, next, kStart, kStart, {.max_corners = corners}).agreeing, corners);
        BoxFollower follower(kStart, fine, options);
        follower.startsWith({0, 0});
        return length(follower.advance(fine, next, {}).box.centre - kStart.centre - way);
    };
    EXPECT_LT(off(3), 0.5);
    EXPECT_GT(off(2), 3);
}

TEST(BoxFollowerSteps, WithoutCornersItIsSoughtSixPixelsAwayAtFirstAndThreeLater) {
    cv::Mat noise(kPicture, CV_8UC1);
    cv::RNG(3).fill(noise, cv::RNG::UNIFORM, 0, 256);
    OrientedBox start = kStart;
    start.heading = 0;
    const auto found = [&](cv::Point2d way, bool later) {
        BoxFollower follower(start, noise, withoutCorners());
        if (later) follower.startsWith({0, 0});
        const BoxFollower::Step step = follower.advance(noise, shifted(noise, way), {});
        return length(step.box.centre - start.centre - way) < 0.3;
    };
    for (const cv::Point2d side : {cv::Point2d(1, 0), {-1, 0}, {0, 1}, {0, -1}}) {
        EXPECT_TRUE(found(side * 6, false)) << side;
        EXPECT_FALSE(found(side * 9, false)) << side;
        EXPECT_TRUE(found(side * 3, true)) << side;
        EXPECT_FALSE(found(side * 6, true)) << side;
    }
}

TEST(BoxFollowerSteps, TheLookIsWeighedAgainstEveryPixelAndTurnAway) {
    // So coarse that a place nearer by is nearly as good.
    for (const double blur : {4.0, 7.0}) {
        const cv::Mat coarse = ground(blur);
        for (const auto& [turn, way] :
             {std::pair(0.0, cv::Point2d(4, 2)), {0.1, {0, 0}}, {-0.1, {0, 0}}, {0.07, {-3, 3}}}) {
            const cv::Mat next = moved(coarse, motion(turn, 1, way));
            BoxFollower follower(kStart, coarse, withoutCorners());
            const OrientedBox box = follower.advance(coarse, next, {}).box;
            const BoxPatch look = lookOf(coarse, kStart);
            const auto worth = [&](const OrientedBox& at) {
                const double away = length(at.centre - kStart.centre), turned = at.heading - kStart.heading;
                return lookOf(next, at).correlation(look) - 0.004 * away * away - turned * turned;
            };
            OrientedBox best = kStart;
            for (int right = -9; right <= 9; right += 2)
                for (int down = -9; down <= 9; down += 2)
                    for (int more = -3; more <= 3; ++more) {
                        OrientedBox beside = box;
                        beside.centre += cv::Point2d(0.1 * right, 0.1 * down);
                        beside.heading += 0.01 * more;
                        if (worth(beside) > worth(best)) best = beside;
                    }
            EXPECT_LT(length(best.centre - box.centre), 0.35) << blur << way;
            EXPECT_NEAR(best.heading, box.heading, 0.021) << blur << turn;
            EXPECT_LT(worth(best) - worth(box), 0.002) << blur << way;
        }
    }
}

TEST(BoxFollowerSteps, TheLookTellsTurnsThatFewCornersDoNot) {
    FollowOptions options = endless();
    options.max_corners = 4;
    for (const double turn : {0.03, -0.03, 0.045, -0.045}) {
        const cv::Mat next = moved(ground(), motion(turn, 1, {2, -1}));
        EXPECT_EQ(flowOf(ground(), next, kStart, kStart, {.max_corners = 4}).box.heading, 0.3);
        BoxFollower follower(kStart, ground(), options);
        EXPECT_NEAR(follower.advance(ground(), next, {}).box.heading, 0.3 + turn, 0.006) << turn;
    }
}

TEST(BoxFollowerSteps, LongBoxesTurnByWhatMovesTheirEnds) {
    OrientedBox lorry = kStart;
    lorry.length = 100;
    FollowOptions options = endless();
    options.max_corners = 4;
    const cv::Mat coarse = ground(3);
    for (const double turn : {0.07, -0.07}) {
        const cv::Mat next = moved(coarse, motion(turn, 1, {0, 0}));
        ASSERT_EQ(flowOf(coarse, next, lorry, lorry, {.max_corners = 4}).box.heading, 0.3);
        BoxFollower follower(lorry, coarse, options);
        EXPECT_NEAR(follower.advance(coarse, next, {}).box.heading, 0.3 + turn, 0.006) << turn;
    }
}

TEST(BoxFollowerSteps, GrowsWithCornersByTheRootInEachStep) {
    FollowOptions options = endless();
    options.corners_to_grow = 10;
    for (const auto& [scale, believed] : {std::pair(1.05, 1.05), {0.95, 0.95}, {1.22, 1.15}, {0.8, 1 / 1.15}}) {
        const cv::Mat next = moved(ground(), motion(0, scale, {0, 0}));
        BoxFollower follower(kStart, ground(), options);
        const BoxFollower::Step step = follower.advance(ground(), next, {});
        EXPECT_TRUE(step.by_corners) << scale;
        const double growth = step.box.length / 40;
        EXPECT_NEAR(growth, believed, believed == scale ? 0.006 : 1e-9) << scale;
        EXPECT_NEAR(step.box.width / 24, growth, 1e-9);
        if (believed != scale) continue;  // it does not look like itself then
        const OrientedBox third = follower.advance(next, grey(), {}).box;
        EXPECT_NEAR(third.length, 40 * growth * std::sqrt(growth), 1e-6) << "as it grew lately, in part";
        EXPECT_NEAR(third.width, 24 * growth * std::sqrt(growth), 1e-6);
    }
}

TEST(BoxFollowerSteps, GrowsWhereEnoughCornersAgreeAndItIsLargeEnough) {
    const cv::Mat next = moved(ground(), motion(0, 1.05, {0, 0}));
    const int agreeing = flowOf(ground(), next, kStart, kStart, {}).agreeing;
    const auto grows = [&](int corners, double size) {
        FollowOptions options = endless();
        options.corners_to_grow = corners;
        options.size_to_grow_px = size;
        const BoxFollower::Step step = BoxFollower(kStart, ground(), options).advance(ground(), next, {});
        EXPECT_EQ(step.by_corners, step.box.length != 40);
        return step.by_corners;
    };
    EXPECT_TRUE(grows(agreeing, 0));
    EXPECT_FALSE(grows(agreeing + 1, 0));
    EXPECT_TRUE(grows(1, 0));
    EXPECT_FALSE(grows(0, 0));
    EXPECT_TRUE(grows(10, 30.9)) << "the root of 40 × 24 is 30.98";
    EXPECT_FALSE(grows(10, 31.1));
}

TEST(BoxFollowerSteps, GrowsWhereThreeOfFiveCornersAgree) {
    int grew = 0, did_not = 0;
    for (int covered = 0; covered <= 30; covered += 2) {
        // Something else moves in front of a part of it.
        cv::Mat next = moved(ground(), motion(0, 1.03, {2, 1}));
        shifted(ground(), {-3, 4})(cv::Rect(90, 60, covered + 10, 60)).copyTo(next(cv::Rect(90, 60, covered + 10, 60)));
        const BoxFlow flow = flowOf(ground(), next, kStart, kStart, {});
        FollowOptions options = endless();
        options.corners_to_grow = 3;
        const bool grows = BoxFollower(kStart, ground(), options).advance(ground(), next, {}).by_corners;
        EXPECT_EQ(grows, flow.agreeing >= 0.6 * flow.corners) << flow.agreeing << " of " << flow.corners;
        (grows ? grew : did_not)++;
    }
    EXPECT_GE(grew, 3);
    EXPECT_GE(did_not, 3);
}

}  // namespace eyrie::box_follower_steps_test
