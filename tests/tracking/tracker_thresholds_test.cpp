#include <gtest/gtest.h>

#include "tracking/tracked_scene.h"
#include "tracking/tracker.h"

namespace eyrie::tracker_thresholds_test {
namespace {

using test::MovingScene;
using test::neighbours;
using test::twoCars;

/// Options of a tracker with one parameter set by its name.
TrackerOptions with(const std::string& name, const std::string& value, TrackerOptions options = {}) {
    setParameter(describeOf(options), name, value);
    return options;
}

/// A tracker that has seen all objects of a scene in its first frames.
Tracker trackerAfter(int frames, const MovingScene& scene, const TrackerOptions& options) {
    Tracker tracker(options, scene.scale);
    for (int frame = 0; frame < frames; ++frame) tracker.next(scene.motion(frame), scene.detections(frame));
    return tracker;
}

int countOf(const std::vector<TrackState>& states, StateOrigin origin) {
    return static_cast<int>(
        std::count_if(states.begin(), states.end(), [origin](const TrackState& s) { return s.origin == origin; }));
}

MovingScene lorry() {
    MovingScene scene;
    scene.objects = {{{100, 100}, {2, 0}, 60, 12, 0}};
    return scene;
}

/// Tracks of a lorry that is seen together with a piece of 8 × 10 px, `outside` px of which lie in front of it.
std::size_t tracksOfLorryAndPiece(double outside, const TrackerOptions& options) {
    const MovingScene scene = lorry();
    Tracker tracker = trackerAfter(10, scene, options);
    auto detections = scene.detections(10);
    detections.push_back(detections[0]);
    detections[1].box = {detections[0].box.toImage({30 + outside - 4, 0}), 8, 10, detections[0].box.heading};
    return tracker.next(scene.motion(10), detections).size();
}

}  // namespace

TEST(TrackerThresholds, PartContainmentTellsPartsFromNeighbours) {
    // Three eighths of the piece lie in front.
    EXPECT_EQ(tracksOfLorryAndPiece(3, with("tracking.part_containment", "0.6")), 1U);
    EXPECT_EQ(tracksOfLorryAndPiece(3, with("tracking.part_containment", "0.65")), 2U);
}

TEST(TrackerThresholds, PartContainmentTellsWhichTracksAMergedDetectionCovers) {
    MovingScene scene = neighbours();
    scene.objects[1].start = {100, 110};
    for (const char* value : {"0.6", "0.7"}) {
        Tracker tracker = trackerAfter(15, scene, with("tracking.part_containment", value));
        // It covers .65 of each.
        Detection merged = scene.detection(0, 15);
        merged.box.centre.y += 5;
        merged.box.width = 13;
        const auto states = tracker.next(scene.motion(15), {merged});
        EXPECT_EQ(countOf(states, StateOrigin::detected), value == std::string("0.6") ? 0 : 1) << value;
    }
}

TEST(TrackerThresholds, TheDistanceGateIsTheLargerOfMetresAndPixels) {
    MovingScene scene = twoCars();
    scene.objects.resize(1);
    const auto gated = [&](const char* metres, const char* pixels) {
        const TrackerOptions options =
            with("tracking.distance_gate_m", metres, with("tracking.distance_gate_px", pixels));
        Tracker tracker = trackerAfter(10, scene, options);
        // Beside the predicted box, which it does not touch.
        Detection beside = scene.detection(0, 10);
        beside.box.centre.y += 12;
        TrackingTrace trace;
        tracker.next(scene.motion(10), {beside}, &trace);
        return trace.tracks.at(0);
    };
    EXPECT_EQ(gated("0", "0").kind, AssociationKind::missed);
    EXPECT_EQ(gated("5", "0").kind, AssociationKind::matched) << "20 px";
    EXPECT_EQ(gated("0", "20").kind, AssociationKind::matched);
    EXPECT_NEAR(gated("5", "3").gate_px, 20, 1e-9);
    EXPECT_NEAR(gated("5", "30").gate_px, 30, 1e-9);
}

TEST(TrackerThresholds, MaxTurnIsHowFarADetectionMayMoveIntoAnotherDirection) {
    MovingScene scene = twoCars();
    scene.objects.resize(1);
    for (const auto& [degrees, kind] : {std::pair("50", AssociationKind::missed), {"70", AssociationKind::matched}}) {
        Tracker tracker = trackerAfter(10, scene, with("tracking.max_turn", degrees));
        Detection turned = scene.detection(0, 10);
        turned.velocity = {2 * std::cos(kPi / 3), 2 * std::sin(kPi / 3)};
        TrackingTrace trace;
        tracker.next(scene.motion(10), {turned}, &trace);
        EXPECT_EQ(trace.tracks.at(0).kind, kind) << degrees;
    }
}

TEST(TrackerThresholds, SplitPatienceIsHowLongAMergedTrackIsHeldTogether) {
    const MovingScene scene = neighbours();
    constexpr int kApart = 8;
    for (const int patience : {4, 8, 12}) {
        Tracker tracker(with("tracking.split_patience", std::to_string(patience)), scene.scale);
        int first_of_two = 0;
        for (int frame = 0; frame < 40 && first_of_two == 0; ++frame) {
            auto detections = scene.detections(frame);
            if (frame < kApart) {
                detections[0].box = unionBox(detections[0].box, detections[1].box);
                detections.resize(1);
            }
            if (tracker.next(scene.motion(frame), detections).size() == 2) first_of_two = frame;
        }
        EXPECT_EQ(first_of_two, kApart + patience);
    }
}

TEST(TrackerThresholds, SizePatienceIsHowManyDetectionsOfAnotherSizeAreNotBelieved) {
    const MovingScene scene = twoCars();
    for (const int patience : {4, 10, 20}) {
        Tracker tracker = trackerAfter(20, scene, with("tracking.size_patience", std::to_string(patience)));
        int doubted = 0;
        for (int frame = 20; frame < 60; ++frame) {
            auto detections = scene.detections(frame);
            detections[0].box.length *= 1.5;
            detections[0].box.width *= 1.5;
            const auto states = tracker.next(scene.motion(frame), detections);
            ASSERT_EQ(states.size(), 2U);
            if (states[0].box.length > 22) break;
            ++doubted;
        }
        EXPECT_EQ(doubted, patience);
    }
}

TEST(TrackerThresholds, VectorSpeedDifferenceTellsWhichVectorsBelongToATrack) {
    const MovingScene scene = twoCars();
    for (const char* value : {"0.25", "0.35"}) {
        Tracker tracker(with("tracking.vector_speed_difference", value), scene.scale);
        std::vector<TrackState> states;
        for (int frame = 0; frame < 11; ++frame) {
            FrameMotion motion = scene.motion(frame);
            for (MotionVector& vector : motion.motion_vectors) vector.velocity *= 0.7F;  // three tenths slower
            states = tracker.next(motion, frame < 10 ? scene.detections(frame) : std::vector<Detection>{});
        }
        EXPECT_EQ(countOf(states, StateOrigin::reconstructed), value == std::string("0.25") ? 0 : 2) << value;
    }
}

TEST(TrackerThresholds, SupportedHitsIsHowManyDetectionsEarnALongRebuiltLife) {
    const MovingScene scene = twoCars();
    for (const int hits : {30, 31}) {
        TrackerOptions options;  // ten frames for all, a second for those
        Tracker tracker = trackerAfter(30, scene, with("tracking.supported_hits", std::to_string(hits), options));
        int rebuilt = 0;
        for (int frame = 30; frame < 80; ++frame)
            rebuilt += countOf(tracker.next(scene.motion(frame), {}), StateOrigin::reconstructed);
        EXPECT_EQ(rebuilt, 2 * (hits <= 30 ? 25 : 10)) << hits;
    }
}

TEST(TrackerThresholds, MaxVectorsIsHowManyATrackHas) {
    const MovingScene scene = twoCars();  // with six vectors each
    TrackerOptions options;
    options.min_vectors = 4;
    for (const auto& [most, rebuilt] : {std::pair("3", 0), {"4", 2}}) {
        Tracker tracker = trackerAfter(10, scene, with("tracking.max_vectors", most, options));
        EXPECT_EQ(countOf(tracker.next(scene.motion(10), {}), StateOrigin::reconstructed), rebuilt) << most;
    }
}

TEST(TrackerThresholds, ConfirmWindowIsWithinHowManyFramesATrackIsConfirmed) {
    const MovingScene scene = twoCars();  // detected in every other frame: five times in nine
    for (const auto& [window, confirmed] : {std::pair("8", false), {"9", true}}) {
        Tracker tracker(with("tracking.confirm_window", window), scene.scale);
        bool any = false;
        for (int frame = 0; frame < 30; ++frame) {
            const auto detections = frame % 2 == 0 ? scene.detections(frame) : std::vector<Detection>{};
            for (const TrackState& state : tracker.next(scene.motion(frame), detections))
                any = any || state.status != TrackStatus::tentative;
        }
        EXPECT_EQ(any, confirmed) << window;
    }
}

TEST(TrackerThresholds, MaxFailedIsHowLongTracksOutliveAFailingRegistration) {
    const MovingScene scene = twoCars();
    for (const auto& [value, frames] : {std::pair("0.4", 10), {"0.8", 20}}) {
        Tracker tracker = trackerAfter(10, scene, with("tracking.max_failed", value));
        FrameMotion motion = scene.motion(10);
        motion.registration.state = RegistrationState::failed;
        motion.registration.failure = {.fault = RegistrationFault::too_few_corners, .count = 3, .of = 40};
        int lived = 0;
        while (lived < 60 && !tracker.next(motion, {}).empty()) ++lived;
        EXPECT_EQ(lived, frames);
    }
}

TEST(TrackerThresholds, DuplicateContainmentTellsWhatInsideATrackStartsNone) {
    TrackerOptions apart;
    apart.split_merge = SplitMergeRule::none;  // otherwise it is fused before it could start one
    // A quarter of the piece lies in front.
    EXPECT_EQ(tracksOfLorryAndPiece(2, with("tracking.duplicate_containment", "0.7", apart)), 1U);
    EXPECT_EQ(tracksOfLorryAndPiece(2, with("tracking.duplicate_containment", "0.8", apart)), 2U);
}

TEST(TrackerThresholds, DuplicateContainmentTellsWhichTracksAreOne) {
    // Two that drive apart at first: the small one ends up with a quarter of it in front of the lorry.
    MovingScene scene = lorry();
    scene.objects.push_back({{100 + 28 + 0.5 * 30, 100}, {1.5, 0}, 8, 10, 100});
    for (const auto& [value, left] : {std::pair("0.7", 1U), {"0.8", 2U}}) {
        TrackerOptions options = with("tracking.duplicate_containment", value);
        options.split_merge = SplitMergeRule::none;
        EXPECT_EQ(trackerAfter(30, scene, options).next(scene.motion(30), scene.detections(30)).size(), left) << value;
    }
}

TEST(TrackerThresholds, MaxMissingTentativeIsForHowManyFramesATrackSeenOnceIsHeld) {
    const MovingScene scene = lorry();
    for (const int most : {0, 2, 5}) {
        Tracker tracker = trackerAfter(1, scene, with("tracking.max_missing_tentative", std::to_string(most)));
        int held = 0;
        for (int frame = 1; frame < 20; ++frame) held += !tracker.next(scene.motion(frame), {}).empty();
        EXPECT_EQ(held, most);
    }
}

TEST(TrackerThresholds, WhereTheVideoIsSlowFewerHitsConfirmATrack) {
    const auto framesUntilConfirmed = [](const TrackerOptions& options, double frame_rate_hz) {
        test::MovingScene scene;
        scene.scale.frame_rate_hz = frame_rate_hz;
        scene.objects = {{{100, 240}, {6, 0}, 40, 14, 0}};
        Tracker tracker(options, scene.scale);
        for (int frame = 0; frame < 12; ++frame) {
            const auto states = tracker.next(scene.motion(frame), scene.detections(frame));
            if (!states.empty() && states[0].status == TrackStatus::confirmed) return frame + 1;
        }
        return 0;
    };
    EXPECT_EQ(framesUntilConfirmed({}, 25), 5);
    EXPECT_EQ(framesUntilConfirmed({}, 10), 5);
    EXPECT_EQ(framesUntilConfirmed({}, 6.5), 4);
    EXPECT_EQ(framesUntilConfirmed({}, 2), 4);
    TrackerOptions counted;
    counted.follow_rate = false;
    EXPECT_EQ(framesUntilConfirmed(counted, 2), 5);
    counted = {};
    counted.confirm_hits = 2;
    EXPECT_EQ(framesUntilConfirmed(counted, 2), 2) << "never more than asked for";
}

TEST(TrackerThresholds, WhereTheVideoIsSlowTwoWholeVehiclesConfirmATrack) {
    // Which of its detections a classifier takes for a whole vehicle, one letter a frame.
    const auto framesUntilConfirmed = [](const std::string& looks, double frame_rate_hz,
                                         const TrackerOptions& options) {
        test::MovingScene scene;
        scene.scale.frame_rate_hz = frame_rate_hz;
        scene.objects = {{{100, 240}, {6, 0}, 40, 14, 0}};
        Tracker tracker(options, scene.scale);
        for (int frame = 0; frame < 12; ++frame) {
            auto detections = scene.detections(frame);
            const auto at = static_cast<std::size_t>(frame);
            for (Detection& detection : detections) detection.complete = at < looks.size() && looks[at] == 'w';
            const auto states = tracker.next(scene.motion(frame), detections);
            if (!states.empty() && states[0].status == TrackStatus::confirmed) return frame + 1;
        }
        return 0;
    };
    EXPECT_EQ(framesUntilConfirmed("ww", 2, {}), 2);
    EXPECT_EQ(framesUntilConfirmed("w-w", 2, {}), 3);
    EXPECT_EQ(framesUntilConfirmed("w--", 2, {}), 4) << "one is not enough";
    EXPECT_EQ(framesUntilConfirmed("wwww", 10, {}), 5) << "where there are pictures enough they are asked for";
    EXPECT_EQ(framesUntilConfirmed("www", 2, with("tracking.confirm_whole", "3")), 3);
    EXPECT_EQ(framesUntilConfirmed("w", 2, with("tracking.confirm_whole", "1")), 1);
    EXPECT_EQ(framesUntilConfirmed("-w", 2, with("tracking.confirm_whole", "1")), 2);
    EXPECT_EQ(framesUntilConfirmed("www", 2, with("tracking.confirm_whole", "0")), 4);
    EXPECT_EQ(framesUntilConfirmed("www", 2, with("tracking.follow_rate", "false")), 5);
}

TEST(TrackerThresholds, FewerHitsAreAsManyAsFitInSixTenthsOfASecond) {
    const auto hitsAt = [](double frame_rate_hz, int asked = 5) {
        TrackerOptions options;
        options.confirm_hits = asked;
        return options.atRate(frame_rate_hz).confirm_hits;
    };
    EXPECT_EQ(hitsAt(8.4, 20), 20) << "five frames fit";
    EXPECT_EQ(hitsAt(8.3, 20), 20) << "19.9";
    EXPECT_EQ(hitsAt(8, 20), 19);
    EXPECT_EQ(hitsAt(5, 20), 12);
    EXPECT_EQ(hitsAt(7), 4);
    EXPECT_EQ(hitsAt(5), 4) << "3, which is too few";
    EXPECT_EQ(hitsAt(1), 4);
    EXPECT_EQ(hitsAt(1, 20), 4) << "2.4, which is too few";
    EXPECT_EQ(hitsAt(1, 2), 2);
    EXPECT_EQ(TrackerOptions::thesis().atRate(1).confirm_hits, 5);
}

}  // namespace eyrie::tracker_thresholds_test
