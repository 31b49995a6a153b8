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

/// A round spot on grey, and how it moves.
struct Spot {
    cv::Point2d place;
    cv::Point2d moved{0, 0};
    double contrast = 1;
};

cv::Mat spotted(const std::vector<Spot>& spots) {
    cv::Mat picture(kPicture, CV_64FC1, cv::Scalar(60));
    constexpr int kReach = 6;
    for (const Spot& spot : spots) {
        const cv::Point2d at = spot.place + spot.moved;
        for (int y = cvRound(at.y) - kReach; y <= cvRound(at.y) + kReach; ++y) {
            for (int x = cvRound(at.x) - kReach; x <= cvRound(at.x) + kReach; ++x) {
                const cv::Point2d away = cv::Point2d(x, y) - at;
                picture.at<double>(y, x) += 180 * spot.contrast * std::exp(-away.dot(away) / 2);
            }
        }
    }
    cv::Mat bytes;
    picture.convertTo(bytes, CV_8U);
    return bytes;
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

TEST(BoxFlow, FiveCornersTellATurn) {
    const cv::Mat next = movedBy(ground(), motion(0.05, 1, {2, 1}));
    const BoxFlow flow = flowOf(ground(), next, standingBox(), standingBox(), {.max_corners = 5});
    ASSERT_EQ(flow.agreeing, 5);
    EXPECT_NEAR(flow.box.heading, 0.35, 0.02);
}

TEST(BoxFlow, TellsHowWhatItLiesOnGrowsBeyondThePrediction) {
    for (const double scale : {0.95, 1.0, 1.06}) {
        const cv::Mat next = movedBy(ground(), motion(0.02, scale, {1, 2}));
        EXPECT_NEAR(flowOf(ground(), next, standingBox(), standingBox(), {}).growth, scale, 0.005);
        const OrientedBox predicted{{121, 92}, 40 * scale, 24 * scale, 0.32};
        EXPECT_NEAR(flowOf(ground(), next, standingBox(), predicted, {}).growth, 1, 0.005) << scale;
    }
}

TEST(BoxFlow, ABoxWithoutLengthIsFollowedByWhatLiesOnItsLine) {
    const OrientedBox line{{120, 90}, 0, 60, 0.3};
    const BoxFlow flow = flowOf(ground(), movedBy(ground(), motion(0, 1, {2, -1})), line, line, {});
    EXPECT_GE(flow.agreeing, 2);
    EXPECT_LT(between(flow.box.centre, {122, 89}), 0.5);
}

TEST(BoxFlow, NeedsSixteenPixelsOfPicture) {
    const OrientedBox small{{8, 8}, 12, 10, 0};
    const auto corners = [&](cv::Size size) {
        const cv::Mat picture = ground()(cv::Rect({100, 80}, size));
        return flowOf(picture, picture, small, small, {}).corners;
    };
    EXPECT_GT(corners({16, 90}), 0);
    EXPECT_EQ(corners({15, 90}), 0);
    EXPECT_GT(corners({90, 16}), 0);
    EXPECT_EQ(corners({90, 15}), 0);
}

TEST(BoxFlow, FollowsCornersWellWithinTheBoxAndNotMuchFainterThanTheClearest) {
    const OrientedBox box{{120, 90}, 80, 60, 0};
    const auto corners = [&](const std::vector<Spot>& spots) {
        const cv::Mat picture = spotted(spots);
        return flowOf(picture, picture, box, box, {}).corners;
    };
    const Spot clear{{110, 90}};
    EXPECT_EQ(corners({clear}), 1);
    EXPECT_EQ(corners({clear, {{157, 90}}, {{83, 90}}, {{120, 117}}, {{120, 63}}}), 5) << "37 px along, 27 across";
    EXPECT_EQ(corners({clear, {{159, 90}}, {{81, 90}}, {{120, 119}}, {{120, 61}}}), 1)
        << "the last twentieth is spared";
    // A fiftieth of how clear the clearest is, which goes with the square of the contrast.
    EXPECT_EQ(corners({clear, {{130, 90}, {}, 0.16}}), 2);
    EXPECT_EQ(corners({clear, {{130, 90}, {}, 0.12}}), 1);
}

TEST(BoxFlow, WhatMovesOtherwiseByHalfAPixelDoesNotAgreeInALargeBoxByAPixel) {
    const auto agreeing = [](const OrientedBox& box, double other_by) {
        std::vector<Spot> spots;
        for (int i = 0; i < 12; ++i) {
            const int row = i / 4;
            const double along = box.length * (i % 4 - 1.5) / 5, across = box.width * (row - 1) / 3.5;
            spots.push_back({box.centre + cv::Point2d(along, across)});
        }
        const cv::Mat current = spotted(spots);
        for (Spot& spot : spots) spot.moved = {1, 0.5};
        spots[5].moved += cv::Point2d(0, other_by);
        spots[6].moved += cv::Point2d(0, -other_by);
        const BoxFlow flow = flowOf(current, spotted(spots), box, box, {});
        EXPECT_EQ(flow.corners, 12) << other_by;
        EXPECT_LT(between(flow.box.centre, box.centre + cv::Point2d(1, 0.5)), 0.15) << other_by;
        return flow.agreeing;
    };
    const OrientedBox car{{120, 90}, 48, 36, 0};      // 2 % of the root of the area are less than a pixel
    const OrientedBox lorry{{120, 90}, 140, 100, 0};  // … are 2.4 px
    EXPECT_EQ(agreeing(car, 0), 12);
    EXPECT_EQ(agreeing(car, 0.38), 12);
    EXPECT_EQ(agreeing(car, 0.65), 10);
    EXPECT_EQ(agreeing(lorry, 1.0), 12);
    EXPECT_EQ(agreeing(lorry, 1.5), 10);
}

TEST(BoxFlow, WhereAllMoveUnevenlyTwoAndAHalfTimesTheUsualAgrees) {
    const OrientedBox car{{120, 90}, 56, 48, 0};
    const auto agreeing = [&](double usual, double of_one) {
        std::vector<Spot> spots;
        spots.reserve(16);
        for (int i = 0; i < 16; ++i) {
            const int row = i / 4;
            spots.push_back({{99.0 + 14 * (i % 4), 72.0 + 12 * row}});
        }
        const cv::Mat current = spotted(spots);
        // In turn to the one side and the other, which no turn and no growth explains.
        for (int i = 0; i < 16; ++i) spots[std::size_t(i)].moved.y = (i + i / 4) % 2 == 0 ? usual : -usual;
        spots[5].moved.y = of_one;
        spots[6].moved.y = -of_one;
        const BoxFlow flow = flowOf(current, spotted(spots), car, car, {});
        EXPECT_EQ(flow.corners, 16);
        return flow.agreeing;
    };
    EXPECT_EQ(agreeing(0.3, 0.68), 16);
    EXPECT_EQ(agreeing(0.3, 0.9), 14);
    EXPECT_EQ(agreeing(0.9, 1.8), 16) << "two pixels at most";
    EXPECT_EQ(agreeing(0.9, 2.4), 14);
}

TEST(BoxFlow, CornersAreThoseOfShiAndTomasiTwoPixelsApart) {
    const cv::Mat fine = test::groundTexture(kPicture, 5, 0.7, 20, 235);
    std::vector<cv::Point> outline;
    for (const cv::Point2d& corner : standingBox().scaled(0.95, 0.95).corners())
        outline.emplace_back(cvRound(corner.x), cvRound(corner.y));
    cv::Mat mask = cv::Mat::zeros(kPicture, CV_8UC1);
    cv::fillConvexPoly(mask, outline, 255);
    std::vector<cv::Point2f> corners;
    cv::goodFeaturesToTrack(fine, corners, 1000, 0.02, 2, mask);
    EXPECT_EQ(flowOf(fine, fine, standingBox(), standingBox(), {.max_corners = 1000}).corners, int(corners.size()));
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
    const cv::Rect wide_enough(0, 0, 32, 180);
    EXPECT_FALSE(stands(ground()(wide_enough), next(wide_enough), {{15, 90}, 4, 4, 0}));
    const cv::Rect high_enough(0, 0, 240, 32);
    EXPECT_FALSE(stands(ground()(high_enough), next(high_enough), {{120, 15}, 4, 4, 0}));
    EXPECT_FALSE(stands(ground(), next, standingBox()));
}

TEST(CameraAroundABox, IsToldByTwelveCornersWithinEightyPixelsAndNotNextToTheBox) {
    const OrientedBox box{{120, 90}, 20, 20, 0};
    const auto isTold = [&](cv::Point2d twelfth) {
        std::vector<Spot> spots;
        spots.reserve(12);
        for (int i = 0; i < 11; ++i) spots.push_back({{60.0 + 12 * i, i % 2 == 0 ? 50.0 : 130.0}});
        spots.push_back({twelfth});
        const cv::Mat current = spotted(spots);
        for (Spot& spot : spots) spot.moved = {1.5, -0.5};
        const Homography map = cameraAround(current, spotted(spots), box);
        if (map.matrix == cv::Matx33d::eye()) return false;
        EXPECT_LT(between(map.apply(box.centre), {121.5, 89.5}), 0.1);
        return true;
    };
    EXPECT_TRUE(isTold({60, 100}));
    EXPECT_FALSE(isTold({120, 90})) << "the box itself";
    EXPECT_FALSE(isTold({131, 90}));
    EXPECT_TRUE(isTold({136, 90})) << "beyond 1.3 times its size";
    EXPECT_TRUE(isTold({39, 90}));
    EXPECT_FALSE(isTold({26, 90})) << "too far away";
    EXPECT_TRUE(isTold({201, 90}));
    EXPECT_FALSE(isTold({214, 90}));
}

}  // namespace
}  // namespace eyrie::box_flow_test
