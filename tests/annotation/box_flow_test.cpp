#include "imaging/following/box_flow.h"

#include <gtest/gtest.h>

#include "annotation/scenes.h"
#include "core/geometry/angle.h"

/// How a box moves from one picture to the next, where the whole picture moves in a known way.
namespace eyrie::box_flow_test {
namespace {

const cv::Size kPicture(240, 180);

/// About the middle of the box below: a turn, a scale and a shift.
cv::Matx33d motion(double turn, double scale, cv::Point2d shift, cv::Point2d middle = {120, 90}) {
    const double c = scale * std::cos(turn), s = scale * std::sin(turn);
    return {c, -s, middle.x + shift.x - c * middle.x + s * middle.y,
            s, c,  middle.y + shift.y - s * middle.x - c * middle.y,
            0, 0,  1};
}

OrientedBox standingBox() {
    return {{120, 90}, 40, 24, 0.3};
}

cv::Mat ground() {
    static const cv::Mat texture = test::groundTexture(kPicture, 5, 1.5, 20, 235);
    return texture;
}

cv::Mat movedBy(const cv::Mat& picture, const cv::Matx33d& map) {
    cv::Mat moved;
    cv::warpAffine(picture, moved, map.get_minor<2, 3>(0, 0), picture.size(), cv::INTER_CUBIC, cv::BORDER_REFLECT);
    return moved;
}

/// The inside of a box out of another picture.
void paste(cv::Mat& picture, const OrientedBox& box, const cv::Mat& other) {
    std::vector<cv::Point> outline;
    for (const cv::Point2d& corner : box.corners()) outline.emplace_back(cvRound(corner.x), cvRound(corner.y));
    cv::Mat mask = cv::Mat::zeros(picture.size(), CV_8UC1);
    cv::fillConvexPoly(mask, outline, 255);
    other.copyTo(picture, mask);
}

double between(cv::Point2d a, cv::Point2d b) {
    return std::hypot(a.x - b.x, a.y - b.y);
}

TEST(BoxFlow, IsTheMotionOfThePictureInsideTheBox) {
    for (const double turn : {0.0, 0.06, -0.06}) {
        for (const cv::Point2d shift : {cv::Point2d(0, 0), {3.5, -2.25}, {-1.75, 4}}) {
            const cv::Mat next = movedBy(ground(), motion(turn, 1, shift));
            const BoxFlow flow = flowOf(ground(), next, standingBox(), standingBox(), {});
            EXPECT_GE(flow.corners, 15) << turn << shift;
            EXPECT_LE(flow.corners, 40);
            EXPECT_GE(flow.agreeing, flow.corners / 2);
            EXPECT_LE(flow.agreeing, flow.corners);
            EXPECT_LT(between(flow.box.centre, standingBox().centre + shift), 0.15) << turn << shift;
            EXPECT_NEAR(flow.box.heading, 0.3 + turn, 0.01) << turn << shift;
            EXPECT_EQ(flow.box.length, 40);
            EXPECT_EQ(flow.box.width, 24);
        }
    }
}

TEST(BoxFlow, WhatWasPredictedOnlyNeedsToBePutRight) {
    // Farther and more turned than corners could be followed by themselves.
    const cv::Mat next = movedBy(ground(), motion(0.3, 1.1, {30, -21}));
    const OrientedBox predicted{{149, 70}, 44, 26.4, 0.57};
    const BoxFlow flow = flowOf(ground(), next, standingBox(), predicted, {});
    EXPECT_GE(flow.agreeing, 10);
    EXPECT_LT(between(flow.box.centre, {150, 69}), 0.3);
    EXPECT_NEAR(flow.box.heading, 0.6, 0.015);
    EXPECT_EQ(flow.box.length, 44) << "sizes are not put right";
}

TEST(BoxFlow, AVehicleTurnsByATenthOfARadianAtMost) {
    const cv::Mat next = movedBy(ground(), motion(0.18, 1, {0, 0}));
    const BoxFlow flow = flowOf(ground(), next, standingBox(), standingBox(), {});
    EXPECT_NEAR(flow.box.heading, 0.3 + 0.12, 1e-9);
    const BoxFlow back =
        flowOf(ground(), movedBy(ground(), motion(-0.18, 1, {0, 0})), standingBox(), standingBox(), {});
    EXPECT_NEAR(back.box.heading, 0.3 - 0.12, 1e-9);
}

TEST(BoxFlow, WhatPassesInFrontOfAPartTakesNothingFromTheRest) {
    const cv::Matx33d here = motion(0, 1, {2, 1});
    cv::Mat next = movedBy(ground(), here);
    paste(next, {{134, 97}, 14, 30, 0.3}, movedBy(ground(), motion(0, 1, {-3, 4})));
    const BoxFlow flow = flowOf(ground(), next, standingBox(), standingBox(), {});
    EXPECT_LT(flow.agreeing, flow.corners);
    EXPECT_LT(between(flow.box.centre, {122, 91}), 0.3);
    EXPECT_NEAR(flow.box.heading, 0.3, 0.02);
}

TEST(BoxFlow, TheGroundAroundTheBoxDoesNotCount) {
    cv::Mat next = movedBy(ground(), motion(0, 1, {-4, 3}));
    OrientedBox there = standingBox().scaled(1.2, 1.4);
    there.centre += cv::Point2d(3, -2);
    paste(next, there, movedBy(ground(), motion(0, 1, {3, -2})));
    const BoxFlow flow = flowOf(ground(), next, standingBox(), standingBox(), {});
    EXPECT_LT(between(flow.box.centre, {123, 88}), 0.15);
    EXPECT_GE(flow.agreeing, flow.corners * 2 / 3);
}

TEST(BoxFlow, WithoutCornersItIsAsPredicted) {
    const OrientedBox predicted{{123, 91}, 41, 25, 0.4};
    const auto isAsPredicted = [&](const cv::Mat& current, const cv::Mat& next) {
        const BoxFlow flow = flowOf(current, next, standingBox(), predicted, {});
        return flow.corners == 0 && flow.agreeing == 0 && flow.box.centre == predicted.centre &&
               flow.box.heading == predicted.heading && flow.box.length == predicted.length;
    };
    const cv::Mat grey(kPicture, CV_8UC1, cv::Scalar(90));
    EXPECT_TRUE(isAsPredicted(grey, ground()));
    EXPECT_TRUE(isAsPredicted(ground(), grey)) << "none is found again";
    EXPECT_TRUE(isAsPredicted(ground()(cv::Rect(0, 0, 60, 180)), ground()(cv::Rect(0, 0, 60, 180))))
        << "the box is beyond the picture";
    EXPECT_FALSE(isAsPredicted(ground(), ground()));
}

TEST(BoxFlow, NoMoreCornersAreFollowedThanAskedFor) {
    const BoxFlow few = flowOf(ground(), ground(), standingBox(), standingBox(), {.max_corners = 7});
    EXPECT_EQ(few.corners, 7);
    EXPECT_EQ(few.agreeing, 7);
    const cv::Mat next = movedBy(ground(), motion(0.05, 1, {2, 1}));
    EXPECT_EQ(flowOf(ground(), next, standingBox(), standingBox(), {.max_forward_backward_px = -1}).corners, 0);
}

TEST(BoxFlow, FourCornersTellNoTurn) {
    const cv::Mat next = movedBy(ground(), motion(0.05, 1, {2, 1}));
    EXPECT_EQ(flowOf(ground(), next, standingBox(), standingBox(), {.max_corners = 4}).box.heading, 0.3);
    EXPECT_NEAR(flowOf(ground(), next, standingBox(), standingBox(), {.max_corners = 12}).box.heading, 0.35, 0.02);
}

TEST(CameraAroundABox, IsTheMotionOfTheGroundWhateverTheBoxDoes) {
    for (const auto& [turn, scale, shift] : {std::tuple(0.0, 1.0, cv::Point2d(3, -2)),
                                             {0.02, 1.0, cv::Point2d(-2, 1)},
                                             {-0.01, 1.02, cv::Point2d(1.5, 2.5)}}) {
        const cv::Matx33d camera = motion(turn, scale, shift);
        cv::Mat next = movedBy(ground(), camera);
        OrientedBox there = standingBox();
        there.centre += shift;
        paste(next, there, movedBy(ground(), motion(0, 1, {-5, 4})));
        const Homography map = cameraAround(ground(), next, standingBox());
        Homography truth;
        truth.matrix = camera;
        for (const cv::Point2d px : {cv::Point2d(60, 40), {180, 50}, {170, 140}, {70, 130}, {120, 90}})
            EXPECT_LT(between(map.apply(px), truth.apply(px)), 0.15) << turn << px;
        EXPECT_EQ(map.matrix(2, 0), 0);
        EXPECT_EQ(map.matrix(2, 1), 0);
        EXPECT_EQ(map.matrix(2, 2), 1);
    }
}

TEST(CameraAroundABox, IsTakenToStandWhereNothingCanBeFollowed) {
    const cv::Mat grey(kPicture, CV_8UC1, cv::Scalar(90));
    const cv::Mat next = movedBy(ground(), motion(0, 1, {3, -2}));
    const auto stands = [](const cv::Mat& current, const cv::Mat& next_picture, const OrientedBox& box) {
        return cameraAround(current, next_picture, box).matrix == cv::Matx33d::eye();
    };
    EXPECT_TRUE(stands(grey, next, standingBox()));
    EXPECT_TRUE(stands(ground(), grey, standingBox()));
    EXPECT_TRUE(stands(ground(), next, {{120, 90}, 400, 300, 0})) << "the box fills the picture";
    const cv::Rect narrow(0, 0, 31, 180);
    EXPECT_TRUE(stands(ground()(narrow), next(narrow), {{15, 90}, 4, 4, 0}));
    const cv::Rect low(0, 0, 240, 31);
    EXPECT_TRUE(stands(ground()(low), next(low), {{120, 15}, 4, 4, 0}));
    EXPECT_FALSE(stands(ground(), next, standingBox()));
}

}  // namespace
}  // namespace eyrie::box_flow_test
