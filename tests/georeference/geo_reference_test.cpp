#include "georeference/geo_reference.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <functional>
#include <random>

#include "core/geometry/outline_map.h"
#include "georeference/video_metadata.h"
#include "metadata/collected.h"

namespace eyrie::geo_reference_test {
namespace {

const cv::Size kPicture(200, 100);
constexpr double kPixel_m = 0.5;
constexpr double kRate_hz = 10;
constexpr int kFilmed = 200;
const GeoPoint kHome{48.0, 11.0};

/// A camera that flies east by a pixel a frame, its picture's top to the north.
cv::Point2d groundOf(FrameIndex frame, cv::Point2d px) {
    return {kPixel_m * (px.x + frame), -kPixel_m * px.y};
}

struct FlightOptions {
    double jitter_m = 0;
    int from = 0;
    int to = kFilmed - 1;
    int every = 1;  ///< frames between two sets
};

/// The sets of that flight, each stated place astray as a whole by so much (standard deviation).
MetadataStream flight(const FlightOptions& options) {
    std::mt19937 random(7);
    std::normal_distribution<double> astray(0, 1);
    const LocalPlane plane(kHome);
    std::vector<test::Carried> sets;
    for (int frame = options.from; frame <= options.to; frame += options.every) {
        test::LocalSetWriter set;
        set.time(1'231'798'102'000'000 + frame * 100'000ULL);
        const cv::Point2d error(options.jitter_m * astray(random), options.jitter_m * astray(random));
        int number = tag::kCorners;
        for (const cv::Point2d& corner : outlineOf(kPicture)) {
            const GeoPoint place = plane.placeOf(groundOf(frame, corner) + error);
            set.angle(number, place.latitude_deg, 90).angle(number + 1, place.longitude_deg, 180);
            number += 2;
        }
        set.range(tag::kCentreElevation, 512, -900, 19000);
        sets.push_back({set.bytes(), frame * 100'000LL, frame});
    }
    return test::collected(sets);
}

std::vector<PictureStamp> picturesOf() {
    std::vector<PictureStamp> all;
    for (int i = 0; i < kFilmed; ++i) all.push_back({i * 100'000LL, i * 100'000LL});
    return all;
}

GeoFootage footage(bool cut = false) {
    GeoFootage footage;
    footage.image_size = kPicture;
    footage.last_frame = kFilmed - 1;
    footage.frame_rate_hz = kRate_hz;
    footage.time_us = [](FrameIndex frame) { return frame * 100'000LL; };
    std::vector<Homography> steps;
    for (int frame = 1; frame < kFilmed; ++frame) {
        if (cut && frame == kFilmed / 2) continue;
        Homography step;
        step.from_frame = frame - 1;
        step.to_frame = frame;
        step.matrix(0, 2) = -1;
        steps.push_back(step);
    }
    footage.camera = CameraMotion(steps);
    return footage;
}

/// How far places of the middle of the picture are from the truth, root mean square over the frames asked, m; a frame
/// without one counts as `missing`.
double error_m(const GeoReference& reference, int from, int to, int* missing = nullptr) {
    const LocalPlane plane(kHome);
    double sum = 0;
    int count = 0;
    for (int frame = from; frame <= to; ++frame) {
        const auto place = reference.placeOf(frame, {120, 40});
        if (!place) {
            if (missing != nullptr) ++*missing;
            continue;
        }
        const cv::Point2d off = plane.metresOf(*place) - groundOf(frame, {120, 40});
        sum += off.dot(off);
        ++count;
    }
    return count == 0 ? -1 : std::sqrt(sum / count);
}

}  // namespace

TEST(GeoReference, pixelsLieWhereTheMetadataSay) {
    const VideoMetadata metadata(flight({}), picturesOf());
    const GeoReference reference(metadata.timeline(), footage());
    ASSERT_TRUE(reference.known());
    EXPECT_EQ(reference.source(), GroundSource::corners);
    int missing = 0;
    EXPECT_LT(error_m(reference, 0, kFilmed - 1, &missing), 0.02);  // the tags are exact to a centimetre
    EXPECT_EQ(missing, 0);
    const auto a = reference.metresOf(50, {10, 20}), b = reference.metresOf(50, {30, 20});
    ASSERT_TRUE(a && b);
    EXPECT_NEAR(b->x - a->x, 20 * kPixel_m, 0.01);  // east
    EXPECT_NEAR(b->y - a->y, 0, 0.01);
}

TEST(GeoReference, northAndScaleAreThoseOfThePicture) {
    const VideoMetadata metadata(flight({}), picturesOf());
    const GeoReference reference(metadata.timeline(), footage());
    ASSERT_TRUE(reference.northOf(33));
    EXPECT_NEAR(*reference.northOf(33), 270, 0.1);  // up
    ASSERT_TRUE(reference.gsdOf(33));
    EXPECT_NEAR(*reference.gsdOf(33), kPixel_m, 0.001);
    EXPECT_FALSE(reference.isByHand());
    EXPECT_FALSE(GeoReference().northOf(33));
    EXPECT_FALSE(GeoReference().gsdOf(33));
    ASSERT_TRUE(reference.courseOf(33));
    EXPECT_NEAR(std::remainder(*reference.courseOf(33), 360), 0, 0.1);
}

TEST(GeoReference, theRegistrationSteadiesJitteringStatements) {
    constexpr double kJitter_m = 6;
    const VideoMetadata metadata(flight({.jitter_m = kJitter_m}), picturesOf());
    const GeoReference reference(metadata.timeline(), footage());
    // The median of 21 statements strays by about 1.25 / √21 of one, over two axes; half of them at the ends.
    EXPECT_LT(error_m(reference, 0, kFilmed - 1), 0.45 * std::sqrt(2) * kJitter_m);
    // From frame to frame nothing jumps: what moves with the ground stays where it is.
    double jump = 0;
    for (int frame = 1; frame < kFilmed; ++frame) {
        const auto before = reference.metresOf(frame - 1, {100, 50}), now = reference.metresOf(frame, {99, 50});
        jump = std::max(jump, cv::norm(*now - *before));
    }
    EXPECT_LT(jump, kJitter_m);
}

TEST(GeoReference, itIsToldHowFarMetadataAndRegistrationAgree) {
    const VideoMetadata exact(flight({}), picturesOf());
    const GeoReference good(exact.timeline(), footage());
    ASSERT_TRUE(good.disagreement_m());
    EXPECT_LT(*good.disagreement_m(), 0.05);
    EXPECT_FALSE(good.doubtful());
    // The picture stands still, by the registration, while the metadata fly on: 10 m in two seconds.
    GeoFootage standing = footage();
    standing.camera = CameraMotion::standing(0, kFilmed - 1);
    const GeoReference bad(exact.timeline(), standing);
    ASSERT_TRUE(bad.disagreement_m());
    EXPECT_NEAR(*bad.disagreement_m(), 2 * kRate_hz * kPixel_m, 0.1);
    EXPECT_TRUE(bad.doubtful());
    EXPECT_NE(bad.origin().find("contradict"), std::string::npos);
    EXPECT_EQ(good.origin().find("contradict"), std::string::npos);
}

TEST(GeoReference, framesWithoutMetadataHavePlacesWhereTheRegistrationReaches) {
    const VideoMetadata metadata(flight({.from = 70, .to = 90}), picturesOf());
    const GeoReference reference(metadata.timeline(), footage());
    EXPECT_LT(error_m(reference, 65, 95), 0.02);
    EXPECT_FALSE(reference.placeOf(0, {100, 50}));  // 5 s and more from the first statement, which holds for 1 s
    EXPECT_FALSE(reference.placeOf(199, {100, 50}));
    EXPECT_EQ(reference.elevationOf(0), std::nullopt);
    ASSERT_TRUE(reference.elevationOf(80));
    EXPECT_NEAR(reference.elevationOf(80)->metres, 512, 0.2);
    EXPECT_FALSE(reference.elevationOf(80)->ellipsoid);
}

TEST(GeoReference, nothingIsCarriedAcrossACut) {
    const VideoMetadata metadata(flight({.to = kFilmed / 2 - 1}), picturesOf());
    EXPECT_TRUE(GeoReference(metadata.timeline(), footage()).placeOf(kFilmed / 2 + 10, {100, 50}));
    // Behind the cut only what the metadata hold on to for a second is known.
    const GeoReference cut(metadata.timeline(), footage(true));
    EXPECT_TRUE(cut.placeOf(kFilmed / 2 - 1, {100, 50}));
    EXPECT_FALSE(cut.placeOf(kFilmed / 2 + 70, {100, 50}));
}

TEST(GeoReference, withoutAnyStatementThereIsNoPlace) {
    EXPECT_FALSE(GeoReference().known());
    EXPECT_FALSE(GeoReference().placeOf(0, {1, 1}));
    test::LocalSetWriter set;
    set.time(1'000'000);
    const VideoMetadata metadata(test::collected({{set.bytes(), 0, 0}}), picturesOf());
    const GeoReference reference(metadata.timeline(), footage());
    EXPECT_FALSE(reference.known());
    EXPECT_EQ(reference.source(), GroundSource::none);
    EXPECT_FALSE(reference.metresOf(3, {1, 1}));
}

TEST(GeoReference, statementsThatCannotBeArePassedOver) {
    MetadataStream stream = flight({});
    // Every third set states corners of a picture that is mirrored.
    for (std::size_t i = 0; i < stream.packets.size(); i += 3)
        for (auto& number : stream.packets[i].numbers)
            if (number.tag == tag::kCorners + 1 || number.tag == tag::kCorners + 7) number.value += 0.01;
    const VideoMetadata metadata(std::move(stream), picturesOf());
    EXPECT_LT(error_m(GeoReference(metadata.timeline(), footage()), 0, kFilmed - 1), 0.05);
}

TEST(GeoReference, aFootprintThatIsNoConvexQuadrilateralSaysNothing) {
    using Corners = std::array<GeoPoint, 4>;
    const auto knownWith = [](const std::function<void(Corners&)>& change) {
        MetadataStream stream = flight({.from = 10, .to = 10});
        Corners corners;
        const auto each = [&](const std::function<void(double& stated, double& corner)>& meet) {
            for (auto& number : stream.packets.at(0).numbers) {
                if (number.tag < tag::kCorners || number.tag >= tag::kCorners + 8) continue;
                GeoPoint& corner = corners[static_cast<std::size_t>(number.tag - tag::kCorners) / 2];
                const bool latitude = (number.tag - tag::kCorners) % 2 == 0;
                meet(number.value, latitude ? corner.latitude_deg : corner.longitude_deg);
            }
        };
        each([](double& stated, double& corner) { corner = stated; });
        change(corners);
        each([](double& stated, double& corner) { stated = corner; });
        const VideoMetadata metadata(std::move(stream), picturesOf());
        return GeoReference(metadata.timeline(), footage()).known();
    };
    EXPECT_TRUE(knownWith([](Corners&) {}));
    EXPECT_FALSE(knownWith([](Corners& corners) { std::swap(corners[0], corners[1]); })) << "its sides cross";
    EXPECT_FALSE(knownWith([](Corners& corners) { std::swap(corners[1], corners[2]); })) << "the other two";
    for (std::size_t dented = 0; dented < 4; ++dented) {
        EXPECT_FALSE(knownWith([&](Corners& corners) {
            const GeoPoint beside = corners[(dented + 1) % 4], other = corners[(dented + 3) % 4],
                           opposite = corners[(dented + 2) % 4];
            corners[dented] = {0.6 * opposite.latitude_deg + 0.2 * (beside.latitude_deg + other.latitude_deg),
                               0.6 * opposite.longitude_deg + 0.2 * (beside.longitude_deg + other.longitude_deg)};
        })) << "corner "
            << dented << " lies inside of the other three";
    }
}

}  // namespace eyrie::geo_reference_test
