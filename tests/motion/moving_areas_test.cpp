#include "motion/differences/moving_areas.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>
#include <opencv2/imgproc.hpp>
#include <set>

#include "core/geometry/oriented_box.h"
#include "core/values/corner_density.h"
#include "motion/differences/area_matching.h"

namespace eyrie::moving_areas_test {
namespace {

using testing::Each;
using testing::IsEmpty;
using testing::Not;
using testing::SizeIs;

const SceneScale kScale{0.32, 25, true};
constexpr int kFrames = 12;

/// A car of 14×6 px on a road with little texture, under a camera that pans. Axis-aligned pixels, drawn to a fraction.
struct CarScene {
    cv::Point2d velocity{2, 0};  ///< px/frame over the ground
    cv::Size size{320, 240};
    cv::Point2d camera_per_frame{1.3, 0.6};

    cv::Point2d carAt(int frame) const { return cv::Point2d(150, 120) + (velocity - camera_per_frame) * frame; }
    cv::Mat draw(int frame) const {
        const cv::Mat image = sampled(textureOf({400, 320}, 1, 110, 5), camera_per_frame * frame, size);
        cv::Mat body = textureOf({14, 6}, 7, 190, 35);
        cv::rectangle(body, {0, 0, body.cols, body.rows}, cv::Scalar(235), 1);
        const cv::Point2d corner = carAt(frame) - cv::Point2d(6.5, 2.5);
        const cv::Matx23d place(1, 0, corner.x, 0, 1, corner.y);
        cv::warpAffine(body, image, place, size, cv::INTER_LINEAR, cv::BORDER_TRANSPARENT);
        return image;
    }

