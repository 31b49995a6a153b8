#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "registration/corners/corner_tracker.h"
#include "registration/flight.h"

namespace eyrie::registration_thresholds_test {
namespace {

using test::drift;
using test::Flight;
using test::kSize;
using test::Watch;

const cv::Size kPicture(160, 120);

/// Options of registration with one parameter set by its name.
RegistrationOptions with(const std::string& name, const std::string& value) {
    RegistrationOptions options;
    setParameter(describeOf(options), name, value);
    return options;
}

cv::Mat ground(unsigned seed, double contrast, double noise) {
    return test::TexturedGround(seed, contrast).picture(kPicture, cv::Matx33d::eye(), noise, seed);
}

/// Corners tracked in pictures of one's choice, from a first picture of textured ground on.
struct TrackedGround {
    explicit TrackedGround(const RegistrationOptions& options)
        : tracker(options.tracking, test::scaleOf(0.3)), set(tracker.window()) {
        picture.build(ground(5, 1.5, 0));
        CornerSurroundings surroundings;
        surroundings.noise = 1;
        surroundings.margin = tracker.margin() + 8;
        CornerId next_id = 1;
        tracker.add(set, CornerDetector(options.corners, test::scaleOf(0.3)).detect(picture.level(0), surroundings),
                    picture.smooth(), next_id);
    }
    /// All were found, at their places moved by `shift(corner)`.
    template <class Shift>
    void advance(const Shift& shift, const cv::Matx33d& motion = cv::Matx33d::eye(), double sigma_px = 0) {
        std::vector<TrackedPosition> found;
        for (const TrackedCorner& corner : set.corners) {
            TrackedPosition position;
            position.found = true;
            position.contrast = 100;
            const cv::Vec3d there = motion * cv::Vec3d(double(corner.position.x), double(corner.position.y), 1);
            position.position = cv::Point2f(float(there[0]), float(there[1])) + shift(corner);
            position.offset = corner.offset;
            found.push_back(position);
        }
        HomographyFit fit;
        fit.matrix = motion;
        fit.inlier_distance_px = 1;
        fit.sigma_px = sigma_px;
        tracker.advance(set, found, fit, picture.smooth(), 1, 1);
    }

