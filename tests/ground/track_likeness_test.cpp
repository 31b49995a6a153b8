#include "ground/track_likeness.h"

#include <gtest/gtest.h>

#include "core/error.h"
#include "events/driven_tracks.h"

namespace eyrie::track_likeness_test {
namespace {

StoredTracks runWith(const test::DrivenTracks& scene) {
    StoredTracks run;
    run.tracks = scene.tracks;
    run.footage = scene.footage();
    return run;
}

std::vector<TrackLikeness> likeFirst(const StoredTracks& run) {
    return tracksLike(run, GroundStretches(run.footage), 1);
}

TrackLikeness of(TrackId id, const std::vector<TrackLikeness>& all) {
    const auto found =
        std::find_if(all.begin(), all.end(), [id](const TrackLikeness& each) { return each.track == id; });
    return found == all.end() ? TrackLikeness{.track = -1} : *found;
}

std::vector<TrackId> orderOf(const std::vector<TrackLikeness>& all) {
    std::vector<TrackId> ids;
    for (const TrackLikeness& each : all) ids.push_back(each.track);
    return ids;
}

/// A straight drive at an even speed.
std::vector<std::pair<cv::Point2d, double>> straight(cv::Point2d start, double heading_deg, double kmh,
                                                     double seconds) {
    std::vector<std::pair<cv::Point2d, double>> poses;
    const double heading = radiansFromDegrees(heading_deg);
    const cv::Point2d step = cv::Point2d(std::cos(heading), std::sin(heading)) * (kmh / 3.6 / 25);
    for (int i = 0; i < seconds * 25; ++i) poses.emplace_back(start + step * i, heading);
    return poses;
}

/// 1: a car eastwards at y = 60 m with 36 km/h. 2: the same a lane further; 3: the opposite lane; 4: a lorry in the
/// same lane; 5: the same lane, later; 6: much slower in it; 7: across; 8: eastwards 40 m beside it.
void driveOnRoad(test::DrivenTracks& scene) {
    scene.follow(straight({20, 60}, 0, 36, 12));
    scene.follow(straight({20, 63}, 0, 36, 12), 20);
    scene.follow(straight({140, 56.5}, 180, 36, 12), 10);
    scene.follow(straight({20, 60}, 0, 36, 12), 200, 11);
    scene.follow(straight({20, 60}, 0, 36, 12), 600);
    scene.follow(straight({20, 60}, 0, 14, 25), 300);
    scene.follow(straight({80, 20}, 90, 36, 8), 100);
    scene.follow(straight({20, 100}, 0, 36, 12), 100);
}

}  // namespace

TEST(TrackLikeness, SameLaneAndDirectionCountBeforeTheNextLaneAndTheOppositeOne) {
    for (const auto& camera : {test::DrivenTracks::standing(0.2), test::DrivenTracks::moving(0.2)}) {
        test::DrivenTracks scene;
        scene.camera = camera;
        driveOnRoad(scene);
        const std::vector<TrackLikeness> found = likeFirst(runWith(scene));
        ASSERT_EQ(found.size(), 7U) << "all but the one itself";
        EXPECT_EQ(found[0].track, 5);
        EXPECT_GT(found[0].likeness, 0.9) << "the moment does not matter";
        EXPECT_EQ(found[1].track, 2);
        EXPECT_NEAR(of(2, found).path, 0.6, 0.08) << "exp(-1/2) one lane of 3 m beside it";
        for (const TrackId elsewhere : {3, 7, 8}) {
            EXPECT_LT(of(elsewhere, found).path, 0.05) << elsewhere;
            EXPECT_LT(of(elsewhere, found).likeness, 0.25) << elsewhere;
            EXPECT_GT(of(elsewhere, found).speed, 0.9) << elsewhere;
        }
        EXPECT_GT(of(4, found).path, 0.9) << "the lorry drives where the car does";
        EXPECT_GT(of(4, found).speed, 0.9);
        EXPECT_LT(of(4, found).size, 0.05);
        EXPECT_LT(of(4, found).likeness, of(2, found).likeness);
        EXPECT_GT(of(6, found).path, 0.85);
        EXPECT_NEAR(of(6, found).speed, std::exp(-0.5 * std::pow(std::log(11 / (14 / 3.6 + 1)) / 0.4, 2)), 0.05);
    }
}

TEST(TrackLikeness, IsTheSameSeenFromEither) {
    test::DrivenTracks scene;
    driveOnRoad(scene);
    const StoredTracks run = runWith(scene);
    const GroundStretches ground(run.footage);
    for (const TrackId other : {2, 3, 4, 5, 6, 7, 8}) {
        const TrackLikeness there = of(other, tracksLike(run, ground, 1));
        const TrackLikeness back = of(1, tracksLike(run, ground, other));
        EXPECT_NEAR(there.path, back.path, 1e-9) << other;
        EXPECT_NEAR(there.speed, back.speed, 1e-9) << other;
        EXPECT_NEAR(there.size, back.size, 1e-9) << other;
    }
}

TEST(TrackLikeness, ToleratesOtherBeginningsAndLengthsAndWaitingOnTheWay) {
    test::DrivenTracks scene;
    scene.follow(straight({20, 60}, 0, 36, 12));       // 120 m
    scene.follow(straight({50, 60}, 0, 36, 6), 300);   // 60 m of it
    scene.follow(straight({100, 60}, 0, 36, 9), 100);  // begins 80 m on and goes further
    auto waits = straight({20, 60}, 0, 36, 6);
    waits.insert(waits.end(), 250, waits.back());
    const auto on = straight(waits.back().first, 0, 36, 6);
    waits.insert(waits.end(), on.begin(), on.end());
    scene.follow(waits, 100);
    for (auto& pose : waits) pose.first.y += 40;
    scene.follow(waits, 100);
    const std::vector<TrackLikeness> found = likeFirst(runWith(scene));
    EXPECT_NEAR(of(2, found).path, std::pow(0.5, 0.25), 0.03);
    EXPECT_NEAR(of(3, found).path, std::pow(40.0 / 120, 0.25), 0.04);
    EXPECT_GT(of(4, found).likeness, 0.85) << "a red light on the way";
    EXPECT_GT(of(5, found).speed, 0.9) << "nor does it count elsewhere";
}

TEST(TrackLikeness, WhoTurnsOffDroveOnlyTheFirstPartOfIt) {
    test::DrivenTracks scene;
    scene.follow(straight({20, 60}, 0, 36, 12));
    auto turns = straight({20, 60}, 0, 36, 6);
    const auto aside = straight(turns.back().first, -90, 36, 6);
    turns.insert(turns.end(), aside.begin(), aside.end());
    scene.follow(turns, 200);
    EXPECT_NEAR(likeFirst(runWith(scene)).front().path, 0.5, 0.06);
}

TEST(TrackLikeness, WhatStandsIsLikeWhatStandsBesideIt) {
    test::DrivenTracks scene;
    scene.drive({60, 60}, 0, {{20, 0, 0}});
    scene.drive({62, 60}, 0, {{20, 0, 0}}, 400);
    scene.drive({90, 60}, 0, {{20, 0, 0}});
    scene.follow(straight({20, 60}, 0, 36, 12));
    const std::vector<TrackLikeness> found = likeFirst(runWith(scene));
    EXPECT_EQ(found[0].track, 2);
    EXPECT_NEAR(of(2, found).path, std::exp(-0.5 * 4 / 9), 0.03);
    EXPECT_LT(of(3, found).path, 0.01);
    EXPECT_EQ(of(4, found).path, 0) << "one that drives past";
}

TEST(TrackLikeness, WithoutAScaleVehiclesAreTheMeasure) {
    test::DrivenTracks scene;
    driveOnRoad(scene);
    StoredTracks run = runWith(scene);
    const std::vector<TrackLikeness> in_metres = likeFirst(run);
    run.footage.scale.gsd_known = false;
    run.footage.scale.gsd_m_per_px = SceneScale().gsd_m_per_px;  // what a run assumes that knows none
    const std::vector<TrackLikeness> in_vehicles = likeFirst(run);
    EXPECT_EQ(orderOf(in_vehicles)[0], 5);
    EXPECT_NEAR(of(2, in_vehicles).path, of(2, in_metres).path, 0.03);
    EXPECT_NEAR(of(6, in_vehicles).speed, of(6, in_metres).speed, 0.03);
}

TEST(TrackLikeness, AKnownScaleHoldsWhateverDrives) {
    test::DrivenTracks scene;
    scene.follow(straight({20, 60}, 0, 36, 12), 0, 11);
    scene.follow(straight({20, 63}, 0, 36, 12), 100, 11);
    EXPECT_NEAR(likeFirst(runWith(scene)).front().path, std::exp(-0.5), 0.03) << "lorries on lanes of 3 m";
}

TEST(TrackLikeness, WhoNeverMetIsComparedByTheSpeedsOfWholeDrives) {
    test::DrivenTracks scene;
    scene.follow(straight({20, 60}, 0, 36, 12));
    scene.follow(straight({20, 100}, 0, 18, 12));
    EXPECT_NEAR(likeFirst(runWith(scene)).front().speed, std::exp(-0.5 * std::pow(std::log(11 / 6.0) / 0.4, 2)), 0.03);
}

TEST(TrackLikeness, PicturesMayBeFewAndTakenAnywhereOnTheWay) {
    test::DrivenTracks scene;
    scene.scale.frame_rate_hz = 1;
    scene.frames = 30;
    scene.noise_px = 0;
    const auto speedsUp = [](double from_s) {
        std::vector<std::pair<cv::Point2d, double>> poses;
        for (double t = from_s; t <= 6.5; t += 1) poses.emplace_back(cv::Point2d(20 + 3 * t + 2 * t * t, 60), 0);
        return poses;
    };
    scene.follow(speedsUp(0));
    scene.follow(speedsUp(0.5), 10);
    const TrackLikeness found = likeFirst(runWith(scene)).front();
    EXPECT_GT(found.path, 0.95);
    EXPECT_GT(found.speed, 0.95);
}

TEST(TrackLikeness, NothingIsToldAcrossGroundsThatDoNotConnect) {
    test::DrivenTracks scene;
    scene.follow(straight({20, 60}, 0, 36, 12));
    scene.follow(straight({20, 60}, 0, 36, 12), 600);
    StoredTracks run = runWith(scene);
    std::vector<Homography> steps;
    for (int frame = 1; frame < scene.frames; ++frame) {
        Homography step;
        step.from_frame = frame - 1;
        step.to_frame = frame;
        if (frame != 500) steps.push_back(step);
    }
    run.footage.camera = CameraMotion(steps);
    const std::vector<TrackLikeness> found = likeFirst(run);
    EXPECT_EQ(of(2, found).path, 0);
    EXPECT_GT(of(2, found).speed, 0.9);
}

TEST(TrackLikeness, TracksThatAreNotThereAndShortOnesAreNoTrouble) {
    test::DrivenTracks scene;
    driveOnRoad(scene);
    scene.follow(straight({30, 60}, 0, 36, 0.04));
    StoredTracks run = runWith(scene);
    try {
        tracksLike(run, GroundStretches(run.footage), 99);
        FAIL() << "there is no track 99";
    } catch (const Error& error) {
        EXPECT_EQ(error.kind(), ErrorKind::parameter);
        EXPECT_NE(std::string(error.what()).find("99"), std::string::npos);
    }
    for (const TrackLikeness& each : tracksLike(run, GroundStretches(run.footage), 9)) {
        EXPECT_GE(each.likeness, 0);
        EXPECT_LE(each.likeness, 1);
    }
    run.tracks.resize(1);
    EXPECT_TRUE(likeFirst(run).empty());
}

}  // namespace eyrie::track_likeness_test
