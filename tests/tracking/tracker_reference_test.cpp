// One vehicle followed by the tracker, and by its filter alone, step by step.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "tracking/measurement_model.h"
#include "tracking/tracked_scene.h"
#include "tracking/tracker.h"

namespace eyrie::tracker_reference_test {
namespace {

using test::MovingScene;

/// What the tracker does with the detections of a single vehicle that nothing else is near to.
struct SingleTrack {
    TrackerOptions options;
    MeasurementModel model;
    std::optional<BoxKalmanFilter> filter;
    int hits = 0, size_streak = 0, growth_streak = 0, frozen = 0;

    SingleTrack(const TrackerOptions& o, const SceneScale& scale) : options(o), model(o, scale) {}

    void next(const FrameMotion& motion, const std::vector<Detection>& detections) {
        model.startFrame(motion.image_size, motion.background_speed_sigma);
        const RegistrationState state = motion.registration.state;
        if (state == RegistrationState::frozen) {
            ++frozen;
            return;
        }
        if (filter) {
            // After frames that were repeats it may have moved on by as many.
            if (frozen > 0) filter->smear(frozen * filter->velocity());
            filter->predict(motion.registration.current_from_previous, model.processNoise(filter->box().centre));
        }
        frozen = 0;
        if (state == RegistrationState::failed) {
            if (filter) {
                filter->smear({1, 0});
                filter->smear({0, 1});
            }
            return;
        }
        if (!detections.empty()) {
            if (filter) {
                update(detections[0]);
            } else {
                filter.emplace(model.first(detections[0]));
            }
            ++hits;
        }
        if (filter) filter->pointForward(model.slowSpeed());
    }