    CornerTracker tracker;
    CornerSet set;
    ImagePyramid picture;
};

cv::Point2f nowhere(const TrackedCorner& /*corner*/) {
    return {0, 0};
}

}  // namespace

TEST(RegistrationThresholds, MetresBecomePixelsWithinWhatPixelsAllow) {
    const auto window = [](const char* metres) {
        return CornerTracker(with("registration.window", metres).tracking, test::scaleOf(0.3)).window();
    };
    EXPECT_EQ(window("0.6"), 5);
    EXPECT_EQ(window("3.3"), 11);
    EXPECT_EQ(window("20"), 15);
    const auto spacing = [](const char* name, const char* value, double gsd) {
        return CornerDetector(with(name, value).corners, test::scaleOf(gsd)).spacing();
    };
    EXPECT_NEAR(spacing("registration.corner_spacing", "3", 0.3), 10, 1e-9);
    EXPECT_NEAR(spacing("registration.corner_spacing", "3", 3), RegistrationOptions().corners.min_corner_distance,
                1e-9);
    EXPECT_NEAR(spacing("registration.min_corner_distance", "5", 3), 5, 1e-9);
    EXPECT_NEAR(spacing("registration.corner_spacing", "6.3", 0.1), 63, 1e-9);
    EXPECT_NEAR(spacing("registration.corner_spacing", "20", 0.1), 64, 1e-9) << "however fine the picture";
}

TEST(RegistrationThresholds, MaxSpeedIsHowFarACornerMayGo) {
    // 6 px in a frame of 0.3 m pixels at 25 Hz are 45 m/s.
    const TrackedGround scene({});
    ImagePyramid next;
    next.build(test::TexturedGround(5, 1.5).picture(kPicture, test::cameraMotion(kPicture, -6, 0, 0), 0, 1));
    const auto found = [&](const char* value) {
        const CornerTracker tracker(with("registration.max_speed", value).tracking, test::scaleOf(0.3));
        int there = 0;
        for (const TrackedPosition& position : tracker.track(scene.set, scene.picture, next, cv::Matx33d::eye(), 1, 1))
            there += position.found;
        return there;
    };
    EXPECT_GT(found("50"), 2 * found("40"));
    EXPECT_GT(found("50"), scene.set.size() / 4);
}

TEST(RegistrationThresholds, ALargerTensorWindowLocatesWeakerCorners) {
    const auto corners = [](const char* value) {
        PaddedPicture picture;
        picture.copyFrom(ground(11, 0.3, 2));
        CornerSurroundings surroundings;
        surroundings.noise = 2;
        surroundings.margin = 10;
        return CornerDetector(with("registration.tensor_window", value).corners, test::scaleOf(0.3))
            .detect(picture, surroundings);
    };
    const auto three = corners("3");
    EXPECT_GT(corners("5").size(), 1.5 * double(three.size()));
    EXPECT_EQ(corners("4"), corners("5")) << "even numbers round up";
    EXPECT_NE(corners("5"), corners("7"));
}

TEST(RegistrationThresholds, MaxResidualIsTheShareOfItsContrastByWhichACornerMayChange) {
    // Something else shows through by a third.
    const TrackedGround scene(with("registration.max_residual", "2"));
    cv::Mat changed;
    cv::addWeighted(ground(5, 1.5, 0), 1, ground(6, 0.5, 0), 1, -118, changed);
    ImagePyramid next;
    next.build(changed);
    const auto track = [&](const char* value) {
        const CornerTracker tracker(with("registration.max_residual", value).tracking, test::scaleOf(0.3));
        std::vector<float> shares;
        for (const TrackedPosition& found : tracker.track(scene.set, scene.picture, next, cv::Matx33d::eye(), 0.1, 1)) {
            if (found.found) shares.push_back(found.residual / found.contrast);
        }
        return shares;
    };
    const auto loose = track("2"), strict = track("0.05");
    ASSERT_GT(strict.size(), 20U);
    EXPECT_LE(*std::max_element(strict.begin(), strict.end()), 0.05F);
    EXPECT_GT(std::count_if(loose.begin(), loose.end(), [](float share) { return share > 0.05F; }), 20);
    EXPECT_GT(loose.size(), strict.size() + 20);
}

TEST(RegistrationThresholds, MaxJerkIsByHowMuchACornerMayChangeItsMotion) {
    const auto survive = [](const char* jerk, float speed, float change) {
        TrackedGround scene(with("registration.max_jerk", jerk));
        // Its velocity is that of its first step.
        scene.advance([&](const TrackedCorner&) { return cv::Point2f(speed, 0); });
        const int before = scene.set.size();
        EXPECT_GT(before, 50);
        scene.advance([&](const TrackedCorner&) { return cv::Point2f(speed + change, 0); });
        return scene.set.size() > before / 2;
    };
    EXPECT_TRUE(survive("0.5", 0, 0.45F));
    EXPECT_FALSE(survive("0.5", 0, 0.55F));
    EXPECT_TRUE(survive("0.6", 0, 0.55F));
    EXPECT_TRUE(survive("0.5", 2, 1.45F)) << "and half its speed";
    EXPECT_FALSE(survive("0.5", 2, 1.55F));
}

TEST(RegistrationThresholds, PatchLifeIsHowLongACornerIsComparedWithOnePicture) {
    for (const int life : {1, 3, 100}) {
        TrackedGround scene(with("registration.patch_life", std::to_string(life)));
        for (int frame = 1; frame <= 6; ++frame) {
            scene.advance(nowhere);
            ASSERT_GT(scene.set.size(), 50);
            EXPECT_EQ(scene.set.corners[0].age, frame);
            EXPECT_EQ(scene.set.corners[0].patch_age, frame % life) << life;
        }
    }
}

TEST(RegistrationThresholds, PatchDeformationIsHowFarThePictureTurnsBeforeThePatchDoes) {
    // 0.3° a frame moves the border of a window of w px by w / 2 · 0.0052.
    const cv::Matx33d turn = test::cameraMotion(kPicture, 0, 0, 0.3);
    for (const char* limit : {"0.03", "0.08"}) {
        TrackedGround scene(with("registration.patch_deformation", limit));
        const double step = scene.tracker.window() / 2.0 * std::sin(0.3 * CV_PI / 180);
        const int expected = static_cast<int>(std::stod(limit) / step) + 1;
        ASSERT_GT(expected, 1);
        for (int frame = 1; frame <= expected; ++frame) {
            scene.advance(nowhere, turn);
            ASSERT_GT(scene.set.size(), 20);
            EXPECT_EQ(scene.set.corners[0].patch_turn.xy != 0, frame == expected) << limit << ", frame " << frame;
        }
    }
}

TEST(RegistrationThresholds, MinInlierShareIsHowManyMustAgree) {
    const auto trusted = [](const char* value, int inliers, double share) {
        HomographyFit fit;
        fit.inliers = inliers;
        fit.inlier_share = share;
        const HomographyEstimator estimator(with("registration.min_inlier_share", value).homography, kSize);
        return estimator.trustworthy(fit);
    };
    EXPECT_FALSE(trusted("0.12", 999, 0.1));
    EXPECT_TRUE(trusted("0.08", 999, 0.1));
    EXPECT_FALSE(trusted("0.12", 1000, 0.05)) << "of so many half of it";
    EXPECT_TRUE(trusted("0.12", 1000, 0.07));
    EXPECT_FALSE(trusted("0.08", 299, 0.28)) << "of so few three tenths";
    EXPECT_TRUE(trusted("0.08", 299, 0.32));
    EXPECT_FALSE(trusted("0.35", 299, 0.32));
}

TEST(RegistrationThresholds, RecoveryFramesIsHowLongTheLastGoodFrameIsTriedAgain) {
    for (const int blank : {3, 4}) {
        Watch watch(with("registration.recovery_frames", "3"));
        Flight flight;
        watch.see(flight);
        flight.move(drift());
        watch.see(flight);
        for (int i = 0; i < blank; ++i) {
            flight.move(drift());
            const cv::Mat dark(kSize, CV_8UC1, cv::Scalar(60 * i));
            EXPECT_EQ(watch.seePicture(dark).registration.state, RegistrationState::failed);
        }
        flight.move(drift());
        EXPECT_EQ(watch.see(flight).registration.state,
                  blank == 3 ? RegistrationState::registered : RegistrationState::failed);
    }
}

TEST(RegistrationThresholds, WhereTheGroundScattersACornerMayJumpFourDeviations) {
    const auto survive = [](float change) {
        TrackedGround scene(with("registration.max_jerk", "0.5"));
        scene.advance(nowhere);
        const int before = scene.set.size();
        scene.advance([&](const TrackedCorner&) { return cv::Point2f(change, 0); }, cv::Matx33d::eye(), 0.2);
        return scene.set.size() > before / 2;
    };
    EXPECT_TRUE(survive(0.75F));
    EXPECT_FALSE(survive(0.85F));
}

TEST(RegistrationThresholds, ACornerThatGoesItsOwnWayMovesFromItsFourthFrameOn) {
    TrackedGround scene({});
    const auto alone = [&](const TrackedCorner& corner) {
        return corner.id == 30 ? cv::Point2f(0, 0.6F) : cv::Point2f();
    };
    for (int frame = 1; frame <= 6; ++frame) {
        scene.advance(alone);
        int others = 0;
        bool seen = false;
        for (const TrackedCorner& corner : scene.set.corners) {
            if (corner.id != 30) {
                others += corner.moves;
                EXPECT_TRUE(corner.on_background);
                EXPECT_EQ(corner.drift, cv::Point2f());
                continue;
            }
            seen = true;
            EXPECT_EQ(corner.moves, frame >= 5) << frame;  // told from what was known a frame before
            EXPECT_NEAR(corner.drift.y, 0.6, 1e-4);
            EXPECT_NEAR(corner.velocity.y, 0.6, 1e-4);
        }
        EXPECT_TRUE(seen);
        EXPECT_EQ(others, 0);
    }
}

TEST(RegistrationThresholds, VelocitiesFollowTheNewestAndDriftsTheMean) {
    TrackedGround scene({});
    float step = 0;
    const auto faster = [&](const TrackedCorner&) { return cv::Point2f(step, -step); };
    double velocity = 0, drift = 0;
    for (int age = 0; age < 12; ++age) {
        step = 0.05F * float(age % 5);
        scene.advance(faster);
        velocity = age == 0 ? double(step) : velocity + 0.6 * (double(step) - velocity);
        drift += std::max(0.12, 1.0 / (age + 1)) * (double(step) - drift);
        ASSERT_GT(scene.set.size(), 50);
        EXPECT_NEAR(scene.set.corners[0].velocity.x, velocity, 1e-4) << age;
        EXPECT_NEAR(scene.set.corners[0].velocity.y, -velocity, 1e-4) << age;
        EXPECT_NEAR(scene.set.corners[0].drift.x, drift, 1e-4) << age;
    }
}

TEST(RegistrationThresholds, OfTwoThatRunTogetherTheOlderStays) {
    TrackedGround scene({});
    scene.advance(nowhere);  // some may stand too near from the start
    const cv::Point2f place = scene.set.corners[3].position;
    const int before = scene.set.size();
    ASSERT_GT(before, 50);
    scene.advance(
        [&](const TrackedCorner& corner) { return corner.id == 40 ? place - corner.position : cv::Point2f(); });
    EXPECT_EQ(scene.set.size(), before - 1);
    EXPECT_TRUE(
        std::none_of(scene.set.corners.begin(), scene.set.corners.end(), [](const auto& c) { return c.id == 40; }));
    EXPECT_EQ(scene.set.corners[3].position, place);
}

}  // namespace eyrie::registration_thresholds_test
