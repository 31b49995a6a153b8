#include "tracking/tracker.h"

#include <gtest/gtest.h>

#include "tracking/measurement_model.h"
#include "tracking/tracked_scene.h"

namespace eyrie::tracker_split_merge_test {
namespace {

using test::MovingScene;
using test::nearest;
using test::neighbours;
using test::twoCars;

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

TEST(TrackerSplitMerge, aVehicleSeenWholeThriceAsOftenKeepsItsPartsAFrameLonger) {
    // After how many frames in two parts, one behind the other, the second one starts a track of its own.
    const auto patience = [](int whole_frames) {
        MovingScene scene;
        scene.objects = {{{100, 100}, {2, 0.2}, 40, 12, 0}};
        TrackerOptions options;
        options.split_patience = 4;
        Tracker tracker(options, scene.scale);
        for (int frame = 0; frame < whole_frames + 20; ++frame) {
            std::vector<Detection> detections = scene.detections(frame);
            if (frame >= whole_frames) {
                const OrientedBox whole = detections[0].box;
                detections[0].box = {whole.toImage({-13, 0}), 14, 12, whole.heading};
                detections.push_back(detections[0]);
                detections[1].box = {whole.toImage({12, 0}), 16, 12, whole.heading};
            }
            TrackingTrace trace;
            tracker.next(scene.motion(frame), detections, &trace);
            if (frame > 0 && !trace.started.empty()) return frame - whole_frames;
        }
        return -1;
    };
    EXPECT_EQ(patience(11), 4) << "11 < 3 · 4: the detection that starts the track is one of them";
    EXPECT_EQ(patience(12), 5);
}

TEST(TrackerSplitMerge, theLargestPartSaysHowAVehicleInPartsMoves) {
    for (const std::size_t wrong : {0, 1}) {
        MovingScene scene;
        scene.objects = {{{100, 100}, {2, 0.2}, 40, 12, 0}};
        TrackerOptions options;
        options.use_vectors = false;
        Tracker tracker(options, scene.scale);
        std::vector<TrackState> states;
        for (int frame = 0; frame < 21; ++frame) {
            std::vector<Detection> detections = scene.detections(frame);
            if (frame >= 15) {
                const OrientedBox whole = detections[0].box;
                detections.push_back(detections[0]);
                // In either order; the small one seems to be faster.
                detections[wrong].box = {whole.toImage({15.5, 0}), 9, 12, whole.heading};
                detections[wrong].velocity *= 1.3;
                detections[1 - wrong].box = {whole.toImage({-5, 0}), 30, 12, whole.heading};
            }
            states = tracker.next(scene.motion(frame), detections);
            ASSERT_EQ(states.size(), 1u) << frame;
            EXPECT_EQ(states[0].origin, StateOrigin::detected);
        }
        EXPECT_NEAR(states[0].velocity.x, 2, 0.05) << wrong;
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

TEST(TrackerSplitMerge, thesisTakesVectorsByThePredictedBoxSoThatTheyHelpInTheSameFrame) {
    const MovingScene scene = neighbours();
    constexpr int kMergedFrom = 15;
    constexpr int kNewCorners = 18;  // all are lost and found again while both are merged
    for (const bool first : {true, false}) {
        TrackerOptions options = TrackerOptions::thesis();
        options.min_overlap = 0.3;
        options.vectors_first = first;
        Tracker tracker(options, scene.scale);
        for (int frame = 0; frame < 24; ++frame) {
            std::vector<Detection> detections = scene.detections(frame);
            FrameMotion motion = scene.motion(frame);
            if (frame >= kMergedFrom) {
                detections[0].box = unionBox(detections[0].box, detections[1].box);
                detections.resize(1);
            }
            if (frame >= kNewCorners) {
                for (MotionVector& vector : motion.motion_vectors) vector.id += 1000;
            }
            const auto states = tracker.next(motion, detections);
            ASSERT_EQ(states.size(), 2U) << frame;
            const bool reconstructed = frame >= kMergedFrom && (first || frame < kNewCorners);
            for (std::size_t i = 0; i < 2; ++i) {
                if (frame < kMergedFrom) {
                    EXPECT_EQ(states[i].origin, StateOrigin::detected) << frame;
                } else {
                    EXPECT_EQ(states[i].origin, reconstructed ? StateOrigin::reconstructed : StateOrigin::predicted)
                        << frame;
                }
                EXPECT_GT(overlap(states[i].box, scene.box(i, frame)), 0.85) << frame;
            }
        }
    }
}

TEST(TrackerSplitMerge, thesisRebuildsATrackFromTheVectorsOfItsFirstDetection) {
    const MovingScene scene = twoCars();
    Tracker tracker(TrackerOptions::thesis(), scene.scale);
    tracker.next(scene.motion(0), scene.detections(0));
    const auto states = tracker.next(scene.motion(1), {});
    ASSERT_EQ(states.size(), 2U);
    for (const TrackState& state : states) EXPECT_EQ(state.origin, StateOrigin::reconstructed);
}

TEST(TrackerSplitMerge, thesisGivesANewcomerItsVectorsBesideKnownTracks) {
    const MovingScene scene = twoCars();
    Tracker tracker(TrackerOptions::thesis(), scene.scale);
    for (int frame = 0; frame < 5; ++frame) tracker.next(scene.motion(frame), {scene.detection(0, frame)});
    tracker.next(scene.motion(5), scene.detections(5));  // the other car is seen for the first time
    const auto states = tracker.next(scene.motion(6), {});
    ASSERT_EQ(states.size(), 2U);
    EXPECT_EQ(states[1].origin, StateOrigin::reconstructed);
}

TEST(TrackerSplitMerge, storedSizesGrowWithTheZoom) {
    MovingScene scene = twoCars();
    for (auto& object : scene.objects) object.start.x += 150;
    scene.camera.zoom = [](int frame) { return std::pow(1.02, frame); };
    scene.camera.turn = [](int frame) { return 0.01 * frame; };
    for (const RebuiltSize size : {RebuiltSize::stored, RebuiltSize::predicted}) {
        TrackerOptions options = TrackerOptions::thesis();
        options.rebuilt_size = size;
        Tracker tracker(options, scene.scale);
        for (int frame = 0; frame < 25; ++frame) {
            const bool missed = frame >= 15;
            const auto states =
                tracker.next(scene.motion(frame), missed ? std::vector<Detection>{} : scene.detections(frame));
            ASSERT_EQ(states.size(), 2U) << frame;
            if (!missed) continue;
            for (std::size_t i = 0; i < 2; ++i) {
                ASSERT_EQ(states[i].origin, StateOrigin::reconstructed) << frame;
                EXPECT_NEAR(states[i].box.length / scene.box(i, frame).length, 1, 0.02) << frame;
                EXPECT_GT(overlap(states[i].box, scene.box(i, frame)), 0.9) << frame;
            }
        }
    }
}

TEST(TrackerSplitMerge, aBoxOfStoredSizeIsMeasuredLikeADetection) {
    const MovingScene scene = twoCars();
    MeasurementModel model(TrackerOptions::thesis(), scene.scale);
    model.startFrame(scene.image, 0.02);
    const Detection detection = scene.detection(0, 0);
    const BoxMeasurement seen = model.update(detection.box, detection, detection.box, true).measurement;
    Reconstruction rebuilt;
    rebuilt.box = detection.box;
    rebuilt.velocity = detection.velocity;
    rebuilt.heading_known = true;
    rebuilt.size_known = true;
    const BoxMeasurement told = model.reconstructed(rebuilt);
    EXPECT_DOUBLE_EQ(told.along, seen.along);
    EXPECT_DOUBLE_EQ(told.across, seen.across);
    EXPECT_DOUBLE_EQ(told.length, seen.length);
    EXPECT_DOUBLE_EQ(told.width, seen.width);
    EXPECT_DOUBLE_EQ(told.heading, seen.heading);
    rebuilt.size_known = false;
    const BoxMeasurement placed = model.reconstructed(rebuilt);
    EXPECT_EQ(placed.length, BoxMeasurement::kUnknown);
    EXPECT_EQ(placed.width, BoxMeasurement::kUnknown);
    EXPECT_LT(placed.along, seen.along);
    EXPECT_GT(placed.heading, seen.heading);
}

TEST(TrackerSplitMerge, aPartAtTheEndOfALongVehicleStartsNoTrack) {
    MovingScene scene;
    scene.objects = {{{100, 100}, {2, 0}, 60, 12, 0}};
    TrackerOptions options;
    options.split_merge = SplitMergeRule::none;  // otherwise it is fused before it could start one
    Tracker tracker(options, scene.scale);
    for (int frame = 0; frame < 20; ++frame) {
        auto detections = scene.detections(frame);
        if (frame >= 10) {
            detections.push_back(detections[0]);
            detections[1].box = {detections[0].box.toImage({25, 0}), 8, 10, detections[0].box.heading};
        }
        ASSERT_EQ(tracker.next(scene.motion(frame), detections).size(), 1U) << frame;
    }
}

}  // namespace eyrie::tracker_split_merge_test
