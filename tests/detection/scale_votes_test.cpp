// At what scale something that moves looks like a vehicle: the drawn one is 40 × 16 px and, as the options say, 4.4
// × 1.76 m.
#include "detection/sliding_window/scale_votes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <opencv2/imgproc.hpp>

#include "detection/trained_window_model.h"

namespace eyrie::scale_votes_test {
namespace {

using test::drivenScene;
using test::DrivenScene;

constexpr double kTrue = 0.11;  // m/px
constexpr ScaleRange kOnlyTrue{kTrue, kTrue};

const ScaleLooker& looker() {
    static const ScaleLooker made([] {
        SlidingWindowOptions options = test::drivenSceneWindow();
        options.rejection_margin = SlidingWindowOptions::kNoRejection;  // so small a model gives windows up too early
        return options;
    }());
    return made;
}

std::vector<cv::Point2f> placesOf(const DrivenScene& scene) {
    std::vector<cv::Point2f> places;
    for (const MotionVector& vector : scene.motion.motion_vectors) places.push_back(vector.position);
    return places;
}

/// Places in the axes of a box: ahead of its middle and to the right of it.
std::vector<cv::Point2f> onBox(const OrientedBox& box, const std::vector<cv::Point2d>& places) {
    std::vector<cv::Point2f> in_image;
    for (const cv::Point2d& place : places) in_image.emplace_back(box.toImage(place));
    return in_image;
}

/// Eight places that spread so far along and across the vehicle, and some more.
std::vector<cv::Point2d> spread(double along, double across, const std::vector<cv::Point2d>& more = {}) {
    std::vector<cv::Point2d> places = more;
    for (const double x : {-0.5, -0.2, 0.2, 0.5}) {
        for (const double y : {-0.5, 0.5}) places.emplace_back(x * along, y * across);
    }
    return places;
}

/// The window of 40 × 16 px that votes where nothing but the looks decides.
OrientedBox windowOn(const DrivenScene& scene) {
    const auto found = looker().votesOn(scene.frame.gray, scene.vehicle, placesOf(scene), kOnlyTrue);
    return {found.at(0).place, 40, 16, scene.vehicle.heading};
}

/// Whether it votes with motion vectors at these places in it.
bool votes(const DrivenScene& scene, const std::vector<cv::Point2d>& places) {
    const auto found = looker().votesOn(scene.frame.gray, scene.vehicle, onBox(windowOn(scene), places), kOnlyTrue);
    return !found.empty() && cv::norm(found[0].place - windowOn(scene).centre) < 1;
}

}  // namespace

TEST(ScaleVotes, AVehicleVotesOnceAtTheScaleThatGivesItItsSize) {
    for (const double heading : {0.0, 0.8, 2.5, -1.7}) {
        const DrivenScene scene = drivenScene(heading);
        const auto found =
            looker().votesOn(scene.frame.gray, scene.cluster.box, placesOf(scene), ScaleRange{0.05, 0.25});
        ASSERT_EQ(found.size(), 1U) << heading;
        EXPECT_NEAR(std::log(found[0].gsd_m_per_px / kTrue), 0, 0.15) << heading << ": scales are 12 % apart";
        const cv::Point2d off = scene.vehicle.toBox(found[0].place);
        EXPECT_NEAR(off.x, 0, 5) << heading << ": a roof is as plain in front as behind";
        EXPECT_NEAR(off.y, 0, 2) << heading;
        EXPECT_GE(found[0].decision, 6) << heading << ": sure";
    }
}

TEST(ScaleVotes, OnlyScalesOfTheRangeAreLookedAt) {
    const DrivenScene scene = drivenScene(0.8);
    const auto within = [&](double finest, double coarsest) {
        return looker().votesOn(scene.frame.gray, scene.cluster.box, placesOf(scene), {finest, coarsest});
    };
    ASSERT_EQ(within(kTrue, kTrue).size(), 1U);
    EXPECT_EQ(within(kTrue, kTrue)[0].gsd_m_per_px, kTrue);
    EXPECT_TRUE(within(0.2, 0.4).empty()) << "it is no car of 22 px";
    EXPECT_TRUE(within(kTrue, 0.1).empty());
}

TEST(ScaleVotes, EmptyRoadHasNoVote) {
    const DrivenScene scene = drivenScene(0.8);
    const cv::Mat road(scene.frame.gray.size(), CV_8UC1, cv::Scalar(90));
    EXPECT_TRUE(looker().votesOn(road, scene.cluster.box, placesOf(scene), {0.05, 0.25}).empty());
}

TEST(ScaleVotes, OneEndThatMovesIsEnoughToFindTheWhole) {
    const DrivenScene scene = drivenScene(0.8);
    const OrientedBox front{scene.vehicle.toImage({7, 2}), 26, 8, 0.8};
    std::vector<cv::Point2d> places;
    for (const double x : {-5.5, 0.0, 6.0, 12.0, 19.5}) {
        for (const double y : {-1.5, 5.8}) places.emplace_back(x, y);
    }
    const auto found = looker().votesOn(scene.frame.gray, front, onBox(scene.vehicle, places), kOnlyTrue);
    ASSERT_EQ(found.size(), 1U);
    EXPECT_LT(cv::norm(found[0].place - windowOn(scene).centre), 1.5);
}

TEST(ScaleVotes, AVehicleIsFilledByItsVectors) {
    const DrivenScene scene = drivenScene(0.8);
    EXPECT_TRUE(votes(scene, spread(26, 12)));
    EXPECT_FALSE(votes(scene, spread(22, 12))) << "less than six tenths of its length";
    EXPECT_TRUE(votes(scene, spread(34, 8.2)));
    EXPECT_FALSE(votes(scene, spread(34, 6.2))) << "less than 45 % of its width";
    EXPECT_TRUE(votes(scene, {{-16, -6}, {16, 6}, {16, -6}, {-16, 6}}));
    EXPECT_FALSE(votes(scene, {{-16, -6}, {16, 6}, {16, -6}})) << "fewer than four";
}

TEST(ScaleVotes, AVectorLiesUpToAPixelBesideItsVehicle) {
    const DrivenScene scene = drivenScene(0.8);
    const std::vector<cv::Point2d> middle{{-13, -5}, {13, 5}, {0, 0}};  // with another, just enough
    for (const int side : {-1, 1}) {
        const auto withOneMore = [&](double ahead, double beside) {
            std::vector<cv::Point2d> places = middle;
            places.emplace_back(side * ahead, side * beside);
            return places;
        };
        EXPECT_TRUE(votes(scene, withOneMore(20.6, 0))) << side;
        EXPECT_FALSE(votes(scene, withOneMore(21.4, 0))) << side;
        EXPECT_TRUE(votes(scene, withOneMore(0, 8.6))) << side;
        EXPECT_FALSE(votes(scene, withOneMore(0, 9.4))) << side;
    }
}

TEST(ScaleVotes, WhatGoesOnBesideTheWindowIsSomethingLarger) {
    const DrivenScene scene = drivenScene(0.8);
    // Beyond the 20 px of half a length and one of margin: 6 px are its surroundings; along the width 8, 1 and 2.4.
    const auto beyond = [](double ahead, double beside, int count) {
        std::vector<cv::Point2d> places;
        for (int i = 0; i < count; ++i) places.emplace_back(ahead, beside);
        return places;
    };
    EXPECT_TRUE(votes(scene, spread(34, 12, beyond(24, 0, 2)))) << "eight of ten are held";
    EXPECT_FALSE(votes(scene, spread(34, 12, beyond(24, 0, 3))));
    EXPECT_FALSE(votes(scene, spread(34, 12, beyond(-24, 0, 3))));
    EXPECT_FALSE(votes(scene, spread(34, 12, beyond(0, 10.2, 3))));
    EXPECT_FALSE(votes(scene, spread(34, 12, beyond(0, -10.2, 3))));
    EXPECT_TRUE(votes(scene, spread(34, 12, beyond(29, 0, 9)))) << "another vehicle's";
    EXPECT_TRUE(votes(scene, spread(34, 12, beyond(0, 13.5, 9))));
}

TEST(ScaleVotes, DotsAndHousesAreNotLookedAt) {
    const DrivenScene scene = drivenScene(0);
    const auto votesAt = [&](double factor) {
        cv::Mat picture;
        cv::resize(scene.frame.gray, picture, {}, factor, factor, factor < 1 ? cv::INTER_AREA : cv::INTER_LINEAR);
        OrientedBox moving = scene.cluster.box;
        moving.centre = (moving.centre + cv::Point2d(0.5, 0.5)) * factor - cv::Point2d(0.5, 0.5);
        moving = {moving.centre, moving.length * factor, moving.width * factor, moving.heading};
        std::vector<cv::Point2f> places;
        for (const cv::Point2f& place : placesOf(scene))
            places.emplace_back((place + cv::Point2f(0.5F, 0.5F)) * factor - cv::Point2f(0.5F, 0.5F));
        return looker().votesOn(picture, moving, places, {kTrue / factor, kTrue / factor}).size();
    };
    EXPECT_EQ(votesAt(0.5), 1U) << "20 px";
    EXPECT_EQ(votesAt(0.19), 0U) << "7.6 px";
    EXPECT_EQ(votesAt(6), 1U) << "240 px";
    EXPECT_EQ(votesAt(6.5), 0U) << "260 px";
}

}  // namespace eyrie::scale_votes_test
