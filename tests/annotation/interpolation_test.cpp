#include "annotation/keyframes/interpolation.h"

#include <gtest/gtest.h>

#include "annotation/scenes.h"
#include "core/geometry/angle.h"

namespace eyrie::interpolation_test {
namespace {

using test::keyframe;
using test::object;
using test::seen;

const CameraMotion flying(test::stepsOf(test::flyingView, 120));

TEST(Interpolation, AParkedCarNeedsOneKeyframeHoweverTheCameraMoves) {
    const OrientedBox parked{{200, 150}, 20, 9, 0.7};
    const auto car = object(1, {keyframe(5, seen(parked, test::flyingView(5)))}, 110);
    for (int frame = 5; frame <= 110; ++frame) {
        const LabelledBox box = boxAt(car, frame, flying);
        EXPECT_EQ(box.source, frame == 5 ? BoxSource::keyframe : BoxSource::ground);
        EXPECT_LT(test::cornerDistance(box.box, seen(parked, test::flyingView(frame))), 1e-7) << frame;
    }
}

TEST(Interpolation, ConstantGroundSpeedNeedsTwoKeyframesAndTheHeadingFollows) {
    const auto driving = [](double frame) {
        return OrientedBox{{50 + 2.0 * frame, 100 + 1.5 * frame}, 20, 9, std::atan2(1.5, 2.0)};
    };
    OrientedBox first = seen(driving(3), test::flyingView(3));
    OrientedBox last = seen(driving(103), test::flyingView(103));
    first.heading = 1.1;  // as somebody drew it; not set, so the path counts
    last.heading = -2;
    const auto car = object(1, {keyframe(3, first), keyframe(103, last)}, 103);
    for (int frame = 3; frame <= 103; ++frame) {
        const LabelledBox box = boxAt(car, frame, flying);
        EXPECT_TRUE(box.heading_from_path);
        EXPECT_LT(test::cornerDistance(box.box, seen(driving(frame), test::flyingView(frame))), 1e-6) << frame;
    }
}

TEST(Interpolation, ConstantAccelerationIsExactOnASmoothPathWithThreeKeyframes) {
    const auto braking = [](double t) { return OrientedBox{{10 + 4 * t - 0.015 * t * t, 60}, 20, 9, 0}; };
    std::vector<Keyframe> keyframes;
    for (const int frame : {0, 30, 100})
        keyframes.push_back(keyframe(frame, seen(braking(frame), test::flyingView(frame))));
    const auto car = object(1, keyframes, 100);
    for (int frame = 0; frame <= 100; ++frame) {
        EXPECT_LT(test::cornerDistance(boxAt(car, frame, flying).box, seen(braking(frame), test::flyingView(frame))),
                  1e-6);
    }
    EXPECT_GT(
        test::cornerDistance(boxAt(car, 65, flying, PathShape::straight).box, seen(braking(65), test::flyingView(65))),
        5);
}

TEST(Interpolation, TwoKeyframesCloseTogetherHardlyChangeTheLongWayBefore) {
    const CameraMotion standing = CameraMotion::standing(0, 41);
    const double heading = 0.3;
    const cv::Point2d ahead(std::cos(heading), std::sin(heading));
    for (const bool heading_set : {false, true}) {
        std::vector<Keyframe> keyframes;
        for (const auto& [frame, driven] : {std::pair(0, 0.0), {40, 200.0}, {41, 212.0}})
            keyframes.push_back(keyframe(frame, {cv::Point2d(50, 60) + driven * ahead, 20, 9, heading}, heading_set));
        const auto car = object(1, keyframes, 41);
        for (int frame = 0; frame <= 40; ++frame) {
            const cv::Point2d driven = boxAt(car, frame, standing).box.centre - cv::Point2d(50, 60);
            EXPECT_NEAR(driven.dot(ahead), 5 * frame, 6) << heading_set << ", frame " << frame;
            EXPECT_NEAR(driven.cross(ahead), 0, 1e-6);
        }
    }
}

TEST(Interpolation, ACarThatStopsNeverRunsOnOrBack) {
    std::vector<Keyframe> keyframes;
    const double x[] = {0, 50, 100, 100, 100, 160};
    for (int i = 0; i < 6; ++i) keyframes.push_back(keyframe(20 * i, {{x[i], 30}, 20, 9, 0}));
    const auto car = object(1, keyframes, 100);
    const auto camera = CameraMotion::standing(0, 100);
    double furthest = 0;
    for (int frame = 0; frame <= 100; ++frame) {
        const LabelledBox box = boxAt(car, frame, camera);
        EXPECT_GE(box.box.centre.x, furthest - 1e-9) << frame;
        EXPECT_NEAR(box.box.heading, 0, 1e-9);
        if (frame >= 40 && frame <= 80) {
            EXPECT_NEAR(box.box.centre.x, 100, 1e-9);
        }
        furthest = box.box.centre.x;
    }
}

TEST(Interpolation, WhatStandsAfterItsLastKeyframeBrakesUntilThere) {
    const auto braking = [](double t) {
        const double s = std::min(t, 60.0);
        return OrientedBox{{10 + 3 * s - 0.025 * s * s, 60}, 20, 9, 0};
    };
    std::vector<Keyframe> keyframes;
    for (const int frame : {0, 60}) keyframes.push_back(keyframe(frame, seen(braking(frame), test::flyingView(frame))));
    const auto car = object(1, keyframes, 100);
    for (int frame = 0; frame <= 100; ++frame) {
        EXPECT_LT(test::cornerDistance(boxAt(car, frame, flying).box, seen(braking(frame), test::flyingView(frame))),
                  1e-6)
            << frame;
    }
    // An end that was put a few frames later says nothing of the kind.
    const auto driving = object(1, keyframes, 65);
    const OrientedBox middle{(braking(0).centre + braking(60).centre) / 2, 20, 9, 0};
    EXPECT_LT(test::cornerDistance(boxAt(driving, 30, flying).box, seen(middle, test::flyingView(30))), 1e-6);
}

TEST(Interpolation, ACarThatTurnsACornerAtOneSpeedNeedsFourKeyframes) {
    // 60 px straight on, a quarter of a circle with radius 25 px, 60 px straight on; 1.5 px a frame.
    const double arc = 25 * kPi / 2;
    const auto turning = [&](double t) {
        const double way = 1.5 * t;
        const double angle = std::clamp((way - 60) / 25, 0.0, kPi / 2);
        cv::Point2d at(std::min(way, 60.0) + 25 * std::sin(angle), 25 - 25 * std::cos(angle));
        at.y += std::max(0.0, way - 60 - arc);
        return OrientedBox{at, 20, 9, angle};
    };
    std::vector<Keyframe> keyframes;
    for (const int frame : {0, 40, 66, 106}) {
        keyframes.push_back(keyframe(frame, seen(turning(frame), test::flyingView(frame)), true));
    }
    const auto car = object(1, keyframes, 106);
    for (int frame = 0; frame <= 106; ++frame) {
        const OrientedBox box = boxAt(car, frame, flying).box;
        const OrientedBox truth = seen(turning(frame), test::flyingView(frame));
        EXPECT_LT(test::cornerDistance(box, truth), 0.8) << frame;
        EXPECT_GT(overlap(box, truth), 0.9) << frame;
    }
}

TEST(Interpolation, APixelBetweenNearKeyframesDoesNotBendTheLongWayAfterThem) {
    // 2 px a frame; the second keyframe, four frames after the first, was set 1.5 px too far.
    const auto car = object(
        1, {keyframe(0, {{0, 30}, 20, 9, 0}), keyframe(4, {{9.5, 30}, 20, 9, 0}), keyframe(84, {{168, 30}, 20, 9, 0})},
        84);
    const auto camera = CameraMotion::standing(0, 84);
    for (int frame = 0; frame <= 84; ++frame) EXPECT_NEAR(boxAt(car, frame, camera).box.centre.x, 2 * frame, 2.1);
}

TEST(Interpolation, UprightBoxesStayUprightAndDoNotSteer) {
    const auto at = [](double t) { return OrientedBox{{50 + 2 * t, 100 + 1.2 * t}, 24, 14, 0}; };
    std::vector<Keyframe> keyframes;
    for (const int frame : {0, 50, 100}) {
        OrientedBox box = at(frame);
        box.centre = seen(box, test::flyingView(frame)).centre;
        keyframes.push_back(keyframe(frame, box, true));
    }
    const auto car = object(1, keyframes, 100);
    for (int frame = 0; frame <= 100; frame += 5) {
        const OrientedBox box = boxAt(car, frame, flying).box;
        const cv::Point2d truth = seen(at(frame), test::flyingView(frame)).centre;
        EXPECT_LT(cv::norm(box.centre - truth), 1e-6) << frame;
        EXPECT_NEAR(box.heading, 0, 1e-9) << frame;
    }
}

TEST(Interpolation, WithoutHomographiesItRunsInTheImageAndSaysSo) {
    const auto car = object(1, {keyframe(0, {{0, 0}, 20, 9, 0}), keyframe(10, {{100, 50}, 30, 12, 0})}, 15);
    const CameraMotion nothing;
    const LabelledBox box = boxAt(car, 5, nothing);
    EXPECT_EQ(box.source, BoxSource::image);
    EXPECT_NEAR(box.box.centre.x, 50, 1e-9);
    EXPECT_NEAR(box.box.centre.y, 25, 1e-9);
    EXPECT_NEAR(box.box.length, 25, 1e-9);
    EXPECT_NEAR(box.box.width, 10.5, 1e-9);
    EXPECT_NEAR(box.box.heading, std::atan2(50, 100), 1e-9);
    EXPECT_EQ(boxAt(car, 12, nothing).source, BoxSource::image);
    EXPECT_NEAR(boxAt(car, 12, nothing).box.centre.x, 100, 1e-9);
    EXPECT_EQ(boxAt(car, 10, nothing).source, BoxSource::keyframe);
    EXPECT_NEAR(boxAt(car, 10, nothing).box.heading, std::atan2(50, 100), 1e-9);
}

TEST(Interpolation, ABrokenChainFallsBackToTheImageOnlyWhereItIsBroken) {
    auto steps = test::stepsOf(test::flyingView, 100);
    steps.erase(steps.begin() + 50);
    const CameraMotion broken(steps);
    const OrientedBox parked{{200, 150}, 20, 9, 0.7};
    std::vector<Keyframe> keyframes;
    for (const int frame : {0, 40, 60, 90})
        keyframes.push_back(keyframe(frame, seen(parked, test::flyingView(frame)), true));
    const auto car = object(1, keyframes, 100);
    EXPECT_EQ(boxAt(car, 20, broken).source, BoxSource::ground);
    EXPECT_EQ(boxAt(car, 45, broken).source, BoxSource::image);
    EXPECT_EQ(boxAt(car, 59, broken).source, BoxSource::image);
    EXPECT_EQ(boxAt(car, 75, broken).source, BoxSource::ground);
    EXPECT_EQ(boxAt(car, 95, broken).source, BoxSource::ground);
    for (const int frame : {20, 60, 75, 95}) {
        EXPECT_LT(test::cornerDistance(boxAt(car, frame, broken).box, seen(parked, test::flyingView(frame))), 1e-6)
            << frame;
    }
}

TEST(Interpolation, AnglesTakeTheShorterArc) {
    const auto degrees = [](double d) { return radiansFromDegrees(d); };
    const auto camera = CameraMotion::standing(0, 20);
    // Standing on the spot, turning from 350° to 10°: through 0°, not through 180°.
    const auto car =
        object(1, {keyframe(0, {{50, 50}, 20, 9, degrees(350)}), keyframe(10, {{50, 50}, 20, 9, degrees(10)})}, 10);
    EXPECT_NEAR(boxAt(car, 5, camera).box.heading, 0, 1e-9);
    EXPECT_NEAR(degreesFromRadians(boxAt(car, 2, camera).box.heading), 354, 1e-6);
    // The same with set headings on a car that drives.
    const auto skidding = object(
        1, {keyframe(0, {{50, 50}, 20, 9, degrees(170)}, true), keyframe(10, {{150, 50}, 20, 9, degrees(-170)}, true)},
        10);
    EXPECT_NEAR(std::abs(boxAt(skidding, 5, camera).box.heading), kPi, 1e-9);
}

TEST(Interpolation, ASetHeadingFadesIntoThePath) {
    const auto camera = CameraMotion::standing(0, 20);
    const auto car = object(1, {keyframe(0, {{0, 0}, 20, 9, 0.4}, true), keyframe(10, {{100, 0}, 20, 9, 2})}, 10);
    EXPECT_NEAR(boxAt(car, 0, camera).box.heading, 0.4, 1e-9);
    EXPECT_NEAR(boxAt(car, 5, camera).box.heading, 0.2, 1e-9);
    EXPECT_NEAR(boxAt(car, 10, camera).box.heading, 0, 1e-9);
}

TEST(Interpolation, HeadingIsContinuousThroughATurn) {
    std::vector<Keyframe> keyframes;
    for (int i = 0; i <= 6; ++i) {
        const double angle = i * 0.5;
        keyframes.push_back(keyframe(10 * i, {{100 * std::sin(angle), 100 - 100 * std::cos(angle)}, 20, 9, 0}));
    }
    const auto car = object(1, keyframes, 60);
    const auto camera = CameraMotion::standing(0, 60);
    for (int frame = 1; frame <= 60; ++frame) {
        const double turn =
            turnBetween(boxAt(car, frame - 1, camera).box.heading, boxAt(car, frame, camera).box.heading);
        EXPECT_NEAR(turn, 0.05, 0.02) << frame;
        EXPECT_NEAR(turnBetween(frame * 0.05, boxAt(car, frame, camera).box.heading), 0, 0.05) << frame;
    }
}

TEST(Interpolation, AnObjectEndsWhereToldAndIsNotThereBefore) {
    const auto car = object(1, {keyframe(10, {{0, 0}, 20, 9, 0})}, 20);
    EXPECT_FALSE(boxAt(car, 9, flying).exists());
    EXPECT_TRUE(boxAt(car, 20, flying).exists());
    EXPECT_FALSE(boxAt(car, 21, flying).exists());
    EXPECT_FALSE(boxAt(LabelledObject{}, 0, flying).exists());
    auto cut = object(1, {keyframe(10, {{0, 0}, 20, 9, 0}), keyframe(30, {{90, 0}, 20, 9, 0})}, 20);
    EXPECT_FALSE(boxAt(cut, 25, flying).exists()) << "a keyframe behind the end does not bring it back";
}

TEST(Interpolation, FlagsComeFromTheKeyframeBefore) {
    auto first = keyframe(0, {{0, 0}, 20, 9, 0});
    auto second = keyframe(10, {{50, 0}, 20, 9, 0});
    second.outside = true;
    second.occlusion = Occlusion::fully;
    auto third = keyframe(20, {{70, 40}, 20, 9, 0});
    third.ignore = true;
    third.occlusion = Occlusion::partly;
    const auto car = object(1, {first, second, third}, 30);
    EXPECT_TRUE(boxAt(car, 9, flying).visible());
    EXPECT_FALSE(boxAt(car, 10, flying).visible());
    EXPECT_TRUE(boxAt(car, 15, flying).exists());
    EXPECT_EQ(boxAt(car, 15, flying).occlusion, Occlusion::fully);
    EXPECT_TRUE(boxAt(car, 25, flying).visible());
    EXPECT_TRUE(boxAt(car, 25, flying).ignore);
    EXPECT_EQ(boxAt(car, 25, flying).occlusion, Occlusion::partly);
    // Where it comes back does not bend the path before it went.
    EXPECT_NEAR(boxAt(car, 5, CameraMotion::standing(0, 30)).box.centre.y, 0, 1e-9);
}

TEST(Interpolation, TurningThePictureTurnsTheBoxes) {
    const double angle = 0.9;
    const cv::Matx33d turn{std::cos(angle), -std::sin(angle), 30, std::sin(angle), std::cos(angle), -8, 0, 0, 1};
    const auto turned_view = [&](double frame) { return turn * test::flyingView(frame); };
    const CameraMotion turned(test::stepsOf(turned_view, 120));
    std::vector<Keyframe> plain, other;
    for (const int frame : {0, 25, 60, 90}) {
        const OrientedBox on_ground{{frame * 2.0, 40 * std::sin(frame / 20.0)}, 20, 9, 0.3};
        plain.push_back(keyframe(frame, seen(on_ground, test::flyingView(frame)), frame == 25));
        other.push_back(keyframe(frame, seen(on_ground, turned_view(frame)), frame == 25));
    }
    for (int frame = 0; frame <= 100; frame += 3) {
        const OrientedBox box = boxAt(object(1, plain, 100), frame, flying).box;
        EXPECT_LT(test::cornerDistance(seen(box, turn), boxAt(object(1, other, 100), frame, turned).box), 1e-6)
            << frame;
    }
}

TEST(Keyframes, AreSetReplacedAndRemoved) {
    LabelledObject car = withKeyframe({}, keyframe(10, {{1, 1}, 20, 9, 0}));
    EXPECT_EQ(car.last_frame, 10);
    car.keyframes[0].occlusion = Occlusion::partly;
    car = withBox(car, 20, {{5, 5}, 20, 9, 1}, true);
    ASSERT_EQ(car.keyframes.size(), 2U);
    EXPECT_EQ(car.last_frame, 20);
    EXPECT_EQ(car.keyframes[1].occlusion, Occlusion::partly) << "flags go on";
    car = withBox(car, 10, {{2, 2}, 20, 9, 1}, false);
    ASSERT_EQ(car.keyframes.size(), 2U);
    EXPECT_EQ(car.keyframes[0].box.centre.x, 2);
    car = withBox(car, 4, {{0, 0}, 20, 9, 1}, false);
    EXPECT_EQ(firstFrameOf(car), 4);
    EXPECT_EQ(nextKeyframe(car, 4)->frame, 10);
    EXPECT_EQ(previousKeyframe(car, 20)->frame, 10);
    EXPECT_EQ(keyframeAt(car, 11), nullptr);
    car = withoutKeyframe(car, 10);
    car = withoutKeyframe(car, 11);
    EXPECT_EQ(car.keyframes.size(), 2U);
    car = withoutKeyframe(withoutKeyframe(car, 4), 20);
    EXPECT_EQ(car.keyframes.size(), 1U) << "one always stays";
}

TEST(Keyframes, TakeTheSizeOfOneOnTheGround) {
    using test::flyingView;
    const CameraMotion camera(test::stepsOf(flyingView, 80));
    const OrientedBox right{{40, 60}, 22, 9, 0.3};
    const OrientedBox wrong{{90, 70}, 30, 12, 0.3};
    LabelledObject car =
        object(1, {keyframe(0, seen(right, flyingView(0))), keyframe(80, seen(wrong, flyingView(80)))}, 80);
    const OrientedBox before = car.keyframes[1].box;
    car = withSize(std::move(car), 0, seen(right, flyingView(0)), camera);
    const OrientedBox& after = car.keyframes[1].box;
    EXPECT_NEAR(after.length, 22 * 1.16, 0.01) << "the camera has come nearer";
    EXPECT_NEAR(after.width, 9 * 1.16, 0.01);
    EXPECT_EQ(after.centre, before.centre);
    EXPECT_EQ(after.heading, before.heading);
    car = withSize(std::move(car), 80, after, {});
    EXPECT_EQ(car.keyframes[0].box.length, after.length) << "nothing is known of the camera";
}

TEST(Keyframes, TakeOverWhatOneOfThemCorrects) {
    // A track that is 2 px behind its vehicle and a quarter too long, all the way; the vehicle turns.
    const CameraMotion camera(test::stepsOf(test::flyingView, 100));
    const auto truth = [](double t) {
        const double angle = 0.01 * t;
        return OrientedBox{{200 * std::sin(angle), 200 - 200 * std::cos(angle)}, 20, 9, angle};
    };
    std::vector<Keyframe> keyframes;
    for (const int frame : {0, 30, 60, 90}) {
        OrientedBox box = truth(frame);
        box.centre = box.toImage({-2, 0});
        box.length *= 1.25;
        keyframes.push_back(keyframe(frame, seen(box, test::flyingView(frame)), true));
    }
    auto car = object(1, keyframes, 90);
    car = withBox(std::move(car), 45, seen(truth(45), test::flyingView(45)), true);
    const auto corrected = withCorrectionSpread(car, 45, camera);
    ASSERT_EQ(corrected.keyframes.size(), 5U);
    for (const Keyframe& entry : corrected.keyframes) {
        EXPECT_LT(test::cornerDistance(entry.box, seen(truth(entry.frame), test::flyingView(entry.frame))), 1.0)
            << entry.frame;
    }
    EXPECT_EQ(withCorrectionSpread(car, 46, camera).keyframes[0].box.length, car.keyframes[0].box.length)
        << "there is no keyframe that corrects";
}

TEST(Interpolation, AllObjectsOfAFrame) {
    AnnotationSet set;
    set.objects[7] = object(7, {keyframe(0, {{1, 1}, 20, 9, 0})}, 5);
    set.objects[9] = object(9, {keyframe(6, {{2, 2}, 20, 9, 0})}, 9);
    ASSERT_EQ(boxesAt(set, 5, flying).size(), 1U);
    EXPECT_EQ(boxesAt(set, 5, flying)[0].id, 7);
    EXPECT_TRUE(boxesAt(set, 10, flying).empty());
}

}  // namespace
}  // namespace eyrie::interpolation_test
