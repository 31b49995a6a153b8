#include "report/clip/annotator.h"

#include <gtest/gtest.h>

namespace eyrie::annotator_test {
namespace {

const cv::Size kSize(960, 400);  // not enlarged

Frame greyFrame(cv::Size size = kSize) {
    Frame frame;
    frame.gray = cv::Mat(size, CV_8UC1, cv::Scalar(120));
    return frame;
}

TrackState carAt(cv::Point2d centre, TrackId id = 7) {
    TrackState state;
    state.id = id;
    state.box = {centre, 40, 20, 0};
    state.status = TrackStatus::confirmed;
    return state;
}

FrameResult resultWith(std::vector<TrackState> tracks) {
    FrameResult result;
    result.tracks = std::move(tracks);
    return result;
}

enum class Ink { none, yellow, cyan, red, green, dark };

/// What is drawn at a pixel.
Ink inkAt(const cv::Mat& picture, cv::Point at) {
    const cv::Vec3b& pixel = picture.at<cv::Vec3b>(at);
    const bool blue = pixel[0] > 150, green = pixel[1] > 150, red = pixel[2] > 150;
    if (red && green) return Ink::yellow;
    if (blue && green) return Ink::cyan;
    if (red) return Ink::red;
    if (green) return Ink::green;
    return pixel[0] < 60 && pixel[1] < 60 && pixel[2] < 60 ? Ink::dark : Ink::none;
}

int inkedIn(const cv::Mat& picture, cv::Rect area) {
    int count = 0;
    for (int y = area.y; y < area.br().y; ++y) {
        for (int x = area.x; x < area.br().x; ++x) count += inkAt(picture, {x, y}) != Ink::none;
    }
    return count;
}

}  // namespace

TEST(Annotator, SmallPicturesAreEnlargedUpToFourTimes) {
    EXPECT_EQ(annotationZoom({1920, 1080}), 1);
    EXPECT_EQ(annotationZoom({481, 270}), 1);
    EXPECT_EQ(annotationZoom({480, 270}), 2);
    EXPECT_EQ(annotationZoom({320, 240}), 3);
    EXPECT_EQ(annotationZoom({100, 80}), 4);
    EXPECT_EQ(annotationZoom({0, 0}), 4);
    EXPECT_EQ(Annotator().draw(greyFrame({320, 240}), {}).size(), cv::Size(960, 720));
}

TEST(Annotator, EverythingHasItsColourWhereItIs) {
    FrameResult result = resultWith({carAt({700, 300})});
    result.motion.motion_vectors.push_back({1, {100, 100}, {4, 0}, 9});
    MotionCluster cluster;
    cluster.box = {{200, 100}, 40, 20, 0};
    result.clusters = {cluster};
    Detection kept, rejected;
    kept.box = {{300, 100}, 40, 20, 0};
    rejected.box = {{400, 100}, 40, 20, 0};
    rejected.rejection = Rejection::outlier;
    result.detections = {kept, rejected};
    const cv::Mat all = Annotator().draw(greyFrame(), result);
    EXPECT_EQ(inkAt(all, {102, 100}), Ink::yellow);
    EXPECT_EQ(inkAt(all, {118, 100}), Ink::yellow) << "five times as long as the step";
    EXPECT_EQ(inkAt(all, {123, 100}), Ink::none);
    EXPECT_EQ(inkAt(all, {180, 100}), Ink::cyan);
    EXPECT_EQ(inkAt(all, {200, 110}), Ink::cyan);
    EXPECT_EQ(inkAt(all, {200, 100}), Ink::none) << "an outline";
    EXPECT_EQ(inkAt(all, {280, 100}), Ink::red);
    EXPECT_EQ(inkAt(all, {300, 90}), Ink::red);
    EXPECT_EQ(inkAt(all, {380, 100}), Ink::none) << "what was rejected";
    EXPECT_EQ(inkAt(all, {680, 300}), Ink::green);
    EXPECT_EQ(inkAt(all, {720, 300}), Ink::green);
    EXPECT_EQ(inkAt(all, {700, 310}), Ink::green);
    const cv::Mat tracks = Annotator(Annotator::Parts::tracks).draw(greyFrame(), result);
    EXPECT_EQ(inkAt(tracks, {180, 100}), Ink::none);
    EXPECT_EQ(inkAt(tracks, {680, 300}), Ink::green);
}

TEST(Annotator, PixelsOfEnlargedPicturesLieOnTheirMiddles) {
    // Enlarged three times: pixel x covers 3 x to 3 x + 2.
    const cv::Mat picture = Annotator().draw(greyFrame({320, 240}), resultWith({carAt({100, 100})}));
    EXPECT_EQ(inkAt(picture, {3 * 80 + 1, 3 * 100 + 1}), Ink::green);
    EXPECT_EQ(inkAt(picture, {3 * 100 + 1, 3 * 110 + 1}), Ink::green);
    EXPECT_EQ(inkAt(picture, {3 * 80 - 2, 3 * 100 + 1}), Ink::none);
    EXPECT_EQ(inkAt(picture, {3 * 80 + 4, 3 * 100 + 1}), Ink::none);
}

TEST(Annotator, ATrailLiesOnTheGroundAndIsFiftyFramesLong) {
    // The ground goes down by 2 px a frame, the car as much, and 10 px to the right.
    Annotator annotator(Annotator::Parts::tracks);
    cv::Mat last;
    constexpr int kFrames = 60;
    for (int frame = 0; frame < kFrames; ++frame) {
        FrameResult result = resultWith({carAt({100.0 + 10 * frame, 100.0 + 2 * frame})});
        result.motion.registration.current_from_previous.matrix(1, 2) = 2;
        if (frame + 1 < kFrames)
            annotator.follow(result);
        else
            last = annotator.draw(greyFrame(), result);
    }
    const int y = 100 + 2 * (kFrames - 1);
    EXPECT_EQ(inkAt(last, {100 + 10 * 40, y}), Ink::green) << "level by now";
    EXPECT_EQ(inkAt(last, {205, y}), Ink::green) << "between the places of frames 10 and 11";
    EXPECT_EQ(inkAt(last, {195, y}), Ink::none);
    EXPECT_EQ(inkAt(last, {100 + 10 * 40, 100 + 2 * 40}), Ink::none);
}

TEST(Annotator, WhatIsNotSureIsNotDrawnAndWhoIsGoneLeavesNoTrail) {
    TrackState tentative = carAt({300, 300});
    tentative.status = TrackStatus::tentative;
    Annotator annotator;
    annotator.follow(resultWith({carAt({100, 100}, 3), carAt({100, 200}, 4)}));
    const cv::Mat picture = annotator.draw(greyFrame(), resultWith({carAt({400, 200}, 4), tentative}));
    EXPECT_EQ(inkAt(picture, {280, 300}), Ink::none);
    EXPECT_EQ(inkAt(picture, {100, 100}), Ink::none);
    EXPECT_EQ(inkAt(picture, {250, 200}), Ink::green) << "from where it was";
}

TEST(Annotator, TheNumberStandsAboveItsBox) {
    const cv::Mat picture = Annotator().draw(greyFrame(), resultWith({carAt({400, 200}, 1111)}));
    EXPECT_GT(inkedIn(picture, {395, 172, 40, 16}), 40) << "right of its middle, above its upper edge at 190";
    EXPECT_EQ(inkedIn(picture, {380, 150, 60, 20}), 0);
    EXPECT_EQ(inkedIn(picture, {385, 213, 60, 20}), 0) << "nor below";
    const cv::Mat enlarged = Annotator().draw(greyFrame({320, 240}), resultWith({carAt({100, 100}, 1111)}));
    EXPECT_GT(inkedIn(enlarged, {295, 252, 40, 16}), 40) << "as large, above its edge at 271";
}

}  // namespace eyrie::annotator_test
