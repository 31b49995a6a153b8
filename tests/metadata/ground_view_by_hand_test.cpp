// Views of the ground against figures worked out by hand.
#include <gtest/gtest.h>

#include <cmath>

#include "metadata/sensor_attitude.h"
#include "metadata/stated_ground.h"

namespace eyrie::ground_view_by_hand_test {
namespace {

using test::cornersAt;
using test::kImage;
using test::kNorthPerDegree;
using test::kNorthUp;
using test::kPerDegree;
using test::set;
using test::stateOf;

/// A square of so many metres a side.
MetadataState squareOf(double side) {
    return cornersAt({cv::Point2d(0, side), {side, side}, {side, 0}, {0, 0}});
}

MetadataState withCentre(MetadataState state, cv::Point2d metres) {
    set(state, tag::kCentreLatitude, metres.y / kNorthPerDegree);
    set(state, tag::kCentreLongitude, metres.x / kPerDegree);
    return state;
}

double degreesOfTangent(double tangent_of_half) {
    return 2 * std::atan(tangent_of_half) * 180 / CV_PI;
}

/// Straight down from 1000 m to the north, 1 m a pixel.
MetadataState downward() {
    return stateOf({{tag::kSensorLatitude, 0},
                    {tag::kSensorLongitude, 0},
                    {tag::kSensorAltitude, 1200},
                    {tag::kCentreElevation, 200},
                    {tag::kPlatformHeading, 0},
                    {tag::kSensorAzimuth, 0},
                    {tag::kSensorElevation, -90},
                    {tag::kHorizontalView, degreesOfTangent(0.1)}});
}

/// Where the middle of the picture lies, metres from the sensor.
cv::Point2d middleBy(const MetadataState& state) {
    const auto place = groundViewOf(state, kImage).placeOf({99.5, 49.5});
    return place ? cv::Point2d(place->longitude_deg * kPerDegree, place->latitude_deg * kNorthPerDegree)
                 : cv::Point2d(1e9, 1e9);
}

}  // namespace

TEST(GroundViewByHand, ATrapezoidHasTheScaleOfItsMiddle) {
    // In shares u, v of the picture: x = (200 u + 50 v − 50) / (1 + v), y = 300 (1 − v) / (1 + v). In the middle
    // dx/du = 200 / 1.5 over 200 px, dy/dv = −600 / 1.5² over 100 px.
    const MetadataState state = cornersAt({cv::Point2d(-50, 300), {150, 300}, {100, 0}, {0, 0}});
    const GroundView view = groundViewOf(state, kImage);
    EXPECT_NEAR(view.gsd_x_m_per_px.value_or(0), 2.0 / 3, 1e-4);
    EXPECT_NEAR(view.gsd_y_m_per_px.value_or(0), 8.0 / 3, 1e-4);
    EXPECT_NEAR(view.gsd().value_or(0), 4.0 / 3, 1e-4);
    EXPECT_NEAR(view.north_deg.value_or(0), 270, 1e-3);
    const auto middle = view.placeOf({99.5, 49.5});
    ASSERT_TRUE(middle);
    EXPECT_NEAR(middle->longitude_deg * kPerDegree, 50, 0.01);
    EXPECT_NEAR(middle->latitude_deg * kNorthPerDegree, 100, 0.01);
    // ε above the horizon of v = −1 the ground is 600 m / ε away; no plane reaches beyond 2,000 km.
    const auto upTo = [&](double metres) { return view.placeOf({99.5, -100.5 + 100 * 600 / metres}).has_value(); };
    EXPECT_TRUE(upTo(1.9e6));
    EXPECT_FALSE(upTo(2.1e6));
}

TEST(GroundViewByHand, NorthOfASkewedPicture) {
    // A pixel to the right is (0.5, 0) m, one down (1, −0.5) m: 4 right and 2 up are (2 − 2, 1) m.
    const std::array<cv::Point2d, 4> skewed{cv::Point2d(0, 50), {100, 50}, {200, 0}, {100, 0}};
    const GroundView view = groundViewOf(cornersAt(skewed), kImage);
    EXPECT_NEAR(view.north_deg.value_or(0), 360 - std::atan2(2, 4) * 180 / CV_PI, 0.01);
    EXPECT_NEAR(view.gsd_x_m_per_px.value_or(0), 0.5, 1e-4);
    EXPECT_NEAR(view.gsd_y_m_per_px.value_or(0), std::sqrt(1.25), 1e-3);
    // The centre of the frame may be as far off as the longer diagonal, 206 m, not the shorter, 50 m.
    EXPECT_EQ(groundViewOf(withCentre(cornersAt(skewed), {100, 175}), kImage).source, GroundSource::corners);
    EXPECT_EQ(groundViewOf(withCentre(cornersAt(skewed), {100, 240}), kImage).source, GroundSource::none);
    // The diagonals of 100 m by 50 m measure 111.8 m.
    EXPECT_EQ(groundViewOf(withCentre(cornersAt(kNorthUp), {50 + 110, 25}), kImage).source, GroundSource::corners);
    EXPECT_EQ(groundViewOf(withCentre(cornersAt(kNorthUp), {50 + 114, 25}), kImage).source, GroundSource::none);
    EXPECT_EQ(groundViewOf(withCentre(cornersAt(kNorthUp), {50, 25 - 110}), kImage).source, GroundSource::corners);
    EXPECT_EQ(groundViewOf(withCentre(cornersAt(kNorthUp), {50, 25 - 114}), kImage).source, GroundSource::none);
    // Those of this trapezoid hypot(150, 300) or 335.4 m; its middle lies at (50, 100).
    for (const double mirrored : {1.0, -1.0}) {
        MetadataState trapezoid = cornersAt({cv::Point2d(-50, 300), {150, 300}, {100, 0}, {0, 0}});
        if (mirrored < 0) trapezoid = cornersAt({cv::Point2d(0, 300), {100, 300}, {150, 0}, {-50, 0}});
        const double middle = mirrored < 0 ? 200 : 100;
        EXPECT_EQ(groundViewOf(withCentre(trapezoid, {50 + 334, middle}), kImage).source, GroundSource::corners);
        EXPECT_EQ(groundViewOf(withCentre(trapezoid, {50 + 337, middle}), kImage).source, GroundSource::none);
    }
    MetadataState half = cornersAt(kNorthUp);
    set(half, tag::kCentreLatitude, 1);
    EXPECT_EQ(groundViewOf(half, kImage).source, GroundSource::corners) << "half a centre says nothing";
}

TEST(GroundViewByHand, SidesAreFrom5CentimetresTo200Kilometres) {
    EXPECT_EQ(groundViewOf(squareOf(0.06), kImage).source, GroundSource::corners);
    EXPECT_EQ(groundViewOf(squareOf(0.045), kImage).source, GroundSource::none);
    EXPECT_EQ(groundViewOf(squareOf(195e3), kImage).source, GroundSource::corners);
    EXPECT_EQ(groundViewOf(squareOf(210e3), kImage).source, GroundSource::none);
    // A corner between two others, δ m beyond their line, turns by 2 δ / 50 m; a ten-thousandth is needed.
    const auto bent = [](double metres) {
        const std::array<cv::Point2d, 4> corners{cv::Point2d(0, 50), {50, 50 + metres}, {100, 50}, {50, 0}};
        return groundViewOf(cornersAt(corners), kImage).source;
    };
    EXPECT_EQ(bent(0.003), GroundSource::corners);
    EXPECT_EQ(bent(0.002), GroundSource::none);
    EXPECT_EQ(bent(-0.003), GroundSource::none);
}

TEST(GroundViewByHand, ScalesAreFromAMillimetreTo100Metres) {
    // A square over 200 × 100 px has side / 141 m a pixel.
    for (const double side : {0.06, 16e3}) {
        const GroundView view = groundViewOf(squareOf(side), kImage);
        EXPECT_EQ(view.source, GroundSource::corners);
        EXPECT_FALSE(view.gsd()) << side;
        EXPECT_EQ(view.scale_source, GroundSource::none);
        ASSERT_EQ(view.remarks.size(), 1U);
        EXPECT_NE(view.remarks[0].find("m/px is not believed"), std::string::npos) << view.remarks[0];
    }
    EXPECT_NEAR(groundViewOf(squareOf(0.17), kImage).gsd().value_or(0), 0.0012, 1e-5);
    EXPECT_NEAR(groundViewOf(squareOf(13e3), kImage).gsd().value_or(0), 91.9, 0.1);
    const auto byWidth = [](int tag, double metres) { return groundViewOf(stateOf({{tag, metres}}), kImage).gsd(); };
    EXPECT_NEAR(byWidth(tag::kTargetWidth, 0.25).value_or(0), 0.00125, 1e-9);
    EXPECT_FALSE(byWidth(tag::kTargetWidth, 0.18));
    EXPECT_NEAR(byWidth(tag::kTargetWidthExtended, 18e3).value_or(0), 90, 1e-9);
    EXPECT_FALSE(byWidth(tag::kTargetWidthExtended, 22e3));
    EXPECT_NEAR(groundViewOf(stateOf({{tag::kTargetWidth, 80}, {tag::kTargetWidthExtended, 90}}), kImage).gsd().value(),
                0.4, 1e-9)
        << "the plain width first";
}

TEST(GroundViewByHand, TwoScalesAreTheSameWithinAFactorOfTwo) {
    // The corners say 0.5 m/px.
    const auto remarks = [](double metres_per_px) {
        MetadataState state = cornersAt(kNorthUp);
        set(state, tag::kTargetWidth, 200 * metres_per_px);
        const GroundView view = groundViewOf(state, kImage);
        EXPECT_EQ(view.scale_source, GroundSource::corners);
        return view.remarks.size();
    };
    EXPECT_EQ(remarks(0.95), 0U);
    EXPECT_EQ(remarks(1.05), 1U);
    EXPECT_EQ(remarks(0.27), 0U);
    EXPECT_EQ(remarks(0.23), 1U);
}

TEST(GroundViewByHand, CornersLieOnTheEarth) {
    const auto moved = [](double east_deg, double north_deg) {
        MetadataState state = cornersAt(kNorthUp);
        for (auto& [number, value] : state.numbers) value += (number - tag::kCorners) % 2 == 0 ? north_deg : east_deg;
        return groundViewOf(state, kImage);
    };
    EXPECT_EQ(moved(359.5, 0).source, GroundSource::corners);
    EXPECT_EQ(moved(360.5, 0).source, GroundSource::none);
    EXPECT_EQ(moved(-360.5, 0).source, GroundSource::none);
    EXPECT_TRUE(moved(360.5, 0).remarks.empty());
    EXPECT_TRUE(moved(0, 90.5).remarks.empty()) << "beyond the pole is not even a corner";
    EXPECT_EQ(moved(0, 80).source, GroundSource::corners);
    EXPECT_EQ(groundViewOf(cornersAt(kNorthUp), {2, 2}).source, GroundSource::corners);
    EXPECT_EQ(groundViewOf(cornersAt(kNorthUp), {1, 2}).source, GroundSource::none);
    EXPECT_EQ(groundViewOf(cornersAt(kNorthUp), {2, 1}).source, GroundSource::none);
}

TEST(GroundViewByHand, RangeAndFieldOfViewGiveAScale) {
    // 2 · 1000 m · 0.1 over 200 px are 1 m; down the picture the same, stretched by range over height.
    const auto with = [](double sensor_m, std::optional<double> vertical_deg = {}) {
        MetadataState state = stateOf({{tag::kSlantRange, 1000},
                                       {tag::kHorizontalView, degreesOfTangent(0.1)},
                                       {tag::kSensorAltitude, sensor_m},
                                       {tag::kCentreElevation, 200}});
        if (vertical_deg) set(state, tag::kVerticalView, *vertical_deg);
        return groundViewOf(state, kImage);
    };
    const GroundView view = with(700);
    EXPECT_EQ(view.scale_source, GroundSource::slant_range);
    EXPECT_EQ(view.source, GroundSource::none);
    EXPECT_NEAR(view.gsd_x_m_per_px.value_or(0), 1, 1e-9);
    EXPECT_NEAR(view.gsd_y_m_per_px.value_or(0), 2, 1e-9);
    EXPECT_NEAR(view.gsd().value_or(0), std::sqrt(2), 1e-9);
    EXPECT_NEAR(with(700, degreesOfTangent(0.2)).gsd_y_m_per_px.value_or(0), 8, 1e-9) << "2 · 1000 · 0.2 / 100 · 2";
    EXPECT_NEAR(with(225).gsd_y_m_per_px.value_or(0), 40, 1e-9);
    EXPECT_FALSE(with(215).gsd_y_m_per_px) << "flatter than 1 in 50";
    EXPECT_NEAR(with(1195).gsd_y_m_per_px.value_or(0), 1000.0 / 995, 1e-9);
    EXPECT_FALSE(with(1210).gsd_y_m_per_px) << "higher than the range is long";
    EXPECT_NEAR(with(1210).gsd().value_or(0), 1, 1e-9);
    MetadataState far = stateOf({{tag::kSlantRange, 110e3}, {tag::kHorizontalView, degreesOfTangent(0.1)}});
    EXPECT_FALSE(groundViewOf(far, kImage).gsd()) << "110 m a pixel";
    set(far, tag::kSlantRange, 90e3);
    EXPECT_NEAR(groundViewOf(far, kImage).gsd().value_or(0), 90, 1e-6);
}

TEST(SensorAttitude, TheVerticalFieldFollowsFromThePictureWhereItIsNotStated) {
    const auto field = [](std::vector<MetadataPacket::Number> numbers, cv::Size size = kImage) {
        return fieldOfView(stateOf(std::move(numbers)), size);
    };
    // tan 45° · 100 / 200 is a half.
    EXPECT_NEAR(field({{tag::kHorizontalView, 90}})->vertical_deg, 53.130102354, 1e-6);
    EXPECT_NEAR(field({{tag::kHorizontalView, 90}}, {100, 200})->vertical_deg, 126.869897646, 1e-6);
    EXPECT_EQ(field({{tag::kHorizontalView, 90}})->horizontal_deg, 90);
    EXPECT_EQ(field({{tag::kHorizontalView, 90}, {tag::kVerticalView, 30}})->vertical_deg, 30);
    EXPECT_EQ(field({{tag::kHorizontalView, 90}, {tag::kVerticalView, 169.9}})->vertical_deg, 169.9);
    EXPECT_NEAR(field({{tag::kHorizontalView, 90}, {tag::kVerticalView, 170}})->vertical_deg, 53.130102354, 1e-6);
    EXPECT_NEAR(field({{tag::kHorizontalView, 90}, {tag::kVerticalView, 0}})->vertical_deg, 53.130102354, 1e-6);
    EXPECT_TRUE(field({{tag::kHorizontalView, 169.9}}));
    EXPECT_FALSE(field({{tag::kHorizontalView, 170}}));
    EXPECT_TRUE(field({{tag::kHorizontalView, 0.5}}));
    EXPECT_FALSE(field({{tag::kHorizontalView, 0}}));
    EXPECT_FALSE(field({{tag::kVerticalView, 30}}));
    EXPECT_FALSE(field({{tag::kHorizontalView, 90}}, {0, 100}));
}

TEST(SensorAttitude, HeightsAreTakenFromTheSameSurface) {
    const auto height = [](std::vector<MetadataPacket::Number> numbers) {
        return heightAboveGround(stateOf(std::move(numbers)));
    };
    EXPECT_EQ(height({{tag::kSensorAltitude, 1200}, {tag::kCentreElevation, 200}}), 1000);
    EXPECT_EQ(height({{tag::kSensorAltitude, 200}, {tag::kCentreElevation, 200}}), std::nullopt);
    EXPECT_EQ(height({{tag::kSensorAltitude, 100}, {tag::kCentreElevation, 200}}), std::nullopt);
    EXPECT_EQ(height({{tag::kSensorAltitude, 1200}, {tag::kCentreEllipsoidHeight, 200}}), std::nullopt);
    EXPECT_EQ(height({{tag::kSensorEllipsoidHeight, 800}, {tag::kCentreEllipsoidHeight, 300}}), 500);
    EXPECT_EQ(height({{tag::kSensorEllipsoidHeight, 800},
                      {tag::kSensorEllipsoidHeightExtended, 900},
                      {tag::kCentreEllipsoidHeight, 300}}),
              600)
        << "the finer one";
    EXPECT_EQ(height({{tag::kSensorAltitude, 1200},
                      {tag::kCentreElevation, 200},
                      {tag::kSensorEllipsoidHeight, 800},
                      {tag::kCentreEllipsoidHeight, 300}}),
              1000);
}

TEST(SensorAttitude, PitchLooksAheadAndRollToTheSide) {
    const double tangent_10 = 1000 * std::tan(10 * CV_PI / 180), tangent_20 = 1000 * std::tan(20 * CV_PI / 180);
    EXPECT_LT(cv::norm(middleBy(downward())), 0.1);
    MetadataState state = downward();
    set(state, tag::kPlatformPitch, 10);  // the nose goes up, a camera that looks down looks ahead, to the north
    EXPECT_LT(cv::norm(middleBy(state) - cv::Point2d(0, tangent_10)), 0.5);
    set(state, tag::kPlatformPitchFull, 20);  // the one over the full range counts
    EXPECT_LT(cv::norm(middleBy(state) - cv::Point2d(0, tangent_20)), 0.5);
    state = downward();
    set(state, tag::kPlatformRollFull, 10);  // the right wing goes down, the camera looks to the left, to the west
    EXPECT_LT(cv::norm(middleBy(state) - cv::Point2d(-tangent_10, 0)), 0.5);
    set(state, tag::kPlatformRoll, -10);
    EXPECT_LT(cv::norm(middleBy(state) - cv::Point2d(-tangent_10, 0)), 0.5);
    set(state, tag::kPlatformHeading, 90);  // its left is north now
    EXPECT_LT(cv::norm(middleBy(state) - cv::Point2d(0, tangent_10)), 0.5);
    state = downward();
    set(state, tag::kSensorElevation, -80);  // 10° ahead, and to the azimuth of 90°: the east
    set(state, tag::kSensorAzimuth, 90);
    EXPECT_LT(cv::norm(middleBy(state) - cv::Point2d(tangent_10, 0)), 0.5);
    // A camera that is rolled clockwise has its top to the east, so that north lies to the left.
    state = downward();
    set(state, tag::kSensorRoll, 90);
    EXPECT_NEAR(groundViewOf(state, kImage).north_deg.value_or(0), 180, 1e-3);
    set(state, tag::kSensorRoll, 30);
    EXPECT_NEAR(groundViewOf(state, kImage).north_deg.value_or(0), 240, 1e-3);
    // Each of the three angles is needed.
    for (const int number : {tag::kPlatformHeading, tag::kSensorAzimuth, tag::kSensorElevation}) {
        state = downward();
        std::erase_if(state.numbers, [&](const auto& one) { return one.tag == number; });
        EXPECT_EQ(groundViewOf(state, kImage).source, GroundSource::none) << number;
    }
}

TEST(SensorAttitude, RaysThatDipByLessThanADegreeEndNowhere) {
    // Of 2° by 1° the upper corners look half a degree higher than the middle: sin 1.6° − tan 0.5° · cos 1.6° is
    // 0.0192, sin 1.4° − … 0.0157; 0.0175 is needed.
    MetadataState state = downward();
    std::erase_if(state.numbers, [](const auto& one) { return one.tag == tag::kSensorAltitude; });
    set(state, tag::kSlantRange, 2000);
    set(state, tag::kHorizontalView, 2);
    set(state, tag::kSensorElevation, -1.6);
    const GroundView view = groundViewOf(state, kImage);
    EXPECT_EQ(view.source, GroundSource::attitude);
    // The middle is at the end of the range.
    EXPECT_LT(cv::norm(middleBy(state) - cv::Point2d(0, 2000 * std::cos(1.6 * CV_PI / 180))), 1);
    set(state, tag::kSensorElevation, -1.4);
    EXPECT_EQ(groundViewOf(state, kImage).source, GroundSource::none);
}

}  // namespace eyrie::ground_view_by_hand_test
