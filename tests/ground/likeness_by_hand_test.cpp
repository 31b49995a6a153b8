/// Likeness of tracks where no scale is known and where the view is oblique, worked out by hand.
#include <gtest/gtest.h>

#include <cmath>

#include "events/driven_tracks.h"
#include "ground/track_likeness.h"

namespace eyrie::likeness_by_hand_test {
namespace {

double bellOf(double deviations) {
    return std::exp(-0.5 * deviations * deviations);
}

/// Pixels per metre grow downwards: half as many as in the middle in the row 49.5, half as many again in 549.5.
ScaleSlope slopeOf(const test::DrivenTracks& scene) {
    return ScaleSlope::ofPicture(scene.size, 0, 1.0 / 500);
}

/// A run of a standing camera, 0.2 m/px in the middle of the picture; with a slope boxes are as large as it shows them.
StoredTracks runOf(const test::DrivenTracks& scene, bool oblique) {
    StoredTracks run;
    run.tracks = scene.tracks;
    run.footage = scene.footage();
    if (!oblique) return run;
    run.footage.scale.slope = slopeOf(scene);
    for (EventTrack& track : run.tracks) {
        for (TrackedBox& each : track.boxes)
            each.box = each.box.scaled(run.footage.scale.slope.factorAt(each.box.centre),
                                       run.footage.scale.slope.factorAt(each.box.centre));
    }
    return run;
}

test::DrivenTracks sceneWithoutNoise() {
    test::DrivenTracks scene;
    scene.noise_px = 0;
    return scene;
}

double metresOfRow(double row) {
    return 0.2 * row;
}

std::vector<TrackLikeness> likeFirst(const StoredTracks& run) {
    return tracksLike(run, GroundStretches(run.footage), 1);
}

}  // namespace

TEST(LikenessByHand, WhereNoScaleIsKnownTheMedianVehicleIsAsLongAsACar) {
    test::DrivenTracks scene = sceneWithoutNoise();
    scene.drive({20, 60}, 0, {{12, 36, 36}});
    scene.drive({23.3, 61}, 0, {{5, 36, 36}});
    scene.drive({50, 58}, 10, {{9, 18, 54}});
    scene.drive({30, 20}, 90, {{4, 30, 30}, {6, 30, 30, -15}});
    scene.drive({60, 63}, 0, {{1, 30, 30}, {6, 0, 0}, {4, 60, 60}});
    for (const bool oblique : {false, true}) {
        StoredTracks run = runOf(scene, oblique);
        const std::vector<TrackLikeness> by_scale = likeFirst(run);
        run.footage.scale.gsd_known = false;
        run.footage.scale.gsd_m_per_px = SceneScale().gsd_m_per_px;  // 0.25: a car seems 5.6 m long
        const std::vector<TrackLikeness> by_vehicles = likeFirst(run);
        ASSERT_EQ(by_vehicles.size(), by_scale.size());
        for (std::size_t i = 0; i < by_scale.size(); ++i) {
            EXPECT_EQ(by_vehicles[i].track, by_scale[i].track);
            EXPECT_NEAR(by_vehicles[i].path, by_scale[i].path, 1e-6) << by_scale[i].track;
            EXPECT_NEAR(by_vehicles[i].speed, by_scale[i].speed, 1e-6) << by_scale[i].track;
            EXPECT_NEAR(by_vehicles[i].size, by_scale[i].size, 1e-9) << by_scale[i].track;
        }
    }
}

TEST(LikenessByHand, InAnObliqueViewLanesAreAsWideAsTheScaleOfTheirPlaceSays) {
    // 15 px lie between them everywhere.
    for (const double row : {49.5, 299.5, 549.5}) {
        test::DrivenTracks scene = sceneWithoutNoise();
        scene.drive({20, metresOfRow(row)}, 0, {{12, 36, 36}});
        scene.drive({20, metresOfRow(row + 15)}, 0, {{12, 36, 36}});
        const ScaleSlope slope = slopeOf(scene);
        const double from_first = 3 / slope.factorAt({0, row}), from_second = 3 / slope.factorAt({0, row + 15});
        const TrackLikeness found = likeFirst(runOf(scene, true)).at(0);
        EXPECT_NEAR(found.path, (bellOf(from_first / 3) + bellOf(from_second / 3)) / 2, 5e-3) << row;
        EXPECT_NEAR(found.size, 1, 1e-9) << "what is nearer is no larger";
    }
}

TEST(LikenessByHand, InAnObliqueViewWhatStandsIsAsFarApartAsTheScaleOfItsPlaceSays) {
    for (const double row : {49.5, 299.5, 549.5}) {
        test::DrivenTracks scene = sceneWithoutNoise();
        scene.drive({60, metresOfRow(row)}, 0, {{12, 0, 0}});
        scene.drive({62, metresOfRow(row)}, 0, {{12, 0, 0}});
        const double metres = 2 / slopeOf(scene).factorAt({0, row});
        EXPECT_NEAR(likeFirst(runOf(scene, true)).at(0).path, bellOf(metres / 3), 1e-6) << row;
    }
}

TEST(LikenessByHand, InAnObliqueViewSpeedsAreThoseOfThePlace) {
    // Side by side, 10 and 5 m/s in the middle of the picture; twice as fast where a pixel is twice as long.
    for (const double row : {49.5, 299.5, 549.5}) {
        test::DrivenTracks scene = sceneWithoutNoise();
        scene.drive({20, metresOfRow(row)}, 0, {{12, 36, 36}});
        scene.drive({20, metresOfRow(row)}, 0, {{24, 18, 18}});
        const double by_place = 1 / slopeOf(scene).factorAt({0, row});
        EXPECT_NEAR(likeFirst(runOf(scene, true)).at(0).speed,
                    bellOf(std::log((10 * by_place + 1) / (5 * by_place + 1)) / 0.4), 1e-4)
            << row;
    }
}

TEST(LikenessByHand, WhoNeverMetIsComparedByTheSpeedsOfTheirPlaces) {
    // Far above 10 m/s in the middle's measure, where a pixel is twice as long; below it 20: both drive 20 m/s.
    test::DrivenTracks scene = sceneWithoutNoise();
    scene.drive({20, metresOfRow(49.5)}, 0, {{12, 36, 36}});
    scene.drive({20, metresOfRow(299.5)}, 0, {{6, 72, 72}});
    const TrackLikeness found = likeFirst(runOf(scene, true)).at(0);
    EXPECT_EQ(found.path, 0);
    EXPECT_NEAR(found.speed, 1, 1e-3);
}

TEST(LikenessByHand, TwoPicturesTellASpeedToo) {
    for (const double row : {49.5, 299.5, 549.5}) {
        test::DrivenTracks scene = sceneWithoutNoise();
        scene.scale.frame_rate_hz = 1;
        scene.frames = 20;
        scene.follow({{{20, metresOfRow(row)}, 0}, {{30, metresOfRow(row)}, 0}});
        scene.follow({{{20, metresOfRow(row)}, 0}, {{40, metresOfRow(row)}, 0}}, 5);
        const double by_place = 1 / slopeOf(scene).factorAt({0, row});
        EXPECT_NEAR(likeFirst(runOf(scene, true)).at(0).speed,
                    bellOf(std::log((20 * by_place + 1) / (10 * by_place + 1)) / 0.4), 1e-6)
            << row;
    }
}

}  // namespace eyrie::likeness_by_hand_test