    void update(const Detection& detection) {
        const bool established = hits >= options.confirm_hits;
        const bool size_known = established && size_streak < options.size_patience;
        const auto told = model.update(detection.box, detection, filter->box(), size_known);
        if (told.size_differs) {
            ++size_streak;
            if (established && !size_known) filter->forgetSize(filter->box().width / 2);
        } else if (size_streak > 0) {
            --size_streak;
        }
        if (options.adapt_size && !established && !told.by_ends)
            filter->forgetSize(model.sizeDeviation(filter->box().centre));
        growth_streak = told.grows ? growth_streak + 1 : 0;
        if (growth_streak >= 2)
            filter->loosenEnds(told.grows_front, told.grows_rear, told.grows_left, told.grows_right);
        if (told.size_growth > 0) {
            filter->forgetSize(told.size_growth);
            filter->smear(told.shift);
        }
        filter->update(told.measurement);
    }
};

/// Random boxes of a vehicle that drives through the picture and out of it, some missed, some far too large or small.
void expectFollowed(const TrackerOptions& options, cv::Size2d size, unsigned seed) {
    MovingScene scene;
    scene.objects = {{{30, 240}, {5, 0.6}, size.width, size.height, 0}};
    scene.camera.turn = [](int frame) { return 0.004 * frame; };
    scene.camera.zoom = [](int frame) { return 1 + 0.001 * frame; };
    Tracker tracker(options, scene.scale);
    SingleTrack plain(options, scene.scale);
    std::mt19937 random(seed);
    std::normal_distribution<double> noise(0, 1);
    int compared = 0;
    for (int frame = 0; frame < 115; ++frame) {
        FrameMotion motion = scene.motion(frame);
        std::vector<Detection> detections = scene.detections(frame);
        Detection& d = detections[0];
        d.box.centre += 0.5 * cv::Point2d(noise(random), noise(random));
        const bool odd = (frame / 14) % 3 == 2;  // of another size for more frames than it takes to be believed
        d.box.length *= (odd ? 1.4 : 1) + 0.05 * noise(random);
        d.box.width *= (odd ? 1.5 : 1) + 0.05 * noise(random);
        d.box.heading += 0.05 * noise(random);
        d.velocity += 0.1 * cv::Point2d(noise(random), noise(random));
        d.complete = frame % 7 == 3;
        if (frame % 11 == 9 || (frame > 60 && frame < 64)) detections.clear();
        if (frame == 31 || frame == 32) motion.registration.state = RegistrationState::frozen;
        if (frame == 45) motion.registration.state = RegistrationState::failed;
        plain.next(motion, detections);
        const auto states = tracker.next(motion, detections);
        if (states.empty()) break;
        ASSERT_EQ(states.size(), 1U) << frame;
        const OrientedBox box = plain.filter->box();
        ASSERT_NEAR(states[0].box.centre.x, box.centre.x, 1e-9) << frame;
        ASSERT_NEAR(states[0].box.centre.y, box.centre.y, 1e-9) << frame;
        ASSERT_NEAR(states[0].box.length, box.length, 1e-9) << frame;
        ASSERT_NEAR(states[0].box.width, box.width, 1e-9) << frame;
        ASSERT_NEAR(states[0].box.heading, box.heading, 1e-9) << frame;
        ASSERT_NEAR(states[0].velocity.x, plain.filter->velocity().x, 1e-9) << frame;
        ASSERT_EQ(states[0].hits, plain.hits) << frame;
        ++compared;
    }
    EXPECT_GT(compared, 100);
}

TrackerOptions detectionsAlone(TrackerOptions options = {}) {
    options.use_vectors = false;
    options.appearance = AppearanceUse::none;
    options.max_missing_s = 1;
    return options;
}

}  // namespace

TEST(TrackerReference, ACarIsFollowedAsByItsFilterAlone) {
    for (const unsigned seed : {1U, 2U, 3U}) expectFollowed(detectionsAlone(), {18, 8}, seed);
}

TEST(TrackerReference, ALorryIsFollowedAsByItsFilterAlone) {
    for (const unsigned seed : {4U, 5U}) expectFollowed(detectionsAlone(), {60, 14}, seed);
}

TEST(TrackerReference, WithoutAdaptedSizesItIsFollowedAsByItsFilterAlone) {
    TrackerOptions options = detectionsAlone();
    options.adapt_size = false;
    options.size_patience = 4;
    options.confirm_hits = 8;
    expectFollowed(options, {20, 9}, 6);
    TrackerOptions thesis = detectionsAlone(TrackerOptions::thesis());
    thesis.min_overlap = 0.2;
    expectFollowed(thesis, {24, 12}, 7);
}

TEST(TrackerReference, PlacesAndVectorsAreCarriedOverTheGround) {
    // Vectors stored at 20 × 10 px rebuild the box of a camera that has doubled it, turned it and moved on since.
    MovingScene scene;
    scene.objects = {{{300, 200}, {1.5, 0.4}, 20, 10, 0}};
    scene.camera.zoom = [](int frame) { return 1 + 0.02 * std::max(0, frame - 20); };
    scene.camera.turn = [](int frame) { return 0.02 * std::max(0, frame - 20); };
    TrackerOptions options;
    options.appearance = AppearanceUse::none;
    options.max_reconstructed = 100;
    Tracker tracker(options, scene.scale);
    for (int frame = 0; frame < 60; ++frame) {
        const auto states =
            tracker.next(scene.motion(frame), frame <= 20 ? scene.detections(frame) : std::vector<Detection>{});
        ASSERT_EQ(states.size(), 1U);
        if (frame <= 20) continue;
        ASSERT_EQ(states[0].origin, StateOrigin::reconstructed) << frame;
        EXPECT_GT(overlap(states[0].box, scene.box(0, frame)), 0.9) << frame;
        EXPECT_NEAR(states[0].box.length / scene.box(0, frame).length, 1, 0.03) << frame;
    }
}

TEST(TrackerReference, WhatDetectionsAndTracksMeantForEachOtherIsTold) {
    MovingScene scene = test::twoCars();
    TrackerOptions options = detectionsAlone();
    options.max_missing_s = 0.2;  // five frames
    Tracker tracker(options, scene.scale);
    TrackingTrace trace;
    auto detections = scene.detections(0);
    detections.insert(detections.begin(), Detection{{{10, 10}, 5, 5, 0}, 1, {1, 0}, 0, {}, Rejection::outlier});
    tracker.next(scene.motion(0), detections, &trace);
    EXPECT_TRUE(trace.tracks.empty());
    EXPECT_EQ(trace.started, (std::vector<std::pair<int, TrackId>>{{1, 1}, {2, 2}}));
    EXPECT_EQ(trace.min_overlap, options.min_overlap);
    for (int frame = 1; frame < 10; ++frame) tracker.next(scene.motion(frame), scene.detections(frame), &trace);
    ASSERT_EQ(trace.tracks.size(), 2U);
    EXPECT_NEAR(trace.tracks[0].gate_px, 2.4, 1e-9) << "0.6 m";
    EXPECT_EQ(trace.tracks[1].kind, AssociationKind::matched);
    EXPECT_EQ(trace.tracks[1].detections, std::vector<int>{1});
    ASSERT_EQ(trace.relations.size(), 2U);
    EXPECT_EQ(trace.relations[1].track, 2);
    EXPECT_EQ(trace.relations[1].detection, 1);
    EXPECT_TRUE(trace.relations[1].accepted);
    EXPECT_GT(trace.relations[1].overlap, 0.9);
    EXPECT_TRUE(trace.started.empty());
    EXPECT_NEAR(trace.tracks[0].predicted.centre.x, scene.box(0, 9).centre.x, 0.5);
    for (int frame = 10; frame < 16; ++frame) tracker.next(scene.motion(frame), {scene.detection(1, frame)}, &trace);
    EXPECT_EQ(trace.tracks[0].kind, AssociationKind::missed);
    EXPECT_EQ(trace.tracks[0].ended_by, "tracking.max_missing");
    EXPECT_EQ(trace.tracks[0].ended_value, 6);
    EXPECT_EQ(trace.tracks[0].ended_limit, 5);
    EXPECT_TRUE(trace.tracks[1].ended_by.empty());
}

TEST(TrackerReference, ADoubledDetectionIsToldAndSoIsASuppressedTrack) {
    MovingScene scene;
    scene.objects = {{{100, 100}, {2, 0}, 60, 12, 0}};
    TrackerOptions options = detectionsAlone();
    options.split_merge = SplitMergeRule::none;
    Tracker tracker(options, scene.scale);
    TrackingTrace trace;
    for (int frame = 0; frame < 11; ++frame) {
        auto detections = scene.detections(frame);
        if (frame == 10) {
            detections.push_back(detections[0]);
            detections[1].box = {detections[0].box.toImage({25, 0}), 8, 10, detections[0].box.heading};
        }
        tracker.next(scene.motion(frame), detections, &trace);
    }
    ASSERT_EQ(trace.doubled.size(), 1U);
    EXPECT_EQ(trace.doubled.front().detection, 1);
    EXPECT_TRUE(trace.started.empty());
    // Two that drive into one another.
    scene.objects = {{{100, 100}, {2, 0}, 20, 10, 0}, {{130, 100}, {1.7, 0}, 20, 10, 100}};
    Tracker other(options, scene.scale);
    std::string ended;
    for (int frame = 0; frame < 110 && ended.empty(); ++frame) {
        other.next(scene.motion(frame), scene.detections(frame), &trace);
        for (const TracedTrack& track : trace.tracks) ended += track.ended_by;
    }
    EXPECT_EQ(ended, "tracking.suppress_duplicates");
}

}  // namespace eyrie::tracker_reference_test
