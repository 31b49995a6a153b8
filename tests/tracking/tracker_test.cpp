#include "tracking/tracker.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <set>

#include "core/error.h"
#include "tracking/moving_scene.h"

namespace eyrie {
namespace {

using testing::MovingScene;
using testing::SceneObject;

const TrackState* nearest(const std::vector<TrackState>& states, const OrientedBox& box) {
    const TrackState* best = nullptr;
    for (const TrackState& state : states) {
        if (overlap(state.box, box) > 0.3 && (!best || overlap(state.box, box) > overlap(best->box, box))) {
            best = &state;
        }
    }
    return best;
}

MovingScene twoCars() {
    MovingScene scene;
    scene.objects = {{{100, 100}, {2, 0}, 20, 10, 0}, {{100, 200}, {2, 0.5}, 24, 11, 100}};
    return scene;
}

/// Side by side with equal speed.
MovingScene neighbours() {
    MovingScene scene;
    scene.objects = {{{100, 100}, {2, 0}, 20, 10, 0}, {{102, 113}, {2, 0}, 20, 10, 100}};
    return scene;
}

}  // namespace

TEST(Tracker, confirmsAfterTheGivenNumberOfHits) {
    const MovingScene scene = twoCars();
    Tracker tracker({}, scene.scale);
    for (int frame = 0; frame < 8; ++frame) {
        const auto states = tracker.next(scene.motion(frame), scene.detections(frame));
        ASSERT_EQ(states.size(), 2u);
        EXPECT_EQ(states[0].id, 1);
        EXPECT_EQ(states[1].id, 2);
        EXPECT_EQ(states[0].status, frame < 4 ? TrackStatus::tentative : TrackStatus::confirmed) << frame;
        EXPECT_EQ(states[0].age, frame);
        EXPECT_EQ(states[0].hits, frame + 1);
        EXPECT_DOUBLE_EQ(states[0].score, 1);
    }
}

TEST(Tracker, velocityIsRelativeToTheGroundUnderCameraMotion) {
    MovingScene scene;
    scene.objects = {{{250, 180}, {1.5, 0.8}, 20, 10, 0}};
    scene.camera.turn = [](int frame) { return 0.015 * frame; };
    scene.camera.zoom = [](int frame) { return 1 + 0.002 * frame; };
    scene.camera.shift = [](int frame) { return cv::Point2d(-1.0 * frame, 0.6 * frame); };
    Tracker tracker({}, scene.scale);
    for (int frame = 0; frame < 60; ++frame) {
        // No velocity in the detections: it must come from the positions.
        auto detections = scene.detections(frame);
        detections[0].velocity = {0, 0};
        const auto states = tracker.next(scene.motion(frame), detections);
        ASSERT_EQ(states.size(), 1u) << frame;
        ASSERT_EQ(states[0].id, 1) << frame;
        if (frame < 30) continue;
        const cv::Point2d error = states[0].velocity - scene.velocity(0, frame);
        ASSERT_LT(std::hypot(error.x, error.y), 0.05) << frame;
        ASSERT_GT(overlap(states[0].box, scene.box(0, frame)), 0.9) << frame;
    }
}

TEST(Tracker, missedDetectionsAreRebuiltFromVectorsWhileBraking) {
    MovingScene scene;
    scene.objects = {{{200, 100}, {3, 0}, 20, 10, 0}};
    TrackerOptions options;
    Tracker tracker(options, scene.scale);
    for (int frame = 0; frame < 10; ++frame) tracker.next(scene.motion(frame), scene.detections(frame));
    // It brakes at 8 m/s² while it is not detected: the prediction alone would run 2.8 px ahead.
    OrientedBox box = scene.box(0, 9);
    double speed = 3;
    for (int frame = 10; frame < 20; ++frame) {
        FrameMotion motion = scene.motion(frame);
        speed -= 8 / 0.25 / 25 / 25;
        box.centre.x += speed;
        int i = 0;
        for (const double along : {-0.4, 0.0, 0.4}) {
            for (const double across : {-0.3, 0.3}) {
                auto& vector = motion.motion_vectors[std::size_t(i++)];
                vector.position = cv::Point2f(box.toImage({along * 20, across * 10}));
                vector.velocity = cv::Point2f(float(speed), 0);
            }
        }
        const auto states = tracker.next(motion, {});
        ASSERT_EQ(states.size(), 1u);
        EXPECT_EQ(states[0].id, 1);
        EXPECT_EQ(states[0].origin, StateOrigin::reconstructed) << frame;
        EXPECT_EQ(states[0].status, TrackStatus::coasting);
        EXPECT_NEAR(states[0].box.centre.x, box.centre.x, 0.8) << frame;
    }
}

TEST(Tracker, reconstructionEndsAfterTheLimitAndTheTrackDies) {
    const MovingScene scene = twoCars();
    TrackerOptions options;
    options.max_reconstructed = 10;
    options.max_supported_s = 0;
    Tracker tracker(options, scene.scale);
    for (int frame = 0; frame < 30; ++frame) tracker.next(scene.motion(frame), scene.detections(frame));
    int reconstructed = 0;
    int predicted = 0;
    std::size_t living = 2;
    for (int frame = 30; frame < 80 && living > 0; ++frame) {
        const auto states = tracker.next(scene.motion(frame), {});
        living = states.size();
        if (living == 0) break;
        reconstructed += states[0].origin == StateOrigin::reconstructed;
        predicted += states[0].origin == StateOrigin::predicted;
    }
    EXPECT_EQ(reconstructed, 10);
    EXPECT_EQ(predicted, 8) << "0.3 s at 25 Hz";
    EXPECT_EQ(living, 0u);
}

TEST(Tracker, mergedDetectionKeepsBothTracksApart) {
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

TEST(Tracker, splitDetectionStaysOneTrackOfFullSize) {
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

TEST(Tracker, aTrackThatBeganAsTwoMergedObjectsGivesUp) {
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

TEST(Tracker, neighboursThatWereMergedForLongComeApart) {
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

TEST(Tracker, anOversizedDetectionDoesNotBlowUpAKnownTrack) {
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

TEST(Tracker, recoversFromAFirstPartialDetection) {
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

TEST(Tracker, slowObjectsKeepTheirHeading) {
    MovingScene scene;
    scene.objects = {{{100, 100}, {1.5, 0}, 20, 10, 0}};
    Tracker tracker({}, scene.scale);
    for (int frame = 0; frame < 20; ++frame) tracker.next(scene.motion(frame), scene.detections(frame));
    const OrientedBox last = scene.box(0, 19);
    for (int i = 0; i < 15; ++i) {
        FrameMotion motion = scene.motion(19);
        motion.registration.current_from_previous = {};
        motion.motion_vectors.clear();
        Detection slow = scene.detection(0, 19);
        slow.velocity = {0.02, 0.07};  // below 5 σ: the direction is noise, and so is the box's heading
        slow.box.heading = 1.3;
        std::swap(slow.box.length, slow.box.width);
        const auto states = tracker.next(motion, {slow});
        ASSERT_EQ(states.size(), 1u);
        EXPECT_LT(std::abs(states[0].box.heading), 0.05) << i;
        EXPECT_GT(overlap(states[0].box, last), 0.5) << i;
    }
}

TEST(Tracker, objectsLeaveOverTheBorderAtFullSize) {
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

TEST(Tracker, objectsThatEnterGrowToFullSizeUnderOneId) {
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

TEST(Tracker, failedRegistrationIsCoastedThroughWithTheSameIds) {
    MovingScene scene = twoCars();
    scene.camera.shift = [](int frame) { return cv::Point2d(1.0 * frame, 0); };
    Tracker tracker({}, scene.scale);
    for (int frame = 0; frame < 40; ++frame) {
        FrameMotion motion = scene.motion(frame);
        auto detections = scene.detections(frame);
        if (frame >= 20 && frame < 25) {
            motion.registration.state = RegistrationState::failed;
            motion.registration.reason = "too few corners (3 of 40)";
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

TEST(Tracker, aCutOrALongFailureEndsAllTracks) {
    const MovingScene scene = twoCars();
    Tracker tracker({}, scene.scale);
    for (int frame = 0; frame < 10; ++frame) tracker.next(scene.motion(frame), scene.detections(frame));
    FrameMotion motion = scene.motion(10);
    motion.registration.state = RegistrationState::failed;
    motion.registration.reason = "cut: nothing of the picture before is left";
    EXPECT_TRUE(tracker.next(motion, {}).empty());
    const auto states = tracker.next(scene.motion(11), scene.detections(11));
    ASSERT_EQ(states.size(), 2u);
    EXPECT_EQ(states[0].id, 3) << "ids are never reused";

    motion.registration.reason = "blur";
    std::size_t living = 2;
    for (int i = 0; i < 30; ++i) living = tracker.next(motion, {}).size();
    EXPECT_EQ(living, 0u);
}

TEST(Tracker, nothingMovesInAFrozenFrame) {
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

TEST(Tracker, stoppedVehiclesWaitInTheirPlace) {
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

TEST(Tracker, duplicatesOfATrackAreSuppressedButNotNeighbours) {
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

TEST(Tracker, rejectedAndBrokenDetectionsAreIgnored) {
    const MovingScene scene = twoCars();
    const double nan = std::numeric_limits<double>::quiet_NaN();
    Tracker tracker({}, scene.scale);
    for (int frame = 0; frame < 10; ++frame) {
        auto detections = scene.detections(frame);
        detections.push_back({{{300, 300}, 20, 10, 0}, 1, {1, 0}, 0, {}, Rejection::outlier});
        detections.push_back({{{nan, 300}, 20, 10, 0}, 1, {1, 0}, 0, {}, Rejection::none});
        detections.push_back({{{300, 300}, 0, 10, 0}, 1, {1, 0}, 0, {}, Rejection::none});
        detections.push_back({{{300, 300}, 20, 10, nan}, 1, {1, 0}, 0, {}, Rejection::none});
        detections.push_back({{{300, 300}, 20, 10, 0}, 1, {nan, 0}, 0, {}, Rejection::none});
        FrameMotion motion = scene.motion(frame);
        motion.motion_vectors.push_back({5000, {float(nan), 3}, {1, 1}, 9});
        if (frame == 5) motion.registration.current_from_previous.matrix = cv::Matx33d::all(nan);
        if (frame == 6) motion.background_speed_sigma = nan;
        const auto states = tracker.next(motion, detections);
        ASSERT_EQ(states.size(), 2u) << frame;
        for (const TrackState& state : states) {
            EXPECT_TRUE(std::isfinite(state.box.centre.x) && std::isfinite(state.box.area()));
        }
    }
}

TEST(Tracker, refusesAnImpossibleScale) {
    EXPECT_THROW(Tracker({}, {0, 25, true}), Error);
    EXPECT_THROW(Tracker({}, {0.2, std::numeric_limits<double>::quiet_NaN(), true}), Error);
}

TEST(Tracker, withoutAnyDetectionThereIsNoTrack) {
    MovingScene scene = twoCars();
    Tracker tracker({}, scene.scale);
    for (int frame = 0; frame < 30; ++frame) EXPECT_TRUE(tracker.next(scene.motion(frame), {}).empty());
    FrameMotion nothing;
    EXPECT_TRUE(tracker.next(nothing, {}).empty());
}

TEST(Tracker, aHundredNoisyObjectsKeepTheirIdsAndRunsAreIdentical) {
    MovingScene scene;
    for (int i = 0; i < 100; ++i) {
        const double direction = i % 7;
        scene.objects.push_back({{30.0 + 60 * (i % 10), 25.0 + 45 * (i / 10)},
                                 {0.8 * std::cos(direction), 0.8 * std::sin(direction)},
                                 14,
                                 7,
                                 10 * i});
    }
    const auto run = [&scene] {
        std::mt19937 random(11);
        std::normal_distribution<double> noise(0, 1);
        std::uniform_real_distribution<double> chance(0, 1);
        Tracker tracker(TrackerOptions{}, scene.scale);
        std::vector<std::vector<TrackState>> all;
        for (int frame = 0; frame < 40; ++frame) {
            std::vector<Detection> detections;
            for (std::size_t i = 0; i < 100; ++i) {
                Detection d = scene.detection(i, frame);
                d.box.centre += cv::Point2d(0.7 * noise(random), 0.7 * noise(random));
                d.box.length *= 1 + 0.1 * noise(random);
                d.velocity += cv::Point2d(0.05 * noise(random), 0.05 * noise(random));
                if (frame == 0 || chance(random) > 0.1) detections.push_back(d);
            }
            std::shuffle(detections.begin(), detections.end(), random);
            all.push_back(tracker.next(scene.motion(frame), detections));
        }
        return all;
    };
    const auto first = run();
    const auto second = run();
    ASSERT_EQ(first.size(), second.size());
    std::set<TrackId> ids;
    for (std::size_t f = 0; f < first.size(); ++f) {
        ASSERT_EQ(first[f].size(), second[f].size());
        for (std::size_t i = 0; i < first[f].size(); ++i) {
            EXPECT_EQ(first[f][i].id, second[f][i].id);
            EXPECT_EQ(first[f][i].box.centre, second[f][i].box.centre);
            if (i > 0) {
                EXPECT_LT(first[f][i - 1].id, first[f][i].id);
            }
            if (first[f][i].status != TrackStatus::tentative) ids.insert(first[f][i].id);
        }
    }
    EXPECT_GE(ids.size(), 100u);
    EXPECT_LE(ids.size(), 103u);
    int found = 0;
    for (std::size_t i = 0; i < 100; ++i) found += nearest(first.back(), scene.box(i, 39)) != nullptr;
    EXPECT_GE(found, 97);
}

TEST(Tracker, resetForgetsEverything) {
    const MovingScene scene = twoCars();
    Tracker tracker({}, scene.scale);
    for (int frame = 0; frame < 5; ++frame) tracker.next(scene.motion(frame), scene.detections(frame));
    tracker.reset();
    const auto states = tracker.next(scene.motion(0), scene.detections(0));
    ASSERT_EQ(states.size(), 2u);
    EXPECT_EQ(states[0].id, 1);
    EXPECT_EQ(states[0].age, 0);
}

TEST(TrackerOptions, thesisPresetFollowsTheText) {
    const TrackerOptions thesis = TrackerOptions::thesis();
    EXPECT_DOUBLE_EQ(thesis.min_overlap, 0.5);
    EXPECT_EQ(thesis.max_vectors, 20);
    EXPECT_EQ(thesis.max_reconstructed, 10);
    const MovingScene scene = neighbours();
    Tracker tracker(thesis, scene.scale);
    for (int frame = 0; frame < 30; ++frame) {
        auto detections = scene.detections(frame);
        const auto states = tracker.next(scene.motion(frame), detections);
        ASSERT_EQ(states.size(), 2u) << frame;
    }
}

TEST(TrackerOptions, everyParameterSurvivesSavingAndLoading) {
    TrackerOptions options = TrackerOptions::thesis();
    TrackerOptions loaded;
    for (const Parameter& parameter : listParameters(describeOf(options))) {
        EXPECT_EQ(parameter.name.rfind("tracking.", 0), 0u);
        EXPECT_FALSE(parameter.text.help.empty());
        setParameter(describeOf(loaded), parameter.name, parameter.value);
    }
    const auto a = listParameters(describeOf(options));
    const auto b = listParameters(describeOf(loaded));
    for (std::size_t i = 0; i < a.size(); ++i) EXPECT_EQ(a[i].value, b[i].value) << a[i].name;
    EXPECT_THROW(setParameter(describeOf(loaded), "tracking.min_overlap", "0"), Error);
}

}  // namespace eyrie
