#include <gtest/gtest.h>

#include <cmath>

#include "metadata/stated_ground.h"

namespace eyrie::ground_view_test {

using test::cornersAt;
using test::kImage;
using test::kNorthPerDegree;
using test::kNorthUp;
using test::kPerDegree;
using test::set;
using test::stateOf;

TEST(GroundView, cornersGiveScaleNorthAndPlaces) {
    const GroundView view = groundViewOf(cornersAt(kNorthUp), kImage);
    ASSERT_EQ(view.source, GroundSource::corners);
    EXPECT_NEAR(view.gsd_x_m_per_px.value_or(0), 0.5, 1e-4);  // 100 m over 200 px
    EXPECT_NEAR(view.gsd_y_m_per_px.value_or(0), 0.5, 1e-4);
    EXPECT_NEAR(view.north_deg.value_or(-1), 270, 1e-6);  // up
    const auto middle = view.placeOf({99.5, 49.5});
    ASSERT_TRUE(middle);
    EXPECT_NEAR(middle->longitude_deg * kPerDegree, 50, 0.01);
    EXPECT_NEAR(middle->latitude_deg * kNorthPerDegree, 25, 0.01);
    const auto back = view.pixelOf(*middle);
    ASSERT_TRUE(back);
    EXPECT_NEAR(back->x, 99.5, 1e-6);
    EXPECT_NEAR(back->y, 49.5, 1e-6);
    // The outline lies half a pixel outside the pixels' centres.
    const auto corner = view.placeOf({-0.5, 99.5});
    ASSERT_TRUE(corner);
    EXPECT_NEAR(corner->longitude_deg, 0, 1e-9);
    EXPECT_NEAR(corner->latitude_deg, 0, 1e-9);
}

TEST(GroundView, northTurnsWithTheCamera) {
    // The top of the picture looks east: north is to the left.
    const GroundView east = groundViewOf(cornersAt({cv::Point2d(50, 100), {50, 0}, {0, 0}, {0, 100}}), kImage);
    ASSERT_TRUE(east.north_deg);
    EXPECT_NEAR(*east.north_deg, 180, 1e-6);
}

TEST(GroundView, anObliqueViewHasItsHorizon) {
    // Twice as wide at the top as at the bottom.
    const GroundView view = groundViewOf(cornersAt({cv::Point2d(-50, 300), {150, 300}, {100, 0}, {0, 0}}), kImage);
    ASSERT_EQ(view.source, GroundSource::corners);
    EXPECT_GT(*view.gsd_y_m_per_px, *view.gsd_x_m_per_px);
    EXPECT_FALSE(view.placeOf({100, -150}));  // 100 px above the picture all lines meet
    EXPECT_TRUE(view.placeOf({100, -50}));
    const auto behind = view.pixelOf({-400 / kNorthPerDegree, 0});
    EXPECT_FALSE(behind);
}

TEST(GroundView, impossibleCornersAreNotBelieved) {
    const std::array<cv::Point2d, 4> mirrored{cv::Point2d(100, 50), {0, 50}, {0, 0}, {100, 0}};
    const std::array<cv::Point2d, 4> crossed{cv::Point2d(0, 50), {100, 0}, {100, 50}, {0, 0}};
    const std::array<cv::Point2d, 4> point{};
    const std::array<cv::Point2d, 4> continent{cv::Point2d(0, 5e5), {1e6, 5e5}, {1e6, 0}, {0, 0}};
    for (const auto& corners : {mirrored, crossed, point, continent}) {
        const GroundView view = groundViewOf(cornersAt(corners), kImage);
        EXPECT_EQ(view.source, GroundSource::none);
        EXPECT_FALSE(view.gsd());
        EXPECT_FALSE(view.placeOf({10, 10}));
        EXPECT_EQ(view.remarks.size(), 1U);
    }
    MetadataState elsewhere = cornersAt(kNorthUp);
    set(elsewhere, tag::kCentreLatitude, 1);
    set(elsewhere, tag::kCentreLongitude, 1);
    EXPECT_EQ(groundViewOf(elsewhere, kImage).source, GroundSource::none);
}

TEST(GroundView, offsetsOfCornersTakeTheirPlace) {
    MetadataState state = cornersAt(kNorthUp);
    for (auto& [number, value] : state.numbers) number -= tag::kCorners - tag::kCornerOffsets;
    EXPECT_EQ(groundViewOf(state, kImage).source, GroundSource::none) << "offsets of what?";
    set(state, tag::kCentreLatitude, 0);
    set(state, tag::kCentreLongitude, 0);
    const GroundView view = groundViewOf(state, kImage);
    EXPECT_EQ(view.source, GroundSource::corner_offsets);
    EXPECT_NEAR(view.gsd().value_or(0), 0.5, 1e-3);
}

TEST(GroundView, aMissingCornerIsNotInvented) {
    MetadataState state = cornersAt(kNorthUp);
    std::erase_if(state.numbers, [](const auto& one) { return one.tag == tag::kCorners + 5; });
    EXPECT_EQ(groundViewOf(state, kImage).source, GroundSource::none);
    set(state, tag::kTargetWidth, 80);
    const GroundView view = groundViewOf(state, kImage);
    EXPECT_EQ(view.scale_source, GroundSource::target_width);
    EXPECT_NEAR(view.gsd().value_or(0), 0.4, 1e-9);
    EXPECT_FALSE(view.gsd_y_m_per_px);
    EXPECT_FALSE(view.footprint);
    EXPECT_FALSE(view.north_deg);
}

TEST(GroundView, attitudeCastsTheCornersOntoLevelGround) {
    // Straight down from 1000 m, 53.13° × 28.07°: half widths of 500 m and 250 m. Heading east, the image's top is
    // east.
    const MetadataState down = stateOf({{tag::kSensorLatitude, 0},
                                        {tag::kSensorLongitude, 0},
                                        {tag::kSensorAltitude, 1200},
                                        {tag::kCentreElevation, 200},
                                        {tag::kPlatformHeading, 90},
                                        {tag::kSensorAzimuth, 0},
                                        {tag::kSensorElevation, -90},
                                        {tag::kHorizontalView, 2 * std::atan(0.5) * 180 / CV_PI}});
    const GroundView view = groundViewOf(down, kImage);
    ASSERT_EQ(view.source, GroundSource::attitude);
    EXPECT_NEAR(view.gsd_x_m_per_px.value_or(0), 5, 1e-3);
    EXPECT_NEAR(view.gsd_y_m_per_px.value_or(0), 5, 1e-3);  // the vertical field follows from the picture
    EXPECT_NEAR(view.north_deg.value_or(-1), 180, 1e-6);
    const auto corner = view.placeOf({-0.5, -0.5});
    ASSERT_TRUE(corner);
    EXPECT_NEAR(corner->longitude_deg * kPerDegree, 250, 0.1);
    EXPECT_NEAR(corner->latitude_deg * kNorthPerDegree, 500, 0.1);
    // Azimuth turns like heading; roll of the platform tips the view to the left where the right wing goes down.
    MetadataState turned = down;
    set(turned, tag::kSensorAzimuth, 270);
    EXPECT_NEAR(groundViewOf(turned, kImage).north_deg.value_or(-1), 270, 1e-6);
    MetadataState rolled = down;
    set(rolled, tag::kPlatformRoll, 45);
    const auto middle = groundViewOf(rolled, kImage).placeOf({99.5, 49.5});
    ASSERT_TRUE(middle);
    EXPECT_NEAR(middle->latitude_deg * kNorthPerDegree, 1000, 1);  // left of east is north
}

TEST(GroundView, attitudeNeedsTheGroundInView) {
    MetadataState state = stateOf({{tag::kSensorLatitude, 0},
                                   {tag::kSensorLongitude, 0},
                                   {tag::kSlantRange, 2000},
                                   {tag::kPlatformHeading, 0},
                                   {tag::kSensorAzimuth, 0},
                                   {tag::kSensorElevation, -30},
                                   {tag::kHorizontalView, 20}});
    const GroundView view = groundViewOf(state, kImage);
    ASSERT_EQ(view.source, GroundSource::attitude);  // height from the slant range: 1000 m
    const auto middle = view.placeOf({99.5, 49.5});
    ASSERT_TRUE(middle);
    EXPECT_NEAR(middle->latitude_deg * kNorthPerDegree, 2000 * std::cos(CV_PI / 6), 1);
    set(state, tag::kSensorElevation, -4);  // the upper corners look into the sky
    const GroundView sky = groundViewOf(state, kImage);
    EXPECT_EQ(sky.source, GroundSource::none);
    EXPECT_EQ(sky.scale_source, GroundSource::slant_range);
    EXPECT_NEAR(sky.gsd().value_or(0), 2 * 2000 * std::tan(CV_PI / 18) / 200, 1e-6);
}

TEST(GroundView, aTargetWidthThatDisagreesIsTold) {
    MetadataState state = cornersAt(kNorthUp);
    set(state, tag::kTargetWidth, 1000);
    const GroundView view = groundViewOf(state, kImage);
    EXPECT_NEAR(view.gsd().value_or(0), 0.5, 1e-3);
    EXPECT_EQ(view.remarks.size(), 1U);
    set(state, tag::kTargetWidth, 105);
    EXPECT_TRUE(groundViewOf(state, kImage).remarks.empty());
}

TEST(GroundView, nothingIsKnownOfNothing) {
    const GroundView view = groundViewOf({}, kImage);
    EXPECT_EQ(view.source, GroundSource::none);
    EXPECT_FALSE(view.gsd());
    EXPECT_TRUE(view.remarks.empty());
    EXPECT_FALSE(groundViewOf(cornersAt(kNorthUp), {}).gsd());
}

}  // namespace eyrie::ground_view_test
