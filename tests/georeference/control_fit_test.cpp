#include "georeference/control_fit.h"

#include <gmock/gmock.h>

#include <cmath>
#include <random>

#include "georeference/geo_reference.h"
#include "georeference/video_world.h"

namespace eyrie::control_fit_test {
namespace {

const GeoPoint kMarket{48.137, 11.575};

/// A view from aside: metres east and north of a pixel of frame 0, with a horizon far above the picture.
const cv::Matx33d kOblique{0.5, 0.02, -50, 0.01, -0.6, 40, 0, 0.0004, 1};

cv::Point2d onGround(cv::Point2d px) {
    const cv::Vec3d at = kOblique * cv::Vec3d(px.x, px.y, 1);
    return {at[0] / at[2], at[1] / at[2]};
}

ControlPoint control(FrameIndex frame, cv::Point2d px, cv::Point2d px_of_first, cv::Point2d astray = {0, 0}) {
    return {frame, px, LocalPlane(kMarket).placeOf(onGround(px_of_first) + astray)};
}

/// The camera moves by 2 px a frame to the right, so that the ground moves to the left; no frame fits after `cut`.
CameraMotion flightOver(int frames, int cut = -1) {
    std::vector<Homography> steps;
    for (int frame = 1; frame < frames; ++frame) {
        if (frame == cut) continue;
        Homography step;
        step.from_frame = frame - 1;
        step.to_frame = frame;
        step.matrix(0, 2) = -2;
        steps.push_back(step);
    }
    return CameraMotion(steps);
}

GeoFootage market(const std::vector<ControlPoint>& points, int cut = -1) {
    GeoFootage footage;
    footage.image_size = {200, 100};
    footage.last_frame = 99;
    footage.camera = flightOver(100, cut);
    footage.control = points;
    return footage;
}

std::vector<ControlPoint> corners() {
    return {control(0, {10, 10}, {10, 10}), control(0, {190, 12}, {190, 12}), control(0, {185, 95}, {185, 95}),
            control(0, {8, 90}, {8, 90})};
}

double metresBetween(const std::optional<GeoPoint>& found, cv::Point2d truth_px) {
    if (!found) return 1e9;
    const LocalPlane plane(kMarket);
    return cv::norm(plane.metresOf(*found) - onGround(truth_px));
}

TEST(ControlFit, FourPointsLayEveryPixelOnTheEarth) {
    const GeoReference places = GeoReference::byControl(market(corners()));
    ASSERT_TRUE(places.known());
    for (const cv::Point2d px : {cv::Point2d(0, 0), cv::Point2d(100, 50), cv::Point2d(199, 99), cv::Point2d(60, 80)})
        EXPECT_LT(metresBetween(places.placeOf(0, px), px), 0.01);
    EXPECT_THAT(places.origin(), testing::HasSubstr("4 control points placed by hand"));
}

TEST(ControlFit, TheRegistrationCarriesThemToOtherFrames) {
    const GeoReference places = GeoReference::byControl(market(corners()));
    // In frame 40 the ground of pixel (100, 50) of frame 0 lies 80 px to the left.
    EXPECT_LT(metresBetween(places.placeOf(40, {20, 50}), {100, 50}), 0.01);
    EXPECT_LT(metresBetween(places.placeOf(99, {100, 50}), {298, 50}), 0.05);
}

TEST(ControlFit, PointsOfSeveralFramesCountTogether) {
    const std::vector<ControlPoint> spread{control(0, {10, 10}, {10, 10}), control(10, {170, 12}, {190, 12}),
                                           control(20, {145, 95}, {185, 95}), control(30, {8, 90}, {68, 90})};
    const GeoReference places = GeoReference::byControl(market(spread));
    EXPECT_LT(metresBetween(places.placeOf(0, {100, 50}), {100, 50}), 0.05);
}

TEST(ControlFit, MorePointsAreFittedAndTheirErrorsAreTold) {
    std::mt19937 dice(5);
    std::normal_distribution<double> astray(0, 1);
    std::vector<ControlPoint> points;
    for (int i = 0; i < 40; ++i) {
        const cv::Point2d px(5 + (i * 37) % 190, 5 + (i * 23) % 90);
        points.push_back(control(0, px, px, {astray(dice), astray(dice)}));
    }
    const auto fits = fitControlPoints(points, {}, LocalPlane(kMarket));
    ASSERT_EQ(fits.size(), 1U);
    EXPECT_EQ(fits[0].points, 40);
    EXPECT_NEAR(fits[0].rms_m, std::sqrt(2.0), 0.3) << "a metre east and a metre north";
    const GeoReference places = GeoReference::byControl(market(points));
    EXPECT_LT(metresBetween(places.placeOf(0, {100, 50}), {100, 50}), 0.7);
}

TEST(ControlFit, PointsOnALineOrTooFewSayNothingAndWhy) {
    std::vector<std::string> why;
    std::vector<ControlPoint> line;
    for (int i = 0; i < 6; ++i)
        line.push_back(control(0, {10.0 + 20 * i, 10.0 + 10 * i}, {10.0 + 20 * i, 10.0 + 10 * i}));
    EXPECT_FALSE(GeoReference::byControl(market(line), &why).known());
    ASSERT_EQ(why.size(), 1U);
    EXPECT_THAT(why[0], testing::HasSubstr("lie on a line"));
    why.clear();
    std::vector<ControlPoint> three = corners();
    three.pop_back();
    EXPECT_FALSE(GeoReference::byControl(market(three), &why).known());
    EXPECT_THAT(why.at(0), testing::HasSubstr("four are needed"));
    const std::vector<ControlPoint> same(5, control(0, {10, 10}, {10, 10}));
    EXPECT_FALSE(GeoReference::byControl(market(same)).known());
    EXPECT_FALSE(GeoReference::byControl(market({})).known());
}

TEST(ControlFit, AWrongPointIsNamedWhereOneStandsOut) {
    std::vector<ControlPoint> points = corners();
    points.push_back(control(0, {100, 50}, {100, 50}));
    points.push_back(control(0, {50, 30}, {50, 30}, {20, -15}));  // typed wrongly
    std::vector<ControlPoint> five = points;
    five.erase(five.begin() + 4);
    points.push_back(control(0, {150, 70}, {150, 70}));
    const auto fits = fitControlPoints(points, {}, LocalPlane(kMarket));
    ASSERT_EQ(fits.size(), 1U);
    EXPECT_TRUE(fits[0].doubtful);
    ASSERT_TRUE(fits[0].suspect);
    EXPECT_EQ(*fits[0].suspect, 5U);
    EXPECT_THAT(remarkOn(fits[0]), testing::HasSubstr("without point 6"));
    ASSERT_EQ(fits[0].residuals.size(), points.size());
    EXPECT_EQ(fits[0].residuals[5].point, 5U);
    EXPECT_GT(fits[0].residuals[5].metres, 3);
    // Without one of five the others always agree.
    const auto less = fitControlPoints(five, {}, LocalPlane(kMarket));
    ASSERT_EQ(less.size(), 1U);
    EXPECT_TRUE(less[0].doubtful);
    EXPECT_FALSE(less[0].suspect);
    EXPECT_THAT(remarkOn(less[0]), testing::HasSubstr("a sixth point would tell"));
    const auto good = fitControlPoints(corners(), {}, LocalPlane(kMarket));
    EXPECT_FALSE(good.at(0).doubtful);
    EXPECT_EQ(remarkOn(good[0]), "");
}

TEST(ControlFit, AMirrorImageIsNoPicture) {
    std::vector<ControlPoint> points = corners();
    for (ControlPoint& point : points) {
        const cv::Point2d ground = LocalPlane(kMarket).metresOf(point.place);
        point.place = LocalPlane(kMarket).placeOf({ground.y, ground.x});
    }
    std::vector<std::string> why;
    EXPECT_FALSE(GeoReference::byControl(market(points), &why).known());
    ASSERT_EQ(why.size(), 1U);
    EXPECT_THAT(why[0], testing::HasSubstr("mirror image"));
}

TEST(ControlFit, AHorizonInThePictureSaysNothingAndWhy) {
    // All points lie below row 50, and so does what they say of the ground.
    const cv::Matx33d steep{0.5, 0, -50, 0, -0.6, 10, 0, -0.02, 1};
    std::vector<ControlPoint> points;
    for (const cv::Point2d px : {cv::Point2d(10, 5), {190, 8}, {180, 40}, {20, 35}}) {
        const cv::Vec3d at = steep * cv::Vec3d(px.x, px.y, 1);
        points.push_back({0, px, LocalPlane(kMarket).placeOf({at[0] / at[2], at[1] / at[2]})});
    }
    std::vector<std::string> why;
    const GeoReference places = GeoReference::byControl(market(points), &why);
    EXPECT_FALSE(places.known());
    EXPECT_TRUE(places.origin().empty());
    ASSERT_EQ(why.size(), 1U);
    EXPECT_THAT(why[0], testing::HasSubstr("horizon"));
}

TEST(ControlFit, BeyondACutNothingIsKnownUnlessItHasPointsOfItsOwn) {
    const GeoReference one = GeoReference::byControl(market(corners(), 50));
    EXPECT_TRUE(one.placeOf(49, {100, 50}));
    EXPECT_FALSE(one.placeOf(50, {100, 50}));
    std::vector<ControlPoint> both = corners();
    for (const ControlPoint& point : corners()) {
        both.push_back(point);
        both.back().frame = 60;
    }
    const GeoReference two = GeoReference::byControl(market(both, 50));
    EXPECT_LT(metresBetween(two.placeOf(60, {100, 50}), {100, 50}), 0.01);
}

TEST(ControlFit, TheyCountWithoutAnyMetadata) {
    const VideoWorld world = videoWorldOf(nullptr, market(corners()));
    EXPECT_TRUE(world.places.known());
    EXPECT_TRUE(world.no_places.empty());
    std::vector<ControlPoint> three = corners();
    three.pop_back();
    EXPECT_THAT(videoWorldOf(nullptr, market(three)).no_places, testing::HasSubstr("four are needed"));
}

}  // namespace
}  // namespace eyrie::control_fit_test
