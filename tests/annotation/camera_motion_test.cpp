#include "annotation/keyframes/camera_motion.h"

#include <gtest/gtest.h>

#include <limits>
#include <opencv2/core.hpp>
#include <random>

#include "annotation/scenes.h"

namespace eyrie::camera_motion_test {
namespace {

double distance(cv::Point2d a, cv::Point2d b) {
    return std::hypot(a.x - b.x, a.y - b.y);
}

TEST(CameraMotion, MapsBetweenAnyTwoFramesLikeTheProductOfAllSteps) {
    const CameraMotion camera(test::stepsOf(test::flyingView, 100));
    std::mt19937 dice(3);
    for (int i = 0; i < 500; ++i) {
        const int from = static_cast<int>(dice() % 101);
        const int to = static_cast<int>(dice() % 101);
        const auto map = camera.map(from, to);
        ASSERT_TRUE(map.has_value());
        EXPECT_EQ(map->from_frame, from);
        EXPECT_EQ(map->to_frame, to);
        Homography truth;
        truth.matrix = test::flyingView(to) * test::flyingView(from).inv();
        EXPECT_LT(distance(map->apply({123, 45}), truth.apply({123, 45})), 1e-8);
    }
}

TEST(CameraMotion, StaysPreciseOverTenThousandFramesOfAnObliqueCamera) {
    // A camera that swings: each step has perspective, and the product over all frames has too.
    const auto view = [](double frame) {
        const double swing = std::sin(frame / 300);
        return cv::Matx33d{1, 0.02 * swing, 40 * swing, -0.02 * swing, 1, 5 * std::cos(frame / 200), 4e-4 * swing, 2e-4,
                           1};
    };
    const CameraMotion camera(test::stepsOf(view, 10000));
    for (const int from : {0, 1, 4999, 8191}) {
        for (const int to : {0, 17, 4096, 9999, 10000}) {
            const auto map = camera.map(from, to);
            ASSERT_TRUE(map.has_value());
            Homography truth;
            truth.matrix = view(to) * view(from).inv();
            EXPECT_LT(distance(map->apply({300, 200}), truth.apply({300, 200})), 1e-6) << from << " to " << to;
            const auto there_and_back = camera.map(to, from)->apply(map->apply({300, 200}));
            EXPECT_LT(distance(there_and_back, {300, 200}), 1e-6);
        }
    }
}

TEST(CameraMotion, ALongFlightDoesNotSpoilMapsBetweenNeighbours) {
    // Zooming in by 1 % a frame: the product over 10,000 frames overflows any number, 100 frames do not.
    std::vector<Homography> steps;
    for (int frame = 1; frame <= 10000; ++frame) {
        Homography step;
        step.matrix = {1.01, 0, 1, 0, 1.01, 2, 0, 0, 1};
        step.from_frame = frame - 1;
        step.to_frame = frame;
        steps.push_back(step);
    }
    const CameraMotion camera(steps);
    cv::Point2d point{10, 20};
    for (int i = 0; i < 100; ++i) point = steps[0].apply(point);
    EXPECT_LT(distance(camera.map(9880, 9980)->apply({10, 20}), point), 1e-6);
}

TEST(CameraMotion, AFailedFrameBreaksTheChain) {
    std::vector<Registration> registrations;
    for (const auto& step : test::stepsOf(test::flyingView, 20)) {
        Registration registration;
        registration.current_from_previous = step;
        registration.state = step.to_frame == 10 ? RegistrationState::failed : RegistrationState::registered;
        registrations.push_back(registration);
    }
    registrations.insert(registrations.begin(), Registration{});
    const CameraMotion camera = CameraMotion::fromRegistrations(registrations);
    EXPECT_TRUE(camera.connects(0, 9));
    EXPECT_TRUE(camera.connects(20, 10));
    EXPECT_FALSE(camera.connects(9, 10));
    EXPECT_FALSE(camera.connects(15, 3));
    EXPECT_FALSE(camera.map(3, 15).has_value());
    EXPECT_TRUE(camera.map(19, 12).has_value());
    EXPECT_FALSE(camera.connects(19, 21)) << "beyond the end";
    EXPECT_TRUE(camera.connects(500, 500)) << "a frame with itself";
}

TEST(CameraMotion, MissingDamagedAndStrangeStepsBreakTheChainToo) {
    auto steps = test::stepsOf(test::flyingView, 20);
    steps[4].matrix(0, 0) = std::numeric_limits<double>::quiet_NaN();
    steps[8].matrix = cv::Matx33d::zeros();
    steps.erase(steps.begin() + 14);
    steps.push_back({});  // from frame 0 to frame 0
    std::swap(steps[0], steps[3]);
    const CameraMotion camera(steps);
    EXPECT_TRUE(camera.connects(0, 4));
    EXPECT_FALSE(camera.connects(4, 5));
    EXPECT_TRUE(camera.connects(5, 8));
    EXPECT_FALSE(camera.connects(8, 9));
    EXPECT_TRUE(camera.connects(9, 14));
    EXPECT_FALSE(camera.connects(14, 15));
}

TEST(CameraMotion, FramesWithoutStepsCostNothing) {
    auto steps = test::stepsOf(test::flyingView, 20);
    const CameraMotion near(steps);
    const int far = 2'000'000'000;
    for (const Homography& step : test::stepsOf(test::flyingView, 20)) {
        steps.push_back(step);
        steps.back().from_frame += far;
        steps.back().to_frame += far;
    }
    // With room for every frame between them this would take more memory than any machine has.
    const CameraMotion camera(steps);
    EXPECT_TRUE(camera.connects(far, far + 20));
    EXPECT_FALSE(camera.connects(20, far));
    EXPECT_FALSE(camera.connects(20, 21));
    EXPECT_FALSE(camera.connects(far - 1, far));
    for (const int to : {1, 7, 20}) EXPECT_EQ(camera.map(0, to)->matrix, near.map(0, to)->matrix);
    EXPECT_LT(distance(camera.map(far + 3, far + 17)->apply({9, 5}), near.map(3, 17)->apply({9, 5})), 1e-9);
}

TEST(CameraMotion, KnowsNothingWithoutSteps) {
    const CameraMotion camera;
    EXPECT_TRUE(camera.empty());
    EXPECT_FALSE(camera.map(0, 1).has_value());
    EXPECT_TRUE(camera.map(5, 5).has_value());
    EXPECT_EQ(CameraMotion::standing(0, 9).map(2, 9)->apply({3, 4}), cv::Point2d(3, 4));
}

}  // namespace
}  // namespace eyrie::camera_motion_test
