/// How far interpolated boxes are off, what is looked at in pictures, and when following ends, at their limits.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <opencv2/imgproc.hpp>

#include "annotation/keyframes/dense_boxes.h"
#include "annotation/keyframes/keyframe_path.h"
#include "annotation/keyframes/keyframe_reduction.h"
#include "annotation/pictures/box_tracker.h"
#include "annotation/pictures/object_stack.h"
#include "annotation/pictures/trajectory_refinement.h"
#include "annotation/pictures/trajectory_solver.h"
#include "annotation/scenes.h"
#include "core/error.h"
#include "core/geometry/angle.h"

namespace eyrie::keyframe_limits_by_hand_test {
namespace {

using test::keyframe;
using test::object;

const CameraMotion standing = CameraMotion::standing(0, 999);

LabelledObject parked(FrameIndex first, FrameIndex last, const OrientedBox& box = {{100, 60}, 20, 10, 0}) {
    return object(1, {keyframe(first, box, true)}, last);
}

/// A textured car on a textured ground, where `truth` has it.
cv::Mat pictureOf(const OrientedBox& truth) {
    static const cv::Mat ground = test::groundTexture({300, 200}, 1, 2.5);
    static const cv::Mat car = test::groundTexture({33, 17}, 2, 1.2);
    cv::Mat picture = ground.clone();
    const cv::Point2d d = truth.direction() * (truth.length / 32);
    const cv::Point2d corner = truth.toImage({-truth.length / 2, -truth.width / 2});
    cv::warpAffine(car, picture, cv::Matx23d(d.x, -d.y, corner.x, d.y, d.x, corner.y), picture.size(), cv::INTER_LINEAR,
                   cv::BORDER_TRANSPARENT);
    return picture;
}

OrientedBox driving(std::size_t i) {
    return {{60 + 4.0 * static_cast<double>(i), 90}, 32, 16, 0.3};
}

/// Places of the car, each box off its truth by so much in its own axes.
template <typename Off>
std::vector<PicturePlace> placesOff(std::size_t count, const Off& off) {
    std::vector<PicturePlace> places(count);
    for (std::size_t i = 0; i < count; ++i) {
        places[i].frame = static_cast<FrameIndex>(i);
        places[i].box = driving(i);
        places[i].box.centre = driving(i).toImage(off(i));
        places[i].picture = pictureOf(driving(i));
    }
    return places;
}

double worstOff(const std::vector<PicturePlace>& places, const SampleGrid& grid) {
    double worst = 0;
    for (std::size_t i = 0; i < places.size(); ++i) {
        const OrientedBox found = grid.moved(places[i].box, places[i].found, places[i].turn);
        worst = std::max(worst, cv::norm(found.centre - driving(i).centre));
    }
    return worst;
}

}  // namespace

TEST(DenseBoxesByHand, AreOffByTheFarthestCornerOrTheOverlapThatIsMissing) {
    const std::vector<FrameBox> boxes{{3, {{103, 64}, 20, 10, 0}}, {5, {{105, 60}, 20, 10, 0}}, {30, {}}};
    const LabelledObject shown = parked(0, 20);
    ReductionOptions options;
    options.tolerance_px = 2;
    const auto off = [&](std::size_t i) {
        BoxReader reader(shown, standing, PathShape::smooth);
        return DenseBoxes(boxes, options).deviation(i, reader);
    };
    EXPECT_NEAR(off(0), 2.5, 1e-9);
    EXPECT_NEAR(off(1), 2.5, 1e-9);
    EXPECT_EQ(off(2), std::numeric_limits<double>::max()) << "it is not there any more";
    options.min_overlap = 0.9;  // 15 of 25 px are shared: .4 are missing, .1 may
    EXPECT_NEAR(off(1), 4, 1e-9);
    options.tolerance_px = 1;
    EXPECT_NEAR(off(1), 5, 1e-9);
    options.tolerance_px = 0;
    EXPECT_NEAR(off(1), 4, 1e-9);
    const DenseBoxes dense(boxes, options);
    EXPECT_EQ(dense.from(2), 0U);
    EXPECT_EQ(dense.from(3), 0U);
    EXPECT_EQ(dense.from(4), 1U);
    EXPECT_EQ(dense.from(31), 3U);
}

TEST(DenseBoxesByHand, TheErrorOfAReductionIsToldWithItsFirstWorstFrame) {
    const std::vector<FrameBox> boxes{{1, {{100, 60}, 20, 10, 0}},
                                      {3, {{103, 64}, 20, 10, 0}},
                                      {5, {{105, 60}, 20, 10, 0}},
                                      {7, {{101, 60}, 20, 10, 0}}};
    const ReductionError error = reductionError(parked(0, 20), boxes, standing);
    EXPECT_NEAR(error.corner_px, 5, 1e-9);
    EXPECT_EQ(error.worst_frame, 3);
    EXPECT_NEAR(error.min_overlap, 17.0 * 6 / (400 - 17 * 6), 1e-9);
    const ReductionError gone = reductionError(parked(0, 6), boxes, standing);
    EXPECT_EQ(gone.worst_frame, 7);
    EXPECT_EQ(gone.min_overlap, 0);
    EXPECT_EQ(gone.corner_px, std::numeric_limits<double>::infinity());
    EXPECT_EQ(reductionError(parked(0, 6), {}, standing).min_overlap, 1);
}

TEST(DenseBoxesByHand, AnObjectIsRefinedOnlyWhereItIsOffByMoreThanTheTolerance) {
    const auto keyframesFor = [](double off_px) {
        std::vector<FrameBox> boxes;
        for (FrameIndex frame = 0; frame <= 20; ++frame)
            boxes.push_back({frame, {{100 + (frame == 12 ? off_px : 0), 60}, 20, 10, 0}});
        ReductionOptions options;
        options.tolerance_px = 2;
        return refined(parked(0, 20), boxes, standing, options).keyframes.size();
    };
    EXPECT_EQ(keyframesFor(1.99), 1U);
    EXPECT_EQ(keyframesFor(2), 1U);
    EXPECT_GT(keyframesFor(2.01), 1U);
    EXPECT_TRUE(refined({}, {{0, {}}}, standing, {}).keyframes.empty());
    EXPECT_EQ(refined(parked(0, 20), {}, standing, {}).keyframes.size(), 1U);
}

TEST(FollowBoxByHand, BoxesOfTwoPixelsAndHalfOfThemInThePictureAreFollowed) {
    const cv::Mat ground = test::groundTexture({200, 120}, 1, 2.5);
    const auto gray = [&](FrameIndex) { return ground; };
    const auto of = [&](const OrientedBox& box) { return followBox(box, 3, 5, gray, standing); };
    EXPECT_THROW(of({{100, 60}, 1.9, 10, 0}), Error);
    EXPECT_THROW(of({{100, 60}, 10, 1.9, 0}), Error);
    EXPECT_NO_THROW(of({{100, 60}, 2, 2, 0}));
    EXPECT_EQ(of({{-1.5, 60}, 20, 10, 0}).end_frame, 3) << "nine of 20 px are in it";
    EXPECT_EQ(of({{-1.5, 60}, 20, 10, 0}).end, FollowEnd::left_image);
    EXPECT_NE(of({{0.5, 60}, 20, 10, 0}).end, FollowEnd::left_image);
    const FollowResult done = of({{100, 60}, 20, 10, 0});
    EXPECT_EQ(done.reason, "reached frame 5");
    EXPECT_EQ(done.end_frame, 5);
    ASSERT_EQ(done.boxes.size(), 2U);
    EXPECT_EQ(done.boxes[0].frame, 4);
    EXPECT_EQ(followBox({{100, 60}, 20, 10, 0}, 5, 3, gray, standing).boxes.at(1).frame, 3);
}

TEST(FollowBoxByHand, WhatLeavesThePictureEndsWhereHalfOfItIsGone) {
    const cv::Mat ground = test::groundTexture({400, 120}, 1, 2.5);
    const auto gray = [&](FrameIndex frame) { return ground(cv::Rect(5 * frame, 0, 200, 120)).clone(); };
    const CameraMotion camera(
        test::stepsOf([](double frame) { return cv::Matx33d(1, 0, -5 * frame, 0, 1, 0, 0, 0, 1); }, 40));
    const FollowResult result = followBox({{32, 60}, 20, 10, 0}, 0, 30, gray, camera);
    EXPECT_EQ(result.end, FollowEnd::left_image);
    EXPECT_EQ(result.end_frame, 7) << "there it would be at -3";
    EXPECT_EQ(result.boxes.size(), 6U);
    EXPECT_EQ(result.reason, "stopped at frame 7: it leaves the image");
}

TEST(FollowBoxByHand, PicturesOfAnotherKindAreNone) {
    const cv::Mat ground = test::groundTexture({200, 120}, 1, 2.5);
    cv::Mat colour;
    cv::cvtColor(ground, colour, cv::COLOR_GRAY2BGR);
    for (const cv::Mat& other : {colour, cv::Mat(ground(cv::Rect(0, 0, 199, 120))), cv::Mat()}) {
        const auto at = [&](FrameIndex which) {
            return followBox(
                {{100, 60}, 20, 10, 0}, 3, 9, [&](FrameIndex frame) { return frame == which ? other : ground; },
                standing);
        };
        EXPECT_EQ(at(5).reason, "stopped at frame 5: the frame could not be read");
        EXPECT_EQ(at(5).end, FollowEnd::no_picture);
        EXPECT_EQ(at(5).boxes.size(), 1U);
    }
    std::stop_source stop;
    stop.request_stop();
    const FollowResult stopped = followBox(
        {{100, 60}, 20, 10, 0}, 3, 9, [&](FrameIndex) { return ground; }, standing, {}, {}, stop.get_token());
    EXPECT_EQ(stopped.reason, "stopped at frame 4: stopped by hand");
}

TEST(KeyframePathByHand, APieceMovesFromHalfOfTheMeanLengthOfItsEndsOn) {
    const auto moves = [](double way) {
        KeyframePath path(PathShape::smooth, true);
        path.add({0, {0, 0}, 20, 8, 0});
        path.add({10, {way, 0}, 40, 8, 0});
        path.add({20, {100, 0}, 4, 8, 0});
        return path.moving(0);
    };
    EXPECT_FALSE(moves(14.9));
    EXPECT_TRUE(moves(15));
}

TEST(ObjectStackByHand, ThreePicturesMakeAStack) {
    const cv::Mat ground = test::groundTexture({200, 120}, 1, 2.5);
    const auto stackOf = [&](FrameIndex first, FrameIndex last, int layers, Occlusion later = Occlusion::none) {
        LabelledObject each = parked(0, 40);
        each.keyframes.push_back(keyframe(21, each.keyframes[0].box, true));
        each.keyframes[1].occlusion = later;
        return stackObject(each, 20, standing,
                           [&](FrameIndex frame) { return frame >= first && frame <= last ? ground : cv::Mat(); },
                           {.layers = layers});
    };
    EXPECT_EQ(stackOf(19, 21, 25).layers, 3);
    EXPECT_FALSE(stackOf(19, 21, 25).stacked.empty());
    EXPECT_EQ(stackOf(20, 21, 25).layers, 2);
    EXPECT_TRUE(stackOf(20, 21, 25).stacked.empty());
    EXPECT_EQ(stackOf(0, 40, 4).layers, 4);
    EXPECT_EQ(stackOf(0, 40, 0).layers, 1) << "the frame itself in any case";
    EXPECT_EQ(stackOf(0, 40, 7, Occlusion::fully).layers, 4);
    EXPECT_EQ(stackOf(0, 40, 7, Occlusion::partly).layers, 7);
    EXPECT_EQ(stackOf(21, 40, 7).layers, 0);
}

TEST(SampleGridByHand, HasThirtyTwoSamplesAlongABoxAndAsManyAcrossAsItIsWide) {
    const SampleGrid car = SampleGrid::forBox({{0, 0}, 26, 12, 0}, 0.25, 0.5);
    EXPECT_EQ(car.box, cv::Size(37, 17)) << "1.15 · 32, 1.15 · 32 · 12 / 26";
    EXPECT_EQ(car.reach, cv::Size(8, 7));
    EXPECT_EQ(SampleGrid::forBox({{0, 0}, 100, 4, 0}, 0.01, 0.01).box, cv::Size(37, 9)) << "eight at least";
    EXPECT_EQ(SampleGrid::forBox({{0, 0}, 100, 4, 0}, 0.01, 0.01).reach, cv::Size(1, 1));
    EXPECT_EQ(SampleGrid::forBox({{0, 0}, 10, 30, 0}, 1, 1).box, cv::Size(37, 55)) << "48 at most";
    EXPECT_EQ(SampleGrid::forBox({{0, 0}, 0.5, 0.5, 0}, 1, 1).box, cv::Size(37, 18)) << "of a pixel's length";
}

TEST(SampleGridByHand, MovesBoxesInTheirOwnAxes) {
    const SampleGrid grid = SampleGrid::forBox({{0, 0}, 26, 12, 0}, 0.25, 0.5);
    const double along = 26 * 1.15 / 37, across = 12 * 1.15 / 17;
    const OrientedBox ahead = grid.moved({{100, 60}, 26, 12, 0}, {2, -3}, 0);
    EXPECT_NEAR(ahead.centre.x, 100 + 2 * along, 1e-9);
    EXPECT_NEAR(ahead.centre.y, 60 - 3 * across, 1e-9);
    const OrientedBox down = grid.moved({{100, 60}, 26, 12, CV_PI / 2}, {2, -3}, 0);
    EXPECT_NEAR(down.centre.x, 100 + 3 * across, 1e-9);
    EXPECT_NEAR(down.centre.y, 60 + 2 * along, 1e-9);
    EXPECT_NEAR(grid.moved({{100, 60}, 26, 12, 3}, {}, 0.5).heading, 3.5 - 2 * CV_PI, 1e-9);
    EXPECT_EQ(grid.moved({{100, 60}, 26, 12, 3}, {}, 0.5).centre, cv::Point2d(100, 60));
}

TEST(SampleGridByHand, CutsWhatLiesInAndAroundTheBox) {
    cv::Mat slope(120, 200, CV_8UC1);
    for (int y = 0; y < slope.rows; ++y)
        for (int x = 0; x < slope.cols; ++x)
            slope.at<unsigned char>(y, x) = cv::saturate_cast<unsigned char>(x + 0.5 * y);
    for (const double heading : {0.0, 0.7, CV_PI / 2}) {
        const OrientedBox box{{100, 60}, 26, 12, heading};
        const SampleGrid grid = SampleGrid::forBox(box, 0.25, 0.5);
        for (const cv::Size around : {cv::Size(), cv::Size(3, 5)}) {
            const cv::Mat chip = grid.cut(slope, box, around);
            ASSERT_EQ(chip.size(), cv::Size(37 + 2 * around.width, 17 + 2 * around.height));
            for (int y = 0; y < chip.rows; ++y)
                for (int x = 0; x < chip.cols; ++x) {
                    const cv::Point2d at = box.toImage(
                        {(x - (chip.cols - 1) / 2.0) * 26 * 1.15 / 37, (y - (chip.rows - 1) / 2.0) * 12 * 1.15 / 17});
                    ASSERT_NEAR(chip.at<unsigned char>(y, x), at.x + 0.5 * at.y, 1.2) << heading << x << " " << y;
                }
        }
    }
}

TEST(WayInPictures, IsFoundFromAHandAtTheBeginWhateverSideTheBoxesAreOff) {
    const SampleGrid grid = SampleGrid::forBox(driving(0), 0.4, 0.6);
    for (const cv::Point2d& speed : {cv::Point2d(0.5, 0.3), {-0.5, 0.3}, {0.5, -0.3}, {-0.5, -0.3}}) {
        auto places = placesOff(16, [&](std::size_t i) { return speed * static_cast<double>(i); });
        places[0].by_hand = true;
        EXPECT_GT(worstOff(places, grid), 8);
        findWayInPictures(places, grid);
        EXPECT_LT(worstOff(places, grid), 0.8) << speed;
        EXPECT_EQ(places[0].found, cv::Point2d(0, 0)) << "the hand is right";
    }
}

TEST(WayInPictures, KeepsToTheHandsOnBothSides) {
    const SampleGrid grid = SampleGrid::forBox(driving(0), 0.4, 0.6);
    auto places = placesOff(17, [](std::size_t i) {
        return cv::Point2d(0.6, 0.4) * static_cast<double>(std::min<std::size_t>(i, 16 - i));
    });
    places[0].by_hand = places[16].by_hand = true;
    findWayInPictures(places, grid);
    EXPECT_LT(worstOff(places, grid), 1.7) << "1.24 px where it turns back, as places are smoothed over seven frames";
    // A hand is believed where it is, even where the picture shows the car elsewhere.
    auto wrong = placesOff(5, [](std::size_t) { return cv::Point2d(3, 0); });
    wrong[0].by_hand = true;
    findWayInPictures(wrong, grid);
    for (const PicturePlace& place : wrong) EXPECT_NEAR(cv::norm(place.found), 0, 0.3);
}

TEST(WayInPictures, WhatLooksLikeNothingKnownStays) {
    const SampleGrid grid = SampleGrid::forBox(driving(0), 0.4, 0.6);
    auto places = placesOff(6, [](std::size_t) { return cv::Point2d(0, 0); });
    places[0].by_hand = true;
    for (std::size_t i = 1; i < places.size(); ++i) {
        places[i].picture = cv::Mat(200, 300, CV_8UC1);
        cv::RNG dice(i);
        dice.fill(places[i].picture, cv::RNG::UNIFORM, 0, 256);
    }
    findWayInPictures(places, grid);
    for (const PicturePlace& place : places) EXPECT_LT(cv::norm(place.found), 0.5);
    auto none = placesOff(6, [](std::size_t i) { return cv::Point2d(0.5, 0) * static_cast<double>(i); });
    for (PicturePlace& place : none) place.picture.release();
    none[0].by_hand = true;
    findWayInPictures(none, grid);
    for (const PicturePlace& place : none) {
        EXPECT_EQ(place.found, cv::Point2d(0, 0));
        EXPECT_EQ(place.turn, 0);
    }
    std::vector<PicturePlace> empty;
    findWayInPictures(empty, grid);
    EXPECT_TRUE(empty.empty());
}

TEST(WayInPictures, BoxesAreTurnedAsTheVehicleIs) {
    const SampleGrid grid = SampleGrid::forBox(driving(0), 0.4, 0.6);
    for (const double slower : {0.02, -0.02}) {
        auto places = placesOff(12, [](std::size_t) { return cv::Point2d(0, 0); });
        for (std::size_t i = 0; i < places.size(); ++i) places[i].box.heading += slower * static_cast<double>(i);
        places[0].by_hand = true;
        findWayInPictures(places, grid);
        for (const PicturePlace& place : places) EXPECT_NEAR(wrapPi(place.box.heading + place.turn), 0.3, 0.06);
        EXPECT_LT(worstOff(places, grid), 1);
    }
}

TEST(WayInPictures, AHandThatTheBorderCutsCountsOnlyWhereNoOtherIs) {
    const SampleGrid grid = SampleGrid::forBox(driving(0), 0.4, 0.6);
    auto places = placesOff(9, [](std::size_t i) { return i == 8 ? cv::Point2d(-9, 0) : cv::Point2d(0, 0); });
    places[0].by_hand = places[8].by_hand = true;
    places[8].whole = false;
    findWayInPictures(places, grid);
    for (std::size_t i = 0; i < 6; ++i) EXPECT_LT(cv::norm(places[i].found), 0.6) << i;
    places[0].by_hand = false;
    places[8].box.centre = driving(8).centre;
    findWayInPictures(places, grid);
    for (const PicturePlace& place : places) {
        EXPECT_FALSE(place.likeness.empty());
        EXPECT_LT(cv::norm(place.found), 0.6);
    }
}

}  // namespace eyrie::keyframe_limits_by_hand_test
