#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "events/driven_tracks.h"

namespace eyrie::one_vehicle_test {
namespace {

using test::DrivenTracks;
using test::Leg;
using test::tracksOf;
using testing::ElementsAre;
using testing::IsEmpty;

/// Brakes at 3 m/s² from 36 km/h, stands for ten seconds, drives off.
const std::vector<Leg> kStopAndGo = {{4, 36, 36}, {3.33, 36, 0}, {10, 0, 0}, {3.33, 0, 36}, {4, 36, 36}};

}  // namespace

TEST(BorderEvents, AVehicleThatDrivesThroughAppearsAndLeavesAndIsNotLost) {
    DrivenTracks scene;
    scene.drive({-20, 60}, 0, {{30, 50, 50}}, 50);
    EXPECT_THAT(tracksOf(scene.events(EventKind::appears)), ElementsAre(1));
    EXPECT_THAT(tracksOf(scene.events(EventKind::leaves)), ElementsAre(1));
    EXPECT_THAT(scene.events(EventKind::lost), IsEmpty());
    const Event event = scene.events(EventKind::leaves).front();
    EXPECT_NEAR(event.figure, 50, 3);
    EXPECT_EQ(event.unit, FigureUnit::km_per_hour);
    EXPECT_NEAR(scene.placeOf(event).x, 200, 1);
    EXPECT_NEAR(scene.placeOf(event).y, 60, 0.5);
    EXPECT_NEAR(event.first_frame, 50 + 220 / (50 / 3.6) * 25, 2);
}

TEST(EventScale, SpeedsAndLengthsAreThoseOfThePlaceInAnObliqueView) {
    DrivenTracks scene;
    scene.scale.slope = ScaleSlope::ofPicture(scene.size, 0, 0.002);
    const double far = scene.scale.slope.factorAt({500, 100});  // a metre there has fewer pixels
    const double near = scene.scale.slope.factorAt({500, 500});
    ASSERT_LT(far, 0.7);
    ASSERT_GT(near, 1.3);
    scene.drive({-20, 20}, 0, {{30, 50, 50}}, 50);
    scene.drive({-20, 100}, 0, {{30, 50, 50}}, 50);
    const auto leaving = scene.events(EventKind::leaves);
    ASSERT_EQ(leaving.size(), 2U);
    for (const Event& event : leaving) EXPECT_NEAR(event.figure, 50 / (event.tracks.front() == 1 ? far : near), 4);
    // What is over a limit there need not be so here.
    EventOptions limits;
    limits.over_kmh = 60;
    std::set<TrackId> over;
    for (const Event& event : findEvents(scene.tracks, scene.footage(), limits))
        if (event.kind == EventKind::over_speed) over.insert(event.tracks.front());
    EXPECT_EQ(over, (std::set<TrackId>{1}));
    // Where no scale is known, figures are in pixels as they are seen.
    scene.scale.gsd_known = false;
    for (const Event& event : scene.events(EventKind::leaves)) EXPECT_NEAR(event.figure, 50 / 3.6 / 0.2 / 25, 0.2);
}

TEST(BorderEvents, ATrackThatEndsInMidPictureIsLost) {
    DrivenTracks scene;
    scene.drive({20, 60}, 0, {{30, 50, 50}}, 50);
    scene.cutAfter(6);
    EXPECT_THAT(tracksOf(scene.events(EventKind::lost)), ElementsAre(1));
    EXPECT_THAT(scene.events(EventKind::leaves), IsEmpty());
    EXPECT_NEAR(scene.placeOf(scene.events(EventKind::lost).front()).x, 20 + 50 / 3.6 * 6, 1);
    EXPECT_NEAR(scene.events(EventKind::lost).front().figure, 50, 3);
}

TEST(BorderEvents, WhoIsThereFromBeginningToEndNeitherAppearsNorGetsLost) {
    DrivenTracks scene;
    scene.frames = 200;
    scene.drive({40, 60}, 0, {{7.9, 36, 36}}, 2);
    scene.drive({40, 40}, 0, {{30, 36, 36}});
    EXPECT_THAT(scene.events(), IsEmpty());
}

TEST(BorderEvents, NobodyIsLostWhereTheRegistrationBreaks) {
    DrivenTracks scene;
    scene.drive({40, 60}, 0, {{30, 20, 20}});
    scene.cutAfter(8);
    Footage footage = scene.footage();
    std::vector<Homography> steps;
    for (int frame = 1; frame < scene.frames; ++frame) {
        Homography step;
        step.from_frame = frame - 1;
        step.to_frame = frame;
        if (frame != 200) steps.push_back(step);
    }
    ASSERT_EQ(scene.events(EventKind::lost).size(), 1U);
    footage.camera = CameraMotion(steps);
    EXPECT_THAT(findEvents(scene.tracks, footage), IsEmpty());
}

TEST(TrackSpeeds, TheLowestAndTheHighestAreThoseOfTheDrive) {
    DrivenTracks scene;
    scene.drive({20, 60}, 0, kStopAndGo);
    scene.drive({10, 40}, 0, {{3, 30, 30}, {5, 30, 60}, {2, 60, 60}});
    scene.drive({10, 20}, 0, {{0.2, 30, 30}});  // too short to tell
    const TrackFindings found = searchTracks(scene.tracks, scene.footage());
    EXPECT_EQ(found.events.size(), scene.events().size());
    ASSERT_EQ(found.speeds.size(), 2U);
    EXPECT_EQ(found.speeds.at(1).lowest, 0) << "noise is no motion";
    EXPECT_NEAR(found.speeds.at(1).highest * 3.6, 36, 3);
    EXPECT_NEAR(found.speeds.at(2).lowest * 3.6, 30, 3);
    EXPECT_NEAR(found.speeds.at(2).highest * 3.6, 60, 3);
}

TEST(TrackSpeeds, ThoseOfAnEventAreTakenWhileItLasts) {
    DrivenTracks scene;
    scene.drive({20, 60}, 0, kStopAndGo);
    const TrackFindings found = searchTracks(scene.tracks, scene.footage());
    ASSERT_EQ(found.event_speeds.size(), found.events.size());
    int stands = 0;
    for (std::size_t i = 0; i < found.events.size(); ++i) {
        const Event& event = found.events[i];
        ASSERT_TRUE(found.event_speeds[i]) << nameOf(event.kind);
        EXPECT_LE(found.event_speeds[i]->lowest, found.event_speeds[i]->highest);
        if (event.kind != EventKind::stands) continue;
        ++stands;
        EXPECT_EQ(found.event_speeds[i]->lowest, 0);
        EXPECT_LT(found.event_speeds[i]->highest * 3.6, 10) << "that it drove before and after does not count";
    }
    EXPECT_EQ(stands, 1);

    DrivenTracks brief;
    brief.drive({10, 20}, 0, {{0.2, 30, 30}});
    for (const auto& speeds : searchTracks(brief.tracks, brief.footage()).event_speeds) EXPECT_FALSE(speeds);
}

TEST(Standstills, AStopAStandAndAStartAreFoundWhereTheyAre) {
    DrivenTracks scene;
    scene.drive({20, 60}, 0, kStopAndGo);
    const auto stops = scene.events(EventKind::stops);
    const auto stands = scene.events(EventKind::stands);
    const auto starts = scene.events(EventKind::starts);
    ASSERT_THAT(tracksOf(stops), ElementsAre(1));
    ASSERT_THAT(tracksOf(stands), ElementsAre(1));
    ASSERT_THAT(tracksOf(starts), ElementsAre(1));
    EXPECT_NEAR(stops[0].frame, 7.33 * 25, 12);  // half the time over which speeds are taken
    EXPECT_NEAR(starts[0].frame, 17.33 * 25, 12);
    EXPECT_NEAR(stands[0].figure, 10, 0.8);
    EXPECT_EQ(stands[0].unit, FigureUnit::seconds);
    EXPECT_GT(stops[0].figure, 20);
    EXPECT_GT(starts[0].figure, 20);
    EXPECT_NEAR(scene.placeOf(stops[0]).x, 20 + 40 + 16.7, 1);
    EXPECT_LT(stops[0].frame, stands[0].frame);
    EXPECT_LT(stands[0].frame, starts[0].frame);
}

TEST(Standstills, ATrackThatIsLostInAStandstillNeedsToShowLessOfIt) {
    DrivenTracks scene;
    scene.noise_px = 0;
    scene.drive({20, 60}, 0, {{4, 36, 36}, {3.33, 36, 0}, {0.8, 0, 0}});
    const auto stops = scene.events(EventKind::stops);
    ASSERT_THAT(tracksOf(stops), ElementsAre(1));
    EXPECT_THAT(tracksOf(scene.events(EventKind::lost)), ElementsAre(1));
    scene.tracks[0].seen_until = stops[0].frame - 2;
    EXPECT_THAT(scene.events(EventKind::stops), ::testing::SizeIs(1));
    scene.tracks[0].seen_until = stops[0].frame - 3;
    EXPECT_THAT(scene.events(EventKind::stops), IsEmpty()) << "what came to rest is its prediction";
    scene.tracks[0].seen_until = kLastFrame;
    scene.frames = scene.tracks[0].boxes.back().frame + 1;
    EXPECT_THAT(scene.events(EventKind::stops), IsEmpty()) << "it is not lost, the video is over";
}

TEST(Standstills, ATenthOfASecondMayPassUnseenBeforeOneThatIsLost) {
    // At ten frames a second that is one frame just so.
    DrivenTracks scene;
    scene.noise_px = 0;
    scene.scale.frame_rate_hz = 10;
    scene.drive({20, 60}, 0, {{4, 36, 36}, {3.3, 36, 0}, {0.8, 0, 0}});
    const auto stops = scene.events(EventKind::stops);
    ASSERT_THAT(tracksOf(stops), ElementsAre(1));
    scene.tracks[0].seen_until = stops[0].frame - 1;
    EXPECT_THAT(scene.events(EventKind::stops), ::testing::SizeIs(1));
    scene.tracks[0].seen_until = stops[0].frame - 2;
    EXPECT_THAT(scene.events(EventKind::stops), IsEmpty());
}

TEST(Standstills, APauseAndBrakingAreNone) {
    DrivenTracks scene;
    scene.noise_px = 0;
    scene.drive({20, 60}, 0, {{4, 36, 36}, {3.33, 36, 0}, {0.4, 0, 0}, {3.33, 0, 36}});
    scene.drive({20, 90}, 0, {{4, 36, 36}, {3, 36, 4}});  // it is lost while it brakes
    EXPECT_THAT(scene.events(EventKind::stops), IsEmpty());
}

TEST(Standstills, SlowDrivingIsNone) {
    DrivenTracks scene;
    scene.drive({20, 60}, 0, {{4, 36, 36}, {3, 36, 5}, {6, 5, 5}, {3, 5, 36}, {4, 36, 36}});
    EXPECT_THAT(scene.events(EventKind::stops), IsEmpty());
    EXPECT_THAT(scene.events(EventKind::starts), IsEmpty());
    EXPECT_THAT(scene.events(EventKind::stands), IsEmpty());
}

TEST(Standstills, NoiseStartsNobody) {
    DrivenTracks scene;
    scene.noise_px = 0.6;
    for (int i = 0; i < 20; ++i) scene.drive({20.0 + 8 * i, 60}, 0, {{40, 0, 0}});
    EXPECT_THAT(scene.events(EventKind::starts), IsEmpty());
    EXPECT_EQ(scene.events(EventKind::stands).size(), 20U);
    scene.scale.gsd_m_per_px = 2;  // the same boxes seen from far away: noise is ten times as fast
    EXPECT_THAT(scene.events(EventKind::starts), IsEmpty());
}

TEST(TurnBacks, AUTurnIsOneAndABendIsNone) {
    DrivenTracks scene;
    const TrackId turned = scene.drive({40, 30}, 0, {{5, 30, 30}, {6, 15, 15, 30}, {5, 30, 30}});
    scene.drive({40, 60}, 0, {{5, 30, 30}, {4, 15, 15, 22.5}, {5, 30, 30}});
    scene.drive({40, 100}, 0, {{5, 30, 30}, {4, 15, 15, -22.5}, {5, 30, 30}});
    const auto events = scene.events(EventKind::turns_back);
    ASSERT_THAT(tracksOf(events), ElementsAre(turned));
    EXPECT_GE(events[0].figure, 150);
    // Furthest along its first way in the middle of the turn.
    EXPECT_NEAR(events[0].frame, (5 + 3) * 25, 20);
    EXPECT_NEAR(scene.placeOf(events[0]).x, 40 + 30 / 3.6 * 5 + 15 / 3.6 / radiansFromDegrees(30), 2);
    EXPECT_GT(scene.placeOf(events[0]).y, 30) << "it turned to the right";
}

TEST(TurnBacks, StoppingAndReversingIsOneToo) {
    DrivenTracks scene;
    scene.drive({40, 30}, 0, {{5, 30, 30}, {3, 30, 0}, {4, 0, 0}, {3, 0, -20}, {5, -20, -20}});
    const auto events = scene.events(EventKind::turns_back);
    ASSERT_EQ(events.size(), 1U);
    EXPECT_GT(events[0].figure, 170);
}

TEST(TurnBacks, AWideLoopIsNone) {
    DrivenTracks scene;
    scene.drive({60, 15}, 0, {{3, 40, 40}, {16, 40, 40, 16.9}, {3, 40, 40}});  // radius 38 m, all but a circle
    EXPECT_THAT(scene.events(EventKind::turns_back), IsEmpty());
}

TEST(Speeds, OverAndUnderALimit) {
    DrivenTracks scene;
    EventOptions options;
    options.over_kmh = 60;
    const TrackId fast = scene.drive({10, 30}, 0, {{3, 50, 50}, {2, 50, 72}, {3, 72, 72}, {2, 72, 50}});
    const TrackId steady = scene.drive({10, 60}, 0, {{10, 55, 55}});
    const TrackId slow = scene.drive({10, 90}, 0, {{3, 40, 40}, {2, 40, 9}, {9, 9, 9}, {2, 9, 40}});
    const auto over = scene.events(EventKind::over_speed, options);
    ASSERT_THAT(tracksOf(over), ElementsAre(fast));
    EXPECT_NEAR(over[0].figure, 72, 3);
    EXPECT_NEAR(over[0].first_frame, 25 * (3 + 2 * 10 / 22.0), 15);
    const auto under = scene.events(EventKind::under_speed, options);
    ASSERT_THAT(tracksOf(under), ElementsAre(slow));
    EXPECT_NEAR(under[0].figure, 9, 1.5);
    EXPECT_GT(under[0].last_frame - under[0].first_frame, 9 * 25 - 10);
    (void)steady;
}

TEST(Speeds, ArePixelsAFrameWhereTheScaleIsNotKnown) {
    DrivenTracks scene;
    scene.scale.gsd_known = false;
    scene.drive({-20, 60}, 0, {{30, 45, 45}}, 50);
    const Event event = scene.events(EventKind::leaves).front();
    EXPECT_EQ(event.unit, FigureUnit::px_per_frame);
    EXPECT_NEAR(event.figure, 45 / 3.6 / 0.2 / 25, 0.15);
    EXPECT_EQ(scene.events(EventKind::appears).front().unit, FigureUnit::px);
}

TEST(Loitering, DrivingAboutInOnePlace) {
    DrivenTracks scene;
    scene.frames = 2500;
    const TrackId circling = scene.drive({60, 60}, 0, {{90, 18, 18, 20}});  // circles of 14 m radius
    scene.drive({20, 20}, 0, {{90, 3.5, 3.5}});                             // crawls away
    scene.drive({120, 100}, 0, {{90, 0, 0}});                               // stands
    const auto events = scene.events(EventKind::loiters);
    ASSERT_THAT(tracksOf(events), ElementsAre(circling));
    EXPECT_NEAR(events[0].figure, 90, 2);
}

}  // namespace eyrie::one_vehicle_test
