#include "tracking/tracker.h"

#include <gtest/gtest.h>

#include "tracking/tracked_scene.h"

namespace eyrie {
namespace {

using testing::MovingScene;
using testing::nearest;
using testing::neighbours;
using testing::twoCars;

}  // namespace

TEST(TrackerSplitMerge, mergedDetectionKeepsBothTracksApart) {
    const MovingScene scene = neighbours();
    Tracker tracker({}, scene.scale);
    for (int frame = 0; frame < 40; ++frame) {
        std::vector<Detection> detections = scene.detections(frame);
        const bool merged = frame >= 15 && frame < 25;
        if (merged) {
            detections[0].box = unionBox(detections[0].box, detections[1].box);
            detections.resize(1);
        }
        const auto states = tracker.next(scene.motion(frame), detections);
        ASSERT_EQ(states.size(), 2u) << frame;
        for (std::size_t i = 0; i < 2; ++i) {
            ASSERT_EQ(states[i].id, int(i) + 1);
            EXPECT_EQ(states[i].origin, merged ? StateOrigin::reconstructed : StateOrigin::detected) << frame;
            EXPECT_GT(overlap(states[i].box, scene.box(i, frame)), 0.85) << frame;
        }
    }
}

TEST(TrackerSplitMerge, splitDetectionStaysOneTrackOfFullSize) {
    MovingScene scene;
    scene.objects = {{{100, 100}, {2, 0.2}, 40, 12, 0}};
    Tracker tracker({}, scene.scale);
    for (int frame = 0; frame < 40; ++frame) {
        std::vector<Detection> detections = scene.detections(frame);
        if (frame >= 15 && frame < 22) {
            const OrientedBox whole = detections[0].box;
            detections[0].box = {whole.toImage({-13, 0}), 14, 12, whole.heading};
            detections.push_back(detections[0]);
            detections[1].box = {whole.toImage({12, 0}), 16, 12, whole.heading};
        }
        const auto states = tracker.next(scene.motion(frame), detections);
        ASSERT_EQ(states.size(), 1u) << frame;
        ASSERT_EQ(states[0].id, 1) << frame;
        EXPECT_GT(overlap(states[0].box, scene.box(0, frame)), 0.85) << frame;
    }
}

TEST(TrackerSplitMerge, aTrackThatBeganAsTwoMergedObjectsGivesUp) {
    const MovingScene scene = neighbours();
    Tracker tracker({}, scene.scale);
    std::vector<TrackState> states;
    for (int frame = 0; frame < 65; ++frame) {
        std::vector<Detection> detections = scene.detections(frame);
        if (frame < 8) {
            detections[0].box = unionBox(detections[0].box, detections[1].box);
            detections.resize(1);
        }
        states = tracker.next(scene.motion(frame), detections);
    }
    ASSERT_EQ(states.size(), 2u);
    for (std::size_t i = 0; i < 2; ++i) EXPECT_GT(overlap(states[i].box, scene.box(i, 64)), 0.8);
}

TEST(TrackerSplitMerge, neighboursThatWereMergedForLongComeApart) {
    const MovingScene scene = neighbours();
    Tracker tracker({}, scene.scale);
    std::vector<TrackState> states;
    for (int frame = 0; frame < 110; ++frame) {
        std::vector<Detection> detections = scene.detections(frame);
        if (frame < 70) {
            detections[0].box = unionBox(detections[0].box, detections[1].box);
            detections.resize(1);
        }
        states = tracker.next(scene.motion(frame), detections);
    }
    ASSERT_EQ(states.size(), 2u);
    for (std::size_t i = 0; i < 2; ++i) EXPECT_NE(nearest(states, scene.box(i, 109)), nullptr);
}

TEST(TrackerSplitMerge, anOversizedDetectionDoesNotBlowUpAKnownTrack) {
    const MovingScene scene = twoCars();
    Tracker tracker({}, scene.scale);
    for (int frame = 0; frame < 30; ++frame) {
        auto detections = scene.detections(frame);
        if (frame >= 15 && frame < 20) {
            detections[0].box.centre.y += 7;  // merged with a shadow
            detections[0].box.width *= 2.4;
        }
        const auto states = tracker.next(scene.motion(frame), detections);
        ASSERT_EQ(states.size(), 2u);
        EXPECT_GT(overlap(states[0].box, scene.box(0, frame)), 0.7) << frame;
    }
}

TEST(TrackerSplitMerge, recoversFromAFirstPartialDetection) {
    const MovingScene scene = twoCars();
    Tracker tracker({}, scene.scale);
    std::vector<TrackState> states;
    for (int frame = 0; frame < 10; ++frame) {
        auto detections = scene.detections(frame);
        if (frame < 2) detections[0].box = {detections[0].box.toImage({-5, 0}), 10, 6, detections[0].box.heading};
        states = tracker.next(scene.motion(frame), detections);
        ASSERT_EQ(states.size(), 2u) << frame;
    }
    EXPECT_GT(overlap(states[0].box, scene.box(0, 9)), 0.85);
}

TEST(TrackerSplitMerge, duplicatesOfATrackAreSuppressedButNotNeighbours) {
    const MovingScene scene = neighbours();
    Tracker tracker({}, scene.scale);
    std::vector<TrackState> states;
    for (int frame = 0; frame < 20; ++frame) {
        auto detections = scene.detections(frame);
        Detection again = detections[0];
        again.box = {again.box.toImage({4, 0}), 16, 9, again.box.heading};
        detections.push_back(again);
        states = tracker.next(scene.motion(frame), detections);
    }
    ASSERT_EQ(states.size(), 2u);
    EXPECT_EQ(states[0].id, 1);
    EXPECT_EQ(states[1].id, 2);
}

}  // namespace eyrie
