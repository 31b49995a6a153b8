// What independent motion and difference images remember can be kept and taken up again.
#include <gtest/gtest.h>

#include "core/state_archive.h"
#include "motion/differences/difference_motion.h"
#include "motion/moving_corners.h"
#include "motion/vectors/independent_motion.h"
#include "support/moving_scene.h"

namespace eyrie::motion_state_test {
namespace {

using test::flatFrame;
using test::MovingCorners;
using test::MovingScene;

const SceneScale kKeptScale{0.3, 25, true};

MovingCorners carsAndCorners() {
    return MovingCorners({{{300, 200}, {0.9, 0.5}}, {{100, 100}, {-1, 1}}}, 0.05);
}

template <class Stage>
std::string kept(Stage& stage) {
    StateWriter writer;
    stage.transfer(writer);
    return writer.bytes();
}

template <class Stage>
void takeUp(Stage& stage, const std::string& bytes, const PictureSource& pictures) {
    StateReader reader(bytes, pictures);
    stage.transfer(reader);
    reader.end();
}

void expectSameMotion(const FrameMotion& a, const FrameMotion& b) {
    ASSERT_EQ(a.motion_vectors.size(), b.motion_vectors.size());
    for (std::size_t i = 0; i < a.motion_vectors.size(); ++i) {
        EXPECT_EQ(a.motion_vectors[i].id, b.motion_vectors[i].id);
        EXPECT_EQ(a.motion_vectors[i].position, b.motion_vectors[i].position);
        EXPECT_EQ(a.motion_vectors[i].velocity, b.motion_vectors[i].velocity);
    }
    EXPECT_EQ(a.stationary_corners, b.stationary_corners);
    EXPECT_EQ(a.background_speed_sigma, b.background_speed_sigma);
}

TEST(MotionState, IndependentMotionGoesOnFromItAsIfNothingHadHappened) {
    // After 0 frames, while corners are young, and beyond the depth of their history.
    for (const int before : {0, 1, 4, 9, 20}) {
        MovingCorners scene = carsAndCorners();
        IndependentMotion motion({}, kKeptScale);
        for (int i = 0; i < before; ++i) motion.next(scene.next(), flatFrame(i));
        IndependentMotion other({}, kKeptScale);
        takeUp(other, kept(motion), [](FrameIndex index) { return flatFrame(int(index)).gray; });
        for (int i = before; i < before + 8; ++i) {
            const RegisteredFrame frame = scene.next();
            expectSameMotion(motion.next(frame, flatFrame(i)), other.next(frame, flatFrame(i)));
        }
        EXPECT_EQ(kept(motion), kept(other)) << before;
    }
}

TEST(MotionState, ARememberedFrameCountsLikeOneThatWasAskedAbout) {
    MovingCorners scene = carsAndCorners();
    IndependentMotion asked({}, kKeptScale);
    IndependentMotion remembered({}, kKeptScale);
    for (int i = 0; i < 16; ++i) {
        const RegisteredFrame frame = scene.next();
        const FrameMotion found = asked.next(frame, flatFrame(i));
        if (i < 14)
            remembered.remember(frame, flatFrame(i));
        else
            expectSameMotion(found, remembered.next(frame, flatFrame(i)));
    }
}

TEST(MotionState, DifferencesGoOnFromIt) {
    const MovingScene scene;
    const auto frameOf = [&](FrameIndex index) {
        return Frame{index, index * 40000, scene.draw(static_cast<int>(index)), {}};
    };
    const auto motionOf = [&](int index) {
        FrameMotion motion;
        motion.registration.state = index == 0 ? RegistrationState::first : RegistrationState::registered;
        Homography& step = motion.registration.current_from_previous;
        step.from_frame = std::max(0, index - 1);
        step.to_frame = index;
        if (index > 0) {
            step.matrix(0, 2) = -scene.camera_per_frame.x;
            step.matrix(1, 2) = -scene.camera_per_frame.y;
        }
        return motion;
    };
    DifferenceOptions options;
    options.method = MotionMethod::three_frame_difference;
    options.gap = 3;
    DifferenceMotion difference(options, kKeptScale);
    for (int i = 0; i < 8; ++i) difference.next(frameOf(i), motionOf(i));
    DifferenceMotion other(options, kKeptScale);
    takeUp(other, kept(difference), [&](FrameIndex index) { return frameOf(index).gray; });
    const DifferenceResult a = difference.next(frameOf(8), motionOf(8));
    const DifferenceResult b = other.next(frameOf(8), motionOf(8));
    ASSERT_EQ(a.clusters.size(), 2U);
    ASSERT_EQ(b.clusters.size(), 2U);
    for (std::size_t i = 0; i < 2; ++i) EXPECT_EQ(a.clusters[i].box.centre, b.clusters[i].box.centre);
    EXPECT_EQ(a.threshold, b.threshold);
}

}  // namespace
}  // namespace eyrie::motion_state_test
