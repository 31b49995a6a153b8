// Where a flight lies on the earth, by figures that follow from how it was made up.
#include <gtest/gtest.h>

#include <cmath>
#include <opencv2/core.hpp>
#include <optional>
#include <vector>

#include "core/geometry/outline_map.h"
#include "georeference/geo_reference.h"
#include "georeference/video_metadata.h"
#include "metadata/collected.h"

namespace eyrie::geo_reference_by_hand_test {
namespace {

const cv::Size kPicture(200, 100);
constexpr double kPixel_m = 0.5;
constexpr int kFilmed = 200;
const GeoPoint kHome{48.0, 11.0};

/// A camera that flies east by a pixel a frame, its picture's top to the north.
cv::Point2d groundOf(FrameIndex frame, cv::Point2d px) {
    return {kPixel_m * (px.x + frame), -kPixel_m * px.y};
}

/// A set of one frame, which counts for that frame alone.
struct Stated {
    FrameIndex frame = 0;
    cv::Point2d astray_m{0, 0};
    std::optional<double> above_sea_m{}, ellipsoid_m{};
};

/// Ten frames a second; `camera`: how many px it moves in each, as it was registered.
GeoFootage footage(cv::Point2d camera = {1, 0}, int cut = -1) {
    GeoFootage footage;
    footage.image_size = kPicture;
    footage.last_frame = kFilmed - 1;
    footage.frame_rate_hz = 10;
    footage.time_us = [](FrameIndex frame) { return frame * 100'000LL; };
    std::vector<Homography> steps;
    for (int frame = 1; frame < kFilmed; ++frame) {
        if (frame == cut) continue;
        Homography step;
        step.from_frame = frame - 1;
        step.to_frame = frame;
        step.matrix(0, 2) = -camera.x;
        step.matrix(1, 2) = -camera.y;
        steps.push_back(step);
    }
    footage.camera = CameraMotion(steps);
    return footage;
}

GeoReference referenceBy(const std::vector<Stated>& statements, GeoFootage footage) {
    const LocalPlane plane(kHome);
    std::vector<test::Carried> sets;
    for (const Stated& stated : statements) {
        test::LocalSetWriter set;
        int number = tag::kCorners;
        for (const cv::Point2d& corner : outlineOf(kPicture)) {
            const GeoPoint place = plane.placeOf(groundOf(stated.frame, corner) + stated.astray_m);
            set.angle(number, place.latitude_deg, 90).angle(number + 1, place.longitude_deg, 180);
            number += 2;
        }
        if (stated.above_sea_m) set.range(tag::kCentreElevation, *stated.above_sea_m, -900, 19000);
        if (stated.ellipsoid_m) set.range(tag::kCentreEllipsoidHeight, *stated.ellipsoid_m, -900, 19000);
        sets.push_back({set.bytes(), stated.frame * 100'000LL, stated.frame});
    }
    std::vector<PictureStamp> pictures;
    for (int i = 0; i < kFilmed; ++i) pictures.push_back({i * 100'000LL, i * 100'000LL});
    TimelineOptions alone;
    alone.longest_gap_s = alone.longest_hold_s = 0.05;
    const VideoMetadata metadata(test::collected(sets), pictures, alone);
    return {metadata.timeline(), std::move(footage)};
}

/// How far a place of the picture is from where it is by the flight, m.
cv::Point2d astray(const GeoReference& reference, FrameIndex frame) {
    const auto place = reference.placeOf(frame, {120, 40});
    if (!place) return {1e9, 1e9};
    return LocalPlane(kHome).metresOf(*place) - groundOf(frame, {120, 40});
}

/// A statement every half second.
std::vector<Stated> wholeFlight() {
    std::vector<Stated> all;
    for (int frame = 0; frame < kFilmed; frame += 5) all.push_back({frame});
    return all;
}

}  // namespace

TEST(GeoReferenceByHand, MetadataAreAskedEveryHalfSecondToTheLastFrame) {
    const auto knownBy = [](FrameIndex stated, double rate_hz = 10) {
        GeoFootage film = footage();
        film.last_frame = 195;
        film.frame_rate_hz = rate_hz;
        return referenceBy({{stated}}, film).known();
    };
    EXPECT_TRUE(knownBy(0));
    EXPECT_TRUE(knownBy(5));
    EXPECT_FALSE(knownBy(8));
    EXPECT_TRUE(knownBy(195));
    // Of frames that last longer than that each one is asked.
    EXPECT_TRUE(knownBy(8, 0.5));
    EXPECT_TRUE(knownBy(13, 0.5));
}

TEST(GeoReferenceByHand, AStatementIsCarriedForFiveSeconds) {
    const GeoReference reference = referenceBy({{100, {0, 0}, 512}}, footage());
    for (const FrameIndex frame : {50, 99, 150}) {
        EXPECT_LT(cv::norm(astray(reference, frame)), 0.05) << frame;
        EXPECT_TRUE(reference.elevationOf(frame)) << frame;
        EXPECT_NEAR(reference.northOf(frame).value_or(0), 270, 0.1) << frame;
        EXPECT_NEAR(std::abs(std::remainder(reference.courseOf(frame).value_or(90), 360)), 0, 0.1) << frame;
        EXPECT_NEAR(reference.gsdOf(frame).value_or(0), kPixel_m, 1e-3) << frame;
    }
    for (const FrameIndex frame : {49, 151}) {
        EXPECT_FALSE(reference.placeOf(frame, {120, 40})) << frame;
        EXPECT_FALSE(reference.elevationOf(frame)) << frame;
        EXPECT_FALSE(reference.northOf(frame)) << frame;
        EXPECT_FALSE(reference.courseOf(frame)) << frame;
        EXPECT_FALSE(reference.gsdOf(frame)) << frame;
    }
}

TEST(GeoReferenceByHand, ACornerAWidthOutsideOfTheStatedFrameIsNoMeasure) {
    // 33 steps of 6 px are 198 px: a width of 200 px less the half pixel of the outline; 34 are 204.
    for (const cv::Point2d camera : {cv::Point2d(6, 0), {0, 6}}) {
        const GeoReference reference = referenceBy({{100}}, footage(camera));
        EXPECT_TRUE(reference.metresOf(67, {100, 50})) << camera;
        EXPECT_FALSE(reference.metresOf(66, {100, 50})) << camera;
        EXPECT_TRUE(reference.metresOf(133, {100, 50})) << camera;
        EXPECT_FALSE(reference.metresOf(134, {100, 50})) << camera;
    }
    // Where a person said what lies where, a hundred widths: 96 steps of 210 px are 20,160 px.
    GeoFootage film = footage({210, 0});
    for (const cv::Point2d px : {cv::Point2d(0, 0), {199, 0}, {199, 99}, {0, 99}})
        film.control.push_back({0, px, LocalPlane(kHome).placeOf(groundOf(0, px))});
    const GeoReference by_hand = GeoReference::byControl(film);
    ASSERT_TRUE(by_hand.isByHand());
    EXPECT_TRUE(by_hand.metresOf(95, {100, 50}));
    EXPECT_FALSE(by_hand.metresOf(96, {100, 50}));
}

TEST(GeoReferenceByHand, OfSeveralStatementsTheMedianCountsInEitherDirection) {
    // Of two it lies in their middle.
    const cv::Point2d between = astray(referenceBy({{100}, {105, {4, 2}}}, footage()), 102);
    EXPECT_NEAR(between.x, 2, 0.05);
    EXPECT_NEAR(between.y, 1, 0.05);
    const cv::Point2d middle = astray(referenceBy({{100, {4, 2}}, {105}, {110, {9, -9}}}, footage()), 102);
    EXPECT_NEAR(middle.x, 4, 0.05);
    EXPECT_NEAR(middle.y, 0, 0.05);
    const cv::Point2d four =
        astray(referenceBy({{100, {4, 1}}, {105, {7, -3}}, {110, {-20, 50}}, {115, {30, -2}}}, footage()), 102);
    EXPECT_NEAR(four.x, 5.5, 0.05);   // of −20, 4, 7, 30
    EXPECT_NEAR(four.y, -0.5, 0.05);  // of −3, −2, 1, 50
}

TEST(GeoReferenceByHand, TheHeightOfTheGroundIsThatOfTheNearestStatement) {
    const GeoReference reference = referenceBy({{20, {0, 0}, 512, 560}, {100, {0, 0}, 512}}, footage());
    for (const FrameIndex frame : {0, 20, 59}) {
        const auto height = reference.elevationOf(frame);
        ASSERT_TRUE(height) << frame;
        EXPECT_NEAR(height->metres, 560, 0.2) << frame;
        EXPECT_TRUE(height->ellipsoid) << frame << ": above the ellipsoid, where both are stated";
    }
    for (const FrameIndex frame : {61, 100, 150}) {
        const auto height = reference.elevationOf(frame);
        ASSERT_TRUE(height) << frame;
        EXPECT_NEAR(height->metres, 512, 0.2) << frame;
        EXPECT_FALSE(height->ellipsoid) << frame;
    }
    EXPECT_FALSE(reference.elevationOf(151));
    EXPECT_FALSE(referenceBy({{100}}, footage()).elevationOf(100)) << "none is stated";
}

TEST(GeoReferenceByHand, MetadataAreDoubtfulFromATwentiethOfTheDiagonalOn) {
    // The camera flies a pixel a frame; by the registration so many. In 20 frames both part by 10 m times the
    // difference. The diagonal is half a metre times hypot(199, 99): 111.1 m; a twentieth is 5.6 m.
    const auto registeredBy = [](double px) { return referenceBy(wholeFlight(), footage({px, 0})); };
    const GeoReference good = registeredBy(0.5);
    EXPECT_NEAR(good.disagreement_m().value_or(0), 5, 0.04);
    EXPECT_FALSE(good.doubtful());
    EXPECT_NE(good.origin().find("in the metadata, steadied by the registration; both agree to 5 m within 2 s"),
              std::string::npos)
        << good.origin();
    const GeoReference bad = registeredBy(0.4);
    EXPECT_NEAR(bad.disagreement_m().value_or(0), 6, 0.04);
    EXPECT_TRUE(bad.doubtful());
    const GeoReference worse = registeredBy(2.04);
    EXPECT_NEAR(worse.disagreement_m().value_or(0), 10.4, 0.04);
    EXPECT_NE(worse.origin().find("contradict the pictures by 10 m within 2 s"), std::string::npos) << worse.origin();
}

TEST(GeoReferenceByHand, TheDiagonalIsThatFromTheFirstPixelToTheLast) {
    const double limit_m = 0.05 * 0.5 * std::hypot(199, 99);
    int doubtful = 0, good = 0;
    for (int i = 0; i < 60; ++i) {
        const GeoReference reference = referenceBy(wholeFlight(), footage({0.430 + 0.0005 * i, 0}));
        const double apart_m = reference.disagreement_m().value_or(0);
        if (std::abs(apart_m - limit_m) < 0.002) continue;  // angles are stated to some millimetres
        EXPECT_EQ(reference.doubtful(), apart_m > limit_m) << apart_m;
        ++(reference.doubtful() ? doubtful : good);
    }
    EXPECT_GT(doubtful, 10);
    EXPECT_GT(good, 10);
}

TEST(GeoReferenceByHand, MetadataAndRegistrationAreComparedInTheMiddleOfThePicture) {
    // By the metadata the camera flies on; by the registration it turns by a degree a frame about its middle besides.
    GeoFootage turning = footage();
    std::vector<Homography> steps;
    steps.reserve(kFilmed);
    const double c = std::cos(CV_PI / 180), s = std::sin(CV_PI / 180);
    const cv::Point2d middle((kPicture.width - 1) / 2.0, (kPicture.height - 1) / 2.0);
    for (int frame = 1; frame < kFilmed; ++frame) {
        Homography step;
        step.from_frame = frame - 1;
        step.to_frame = frame;
        step.matrix = {c, -s, middle.x - c * middle.x + s * middle.y, s, c, middle.y - s * middle.x - c * middle.y, 0,
                       0, 1};
        steps.push_back(step);
    }
    turning.camera = CameraMotion(steps);
    std::vector<Stated> still;
    still.reserve(kFilmed / 5);
    for (int frame = 0; frame < kFilmed; frame += 5) still.push_back({frame, {-kPixel_m * frame, 0}});
    EXPECT_NEAR(referenceBy(still, turning).disagreement_m().value_or(1e9), 0, 0.02);
}

TEST(GeoReferenceByHand, AStatementTwoHundredKilometresAwayIsNoneOfThisVideo) {
    // The first one says where the video is, and is outnumbered by what is stated later.
    const auto errorWith = [](double astray_m) {
        std::vector<Stated> statements{{0}};
        for (const int frame : {20, 25, 30}) statements.push_back({frame, {astray_m, 0}});
        return cv::norm(astray(referenceBy(statements, footage()), 28));
    };
    EXPECT_NEAR(errorWith(199'000), 199'000, 2000) << "so far a plane holds";
    EXPECT_LT(errorWith(201'000), 0.05);
    EXPECT_LT(errorWith(-201'000), 0.05);
}

TEST(GeoReferenceByHand, ACutSaysNothingOfWhatFollowsIt) {
    const GeoReference reference = referenceBy(wholeFlight(), footage({0.4, 0}, 10));
    EXPECT_NEAR(reference.disagreement_m().value_or(0), 6, 0.04);
    EXPECT_FALSE(referenceBy({{0}, {15}}, footage()).disagreement_m()) << "less than two seconds apart";
}

}  // namespace eyrie::geo_reference_by_hand_test
