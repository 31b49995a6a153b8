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
    // Of six it is named.
    std::vector<ControlPoint> six = points;
    six.pop_back();
    EXPECT_EQ(fitControlPoints(six, {}, LocalPlane(kMarket)).at(0).suspect, 5U);
    const auto good = fitControlPoints(corners(), {}, LocalPlane(kMarket));
    EXPECT_FALSE(good.at(0).doubtful);
    EXPECT_EQ(remarkOn(good[0]), "");
}

TEST(ControlFit, AWrongPointStandsOutAmongOthersThatAreHalfAMetreOff) {
    std::vector<ControlPoint> points;
    const cv::Point2d places[] = {{10, 10}, {190, 12}, {185, 95}, {8, 90}, {100, 50}, {60, 20}, {140, 80}, {50, 70}};
    points.reserve(std::size(places));
    for (std::size_t i = 0; i < std::size(places); ++i) {
        const double off = i % 2 == 0 ? 0.5 : -0.5;
        points.push_back(control(0, places[i], places[i], {off, i % 3 == 0 ? off : -off}));
    }
    points[4] = control(0, places[4], places[4], {25, -15});
    const auto fits = fitControlPoints(points, {}, LocalPlane(kMarket));
    ASSERT_EQ(fits.size(), 1U);
    EXPECT_TRUE(fits[0].doubtful);
    EXPECT_EQ(fits[0].suspect, 4U);
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
    // However the camera is turned, and on whichever side of the horizon the picture's first pixel lies.
    for (const double turn : {0.0, 1.0, 2.0, 3.0, 4.0, 5.0, 6.0}) {
        for (const double steep : {0.0, 0.004, -0.02}) {
            const auto placed = [&](double side) {
                std::vector<ControlPoint> laid;
                for (const cv::Point2d px : {cv::Point2d(110, 60), {190, 62}, {185, 95}, {108, 90}}) {
                    const double depth = std::abs(1 + steep * px.x);
                    const cv::Point2d ground = cv::Point2d(side * px.x, -px.y) / depth;
                    laid.push_back(
                        {0, px,
                         LocalPlane(kMarket).placeOf({std::cos(turn) * ground.x - std::sin(turn) * ground.y,
                                                      std::sin(turn) * ground.x + std::cos(turn) * ground.y})});
                }
                why.clear();
                return fitControlPoints(laid, {}, LocalPlane(kMarket), &why).size();
            };
            // Beyond a horizon the picture is turned over.
            const double upright = 1 + steep * 110 > 0 ? 1 : -1;
            EXPECT_EQ(placed(upright), 1U) << turn << ' ' << steep;
            EXPECT_EQ(placed(-upright), 0U) << turn << ' ' << steep;
            EXPECT_THAT(why, testing::ElementsAre(testing::HasSubstr("mirror image"))) << turn << ' ' << steep;
        }
    }
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

TEST(ControlFit, PointsBehindACutCountWhateverIsWrongBeforeIt) {
    // Before the cut too few, points on a line, or a mirror image; behind it four that are right.
    std::vector<ControlPoint> few = corners(), line, mirrored = corners();
    few.pop_back();
    line.reserve(5);
    for (int i = 0; i < 5; ++i) line.push_back(control(0, {10.0 + 20 * i, 10}, {10.0 + 20 * i, 10}));
    std::swap(mirrored[0].place, mirrored[1].place);
    std::swap(mirrored[2].place, mirrored[3].place);
    for (std::vector<ControlPoint> points : {few, line, mirrored}) {
        for (ControlPoint right : corners()) {
            right.frame = 60;
            points.push_back(right);
        }
        std::vector<std::string> why;
        const GeoReference reference = GeoReference::byControl(market(points, 50), &why);
        EXPECT_EQ(why.size(), 1U);
        EXPECT_FALSE(reference.placeOf(10, {100, 50}));
        EXPECT_LT(metresBetween(reference.placeOf(60, {100, 50}), {100, 50}), 0.01);
    }
}

TEST(ControlFit, TheyCountWithoutAnyMetadata) {
    const VideoWorld world = videoWorldOf(nullptr, market(corners()));
    EXPECT_TRUE(world.places.known());
    EXPECT_TRUE(world.no_places.empty());
    std::vector<ControlPoint> three = corners();
    three.pop_back();
    EXPECT_THAT(videoWorldOf(nullptr, market(three)).no_places, testing::HasSubstr("four are needed"));
}

TEST(ProjectiveMapByHand, IsScaledToOneAndPositiveWhereThePointsLie) {
    // x' = (2 x + 10) / (1 + x / 100), y' = (3 y − 4) / (1 + x / 100).
    const std::vector<cv::Point2d> image{{0, 0}, {100, 0}, {100, 50}, {0, 50}};
    const std::vector<cv::Point2d> plane{{10, -4}, {105, -2}, {105, 73}, {10, 146}};
    const auto map = projectiveMap(image, plane);
    ASSERT_TRUE(map);
    const cv::Matx33d expected{2, 0, 10, 0, 3, -4, 0.01, 0, 1};
    for (int i = 0; i < 9; ++i) EXPECT_NEAR(map->val[i], expected.val[i], 1e-7) << i;
    EXPECT_FALSE(projectiveMap({image.begin(), image.begin() + 3}, {plane.begin(), plane.begin() + 3}));
    EXPECT_FALSE(projectiveMap(image, {plane.begin(), plane.begin() + 3})) << "as many of both";
    // Two corners exchanged: some of the points would lie behind the horizon.
    EXPECT_FALSE(projectiveMap(image, {plane[1], plane[0], plane[2], plane[3]}));
    // Far behind the camera's foot: where the map's last number is negative, the points are still in front.
    const std::vector<cv::Point2d> far{{200, 0}, {300, 0}, {300, 50}, {200, 50}};
    std::vector<cv::Point2d> ground;
    for (const cv::Point2d& p : far) ground.emplace_back(p.x / (p.x / 100 - 1), p.y / (p.x / 100 - 1));
    const auto beyond = projectiveMap(far, ground);
    ASSERT_TRUE(beyond);
    const cv::Matx33d ahead{1, 0, 0, 0, 1, 0, 0.01, 0, -1};
    for (int i = 0; i < 9; ++i) EXPECT_NEAR(beyond->val[i], ahead.val[i], 1e-6) << i;
}

TEST(ProjectiveMapByHand, HowFarPointsMustBeOffALineDoesNotDependOnHowManyThereAre) {
    const auto mapped = [](double off_px, int times) {
        std::vector<cv::Point2d> image, plane;
        for (int i = 0; i < times; ++i)
            for (const cv::Point2d& px : {cv::Point2d(10, 50), {70, 50 + off_px}, {130, 50 - off_px}, {190, 50}}) {
                image.push_back(px);
                plane.push_back(px / 2);
            }
        return projectiveMap(image, plane);
    };
    for (const int times : {1, 25}) {
        EXPECT_FALSE(mapped(0, times)) << times;
        EXPECT_FALSE(mapped(0.2, times)) << times << ": any small error would turn the plane about the line";
        const auto map = mapped(0.5, times);
        ASSERT_TRUE(map) << times;
        const cv::Matx33d half{0.5, 0, 0, 0, 0.5, 0, 0, 0, 1};
        for (int i = 0; i < 9; ++i) EXPECT_NEAR(map->val[i], half.val[i], 1e-6) << i;
    }
}

namespace {

/// Each corner of 80 m by 60 m was placed twice, so far east and so far west of where it is.
ControlFit placedTwice(double astray_m) {
    std::vector<ControlPoint> points;
    for (const cv::Point2d px : {cv::Point2d(20, 20), {180, 20}, {180, 80}, {20, 80}}) {
        const cv::Point2d ground(px.x / 2, 80 - px.y);
        for (const double off : {astray_m, -astray_m})
            points.push_back({0, px, LocalPlane(kMarket).placeOf(ground + cv::Point2d(off, 0))});
    }
    const auto fits = fitControlPoints(points, {}, LocalPlane(kMarket));
    EXPECT_EQ(fits.size(), 1U);
    return fits.empty() ? ControlFit() : fits[0];
}

}  // namespace

TEST(ControlFitByHand, PointsThatAreOffByAFiftiethOfTheirSpanAreDoubtful) {
    // The span is hypot(80 + 2 off, 60): 102.4 m and 104 m. The best fit lies between both placings,
    // but for what least squares of a projective map are biased: 5 m² over the (50 m)² of their reach.
    const ControlFit good = placedTwice(1.5);
    EXPECT_NEAR(good.rms_m, 1.5, 0.1);
    EXPECT_EQ(good.points, 8);
    EXPECT_FALSE(good.doubtful);
    ASSERT_EQ(good.residuals.size(), 8U);
    for (std::size_t i = 0; i < 8; ++i) {
        EXPECT_EQ(good.residuals[i].point, i);
        EXPECT_NEAR(good.residuals[i].metres, 1.5, 0.3);
    }
    const ControlFit bad = placedTwice(2.5);
    EXPECT_NEAR(bad.rms_m, 2.5, 0.15);
    EXPECT_TRUE(bad.doubtful);
    EXPECT_FALSE(bad.suspect) << "none stands out of eight";
    EXPECT_THAT(remarkOn(bad), testing::EndsWith(" m; several are probably wrong"));
}

TEST(ControlFitByHand, ThePlaceOfAPointIsToldByItsNumberFromOne) {
    ControlFit fit;
    fit.rms_m = 12.34;
    fit.suspect = 2;
    EXPECT_EQ(remarkOn(fit), "") << "not doubtful";
    fit.doubtful = true;
    fit.points = 6;
    EXPECT_EQ(remarkOn(fit),
              "the points contradict each other by 12.3 m; without point 3 the others agree, so that one is probably "
              "wrong");
    fit.suspect.reset();
    EXPECT_THAT(remarkOn(fit), testing::EndsWith("several are probably wrong"));
    fit.points = 5;
    EXPECT_THAT(remarkOn(fit), testing::EndsWith("a sixth point would tell which"));
}

namespace {

/// A picture of 200 × 100 px that is laid on the ground by its corners: a pixel to the right is `right` m, one down
/// `down` m.
GeoReference laid(cv::Point2d right, cv::Point2d down) {
    std::vector<ControlPoint> points;
    for (const cv::Point2d px : {cv::Point2d(0, 0), {199, 0}, {199, 99}, {0, 99}})
        points.push_back({0, px, LocalPlane(kMarket).placeOf(px.x * right + px.y * down)});
    return GeoReference::byControl(market(points));
}

}  // namespace

TEST(GeoReferenceByHand, NorthCourseAndScaleOfASkewedPicture) {
    // Of a picture whose right is east by half a metre and whose lower edge is 1 m east and half a metre south a pixel,
    // 4 px right and 2 px up are (2 − 2, 1) m: north. Its top points to (−1, 0.5).
    const GeoReference skewed = laid({0.5, 0}, {1, -0.5});
    ASSERT_TRUE(skewed.known());
    EXPECT_NEAR(skewed.northOf(0).value_or(0), 360 - std::atan2(2, 4) * 180 / CV_PI, 0.01);
    EXPECT_NEAR(skewed.courseOf(0).value_or(0), 360 - std::atan2(1, 0.5) * 180 / CV_PI, 0.01);
    EXPECT_NEAR(skewed.gsdOf(0).value_or(0), 0.5, 1e-4);  // √(0.5 · 0.5)
    // The camera heads north-east: right is south-east, down is south-west.
    const GeoReference turned = laid({0.2, -0.2}, {-0.3, -0.3});
    EXPECT_NEAR(turned.courseOf(0).value_or(0), 45, 0.01);
    // 2.5 px left and 1.67 px up are (−0.5 + 0.5, 0.5 + 0.5) m.
    EXPECT_NEAR(turned.northOf(0).value_or(0), 180 + std::atan2(1 / 0.6, 1 / 0.4) * 180 / CV_PI, 0.01);
    EXPECT_NEAR(turned.gsdOf(0).value_or(0), std::sqrt(0.12), 1e-4);  // 0.2 · 0.3 + 0.2 · 0.3
    EXPECT_TRUE(turned.isByHand());
    EXPECT_EQ(turned.origin(),
              "4 control points placed by hand (0 m off their places, root mean square), carried by the registration");
    const auto at = turned.metresOf(0, {10, 20});
    ASSERT_TRUE(at);
    EXPECT_NEAR(at->x, 2 - 6, 1e-3);
    EXPECT_NEAR(at->y, -2 - 6, 1e-3);
    // In frame 5 the ground lies 10 px to the left.
    const auto later = turned.metresOf(5, {0, 20});
    ASSERT_TRUE(later);
    EXPECT_NEAR(later->x, 2 - 6, 1e-3);
    EXPECT_NEAR(later->y, -2 - 6, 1e-3);
    EXPECT_FALSE(turned.disagreement_m());
    EXPECT_FALSE(turned.doubtful());
}

}  // namespace
}  // namespace eyrie::control_fit_test