 private:
    static cv::Mat textureOf(cv::Size size, std::uint64_t seed, double mean, double deviation) {
        cv::Mat texture(size, CV_8UC1);
        cv::RNG(seed).fill(texture, cv::RNG::NORMAL, mean, 2.5 * deviation);
        cv::GaussianBlur(texture, texture, {}, 0.8);
        return texture;
    }
    static cv::Mat sampled(const cv::Mat& ground, cv::Point2d corner, cv::Size size) {
        cv::Mat image;
        cv::warpAffine(ground, image, cv::Matx23d(1, 0, corner.x, 0, 1, corner.y), size,
                       cv::INTER_LINEAR | cv::WARP_INVERSE_MAP);
        return image;
    }
};

CarScene sceneWith(cv::Point2d velocity) {
    CarScene scene;
    scene.velocity = velocity;
    return scene;
}

Registration panned(const CarScene& scene, int index) {
    Registration registration;
    registration.state = index == 0 ? RegistrationState::first : RegistrationState::registered;
    registration.current_from_previous.from_frame = std::max(0, index - 1);
    registration.current_from_previous.to_frame = index;
    if (index > 0) {
        registration.current_from_previous.matrix(0, 2) = -scene.camera_per_frame.x;
        registration.current_from_previous.matrix(1, 2) = -scene.camera_per_frame.y;
    }
    return registration;
}

/// A frame in which hardly a corner could be tracked.
FrameMotion starved(const CarScene& scene) {
    FrameMotion motion;
    motion.image_size = scene.size;
    motion.corner_count = 500;
    return motion;
}

void withNoise(int index, cv::Mat& gray) {
    cv::RNG random(static_cast<std::uint64_t>(index) + 1);
    cv::Mat drawn(gray.size(), CV_16SC1);
    random.fill(drawn, cv::RNG::NORMAL, 0, 12);
    cv::add(gray, drawn, gray, cv::noArray(), CV_8U);
}

/// What is inferred in the last frame. `change` alters the pictures.
std::vector<MotionVector> inferred(const CarScene& scene, const FrameMotion& motion,
                                   const std::function<void(int, cv::Mat&)>& change = {},
                                   const MovingAreaOptions& options = {}) {
    MovingAreas areas(options, kScale);
    for (int index = 0; index < kFrames; ++index) {
        cv::Mat gray = scene.draw(index);
        if (change) change(index, gray);
        areas.add({index, index * 40000, gray, {}}, panned(scene, index));
    }
    return areas.infer(motion, [](cv::Point2d) { return kScale.pxPerFrame(1); });
}

}  // namespace

class MovingAreasOfACar : public testing::TestWithParam<cv::Point2d> {};

TEST_P(MovingAreasOfACar, MoveLikeItAndLieOnItWhereItIsNow) {
    const CarScene scene = sceneWith(GetParam());
    const std::vector<MotionVector> vectors = inferred(scene, starved(scene));
    ASSERT_THAT(vectors, Not(IsEmpty()));
    const cv::Point2d centre = scene.carAt(kFrames - 1);
    const OrientedBox car{centre, 14, 6, 0};
    for (const MotionVector& vector : vectors) {
        EXPECT_TRUE(car.contains(vector.position, 3)) << vector.position << " is not on the car at " << centre;
        EXPECT_NEAR(vector.velocity.x, GetParam().x, 0.3);
        EXPECT_NEAR(vector.velocity.y, GetParam().y, 0.3);
        EXPECT_TRUE(vector.isInferred());
    }
    EXPECT_TRUE(std::is_sorted(vectors.begin(), vectors.end(), [](auto& a, auto& b) { return a.id < b.id; }));
    EXPECT_GT(vectors.front().id, CornerId{1} << 40) << "above corners and silhouettes";
}

INSTANTIATE_TEST_SUITE_P(Directions, MovingAreasOfACar,
                         testing::Values(cv::Point2d(2, 0), cv::Point2d(-1.5, 1), cv::Point2d(0, -3),
                                         cv::Point2d(1.1, 0.4)));

TEST(MovingAreas, AreAsFastAsTheyAreWherePicturesWereLost) {
    const CarScene scene = sceneWith({2, 0});
    for (const int lost : {1, 3, 4, 40}) {
        SCOPED_TRACE(lost);
        MovingAreas areas({}, kScale);
        for (int index = 0; index < kFrames; ++index) {
            const bool last = index == kFrames - 1;
            Registration registration = panned(scene, index);
            if (last) {
                registration.elapsed = 1 + lost;
                registration.current_from_previous.matrix(0, 2) *= 1 + lost;
                registration.current_from_previous.matrix(1, 2) *= 1 + lost;
            }
            areas.add({index, index * 40000, scene.draw(last ? index + lost : index), {}}, registration);
        }
        const std::vector<MotionVector> vectors =
            areas.infer(starved(scene), [](cv::Point2d) { return kScale.pxPerFrame(1); });
        EXPECT_EQ(vectors.empty(), lost > 5) << "over a long time much comes and goes";
        for (const MotionVector& vector : vectors) EXPECT_NEAR(vector.velocity.x, 2, 0.3);
    }
}

TEST(MovingAreas, AreNotFiguresDrawnIntoThePicture) {
    const CarScene scene = sceneWith({2, 0});
    PictureMask graphics{cv::Mat::zeros(scene.size.height / 2, scene.size.width / 2, CV_8UC1), 2};
    const auto seen = [&] {
        MovingAreas areas({}, kScale);
        for (int index = 0; index < kFrames; ++index)
            areas.add({index, index * 40000, scene.draw(index), {}}, panned(scene, index), graphics);
        return areas.infer(starved(scene), [](cv::Point2d) { return kScale.pxPerFrame(1); });
    };
    EXPECT_THAT(seen(), Not(IsEmpty()));
    const cv::Point2d centre = scene.carAt(kFrames - 1);
    graphics.cells(cv::Rect(cv::Point(0, cvRound(centre.y / 2) - 12), cv::Size(graphics.cells.cols, 24))).setTo(255);
    EXPECT_THAT(seen(), IsEmpty()) << "where it is and was";
}

TEST(MovingAreas, AreNotSeenWhereNothingMoves) {
    const CarScene scene = sceneWith({0, 0});
    EXPECT_THAT(inferred(scene, starved(scene)), IsEmpty());
}

TEST(MovingAreas, AreNotLightsThatFlicker) {
    const CarScene scene = sceneWith({0, 0});
    const auto flicker = [&](int index, cv::Mat& gray) {
        const cv::Point2d at = scene.carAt(index);
        cv::circle(gray, at, 5, cv::Scalar(index / 3 % 2 == 0 ? 255 : 60), -1);
    };
    EXPECT_THAT(inferred(scene, starved(scene), flicker), IsEmpty());
}

TEST(MovingAreas, AreLookedForOnlyWhereCornersStarve) {
    const CarScene scene = sceneWith({2, 0});
    FrameMotion motion = starved(scene);
    motion.corner_count = 320 * 240 / 10;  // eight on a car
    EXPECT_THAT(inferred(scene, motion), IsEmpty());
    // Fewer than the limit, not as many.
    MovingAreaOptions options;
    options.area_max_corners = cornersOnCar(starved(scene), kScale);
    EXPECT_THAT(inferred(scene, starved(scene), {}, options), IsEmpty());
}

TEST(MovingAreas, MustBeSureWhereCornersNearlySuffice) {
    const CarScene scene = sceneWith({2, 0});
    FrameMotion motion = starved(scene);
    EXPECT_THAT(inferred(scene, motion, withNoise), Not(IsEmpty()));
    motion.corner_count = 320 * 240 / 20;  // four on a car
    EXPECT_THAT(inferred(scene, motion), Not(IsEmpty()));
    EXPECT_THAT(inferred(scene, motion, withNoise), IsEmpty());
}

TEST(MovingAreas, FollowWhatGoesFarBetweenTheFewPicturesOfASlowVideo) {
    // 50 px, 16 m, from picture to picture; in the last the car is nearer to the right border than it may have come.
    const SceneScale slow{0.32, 2, true};
    const auto found = [&](const SceneScale& scale) {
        CarScene scene = sceneWith({50, 0});
        scene.camera_per_frame = {1, 0};
        MovingAreas areas({}, scale);
        for (int index = 0; index < 3; ++index)
            areas.add({index, index * 500000, scene.draw(index), {}}, panned(scene, index));
        FrameMotion motion = starved(scene);
        motion.corner_count = 320 * 240 / 10;  // eight on a car, of which none could be followed on it
        return areas.infer(motion, [](cv::Point2d) { return 0.1; });
    };
    const auto vectors = found(slow);
    ASSERT_THAT(vectors, Not(IsEmpty()));
    const OrientedBox box{{248, 120}, 14, 6, 0};
    for (const MotionVector& vector : vectors) {
        EXPECT_TRUE(box.contains(vector.position, 3)) << vector.position;
        EXPECT_NEAR(vector.velocity.x, 50, 0.3);
        EXPECT_NEAR(vector.velocity.y, 0, 0.3);
    }
    EXPECT_THAT(found({0.32, 9, true}), IsEmpty()) << "corners can be followed there";
}

TEST(MovingAreas, LetVehiclesBrakeByATenthOfTheirWay) {
    const SceneScale slow{0.32, 2, true};
    // Where the car is in three pictures: it goes 40 px, then `last`.
    const auto found = [&](double last) {
        CarScene scene = sceneWith({40, 0});
        scene.camera_per_frame = {0, 0};
        MovingAreas areas({}, slow);
        for (int index = 0; index < 3; ++index) {
            CarScene here = scene;
            if (index == 2) here.velocity.x = (40 + last) / 2;
            areas.add({index, index * 500000, here.draw(index), {}}, panned(scene, index));
        }
        return !areas.infer(starved(scene), [](cv::Point2d) { return 0.1; }).empty();
    };
    EXPECT_TRUE(found(40));
    EXPECT_TRUE(found(37));
    EXPECT_TRUE(found(43));
    EXPECT_FALSE(found(30));
}

TEST(MovingAreas, LeaveCarsAloneThatHaveVectors) {
    const CarScene scene = sceneWith({2, 0});
    const cv::Point2f centre = scene.carAt(kFrames - 1);
    const auto covered = [&](float spacing, cv::Point2f velocity) {
        FrameMotion motion = starved(scene);
        for (float y = -2; y <= 2; y += spacing) {
            for (float x = -6; x <= 6; x += spacing)
                motion.motion_vectors.push_back({CornerId(x * 100 + y), centre + cv::Point2f(x, y), velocity, 9});
        }
        return motion;
    };
    EXPECT_THAT(inferred(scene, covered(1, {2, 0})), IsEmpty());
    EXPECT_THAT(inferred(scene, covered(12, {2, 0})), Not(IsEmpty())) << "two are not enough";
    EXPECT_THAT(inferred(scene, covered(1, {-2, 0})), Not(IsEmpty())) << "those of something else do not count";
}

TEST(MovingAreas, AreForgottenAtACut) {
    const CarScene scene = sceneWith({2, 0});
    MovingAreas areas({}, kScale);
    for (int index = 0; index < kFrames; ++index) {
        Registration registration = panned(scene, index);
        if (index == 8) registration.current_from_previous.from_frame = 3;
        areas.add({index, index * 40000, scene.draw(index), {}}, registration);
    }
    EXPECT_THAT(areas.infer(starved(scene), [](cv::Point2d) { return 0.1; }), IsEmpty());
    MovingAreas off({.areas = false}, kScale);
    off.add({0, 0, scene.draw(0), {}}, panned(scene, 0));
    EXPECT_THAT(off.infer(starved(scene), [](cv::Point2d) { return 0.1; }), IsEmpty());
}

struct AreaLimit {
    const char* parameter;
    const char* passes;
    const char* refuses;
};

class LimitsOfMovingAreas : public testing::TestWithParam<AreaLimit> {};

TEST_P(LimitsOfMovingAreas, LieAboutTheCar) {
    // 14×6 px are 4.5×1.9 m and 84 px², 21 of the halved picture; three frames apart it has moved by 6 px. With 500
    // corners in the picture half a corner lies on it.
    const CarScene scene = sceneWith({2, 0});
    const auto found = [&](const char* value) {
        MovingAreaOptions options;
        if (GetParam().parameter == std::string("motion.area_sure_correlation")) options.area_few_corners = 0.4;
        if (GetParam().parameter == std::string("motion.area_few_corners")) options.area_sure_correlation = 1;
        if (GetParam().parameter == std::string("motion.area_low_rate")) options.area_low_rate_correlation = 1;
        if (GetParam().parameter == std::string("motion.area_low_rate_correlation")) options.area_low_rate_hz = 26;
        setParameter(describeOf(options), GetParam().parameter, value);
        if (GetParam().parameter != std::string("motion.area_noise_factor"))
            return !inferred(scene, starved(scene), {}, options).empty();
        options.area_min_correlation = 0.3;
        return !inferred(scene, starved(scene), withNoise, options).empty();
    };
    EXPECT_TRUE(found(GetParam().passes));
    EXPECT_FALSE(found(GetParam().refuses));
}

INSTANTIATE_TEST_SUITE_P(
    Each, LimitsOfMovingAreas,
    testing::Values(AreaLimit{"motion.area_max_corners", "0.6", "0.4"},
                    AreaLimit{"motion.area_few_corners", "0.6", "0.4"},
                    AreaLimit{"motion.area_noise_factor", "0", "100"}, AreaLimit{"motion.area_contrast", "8", "200"},
                    AreaLimit{"motion.area_min_size", "2", "15"}, AreaLimit{"motion.area_min_size_px", "20", "300"},
                    AreaLimit{"motion.area_max_length", "8", "2"}, AreaLimit{"motion.area_min_shift", "5.5", "6.5"},
                    AreaLimit{"motion.area_min_correlation", "0.5", "0.9999"},
                    AreaLimit{"motion.area_sure_correlation", "0.5", "0.9999"},
                    AreaLimit{"motion.area_low_rate", "25", "26"},
                    AreaLimit{"motion.area_low_rate_correlation", "0.5", "0.9999"}),
    [](const auto& limit) { return std::string(limit.param.parameter).substr(12); });

TEST(MovingAreas, OfVeryManyOnlyTheLargestAreLookedAt) {
    // Things of 6×6 px in a grid, ten of them smaller, all of which move by their own length between two pictures.
    constexpr int kColumns = 40, kSpacing = 28, kBorder = 24;
    const auto isSmall = [](int thing) { return thing % 151 == 75; };
    const auto seenOf = [&](int number) {
        CarScene still;
        still.camera_per_frame = {0, 0};
        still.size = cv::Size(kColumns * kSpacing + 2 * kBorder, kColumns * kSpacing + 2 * kBorder);
        MovingAreaOptions options;
        options.area_min_size_m2 = 0;
        options.area_min_size_px = 4;
        MovingAreas areas(options, {0.7, 25, true});
        const auto placeOf = [&](int thing, int index) {
            return cv::Point(kBorder + thing % kColumns * kSpacing + 2 * index, kBorder + thing / kColumns * kSpacing);
        };
        for (int index = 0; index < 7; ++index) {
            cv::Mat gray(still.size, CV_8UC1, cv::Scalar(80));
            for (int thing = 0; thing < number; ++thing) {
                const int side = isSmall(thing) ? 4 : 6;
                gray(cv::Rect(placeOf(thing, index), cv::Size(side, side))).setTo(200);
            }
            areas.add({index, index * 40000, gray, {}}, panned(still, index));
        }
        FrameMotion motion;
        motion.image_size = still.size;
        std::set<int> large, small;
        for (const MotionVector& vector : areas.infer(motion, [](cv::Point2d) { return 0.1; })) {
            const cv::Point2f from = vector.position - cv::Point2f(placeOf(0, 6)) + cv::Point2f(4, 4);
            const int thing = static_cast<int>(from.y / kSpacing) * kColumns + static_cast<int>(from.x / kSpacing);
            (isSmall(thing) ? small : large).insert(thing);
        }
        return std::tuple(large.size(), small.size(), *large.rbegin());
    };
    EXPECT_EQ(seenOf(1490), std::tuple(1480U, 10U, 1489));
    EXPECT_EQ(seenOf(1520), std::tuple(1500U, 0U, 1509)) << "of equally large ones the upper";
}

TEST(MovingAreas, TheGapIsATimeInFrames) {
    MovingAreaOptions options;
    const auto frames = [&](double gap_s, double rate_hz) {
        options.area_gap_s = gap_s;
        return options.gapFrames({0.32, rate_hz, true});
    };
    EXPECT_EQ(frames(0.12, 25), 3);
    EXPECT_EQ(frames(0.12, 60), 7);
    EXPECT_EQ(frames(0.01, 25), 1);
    EXPECT_EQ(frames(10, 25), 30);
}

/// A car that is hardly brighter than its road, in noise, goes 40 px from picture to picture.
std::vector<MotionVector> inferredOfGreyCar(const MovingAreaOptions& options, double frame_rate_hz) {
    CarScene scene = sceneWith({40, 0});
    scene.camera_per_frame = {0, 0};
    MovingAreas areas(options, {0.32, frame_rate_hz, true});
    for (int index = 0; index < 3; ++index) {
        cv::Mat gray(scene.size, CV_8UC1, cv::Scalar(100));
        const cv::Rect body(cv::Point(scene.carAt(index) - cv::Point2d(10, 5)), cv::Size(20, 10));
        gray(body) = 110;
        gray(cv::Rect(body.tl() + cv::Point(5, 2), cv::Size(5, 6))) = 80;
        cv::RNG random(static_cast<std::uint64_t>(index) + 1);
        cv::Mat drawn(gray.size(), CV_16SC1);
        random.fill(drawn, cv::RNG::NORMAL, 0, 5);
        cv::add(gray, drawn, gray, cv::noArray(), CV_8U);
        areas.add({index, index * 500000, gray, {}}, panned(scene, index));
    }
    return areas.infer(starved(scene), [](cv::Point2d) { return 0.1; });
}

TEST(MovingAreas, OfGreyCarsOnGreyRoadsAreFoundAtLowerDifferencesInASlowVideo) {
    MovingAreaOptions high;
    high.area_noise_factor = 20;
    const auto vectors = inferredOfGreyCar(high, 2);
    ASSERT_THAT(vectors, Not(IsEmpty()));
    std::set<std::pair<double, double>> places;
    for (const MotionVector& vector : vectors) {
        EXPECT_NEAR(vector.velocity.x, 40, 0.5);
        EXPECT_NEAR(vector.velocity.y, 0, 0.5);
        EXPECT_TRUE(places.insert({vector.position.x, vector.position.y}).second) << "each threshold finds it again";
    }
    high.area_low_rate_noise_factor = high.area_noise_factor;
    EXPECT_THAT(inferredOfGreyCar(high, 2), IsEmpty());
}

TEST(AreaMatching, LooksBothWaysForAWayThatBothPicturesShow) {
    // What looks the same, only better, lies in the later picture as well as in the earlier one, but on no way.
    const CarScene scene = sceneWith({0, 0});
    const cv::Mat from = scene.draw(0);
    const cv::Rect car(140, 114, 20, 12);
    std::vector<cv::Point> pixels;
    for (int y = car.y; y < car.br().y; ++y) {
        for (int x = car.x; x < car.br().x; ++x) pixels.emplace_back(x, y);
    }
    const cv::Mat road(from.size(), CV_8UC1, cv::Scalar(110));
    cv::Mat faded;
    cv::addWeighted(from(car), 0.5, from(cv::Rect(40, 50, 20, 12)), 1, 0, faded);
    const auto with = [&](cv::Point way, cv::Point decoy) {
        cv::Mat picture = road.clone();
        faded.copyTo(picture(car + way));
        from(car).copyTo(picture(car + decoy));
        return picture;
    };
    const cv::Mat later = with({31, 4}, {-40, 20});
    const cv::Mat earlier = with({-30, -5}, {-20, -60});
    const auto alone = matchArea(pixels, from, later, {0, 0}, 70);
    ASSERT_TRUE(alone);
    EXPECT_NEAR(alone->shift.x, -40, 0.3) << "the decoy is what is looked for";
    const auto way = matchWay(pixels, from, later, earlier, {0, 0}, 70, 0.1);
    ASSERT_TRUE(way);
    EXPECT_LT(cv::norm(way->on.shift - cv::Point2d(31, 4)), 0.5) << way->on.shift;
    EXPECT_LT(cv::norm(way->came.shift - cv::Point2d(-30, -5)), 0.5) << way->came.shift;
    EXPECT_EQ(way->correlation(), std::min(way->on.correlation, way->came.correlation));
    EXPECT_GT(way->correlation(), 0.7);
    EXPECT_LT(way->correlation(), 0.99);

    EXPECT_FALSE(matchWay({}, from, later, earlier, {0, 0}, 70, 0.1));
    EXPECT_FALSE(matchWay(pixels, road, later, earlier, {0, 0}, 70, 0.1)) << "plain";
    EXPECT_FALSE(matchWay(pixels, from, later, earlier, {161, 0}, 70, 0.1)) << "a pixel must be left at the border";
}

TEST(AreaMatching, FindsTheShiftToAFractionOfAPixel) {
    const CarScene scene = sceneWith({0, 0});
    const cv::Mat from = scene.draw(0);
    cv::Mat to;
    const cv::Matx23d shift(1, 0, 6.3, 0, 1, -4.6);
    cv::warpAffine(from, to, shift, from.size(), cv::INTER_CUBIC, cv::BORDER_REPLICATE);
    std::vector<cv::Point> pixels;
    for (int y = 100; y < 110; ++y) {
        for (int x = 200; x < 215; ++x) pixels.emplace_back(x, y);
    }
    const auto found = matchArea(pixels, from, to, {0, 0}, 12);
    ASSERT_TRUE(found);
    EXPECT_NEAR(found->shift.x, 6.3, 0.15);
    EXPECT_NEAR(found->shift.y, -4.6, 0.15);
    EXPECT_GT(found->correlation, 0.85);
    const auto near = matchArea(pixels, from, to, {6, -5}, 2);
    ASSERT_TRUE(near);
    EXPECT_NEAR(near->shift.x, 6.3, 0.15);
    for (const cv::Point2d truth : {cv::Point2d(7, 5), cv::Point2d(-5, -7), cv::Point2d(3, 8), cv::Point2d(-9, 11)}) {
        cv::warpAffine(from, to, cv::Matx23d(1, 0, truth.x, 0, 1, truth.y), from.size(), cv::INTER_NEAREST,
                       cv::BORDER_REPLICATE);
        const auto whole = matchArea(pixels, from, to, {0, 0}, 12);
        ASSERT_TRUE(whole);
        EXPECT_NEAR(whole->correlation, 1, 1e-9) << "odd shifts, too, are found to the pixel";
        EXPECT_NEAR(cv::norm(whole->shift - truth), 0, 0.1) << truth;
    }
}

TEST(AreaMatching, HasNoAnswerForPlainAreasOrAtTheBorder) {
    const cv::Mat plain(100, 100, CV_8UC1, cv::Scalar(90));
    std::vector<cv::Point> pixels{{50, 50}, {53, 50}, {50, 53}, {53, 53}};
    EXPECT_FALSE(matchArea(pixels, plain, plain, {0, 0}, 5));
    const cv::Mat textured = sceneWith({0, 0}).draw(0);
    EXPECT_TRUE(matchArea(pixels, textured, textured, {0, 0}, 5));
    EXPECT_FALSE(matchArea({}, textured, textured, {0, 0}, 5));
    // 320 px wide: a pixel is left around it at 265, not at 266.
    EXPECT_TRUE(matchArea(pixels, textured, textured, {265, 0}, 5));
    EXPECT_FALSE(matchArea(pixels, textured, textured, {266, 0}, 5));
    EXPECT_TRUE(matchArea(pixels, textured, textured, {-49, -49}, 5));
    EXPECT_FALSE(matchArea(pixels, textured, textured, {-49, -50}, 5));
}

TEST(AreaMatching, LooksAsFarAsThePictureGoes) {
    const cv::Mat from = sceneWith({0, 0}).draw(0);
    std::vector<cv::Point> pixels;
    for (int y = 4; y < 12; ++y) {
        for (int x = 300; x < 314; ++x) pixels.emplace_back(x, y);
    }
    cv::Mat to;
    cv::warpAffine(from, to, cv::Matx23d(1, 0, -27, 0, 1, 19), from.size(), cv::INTER_NEAREST, cv::BORDER_REPLICATE);
    const auto found = matchArea(pixels, from, to, {0, 0}, 40);
    ASSERT_TRUE(found);
    EXPECT_NEAR(cv::norm(found->shift - cv::Point2d(-27, 19)), 0, 0.1);
}

}  // namespace eyrie::moving_areas_test
