#include "tracking/tracker.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "tracking/tracked_scene.h"

namespace eyrie::tracker_interruption_test {
namespace {

using test::MovingScene;
using test::twoCars;

}  // namespace

TEST(TrackerInterruption, objectsLeaveOverTheBorderAtFullSize) {
    MovingScene scene;
    scene.objects = {{{560, 240}, {2, 0}, 40, 14, 0}};
    Tracker tracker({}, scene.scale);
    int last_seen = 0;
    for (int frame = 0; frame < 80; ++frame) {
        // The detection is what is visible of it, less 3 px at the edge, and ends when little is left.
        std::vector<Detection> detections = scene.detections(frame);
        OrientedBox& box = detections[0].box;
        const double front = std::min(box.centre.x + 20, 636.0);
        const double rear = box.centre.x - 20;
        box.centre.x = (front + rear) / 2;
        box.length = front - rear;
        if (box.length < 6) detections.clear();
        FrameMotion motion = scene.motion(frame);
        std::erase_if(motion.motion_vectors, [](const MotionVector& v) { return v.position.x > 636; });
        const auto states = tracker.next(motion, detections);
        if (!states.empty()) last_seen = frame;
        const OrientedBox truth = scene.box(0, frame);
        const double visible = areaInImage(truth, scene.image) / truth.area();
        if (visible > 0.1) {
            ASSERT_EQ(states.size(), 1u) << frame;
            EXPECT_EQ(states[0].id, 1);
            if (frame > 5) {
                EXPECT_GT(states[0].box.length, 36) << frame;
                EXPECT_GT(overlap(states[0].box, truth), 0.75) << frame;
            }
        }
        if (visible == 0 && frame > 62) {
            EXPECT_TRUE(states.empty()) << frame;
        }
    }
    EXPECT_GE(last_seen, 46);
}

TEST(TrackerInterruption, objectsThatEnterGrowToFullSizeUnderOneId) {
    MovingScene scene;
    scene.objects = {{{-20, 240}, {2, 0}, 40, 14, 0}};
    Tracker tracker({}, scene.scale);
    std::vector<TrackState> states;
    for (int frame = 0; frame < 50; ++frame) {
        std::vector<Detection> detections = scene.detections(frame);
        OrientedBox& box = detections[0].box;
        const double front = box.centre.x + 20;
        const double rear = std::max(box.centre.x - 20, 3.0);
        box.centre.x = (front + rear) / 2;
        box.length = front - rear;
        if (box.length < 6) detections.clear();
        FrameMotion motion = scene.motion(frame);
        std::erase_if(motion.motion_vectors, [](const MotionVector& v) { return v.position.x < 3; });
        states = tracker.next(motion, detections);
        ASSERT_LE(states.size(), 1u) << frame;
        if (!states.empty()) {
            ASSERT_EQ(states[0].id, 1);
        }
    }
    ASSERT_EQ(states.size(), 1u);
    EXPECT_GT(overlap(states[0].box, scene.box(0, 49)), 0.85);
}

TEST(TrackerInterruption, failedRegistrationIsCoastedThroughWithTheSameIds) {
    MovingScene scene = twoCars();
    scene.camera.shift = [](int frame) { return cv::Point2d(1.0 * frame, 0); };
    Tracker tracker({}, scene.scale);
    for (int frame = 0; frame < 40; ++frame) {
        FrameMotion motion = scene.motion(frame);
        auto detections = scene.detections(frame);
        if (frame >= 20 && frame < 25) {
            motion.registration.state = RegistrationState::failed;
            motion.registration.failure = {.fault = RegistrationFault::too_few_corners, .count = 3, .of = 40};
            motion.motion_vectors.clear();
            detections = {{{{50, 50}, 300, 300, 0}, 1, {9, 9}, 0, {}, Rejection::none}};
        }
        const auto states = tracker.next(motion, detections);
        ASSERT_EQ(states.size(), 2u) << frame;
        EXPECT_EQ(states[0].id, 1);
        EXPECT_EQ(states[1].id, 2);
        EXPECT_GT(overlap(states[0].box, scene.box(0, frame)), 0.8) << frame;
    }
}

TEST(TrackerInterruption, aCutOrALongFailureEndsAllTracks) {
    const MovingScene scene = twoCars();
    Tracker tracker({}, scene.scale);
    for (int frame = 0; frame < 10; ++frame) tracker.next(scene.motion(frame), scene.detections(frame));
    FrameMotion motion = scene.motion(10);
    motion.registration.state = RegistrationState::failed;
    motion.registration.failure = {.fault = RegistrationFault::cut};
    EXPECT_TRUE(tracker.next(motion, {}).empty());
    const auto states = tracker.next(scene.motion(11), scene.detections(11));
    ASSERT_EQ(states.size(), 2u);
    EXPECT_EQ(states[0].id, 3) << "ids are never reused";

    motion.registration.failure = {RegistrationFault::no_match, PictureQuality::blurred};
    std::size_t living = 2;
    for (int i = 0; i < 30; ++i) living = tracker.next(motion, {}).size();
    EXPECT_EQ(living, 0u);
}

TEST(TrackerInterruption, nothingMovesInAFrozenFrame) {
    const MovingScene scene = twoCars();
    Tracker tracker({}, scene.scale);
    std::vector<TrackState> before;
    for (int frame = 0; frame < 20; ++frame) before = tracker.next(scene.motion(frame), scene.detections(frame));
    FrameMotion frozen = scene.motion(19);
    frozen.registration.state = RegistrationState::frozen;
    frozen.registration.current_from_previous = {};
    for (int i = 0; i < 3; ++i) {
        const auto states = tracker.next(frozen, {});
        ASSERT_EQ(states.size(), 2u);
        EXPECT_EQ(states[0].box.centre, before[0].box.centre);
        EXPECT_EQ(states[0].velocity, before[0].velocity);
        EXPECT_EQ(states[0].hits, before[0].hits);
    }
    // The repeated frames stood for dropped ones: everything jumps ahead.
    FrameMotion after = scene.motion(23);
    const auto states = tracker.next(after, scene.detections(23));
    ASSERT_EQ(states.size(), 2u);
    EXPECT_EQ(states[0].id, 1);
    EXPECT_EQ(states[0].origin, StateOrigin::detected);
}

TEST(TrackerInterruption, tracksGoOnByAllThatPassedWhileThePictureStood) {
    const MovingScene scene = twoCars();
    Tracker tracker({}, scene.scale);
    std::vector<TrackState> before;
    for (int frame = 0; frame < 20; ++frame) before = tracker.next(scene.motion(frame), scene.detections(frame));
    FrameMotion motion = scene.motion(19);
    motion.registration.state = RegistrationState::frozen;
    motion.registration.current_from_previous = {};
    for (int i = 0; i < 9; ++i) tracker.next(motion, {});
    motion.motion_vectors.clear();
    motion.registration.state = RegistrationState::registered;
    motion.registration.elapsed = 10;
    const auto states = tracker.next(motion, {});  // the camera stands, nothing is detected
    ASSERT_EQ(states.size(), 2u);
    for (std::size_t i = 0; i < states.size(); ++i) {
        const cv::Point2d way = states[i].box.centre - before[i].box.centre;
        EXPECT_NEAR(way.x, 10 * before[i].velocity.x, 0.5);
        EXPECT_NEAR(way.y, 10 * before[i].velocity.y, 0.5);
        EXPECT_EQ(states[i].id, before[i].id);
    }
}

TEST(TrackerInterruption, stoppedVehiclesWaitInTheirPlace) {
    MovingScene scene;
    scene.objects = {{{100, 100}, {0.25, 0}, 20, 10, 0}};
    TrackerOptions options;
    options.max_stopped_s = 1;
    Tracker tracker(options, scene.scale);
    for (int frame = 0; frame < 20; ++frame) tracker.next(scene.motion(frame), scene.detections(frame));
    FrameMotion empty = scene.motion(20);
    empty.motion_vectors.clear();
    std::vector<TrackState> states;
    for (int i = 0; i < 24; ++i) states = tracker.next(empty, {});
    ASSERT_EQ(states.size(), 1u);
    EXPECT_NEAR(states[0].box.centre.x, scene.box(0, 19).centre.x, 1.5);
    EXPECT_LT(std::hypot(states[0].velocity.x, states[0].velocity.y), 0.01);
    for (int i = 0; i < 5; ++i) states = tracker.next(empty, {});
    EXPECT_TRUE(states.empty());
}

}  // namespace eyrie::tracker_interruption_test
