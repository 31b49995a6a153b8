// Life and death of tracks: every limit tried on both sides of it.
#include "tracking/track_manager.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <string>

#include "tracking/drawn_cars.h"
#include "tracking/made_tracks.h"

namespace eyrie::track_manager_test {
namespace {

using test::carAt;
using test::kPicture;
using test::kSlow;
using test::managerWith;
using test::trackAt;

Track rememberedCar(double speed = 0.1) {
    const OrientedBox box{{120, 90}, 20, 10, 0};
    Track track = trackAt(box, {speed, 0});
    track.look = VehicleTemplate::of(test::drawnCars({box}), box);
    EXPECT_TRUE(track.look);
    return track;
}

std::string endOf(const Track& track, const TrackerOptions& options = {}, cv::Size image = kPicture) {
    const auto end = managerWith(options).endOf(track, image);
    return end ? end->parameter : "";
}

}  // namespace

TEST(TrackManager, ATrackGivesUpItsPartsAfterItsPatience) {
    TrackerOptions options;
    options.split_patience = 8;
    const TrackManager manager = managerWith(options);
    const auto givesUp = [&](int abreast, int parts, int whole) {
        Track track = carAt({100, 100});
        track.abreast_streak = abreast;
        track.parts_streak = parts;
        track.whole_hits = whole;
        return manager.givesUpParts(track);
    };
    EXPECT_FALSE(givesUp(7, 0, 0));
    EXPECT_TRUE(givesUp(8, 0, 1000)) << "side by side no vehicle falls apart";
    EXPECT_FALSE(givesUp(0, 7, 0));
    EXPECT_TRUE(givesUp(0, 8, 23));
    EXPECT_FALSE(givesUp(0, 8, 24)) << "it was seen in one piece three times as often";
}

TEST(TrackManager, LimitsInSecondsAreRoundedToFramesAndHaveFloors) {
    TrackerOptions options;
    options.max_failed_s = 0.5;
    EXPECT_EQ(TrackManager(options, {0.2, 100, true}).maxFailedFrames(), 50);
    EXPECT_EQ(TrackManager(options, {0.2, 2, true}).maxFailedFrames(), 3);
    EXPECT_EQ(TrackManager(options, {0.2, 100, true}).lookInterval(), 10);
    EXPECT_EQ(TrackManager(options, {0.2, 5, true}).lookInterval(), 1);
    EXPECT_NEAR(managerWith().fastestStart({}, 0.1), 3 * 0.4, 1e-9) << "three times 2 m/s";
    EXPECT_NEAR(managerWith().fastestStart({}, 0.7), 3 * 0.7, 1e-9);
    EXPECT_NEAR(TrackManager::reachOf({{0, 0}, 20, 10, 0}), 3, 1e-9);
    EXPECT_NEAR(TrackManager::reachOf({{0, 0}, 9, 5, 0}), 1.5, 1e-9);
}

TEST(TrackManager, RebuildingIsAllowedForATimeAndLongerForTracksSeenOften) {
    TrackerOptions options;
    options.max_reconstructed = 10;
    options.supported_hits = 20;
    options.max_supported_s = 1;
    const auto allowed = [&](int hits, int streak) {
        Track track = carAt({100, 100});
        track.hits = hits;
        track.reconstructed_streak = streak;
        return managerWith(options).mayBeReconstructed(track);
    };
    EXPECT_TRUE(allowed(19, 9));
    EXPECT_FALSE(allowed(19, 10));
    EXPECT_TRUE(allowed(20, 24));
    EXPECT_FALSE(allowed(20, 25));
    options.max_reconstructed = 30;
    EXPECT_TRUE(allowed(20, 29));
    EXPECT_FALSE(allowed(20, 30));
}

TEST(TrackManager, OnlyWhatHasDrivenMayStand) {
    const TrackManager manager = managerWith();
    const auto may = [&](int hits, cv::Point2d way, bool classified, int whole) {
        Track track = rememberedCar();
        track.hits = hits;
        track.origin_place = track.filter.box().centre - way;
        track.whole_boxes = whole;
        EXPECT_EQ(manager.worthRemembering(track, kSlow, classified),
                  manager.mayBeRecognised(track, kSlow, classified));
        return manager.mayBeRecognised(track, kSlow, classified);
    };
    EXPECT_TRUE(may(10, {20.1, 0}, false, 0));
    EXPECT_FALSE(may(9, {20.1, 0}, false, 0));
    EXPECT_FALSE(may(10, {19.9, 0}, false, 0)) << "a vehicle's length";
    EXPECT_TRUE(may(10, {0, -20.1}, false, 0));
    EXPECT_FALSE(may(10, {-14, 14}, false, 0));
    EXPECT_TRUE(may(10, {-14.2, 14.2}, false, 0));
    // With a classifier that took it for a vehicle in a tenth of its detections it is the same, …
    EXPECT_TRUE(may(20, {20.1, 0}, true, 2));
    EXPECT_FALSE(may(20, {20.1, 0}, true, 1));
    EXPECT_FALSE(may(20, {1000, 0}, true, 1));
    // … otherwise it takes two seconds and two lengths.
    EXPECT_TRUE(may(50, {40.1, 0}, true, 0));
    EXPECT_FALSE(may(49, {40.1, 0}, true, 0));
    EXPECT_FALSE(may(50, {39.9, 0}, true, 0));
}

TEST(TrackManager, WhatIsLookedForByItsLookIsKnownAndSlow) {
    TrackerOptions options;
    options.stop_speed_m_s = 2;  // .4 px/frame
    const auto may = [&](const Track& track, double slow_speed = kSlow) {
        return managerWith(options).mayBeRecognised(track, slow_speed, false);
    };
    EXPECT_TRUE(may(rememberedCar(0.39)));
    EXPECT_FALSE(may(rememberedCar(0.41)));
    EXPECT_TRUE(may(rememberedCar(0.41), 0.5));
    Track track = rememberedCar(5);
    track.stopped = true;
    EXPECT_TRUE(may(track));
    track = rememberedCar();
    track.recognised_streak = 49;  // two seconds
    EXPECT_TRUE(may(track));
    track.recognised_streak = 50;
    EXPECT_FALSE(may(track));
    track.standstill.certain = true;
    EXPECT_TRUE(may(track));
    track.look.reset();
    EXPECT_FALSE(may(track));
    track = rememberedCar();
    track.status = TrackStatus::tentative;
    EXPECT_FALSE(may(track));
    options.appearance = AppearanceUse::lost;
    EXPECT_TRUE(may(rememberedCar(5)));
    options.appearance = AppearanceUse::none;
    EXPECT_FALSE(may(rememberedCar()));
}

TEST(TrackManager, WorthRememberingIsWhatMayStopSoon) {
    TrackerOptions options;
    const auto worth = [&](const Track& track, double slow_speed = kSlow) {
        return managerWith(options).worthRemembering(track, slow_speed, false);
    };
    EXPECT_TRUE(worth(rememberedCar(1.19))) << "three times 2 m/s";
    EXPECT_FALSE(worth(rememberedCar(1.21)));
    EXPECT_TRUE(worth(rememberedCar(1.21), 0.5));
    Track merged = rememberedCar();
    merged.merged = true;
    EXPECT_FALSE(worth(merged));
    Track young = rememberedCar();
    young.status = TrackStatus::tentative;
    EXPECT_FALSE(worth(young));
    options.appearance = AppearanceUse::lost;
    EXPECT_TRUE(worth(rememberedCar(9)));
    options.appearance = AppearanceUse::none;
    EXPECT_FALSE(worth(rememberedCar()));
}

TEST(TrackManager, StandsForSureAfterFourTenthsOfASecondWithinHalfAPixel) {
    const TrackManager manager = managerWith();
    const OrientedBox place{{120, 90}, 20, 10, 0};
    Track track = rememberedCar();
    manager.countStandstill(track, 9.0, place);
    EXPECT_TRUE(track.standstill.begun);
    EXPECT_TRUE(track.standstill.agrees);
    EXPECT_EQ(track.standstill.still, 1) << "nothing is known of its place before";
    EXPECT_EQ(track.standstill.place.centre, place.centre);
    OrientedBox later = place;
    later.centre.x += 0.4;
    for (int frame = 2; frame <= 9; ++frame) manager.countStandstill(track, 0.5, later);
    EXPECT_EQ(track.standstill.still, 9);
    EXPECT_FALSE(track.standstill.certain);
    EXPECT_EQ(track.standstill.place.centre, place.centre) << "it does not follow";
    Track moves = track;
    manager.countStandstill(moves, 0.51, later);
    EXPECT_EQ(moves.standstill.still, 1);
    EXPECT_EQ(moves.standstill.place.centre, later.centre);
    EXPECT_FALSE(moves.standstill.certain);
    Track lost = track;
    manager.countStandstill(lost, std::nullopt, place);
    EXPECT_FALSE(lost.standstill.begun);
    EXPECT_EQ(lost.standstill.still, 0);
    manager.countStandstill(track, 0.5, later);
    EXPECT_TRUE(track.standstill.certain);
    EXPECT_FALSE(TrackManager({}, {0.2, 10, true}).maxFailedFrames() < 3);
}

TEST(TrackManager, AtALowFrameRateFiveLooksSettleIt) {
    const TrackManager manager({}, {0.2, 10, true});
    Track track = rememberedCar();
    for (int look = 1; look <= 5; ++look) {
        EXPECT_FALSE(track.standstill.certain) << look;
        manager.countStandstill(track, 0.1, {{120, 90}, 20, 10, 0});
    }
    EXPECT_TRUE(track.standstill.certain);
}

TEST(TrackManager, AStandingVehicleCreepsOffAfterThreeLooksBesideItsPlace) {
    const TrackManager manager = managerWith();
    Track track = rememberedCar();
    Standstill& stands = track.standstill;
    stands.certain = stands.begun = true;
    stands.hidden = 7;
    stands.place = {{120, 90}, 20, 10, 0};
    // Where it is found its place follows by a tenth, but by .03 px at most.
    manager.countStandstill(track, 0.2, {{120.2, 90}, 20, 10, 0});
    EXPECT_EQ(stands.hidden, 0);
    EXPECT_NEAR(stands.place.centre.x, 120.02, 1e-9);
    manager.countStandstill(track, 3.0, {{121.8, 92.4}, 20, 10, 0});
    EXPECT_NEAR(std::hypot(stands.place.centre.x - 120.02, stands.place.centre.y - 90), 0.03, 1e-9);
    EXPECT_GT(stands.place.centre.y, 90.02);
    stands.place = {{120, 90}, 20, 10, 0};
    manager.countStandstill(track, 3.1, {{123, 91}, 20, 10, 0});
    manager.countStandstill(track, 3.1, {{123, 91}, 20, 10, 0});
    EXPECT_EQ(stands.away, 2);
    EXPECT_EQ(stands.place.centre, cv::Point2d(120, 90)) << "not followed from beyond its reach";
    Track back = track;
    manager.countStandstill(back, 2.9, {{122, 91}, 20, 10, 0});
    EXPECT_EQ(back.standstill.away, 0);
    EXPECT_TRUE(back.standstill.certain);
    Track hidden = track;
    manager.countStandstill(hidden, std::nullopt, {{120, 90}, 20, 10, 0});
    EXPECT_TRUE(hidden.standstill.certain) << "as something passes in front of it";
    EXPECT_FALSE(hidden.standstill.agrees);
    manager.countStandstill(track, 3.1, {{123, 91}, 20, 10, 0});
    EXPECT_FALSE(stands.certain);
    EXPECT_FALSE(stands.begun);
}

TEST(TrackManager, AStandingVehicleDepartsWithThreeDetectionsBesideItsPlace) {
    const TrackManager manager = managerWith();
    for (const cv::Point2d off : {cv::Point2d(3.1, 0), {0, 3.1}, {-2.2, -2.2}}) {
        Track track = rememberedCar();
        Standstill& stands = track.standstill;
        stands.certain = true;
        stands.hidden = 4;
        stands.place = track.filter.box();
        stands.place.centre += off;
        for (const int away : {1, 2}) {
            manager.countDeparture(track);
            EXPECT_EQ(stands.away, away);
            EXPECT_EQ(stands.hidden, 0);
        }
        Track back = track;
        back.standstill.place.centre = track.filter.box().centre + 0.95 * off;
        manager.countDeparture(back);
        EXPECT_EQ(back.standstill.away, 0) << off;
        manager.countDeparture(track);
        EXPECT_FALSE(stands.certain);
    }
    Track unsure = rememberedCar();
    unsure.standstill.begun = true;
    unsure.standstill.still = 4;
    manager.countDeparture(unsure);
    EXPECT_FALSE(unsure.standstill.begun);
    EXPECT_EQ(unsure.standstill.still, 0);
}

TEST(TrackManager, CountsTheEvidenceOfAFrame) {
    TrackerOptions options;
    options.confirm_hits = 3;
    options.confirm_window = 5;
    const TrackManager manager = managerWith(options);
    Track track = carAt({100, 100});
    track.status = TrackStatus::tentative;
    track.hits = 1;
    const auto frame = [&](StateOrigin origin) {
        track.origin = origin;
        manager.count(track, kSlow);
    };
    frame(StateOrigin::predicted);
    EXPECT_EQ(track.missing, 1);
    EXPECT_EQ(track.predicted_streak, 1);
    frame(StateOrigin::reconstructed);
    EXPECT_EQ(track.missing, 2);
    EXPECT_EQ(track.predicted_streak, 0);
    EXPECT_EQ(track.reconstructed_streak, 1);
    frame(StateOrigin::reconstructed);
    EXPECT_EQ(track.reconstructed_streak, 2);
    frame(StateOrigin::detected);
    EXPECT_EQ(track.hits, 2);
    EXPECT_EQ(track.missing, 0);
    EXPECT_EQ(track.reconstructed_streak, 0);
    EXPECT_EQ(track.history, 0b10001U);
    frame(StateOrigin::standing);
    EXPECT_EQ(track.history, 0b10001U) << "what stands cannot be detected, which says nothing against it";
    frame(StateOrigin::detected);
    EXPECT_EQ(track.status, TrackStatus::tentative) << "the first was six frames ago";
    frame(StateOrigin::detected);
    EXPECT_EQ(track.status, TrackStatus::confirmed);
    frame(StateOrigin::predicted);
    EXPECT_EQ(track.status, TrackStatus::coasting);
    frame(StateOrigin::predicted);
    EXPECT_EQ(track.predicted_streak, 2);
    track.recognised = true;
    frame(StateOrigin::predicted);
    EXPECT_EQ(track.predicted_streak, 1) << "found by its look";
    EXPECT_EQ(track.recognised_streak, 1);
    frame(StateOrigin::predicted);
    EXPECT_EQ(track.recognised_streak, 2);
    track.standstill.certain = true;
    frame(StateOrigin::standing);
    EXPECT_EQ(track.recognised_streak, 0) << "what stands does not creep";
}

TEST(TrackManager, AWindowOfConfirmationIsAtLeastTheHitsThatItTakes) {
    TrackerOptions options;
    options.confirm_hits = 4;
    options.confirm_window = 2;
    const TrackManager manager = managerWith(options);
    Track track = carAt({100, 100});
    track.status = TrackStatus::tentative;
    for (int hit = 2; hit <= 4; ++hit) {
        EXPECT_EQ(track.status, TrackStatus::tentative);
        manager.count(track, kSlow);
    }
    EXPECT_EQ(track.status, TrackStatus::confirmed);
    track.hits = 4;
    EXPECT_TRUE(manager.established(track));
    track.hits = 3;
    EXPECT_FALSE(manager.established(track));
}

TEST(TrackManager, WhatIsLostWhileSlowComesToAStop) {
    const TrackManager manager = managerWith();
    const auto speedAfter = [&](double speed, int frames, double slow_speed) {
        Track track = carAt({100, 100}, {speed, 0});
        track.origin = StateOrigin::predicted;
        for (int frame = 0; frame < frames; ++frame) manager.count(track, slow_speed);
        EXPECT_EQ(track.stopped, track.filter.speed() < speed);
        return track.filter.speed();
    };
    EXPECT_NEAR(speedAfter(0.39, 1, kSlow), 0.7 * 0.39, 1e-9);
    EXPECT_NEAR(speedAfter(0.39, 3, kSlow), 0.7 * 0.7 * 0.7 * 0.39, 1e-9);
    EXPECT_NEAR(speedAfter(0.41, 3, kSlow), 0.41, 1e-9);
    EXPECT_NEAR(speedAfter(0.41, 1, 0.5), 0.7 * 0.41, 1e-9);
    Track track = carAt({100, 100}, {0.3, 0});
    track.origin = StateOrigin::predicted;
    track.hits = 4;
    manager.count(track, kSlow);
    EXPECT_FALSE(track.stopped) << "too little is known of it";
    TrackerOptions never;
    never.stop_speed_m_s = 0;
    track.hits = 100;
    managerWith(never).count(track, kSlow);
    EXPECT_FALSE(track.stopped);
    track.stopped = true;
    track.origin = StateOrigin::detected;
    manager.count(track, kSlow);
    EXPECT_FALSE(track.stopped);
}

TEST(TrackManager, TheScoreIsTheShareOfTheLast32FramesThatWereDetected) {
    Track track = carAt({100, 100});
    track.history = 0b1011;
    track.age = 3;
    EXPECT_DOUBLE_EQ(track.state().score, 0.75);
    track.age = 9;
    EXPECT_DOUBLE_EQ(track.state().score, 0.3);
    track.history = ~std::uint64_t{0} << 31;
    track.age = 31;
    EXPECT_DOUBLE_EQ(track.state().score, 1 / 32.);
    track.age = 60;
    EXPECT_DOUBLE_EQ(track.state().score, 1 / 32.);
}

TEST(TrackManager, LivesEndForWantOfEvidence) {
    TrackerOptions options;
    options.max_missing_tentative = 2;
    options.max_missing_s = 0.4;  // 10 frames
    options.max_stopped_s = 0.8;  // 20
    options.max_standing_s = 4;   // 100
    options.max_hidden_s = 1.6;   // 40
    options.max_leaving_s = 1.2;  // 30
    Track track = carAt({300, 200});
    track.status = TrackStatus::tentative;
    track.missing = 2;
    track.predicted_streak = 99;
    EXPECT_EQ(endOf(track, options), "");
    track.missing = 3;
    EXPECT_EQ(endOf(track, options), "tracking.max_missing_tentative");
    track.status = TrackStatus::coasting;
    track.predicted_streak = 10;
    EXPECT_EQ(endOf(track, options), "");
    track.predicted_streak = 11;
    EXPECT_EQ(endOf(track, options), "tracking.max_missing");
    const auto end = managerWith(options).endOf(track, kPicture);
    ASSERT_TRUE(end);
    EXPECT_EQ(end->value, 11);
    EXPECT_EQ(end->limit, 10);
    track.stopped = true;
    track.predicted_streak = 20;
    EXPECT_EQ(endOf(track, options), "");
    track.predicted_streak = 21;
    EXPECT_EQ(endOf(track, options), "tracking.max_stopped");
    track.standstill.certain = true;
    track.predicted_streak = 1000;
    track.standstill.frames = 100;
    track.standstill.hidden = 40;
    EXPECT_EQ(endOf(track, options), "");
    track.standstill.hidden = 41;
    EXPECT_EQ(endOf(track, options), "tracking.max_hidden");
    track.standstill.frames = 101;
    EXPECT_EQ(endOf(track, options), "tracking.max_standing");
    options.max_missing_s = 0;
    Track briefly = carAt({300, 200});
    briefly.status = TrackStatus::coasting;
    briefly.predicted_streak = 2;
    EXPECT_EQ(endOf(briefly, options), "") << "two frames in any case";
    briefly.predicted_streak = 3;
    EXPECT_EQ(endOf(briefly, options), "tracking.max_missing");
}

TEST(TrackManager, WhatLeavesThePictureIsWaitedForOnEachOfItsSides) {
    TrackerOptions options;
    options.max_missing_s = 0.4;
    options.max_leaving_s = 1.2;
    const std::array<std::pair<cv::Point2d, cv::Point2d>, 4> leaving{
        {{{632, 200}, {1, 0}}, {{7, 200}, {-1, 0}}, {{300, 476}, {0, 1}}, {{300, 3}, {0, -1}}}};
    for (const auto& [centre, velocity] : leaving) {
        Track out = carAt(centre, velocity);
        out.predicted_streak = 30;
        EXPECT_EQ(endOf(out, options), "") << centre;
        out.predicted_streak = 31;
        EXPECT_EQ(endOf(out, options), "tracking.max_leaving") << centre;
        EXPECT_EQ(endOf(out, options, {}), "tracking.max_missing") << "nothing is known of the picture";
        Track in = carAt(centre, -velocity);
        in.predicted_streak = 11;
        EXPECT_EQ(endOf(in, options), "tracking.max_missing") << centre;
    }
    // Two hundredths of it outside do not count yet: it ends at x = 639.5.
    for (const double outside : {0.35, 0.45}) {
        Track track = carAt({629.5 + outside, 200}, {1, 0});
        track.predicted_streak = 11;
        EXPECT_EQ(endOf(track, options), outside < 0.4 ? "tracking.max_missing" : "");
    }
}

TEST(TrackManager, ATrackEndsWithTheLastOfItInThePicture) {
    TrackerOptions options;
    options.min_visible = 0.1;
    EXPECT_EQ(endOf(carAt({647.4, 200}), options), "") << ".105 of it";
    Track track = carAt({647.6, 200});
    const auto end = managerWith(options).endOf(track, kPicture);
    ASSERT_TRUE(end);
    EXPECT_STREQ(end->parameter, "tracking.min_visible");
    EXPECT_NEAR(end->value, 0.095, 1e-9);
    EXPECT_NEAR(end->limit, 0.1, 1e-9);
    EXPECT_EQ(endOf(carAt({300, 483.9}), options), "tracking.min_visible");
    EXPECT_EQ(endOf(carAt({900, 200}), options, {}), "") << "nothing is known of the picture";
    EXPECT_EQ(endOf(carAt({NAN, 200}), options), "tracking.min_visible");
    EXPECT_EQ(endOf(carAt({300, NAN}), options), "tracking.min_visible");
}

}  // namespace eyrie::track_manager_test
