#include "motion/vectors/independent_motion.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <random>
#include <set>
#include <string>
#include <tuple>

#include "core/error.h"
#include "motion/clusters/motion_clustering.h"
#include "motion/moving_corners.h"

namespace eyrie::independent_motion_test {
namespace {

using test::flatFrame;
using test::MovingCorners;
using test::MovingPatch;

const SceneScale kScale{0.3, 25, true};

IndependentMotionOptions plain() {
    IndependentMotionOptions options;
    options.baseline = 12;
    options.shadow.shadow_test = false;  // flat frames are nothing but shadow or nothing but ground
    return options;
}

FrameMotion after(IndependentMotion& motion, MovingCorners& scene, int frames) {
    FrameMotion last;
    for (int i = 0; i < frames; ++i) {
        const RegisteredFrame registered = scene.next();
        last = motion.next(registered, flatFrame(registered.frame));
    }
    return last;
}

TEST(IndependentMotion, FindsAVehicleUnderATurningCamera) {
    const cv::Point2d velocity(0.9, 0.5);
    MovingCorners scene({{{300, 200}, velocity}}, 0.05);
    IndependentMotion motion(plain(), kScale);
    const FrameMotion found = after(motion, scene, 12);

    std::set<CornerId> ids;
    int true_vectors = 0;
    for (const MotionVector& v : found.motion_vectors) {
        ids.insert(v.id);
        if (v.id <= scene.backgroundCount()) continue;
        ++true_vectors;
        // Relative to the ground, in the axes of frame 11: turned and zoomed like the camera since frame 0.
        const cv::Point2d p = v.position;
        const cv::Matx33d image_from_ground = MovingCorners::camera(11);
        const cv::Point2d ground = MovingCorners::mapped(image_from_ground.inv(), p);
        const cv::Point2d expected = p - MovingCorners::mapped(image_from_ground, ground - velocity);
        // End points over 11 frames with 0.05 px each: deviation 0.05·√2/11 ≈ 0.0064.
        EXPECT_NEAR(v.velocity.x, expected.x, 0.03);
        EXPECT_NEAR(v.velocity.y, expected.y, 0.03);
    }
    EXPECT_EQ(true_vectors, 24);
    EXPECT_LE(found.motion_vectors.size(), 24U + 2U);
    EXPECT_EQ(ids.size(), found.motion_vectors.size());
    EXPECT_EQ(found.corner_count, 1524);
    EXPECT_GT(found.stationary_corners.size(), 1490U);
    EXPECT_NEAR(found.background_speed_sigma, 0.05 * std::sqrt(2.0) / 11, 0.001);
}

TEST(IndependentMotion, WaitsForTheMinimumAge) {
    MovingCorners scene({{{300, 200}, {2, 0}}}, 0);
    IndependentMotion motion(plain(), kScale);
    EXPECT_TRUE(after(motion, scene, 5).motion_vectors.empty());
    EXPECT_EQ(after(motion, scene, 1).motion_vectors.size(), 24U);
}

TEST(IndependentMotion, ThresholdFollowsTheNoise) {
    // 0.12 px/frame is 0.9 m/s: below 1 m/s, above the slow limit of 0.7 m/s.
    IndependentMotionOptions options = plain();
    options.find_slow = true;
    for (const auto& [noise, expected] : {std::pair{0.02, 24U}, std::pair{1.0, 0U}}) {
        MovingCorners scene({{{300, 200}, {0.12, 0}}}, noise);
        IndependentMotion motion(options, kScale);
        const FrameMotion found = after(motion, scene, 20);
        std::size_t moving = 0;
        for (const MotionVector& v : found.motion_vectors) moving += v.id > scene.backgroundCount();
        EXPECT_LE(found.motion_vectors.size() - moving, 6U) << noise;
        EXPECT_EQ(moving, expected) << noise;
    }
}

TEST(IndependentMotion, FindsSlowVehiclesOverTheLongBaselineOnly) {
    for (const bool find_slow : {true, false}) {
        IndependentMotionOptions options = plain();
        options.find_slow = find_slow;
        MovingCorners scene({{{300, 200}, {0.11, 0}}}, 0.01);
        IndependentMotion motion(options, kScale);
        EXPECT_EQ(after(motion, scene, 9).motion_vectors.size(), 0U);
        EXPECT_EQ(after(motion, scene, 9).motion_vectors.size(), find_slow ? 24U : 0U);
    }
}

TEST(IndependentMotion, SlowCornersMustBeOldEnoughAndAreMeasuredOverTheirBaseline) {
    for (const int slow_min_age : {10, 17, 18}) {
        IndependentMotionOptions options = plain();
        options.find_slow = true;
        options.slow_min_age = slow_min_age;
        options.slow_baseline = 17;
        MovingCorners scene({{{300, 200}, {0.11, 0}}}, 0.01);
        IndependentMotion motion(options, kScale);
        FrameMotion last;
        CornerVerdicts verdicts;
        for (int i = 0; i < 18; ++i) last = motion.next(scene.next(), flatFrame(i), &verdicts);
        EXPECT_EQ(last.motion_vectors.size(), slow_min_age <= 17 ? 24U : 0U) << slow_min_age;
        EXPECT_EQ(verdicts.back().baseline, slow_min_age <= 17 ? 17 : 12) << slow_min_age;
        EXPECT_NEAR(verdicts.back().speed, 0.11, 0.01);
        EXPECT_EQ(verdicts.back().age, 17);
    }
}

TEST(IndependentMotion, BridgesAFrozenPicture) {
    MovingCorners scene({{{300, 200}, {1.5, 0}}}, 0);
    IndependentMotion motion(plain(), kScale);
    const FrameMotion before = after(motion, scene, 10);

    RegisteredFrame frozen;
    frozen.frame = 10;
    frozen.registration.state = RegistrationState::frozen;
    frozen.registration.current_from_previous.from_frame = 9;
    frozen.registration.current_from_previous.to_frame = 10;
    const FrameMotion during = motion.next(frozen, flatFrame(10));
    EXPECT_EQ(during.frame, 10);
    ASSERT_EQ(during.motion_vectors.size(), before.motion_vectors.size());

    RegisteredFrame next = scene.next();  // the scene's frame 10 is shown as frame 11
    next.frame = 11;
    next.registration.current_from_previous.from_frame = 10;
    next.registration.current_from_previous.to_frame = 11;
    const FrameMotion after_it = motion.next(next, flatFrame(11));
    ASSERT_EQ(after_it.motion_vectors.size(), 24U);
    EXPECT_NEAR(cv::norm(after_it.motion_vectors[0].velocity), 1.5, 0.03);
}

TEST(IndependentMotion, MeasuresOverAllThatPassedWhileThePictureStood) {
    MovingCorners scene({{{300, 200}, {1.5, 0}}}, 0);
    IndependentMotion motion(plain(), kScale);
    after(motion, scene, 10);
    cv::Matx33d passed = cv::Matx33d::eye();
    for (int lost = 0; lost < 3; ++lost) passed = scene.next().registration.current_from_previous.matrix * passed;
    RegisteredFrame next = scene.next();  // the scene's frame 13
    next.frame = 10;
    next.registration.elapsed = 4;
    Homography& step = next.registration.current_from_previous;
    step.matrix = step.matrix * passed;
    step.from_frame = 9;
    step.to_frame = 10;
    const FrameMotion found = motion.next(next, flatFrame(10));
    ASSERT_EQ(found.motion_vectors.size(), 24U);
    EXPECT_NEAR(cv::norm(found.motion_vectors[0].velocity), 1.5, 0.03);
}

TEST(IndependentMotion, GoesOnBehindAFrameThatFailed) {
    // The failed frame brings foreign corners and a guess; the next brings the old ids back and mends the guess.
    MovingCorners scene({{{300, 200}, {1.5, 0}}}, 0);
    IndependentMotion motion(plain(), kScale);
    const double speed = cv::norm(after(motion, scene, 10).motion_vectors.at(0).velocity);
    RegisteredFrame failed = scene.next();
    const cv::Matx33d truth = failed.registration.current_from_previous.matrix;
    failed.registration.state = RegistrationState::failed;
    failed.registration.current_from_previous.matrix = cv::Matx33d(1, 0, 7, 0, 1, -3, 0, 0, 1);
    for (Corner& corner : failed.corners) corner.id += 100000;
    EXPECT_TRUE(motion.next(failed, flatFrame(10)).motion_vectors.empty());

    RegisteredFrame next = scene.next();
    Homography& step = next.registration.current_from_previous;
    step.matrix = step.matrix * truth * failed.registration.current_from_previous.matrix.inv();
    const FrameMotion found = motion.next(next, flatFrame(11));
    ASSERT_EQ(found.motion_vectors.size(), 24U);
    EXPECT_NEAR(cv::norm(found.motion_vectors[0].velocity), speed, 0.02) << "the lost frame took time too";
}

TEST(IndependentMotion, FasterThanAnyVehicleIsATrackingErrorWhereTheScaleIsKnown) {
    // 70 m/s are 9.33 px/frame.
    for (const auto& [speed, known, expected] : {std::tuple{9.0, true, 24U}, {10.0, true, 0U}, {10.0, false, 24U}}) {
        IndependentMotion motion(plain(), {0.3, 25, known});
        MovingCorners scene({{{100, 200}, {speed, 0}}}, 0);
        CornerVerdicts verdicts;
        FrameMotion last;
        for (int i = 0; i < 8; ++i) last = motion.next(scene.next(), flatFrame(i), &verdicts);
        EXPECT_EQ(last.motion_vectors.size(), expected) << speed;
        EXPECT_EQ(verdicts.back().fate, expected > 0 ? CornerFate::moving : CornerFate::too_fast);
        EXPECT_NEAR(verdicts.back().limit, expected == 0 ? 9.33 : 0.133, 0.01);
    }
}

TEST(IndependentMotion, RoofsThatRiseAreTakenForStandingOnceHalfTheBaselineIsMeasured) {
    // Roofs of many heights seem to move along x by up to .11 px/frame, below 1 m/s = .133; then four faster things.
    std::vector<MovingPatch> patches;
    for (int i = 0; i < 60; ++i) {
        const cv::Point2d centre(40 + i % 10 * 60, 60 + i / 10 * 70);
        patches.push_back({centre, {0.11 * (i + 1) / 60, 0}, 20, 10, 8});
    }
    for (const cv::Point2d velocity : {cv::Point2d(0.15, 0), {0, 0.15}, {0.5, 0}, {-0.15, 0}})
        patches.push_back({{320, 240}, velocity, 20, 10, 1});
    MovingCorners scene(patches, 0.005, 2);
    IndependentMotion motion(plain(), kScale);
    for (int t = 0; t < 10; ++t) {
        RegisteredFrame registered = scene.next();
        for (Corner& corner : registered.corners) corner.on_background = true;
        CornerVerdicts verdicts;
        motion.next(registered, flatFrame(t), &verdicts);
        if (t < 5) continue;
        const auto fateOf = [&](std::size_t from_end) { return verdicts[verdicts.size() - from_end].fate; };
        EXPECT_EQ(fateOf(4), t < 6 ? CornerFate::moving : CornerFate::parallax) << t;
        EXPECT_EQ(fateOf(3), CornerFate::moving) << "across the others, " << t;
        EXPECT_EQ(fateOf(2), CornerFate::moving) << "far faster, " << t;
        EXPECT_EQ(fateOf(1), CornerFate::moving) << "the other way, " << t;
    }
}

TEST(IndependentMotion, NoiseIsThatOfTheBackgroundWhereAQuarterOfTheCornersBelongsToIt) {
    for (const int every : {4, 5}) {
        MovingCorners scene({}, 0.05);
        IndependentMotion motion(plain(), kScale);
        double sigma = 0;
        for (int t = 0; t < 8; ++t) {
            RegisteredFrame registered = scene.next();
            for (std::size_t i = 0; i < registered.corners.size(); ++i) {
                Corner& corner = registered.corners[i];
                corner.on_background = i % static_cast<std::size_t>(every) == 0;
                // All others drift.
                if (!corner.on_background) corner.current.x += 3.F * static_cast<float>(t);
            }
            sigma = motion.next(registered, flatFrame(t)).background_speed_sigma;
        }
        if (every == 4)
            EXPECT_NEAR(sigma, 0.05 * std::sqrt(2.0) / 7 * 7 / 12, 0.003) << "rare baselines: the way over 12 frames";
        else
            EXPECT_GT(sigma, 0.5) << "too few are left to be trusted";
    }
}

TEST(IndependentMotion, StartsAnewAfterACut) {
    MovingCorners scene({{{300, 200}, {1.5, 0}}}, 0);
    IndependentMotion motion(plain(), kScale);
    after(motion, scene, 10);
    RegisteredFrame failed = scene.next();
    failed.registration.state = RegistrationState::failed;
    failed.registration.current_from_previous.matrix = cv::Matx33d::all(std::nan(""));
    EXPECT_TRUE(motion.next(failed, flatFrame(10)).motion_vectors.empty());
    EXPECT_TRUE(after(motion, scene, 5).motion_vectors.empty());
    EXPECT_EQ(after(motion, scene, 1).motion_vectors.size(), 24U);
}

TEST(IndependentMotion, TreatsAJumpInTheVideoAsAStart) {
    MovingCorners scene({{{300, 200}, {1.5, 0}}}, 0);
    IndependentMotion motion(plain(), kScale);
    after(motion, scene, 10);
    scene.next();
    EXPECT_TRUE(after(motion, scene, 1).motion_vectors.empty());
    EXPECT_EQ(after(motion, scene, 5).motion_vectors.size(), 24U);
}

TEST(IndependentMotion, ForgetsOnReset) {
    MovingCorners scene({{{300, 200}, {1.5, 0}}}, 0);
    IndependentMotion motion(plain(), kScale);
    after(motion, scene, 10);
    motion.reset();
    EXPECT_TRUE(after(motion, scene, 1).motion_vectors.empty());
}

TEST(IndependentMotion, LeavesOutShadowsAndNothingThatComesAfterThem) {
    // A vehicle with its shadow beside it, and another vehicle whose corners have higher numbers.
    const MovingPatch vehicle{{300, 200}, {1.5, 0}, 18, 6, 20};
    const MovingPatch shadow{{302, 209}, {1.5, 0}, 18, 6, 20};
    const MovingPatch other{{150, 300}, {1.5, 0}, 18, 6, 20};
    for (const bool asked : {false, true}) {
        MovingCorners scene({vehicle, shadow, other}, 0);
        const CornerId first = scene.backgroundCount() + 1;
        IndependentMotion motion(IndependentMotionOptions{}, kScale);
        FrameMotion found;
        CornerVerdicts verdicts;
        for (int i = 0; i < 12; ++i) {
            const RegisteredFrame registered = scene.next();
            Frame frame = flatFrame(registered.frame);
            frame.gray.setTo(140);
            for (const auto& [from, value, margin] : {std::tuple{20, 80, 2.0F}, {0, 200, 1.0F}}) {
                std::vector<cv::Point2f> places;
                for (const Corner& corner : registered.corners) {
                    if (corner.id >= first + from && corner.id < first + from + 20) places.push_back(corner.current);
                }
                cv::Rect2f area = cv::boundingRect(places);
                area -= cv::Point2f(margin, margin);
                area += cv::Size2f(2 * margin, 2 * margin);
                frame.gray(cv::Rect(area) & cv::Rect({0, 0}, frame.gray.size())).setTo(value);
            }
            found = motion.next(registered, frame, asked ? &verdicts : nullptr);
        }
        int on[3] = {};
        for (const MotionVector& vector : found.motion_vectors) {
            if (!vector.isInferred() && vector.id >= first) ++on[(vector.id - first) / 20];
        }
        EXPECT_GE(on[0], 18) << asked;
        EXPECT_LE(on[1], 10) << asked;
        EXPECT_EQ(on[2], 20) << asked;
        const auto told = std::count_if(verdicts.begin(), verdicts.end(),
                                        [](const CornerVerdict& v) { return v.fate == CornerFate::shadow; });
        EXPECT_EQ(told, asked ? 20 - on[1] : 0);
    }
}

TEST(IndependentMotion, NamesTheParameterThatASlowCornerFellShortOf) {
    for (const auto& [noise, min_speed_px, parameter] : {std::tuple{0.01, 0.0, "motion.min_speed"},
                                                         {1.0, 0.0, "motion.sigma_factor"},
                                                         {0.01, 0.3, "motion.min_speed_px"}}) {
        MovingCorners scene({{{300, 200}, {0.03, 0}}}, noise);
        IndependentMotionOptions options = plain();
        options.find_slow = false;
        options.min_speed_px = min_speed_px;
        IndependentMotion motion(options, kScale);
        CornerVerdicts verdicts;
        for (int i = 0; i < 12; ++i) {
            const RegisteredFrame registered = scene.next();
            motion.next(registered, flatFrame(registered.frame), &verdicts);
        }
        int slow = 0;
        for (const CornerVerdict& verdict : verdicts) {
            if (verdict.id <= scene.backgroundCount() || verdict.fate != CornerFate::slow) continue;
            ++slow;
            EXPECT_EQ(verdict.parameter, parameter);
            EXPECT_LT(verdict.speed, verdict.limit);
        }
        EXPECT_GE(slow, 12) << parameter;
    }
}

TEST(IndependentMotion, TakesFramesWithoutAnything) {
    IndependentMotion motion({}, kScale);
    RegisteredFrame nothing;
    const FrameMotion found = motion.next(nothing, Frame{});
    EXPECT_TRUE(found.motion_vectors.empty());
    EXPECT_EQ(found.background_speed_sigma, 0);
    nothing.frame = 1;
    nothing.registration.state = RegistrationState::registered;
    nothing.registration.current_from_previous.to_frame = 1;
    EXPECT_TRUE(motion.next(nothing, Frame{}).motion_vectors.empty());
}

TEST(IndependentMotion, LocalBackgroundTakesOutParallax) {
    // The upper left corner of the scene drifts: a roof that one homography cannot follow.
    IndependentMotionOptions options = plain();
    options.find_slow = false;
    std::map<std::string, std::size_t> found;
    for (const std::string setting : {"off", "on", "coarse", "crowded"}) {
        options.local_background = {};
        options.local_background.local_background = setting != "off";
        if (setting == "coarse") options.local_background.local_background_cell_m = 200;  // 667 px
        if (setting == "crowded") options.local_background.local_background_min_corners = 1000;
        MovingPatch roof{{60, 60}, {0.3, 0}, 100, 100, 200};
        MovingCorners scene({roof}, 0.01, 1, 1500);
        IndependentMotion motion(options, kScale);
        for (int t = 0; t < 10; ++t) {
            RegisteredFrame registered = scene.next();
            for (Corner& corner : registered.corners) corner.on_background = true;
            found[setting] = motion.next(registered, flatFrame(t)).motion_vectors.size();
        }
    }
    EXPECT_GT(found["off"], 150U);
    EXPECT_LT(found["on"], 100U);
    EXPECT_EQ(found["coarse"], found["off"]) << "the median of the whole picture is that of the ground";
    EXPECT_EQ(found["crowded"], found["off"]) << "no cell holds so many corners";
}

TEST(IndependentMotionOptions, ThesisUsesOneThresholdAfterFiveFrames) {
    const IndependentMotionOptions options = IndependentMotionOptions::thesis();
    EXPECT_EQ(options.min_age, 5);
    EXPECT_EQ(options.baseline, 5);
    EXPECT_FALSE(options.follow_turns);
    EXPECT_FALSE(options.find_slow);
    EXPECT_EQ(options.sigma_factor, 0);
    EXPECT_EQ(options.noise_cell, 0);
    EXPECT_EQ(options.max_speed_m_s, 0);
    EXPECT_FALSE(options.shadow.shadow_test);
    EXPECT_FALSE(options.silhouettes.silhouettes);
    EXPECT_FALSE(options.areas.areas);
    EXPECT_FALSE(options.parallax.parallax_test);
    EXPECT_FALSE(options.local_background.local_background);
    MovingCorners scene({{{300, 200}, {0.9, 0.5}}}, 0.02);
    IndependentMotion motion(options, kScale);
    EXPECT_EQ(after(motion, scene, 12).motion_vectors.size(), 24U);
}

/// Mean heading of the patch's vectors relative to the last step it really took, radians.
double headingError(bool follow_turns) {
    MovingPatch patch{{300, 200}, {1.5, 0}};
    patch.turn = 0.05;
    MovingCorners scene({patch}, 0.03);
    IndependentMotionOptions options = plain();
    options.follow_turns = follow_turns;
    IndependentMotion motion(options, kScale);
    const FrameMotion found = after(motion, scene, 20);
    cv::Point2d sum(0, 0);
    for (const MotionVector& v : found.motion_vectors) {
        if (v.id > scene.backgroundCount()) sum += cv::Point2d(v.velocity);
    }
    const cv::Matx33d camera = MovingCorners::camera(19);
    const cv::Point2d end = patch.centre + patch.way(19);
    const cv::Point2d expected =
        MovingCorners::mapped(camera, end) - MovingCorners::mapped(camera, end - patch.velocityAt(18));
    return std::abs(std::atan2(sum.cross(expected), sum.dot(expected)));
}

TEST(IndependentMotion, FindsASlowVehicleOnStillGroundBesideRelief) {
    const auto found = [](double cell) {
        IndependentMotionOptions options = plain();
        options.noise_cell = cell;
        options.min_speed_m_s = 0;
        options.parallax.parallax_test = false;
        MovingCorners scene({{{150, 240}, {0.12, 0}}}, 0, 3, 4000);
        const CornerId first = scene.backgroundCount() + 1;
        std::mt19937 random(7);
        std::normal_distribution<float> noise;
        IndependentMotion motion(options, kScale);
        FrameMotion last;
        for (int t = 0; t < 16; ++t) {
            RegisteredFrame frame = scene.next();
            for (Corner& corner : frame.corners) {
                const float much = corner.current.x < 230 ? 0.05F : 0.5F;  // a road, then relief
                corner.current += cv::Point2f(much * noise(random), much * noise(random));
            }
            last = motion.next(frame, flatFrame(t));
        }
        return std::count_if(last.motion_vectors.begin(), last.motion_vectors.end(),
                             [&](const MotionVector& v) { return v.id >= first && !v.isInferred(); });
    };
    EXPECT_GE(found(0.0625), 20);
    EXPECT_LE(found(0), 8);
}

TEST(IndependentMotion, FollowsTurns) {
    // The mean over 12 frames is 5.5 frames old: 0.05 · 5.5 = 0.275 radians behind.
    EXPECT_NEAR(headingError(false), 0.275, 0.03);
    EXPECT_LT(headingError(true), 0.06);
}

}  // namespace
}  // namespace eyrie::independent_motion_test
