#include "tracking/tracker.h"

#include <gtest/gtest.h>

#include <limits>
#include <set>

#include "core/error.h"
#include "tracking/measurement_model.h"
#include "tracking/tracked_scene.h"

namespace eyrie::tracker_test {
namespace {

using test::MovingScene;
using test::nearest;
using test::neighbours;
using test::twoCars;

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
        detections.push_back({{{300, nan}, 20, 10, 0}, 1, {1, 0}, 0, {}, Rejection::none});
        detections.push_back({{{300, 300}, nan, 10, 0}, 1, {1, 0}, 0, {}, Rejection::none});
        detections.push_back({{{300, 300}, 20, nan, 0}, 1, {1, 0}, 0, {}, Rejection::none});
        detections.push_back({{{300, 300}, 20, 0, 0}, 1, {1, 0}, 0, {}, Rejection::none});
        detections.push_back({{{300, 300}, 20, 10, 0}, 1, {nan, 0}, 0, {}, Rejection::none});
        detections.push_back({{{300, 300}, 20, 10, 0}, 1, {1, nan}, 0, {}, Rejection::none});
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

namespace {

/// The part of a box with heading 0 that a picture of this width shows.
OrientedBox cutAtTheRight(OrientedBox box, int width) {
    const double rear = box.centre.x - box.length / 2;
    const double front = std::min(box.centre.x + box.length / 2, width - 0.5);
    box.centre.x = (rear + front) / 2;
    box.length = front - rear;
    return box;
}

}  // namespace

TEST(Tracker, overlapsMayBeTakenOfWholeBoxes) {
    MovingScene scene;
    scene.objects = {{{543, 100}, {8, 0}, 40, 12, 0}};
    for (const bool inside : {false, true}) {
        TrackerOptions options = TrackerOptions::thesis();
        options.use_vectors = false;
        options.visible_overlap = inside;
        Tracker tracker(options, scene.scale);
        for (int frame = 0; frame < 10; ++frame) tracker.next(scene.motion(frame), scene.detections(frame));
        for (int frame = 10; frame < 13; ++frame) tracker.next(scene.motion(frame), {});
        // Less than a third of the car is left in the picture, and all of that is detected.
        Detection rest = scene.detection(0, 13);
        rest.box = cutAtTheRight(rest.box, scene.image.width);
        const auto states = tracker.next(scene.motion(13), {rest});
        ASSERT_EQ(states.size(), inside ? 1U : 2U);
        EXPECT_EQ(states[0].origin, inside ? StateOrigin::detected : StateOrigin::predicted);
    }
}

TEST(Tracker, thesisNeitherCompletesBoxesAtTheBorderNorWaitsForThoseWhoLeave) {
    MovingScene scene;
    scene.objects = {{{600, 100}, {1, 0}, 40, 12, 0}};
    for (const bool thesis : {true, false}) {
        TrackerOptions options = thesis ? TrackerOptions::thesis() : TrackerOptions{};
        options.use_vectors = false;
        Tracker tracker(options, scene.scale);
        std::vector<TrackState> states;
        for (int frame = 0; frame < 35; ++frame) {
            Detection seen = scene.detection(0, frame);
            seen.box = cutAtTheRight(seen.box, scene.image.width);
            states = tracker.next(scene.motion(frame), {seen});
            ASSERT_EQ(states.size(), 1U) << frame;
            ASSERT_EQ(states[0].origin, StateOrigin::detected) << frame;
        }
        // 14.5 of 40 px are hidden: the middle of what is seen lies 7.25 px behind the car's.
        const double behind = scene.box(0, 34).centre.x - states[0].box.centre.x;
        if (thesis) {
            EXPECT_GT(behind, 2);
            EXPECT_LT(states[0].box.length, 38.5);
        } else {
            EXPECT_NEAR(behind, 0, 1);
            EXPECT_NEAR(states[0].box.length, 40, 1);
        }
        int lived = 0;
        for (int frame = 35; frame < 120; ++frame) {
            if (tracker.next(scene.motion(frame), {}).empty()) break;
            ++lived;
        }
        if (thesis) {
            EXPECT_EQ(lived, 8) << "0.3 s at 25 Hz";
        } else {
            EXPECT_GT(lived, 14) << "until hardly anything of it can be in the picture";
            EXPECT_LT(lived, 40);
        }
    }
}

TEST(Tracker, velocitiesNeedNotBeMeasured) {
    MovingScene scene;
    scene.objects = {{{100, 100}, {2, 0}, 20, 10, 0}};
    for (const bool measured : {false, true}) {
        TrackerOptions options = TrackerOptions::thesis();
        options.min_overlap = 0.2;
        options.measure_velocity = measured;
        Tracker tracker(options, scene.scale);
        for (int frame = 0; frame < 80; ++frame) {
            Detection lying = scene.detection(0, frame);
            lying.velocity += cv::Point2d(0, 0.5);
            const auto states = tracker.next(scene.motion(frame), {lying});
            ASSERT_EQ(states.size(), 1U) << frame;
            if (frame < 79) continue;
            EXPECT_NEAR(states[0].velocity.x, 2, 0.05);
            if (measured) {
                EXPECT_GT(states[0].velocity.y, 0.1);
            } else {
                EXPECT_NEAR(states[0].velocity.y, 0, 0.05);
            }
        }
    }
}

TEST(MeasurementModel, sizesMayBeMeasuredAllAlike) {
    const SceneScale scale{0.25, 25, true};
    const TrackerOptions thesis = TrackerOptions::thesis();
    MeasurementModel model(thesis, scale);
    model.startFrame({640, 480}, 0.02);
    const OrientedBox known{{100, 100}, 18, 7, 0};
    for (const bool complete : {false, true}) {
        Detection detection;
        detection.box = {{102, 100}, 10, 5, 0};
        detection.velocity = {2, 0};
        detection.complete = complete;
        const BoxMeasurement first = model.first(detection);
        EXPECT_DOUBLE_EQ(first.length, model.sizeDeviation({}));
        EXPECT_DOUBLE_EQ(first.width, model.sizeDeviation({}));
        EXPECT_EQ(first.along_with_length, 0);
        EXPECT_EQ(first.speed, BoxMeasurement::kUnknown);
        EXPECT_EQ(first.velocity, cv::Point2d(2, 0)) << "the track starts with it";
        const auto update = model.update(detection.box, detection, known, true);
        EXPECT_DOUBLE_EQ(update.measurement.length, model.sizeDeviation({}));
        EXPECT_DOUBLE_EQ(update.measurement.along, first.along);
        EXPECT_DOUBLE_EQ(update.measurement.across, first.across);
        EXPECT_EQ(update.measurement.along_with_length, 0);
        EXPECT_FALSE(update.by_ends);
        EXPECT_FALSE(update.size_differs);
    }
    TrackerOptions adapting = thesis;
    adapting.adapt_size = true;
    MeasurementModel other(adapting, scale);
    other.startFrame({640, 480}, 0.02);
    Detection detection;
    detection.box = {{102, 100}, 10, 7, 0};
    detection.velocity = {2, 0};
    // The box is 8 px short, so its centre may be off by 4.
    const auto update = other.update(detection.box, detection, known, true);
    EXPECT_GT(update.measurement.along, 4);
    EXPECT_LT(update.measurement.across, 1);
}

TEST(MeasurementModel, aFirstBoxSmallerThanACarMayMissHalfOfWhatItLacks) {
    const SceneScale scale{0.25, 25, true};  // a car is 18 × 7.2 px
    MeasurementModel model({}, scale);
    model.startFrame({640, 480}, 0.02);
    const double noise = model.sizeDeviation({}) / 2;
    const auto sizeOf = [&](double length, double width) {
        Detection detection;
        detection.box = {{100, 100}, length, width, 0};
        detection.velocity = {2, 0};
        const BoxMeasurement first = model.first(detection);
        return std::pair(first.length, first.width);
    };
    const auto ofEnds = [&](double missing) { return std::sqrt(2.0) * std::hypot(noise, missing); };
    EXPECT_NEAR(sizeOf(12, 4.2).first, ofEnds(3), 1e-9);
    EXPECT_NEAR(sizeOf(12, 4.2).second, ofEnds(1.5), 1e-9);
    // A larger one may miss a sixth of its own size.
    EXPECT_NEAR(sizeOf(30, 12).first, ofEnds(5), 1e-9);
    EXPECT_NEAR(sizeOf(30, 12).second, ofEnds(2), 1e-9);
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

TEST(Tracker, oneDetectionMayBeEnoughToConfirm) {
    const MovingScene scene = twoCars();
    TrackerOptions options;
    for (const int hits : {1, 2}) {
        options.confirm_hits = hits;
        Tracker tracker(options, scene.scale);
        for (const TrackState& state : tracker.next(scene.motion(0), scene.detections(0)))
            EXPECT_EQ(state.status, hits == 1 ? TrackStatus::confirmed : TrackStatus::tentative);
    }
}

}  // namespace eyrie::tracker_test
