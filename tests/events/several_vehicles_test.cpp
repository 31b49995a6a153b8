#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "events/driven_tracks.h"

namespace eyrie::several_vehicles_test {
namespace {

using test::DrivenTracks;
using test::Leg;
using test::tracksOf;
using testing::ElementsAre;
using testing::IsEmpty;

/// Two lanes, 3.5 m apart: to the right on y = 62, to the left on y = 58.5; a car every two seconds.
void addTwoLanes(DrivenTracks& scene) {
    for (int i = 0; i < 18; ++i) {
        scene.drive({-10, 62}, 0, {{40, 45, 45}}, 40 * i);
        scene.drive({210, 58.5}, 180, {{40, 50, 50}}, 40 * i + 13);
    }
}

}  // namespace

TEST(Flow, TwoLanesSideBySideAreNotAgainstEachOther) {
    DrivenTracks scene;
    addTwoLanes(scene);
    EXPECT_THAT(scene.events(EventKind::against_flow), IsEmpty());
    EXPECT_THAT(scene.events(EventKind::leaves_flow), IsEmpty());
}

TEST(Flow, TheWrongWayDriverIsFoundAndTheOthersAreNot) {
    DrivenTracks scene;
    addTwoLanes(scene);
    const TrackId wrong = scene.drive({-10, 58.5}, 0, {{40, 40, 40}}, 300);
    const auto events = scene.events(EventKind::against_flow);
    ASSERT_THAT(tracksOf(events), ElementsAre(wrong));
    EXPECT_GT(events[0].figure, 150);
    EXPECT_NEAR(scene.placeOf(events[0]).x, 100, 15);
    EXPECT_NEAR(scene.placeOf(events[0]).y, 58.5, 0.5);
}

TEST(Flow, ChangingToTheWrongLaneIsFoundWhereItHappens) {
    DrivenTracks scene;
    addTwoLanes(scene);
    // 3.5 m to the left in three seconds, there for five, and back.
    const TrackId overtaking = scene.drive({-10, 62}, 0,
                                           {{4, 45, 45},
                                            {1.5, 45, 45, -7.1},
                                            {1.5, 45, 45, 7.1},
                                            {4, 45, 45},
                                            {1.5, 45, 45, 7.1},
                                            {1.5, 45, 45, -7.1},
                                            {10, 45, 45}},
                                           305);
    const auto events = scene.events(EventKind::against_flow);
    ASSERT_THAT(tracksOf(events), ElementsAre(overtaking));
    EXPECT_NEAR(events[0].frame, 305 + 25 * (4 + 3 + 2), 25);
}

TEST(Flow, AMomentOfWhichNothingIsKnownPartsNoDriveInTwo) {
    // All others were lost in the middle of the picture, and found again behind it.
    const auto driveAgainst = [](double unknown_m) {
        DrivenTracks scene;
        for (int i = 0; i < 8; ++i) {
            scene.drive({199, 60}, 180, {{12, 50, 50}}, 40 * i);
            scene.cutAfter((99 - unknown_m / 2) / (50 / 3.6));
            scene.drive({100 - unknown_m / 2, 60}, 180, {{12, 50, 50}}, 40 * i + 200);
        }
        scene.drive({-10, 60}, 0, {{40, 40, 40}}, 300);
        EventOptions options;
        options.off_flow_m = 15;  // nobody is off it
        return scene.events(EventKind::against_flow, options).size();
    };
    EXPECT_EQ(driveAgainst(9), 1U) << "half a second";
    EXPECT_EQ(driveAgainst(26), 2U) << "two seconds";
}

TEST(Flow, NothingIsToldWhereTooFewDrive) {
    DrivenTracks scene;
    for (int i = 0; i < 4; ++i) scene.drive({-10, 62}, 0, {{40, 45, 45}}, 40 * i);
    scene.drive({210, 62}, 180, {{40, 45, 45}}, 400);
    EXPECT_THAT(scene.events(EventKind::against_flow), IsEmpty());
}

TEST(Flow, WhoTurnsOffToWhereNobodyDrivesLeavesIt) {
    DrivenTracks scene;
    addTwoLanes(scene);
    // A bend to the right after 80 m, on into the field.
    const TrackId leaving = scene.drive({-10, 62}, 0, {{7.2, 45, 45}, {3, 25, 25, 25}, {6, 25, 25}}, 310);
    const auto events = scene.events(EventKind::leaves_flow);
    ASSERT_THAT(tracksOf(events), ElementsAre(leaving));
    EXPECT_GT(scene.placeOf(events[0]).y, 66);
    EXPECT_LT(scene.placeOf(events[0]).y, 75);
    EXPECT_GT(events[0].figure, 30);
}

TEST(Flow, WhoTurnsOffIsFoundInVideoOfAFrameASecondToo) {
    DrivenTracks scene;
    scene.noise_px = 0;
    scene.scale.frame_rate_hz = 1;
    scene.frames = 60;
    for (int i = 0; i < 8; ++i) scene.drive({-10, 50}, 0, {{40, 18, 18}}, i);
    const TrackId leaving = scene.drive({-10, 50}, 0, {{16, 18, 18}, {4, 18, 18, 22.5}, {8, 18, 18}}, 10);
    EXPECT_THAT(tracksOf(scene.events(EventKind::leaves_flow)), ElementsAre(leaving));
}

TEST(Flow, WhoDrivesOnWhereOthersWereLostDoesNotLeaveIt) {
    DrivenTracks scene;
    for (int i = 0; i < 10; ++i) {
        scene.drive({-10, 62}, 0, {{40, 45, 45}}, 40 * i);
        scene.cutAfter(8);
    }
    scene.drive({-10, 62}, 0, {{40, 45, 45}}, 450);
    EXPECT_THAT(scene.events(EventKind::leaves_flow), IsEmpty());
}

TEST(Convoys, ThreeAtSteadyDistanceAreOneAndOverlappingTrafficIsNot) {
    DrivenTracks scene;
    scene.frames = 900;
    // One after the other along the same way, round a corner.
    for (int i = 0; i < 4; ++i) scene.drive({40, 30}, 0, {{8, 20, 20}, {6, 20, 20, 15}, {16, 15, 15}}, 75 * i);
    // Faster and faster ones behind each other, on another road.
    for (int i = 0; i < 4; ++i) scene.drive({60.0 - 18 * i, 100}, 0, {{40, 8 + 6.0 * i, 8 + 6.0 * i}}, 0);
    const auto events = scene.events(EventKind::convoy);
    ASSERT_EQ(events.size(), 1U);
    EXPECT_THAT(events[0].tracks, ElementsAre(1, 2, 3, 4));
    EXPECT_EQ(events[0].figure, 4);
    EXPECT_GT(events[0].last_frame - events[0].first_frame, 15 * 25);
}

TEST(Convoys, LastAsLongAsTheLastSeenPassesWhereTheOneBeforeWas) {
    // 18 m are 81 frames. Looked up every 13 frames: in frame 546 its way ends 0.7 m before that place, in 559 3.6 m.
    DrivenTracks scene;
    scene.noise_px = 0;
    for (int i = 0; i < 3; ++i) scene.drive({50.0 - 18 * i, 40}, 0, {{25, 20, 20}});
    const auto events = scene.events(EventKind::convoy);
    ASSERT_EQ(events.size(), 1U);
    EXPECT_THAT(events[0].tracks, ElementsAre(1, 2, 3));
    EXPECT_EQ(events[0].first_frame, 0);
    EXPECT_EQ(events[0].last_frame, 546);
    EXPECT_EQ(events[0].frame, 273);
    EXPECT_NEAR(scene.placeOf(events[0]).x, 32 + 273 / 4.5, 1e-6) << "one that follows is shown";
}

TEST(Convoys, LastFromTheFirstWhoFollowsHoweverLateOthersAreFound) {
    // 18 m apart at 20 km/h; one of the three is found eight seconds after the others.
    for (const int late : {0, 2}) {
        DrivenTracks scene;
        scene.noise_px = 0;
        for (int i = 0; i < 3; ++i) {
            const double seconds = i == late ? 8 : 0;
            scene.drive({50.0 - 18 * i + seconds * 20 / 3.6, 40}, 0, {{25 - seconds, 20, 20}},
                        static_cast<int>(seconds * 25));
        }
        EventOptions options;
        options.convoy_time_s = 8;
        const auto events = scene.events(EventKind::convoy, options);
        ASSERT_EQ(events.size(), 1U) << late;
        EXPECT_THAT(events[0].tracks, ElementsAre(1, 2, 3));
        EXPECT_EQ(events[0].first_frame, 0) << late;
        EXPECT_GT(events[0].last_frame, 500) << late;
    }
}

TEST(Convoys, WhoDoesNotFollowForThreeSecondsBeginsAnew) {
    // The last of three goes 6 m beside the others meanwhile, and comes back; 12 s before that and 9 s after it.
    const auto convoysOf = [](double beside_s, double least_s) {
        DrivenTracks scene;
        scene.noise_px = 0;
        for (int i = 0; i < 3; ++i) {
            std::vector<std::pair<cv::Point2d, double>> poses;
            poses.reserve(25 * 26);
            for (int frame = 0; frame < 25 * 26; ++frame) {
                const double seconds = frame / 25.0;
                const bool beside = i == 2 && seconds > 13 && seconds < 13 + beside_s;
                poses.push_back({{50.0 - 18 * i + seconds * 20 / 3.6, beside ? 46.0 : 40.0}, 0});
            }
            scene.follow(poses);
        }
        EventOptions options;
        options.convoy_time_s = least_s;
        return scene.events(EventKind::convoy, options).size();
    };
    EXPECT_EQ(convoysOf(0, 15), 1U);
    EXPECT_EQ(convoysOf(4, 15), 0U);
    EXPECT_GE(convoysOf(4, 7), 1U);
}

TEST(Convoys, TwoOnTwoRoadsAtATimeAreTwo) {
    DrivenTracks scene;
    scene.noise_px = 0;
    for (int i = 0; i < 3; ++i) scene.drive({50.0 - 18 * i, 30}, 0, {{25, 20, 20}});
    for (int i = 0; i < 4; ++i) scene.drive({140.0 + 16 * i, 90}, 180, {{25, 20, 20}});
    const auto events = scene.events(EventKind::convoy);
    ASSERT_EQ(events.size(), 2U);
    for (const Event& event : events) {
        if (event.figure == 3)
            EXPECT_THAT(event.tracks, ElementsAre(1, 2, 3));
        else
            EXPECT_THAT(event.tracks, ElementsAre(4, 5, 6, 7));
    }
}

TEST(Convoys, TwoAreNone) {
    DrivenTracks scene;
    scene.drive({40, 40}, 0, {{30, 20, 20}});
    scene.drive({20, 40}, 0, {{30, 20, 20}});
    EXPECT_THAT(scene.events(EventKind::convoy), IsEmpty());
    EventOptions options;
    options.convoy_vehicles = 2;
    const auto events = scene.events(EventKind::convoy, options);
    ASSERT_EQ(events.size(), 1U);
    EXPECT_NEAR(events[0].frame, (events[0].first_frame + events[0].last_frame) / 2, 1) << "shown in its middle";
}

TEST(Convoys, ThoseWhoDriveTheOtherWayOrBesideDoNotBelongToIt) {
    DrivenTracks scene;
    scene.frames = 700;
    scene.drive({60, 40}, 0, {{28, 20, 20}});
    scene.drive({42, 40}, 0, {{28, 20, 20}});
    scene.drive({30, 44}, 0, {{28, 20, 20}});       // beside
    scene.drive({150, 36.5}, 180, {{28, 20, 20}});  // oncoming
    EXPECT_THAT(scene.events(EventKind::convoy), IsEmpty());
}

TEST(Convoys, WhoDrivesMoreThanTwiceAsFastFollowsNobody) {
    EventOptions options;
    options.convoy_vehicles = 2;
    options.convoy_time_s = 2;
    options.convoy_spread = 10;
    const auto convoys = [&](double leader_kmh, double follower_kmh, double behind_m) {
        DrivenTracks scene;
        scene.frames = 200;
        scene.drive({80, 40}, 0, {{8, leader_kmh, leader_kmh}});
        scene.drive({80 - behind_m, 40}, 0, {{8, follower_kmh, follower_kmh}});
        return scene.events(EventKind::convoy, options).size();
    };
    EXPECT_EQ(convoys(20, 37, 40), 1U);
    EXPECT_EQ(convoys(20, 44, 40), 0U);
    EXPECT_EQ(convoys(37, 20, 8), 1U);
    EXPECT_EQ(convoys(44, 20, 8), 0U);
}

TEST(Meetings, TwoFromDifferentDirectionsStandSideBySide) {
    DrivenTracks scene;
    const std::vector<Leg> come = {{5, 30, 30}, {4, 30, 0}, {10, 0, 0}, {4, 0, 30}, {8, 30, 30}};
    // Both come 58.3 m; they stand 3 m apart, side by side.
    scene.drive({100 - 58.3, 60}, 0, come);
    scene.drive({100 + 58.3, 57}, 180, come, 50);
    const auto events = scene.events(EventKind::meeting);
    ASSERT_EQ(events.size(), 1U);
    EXPECT_THAT(events[0].tracks, ElementsAre(1, 2));
    EXPECT_NEAR(events[0].figure, 8, 1);
    EXPECT_NEAR(events[0].first_frame, 50 + 9 * 25, 15);
    EXPECT_NEAR(scene.placeOf(events[0]).x, 100, 2);
}

TEST(Meetings, OfNoLengthAskForOneFrameInWhichBothStand) {
    EventOptions options;
    options.meeting_time_s = 0;
    const auto metFrom = [&](int frame) {
        DrivenTracks scene;
        scene.noise_px = 0;
        scene.drive({60, 60}, 0, {{101 / 25.0, 0, 0}});  // to the frame 100
        scene.drive({60, 63}, 180, {{8, 0, 0}}, frame);
        return scene.events(EventKind::meeting, options);
    };
    ASSERT_EQ(metFrom(100).size(), 1U);
    EXPECT_EQ(metFrom(100)[0].first_frame, 100);
    EXPECT_EQ(metFrom(100)[0].last_frame, 100);
    EXPECT_EQ(metFrom(100)[0].figure, 0);
    EXPECT_THAT(metFrom(101), IsEmpty());
}

TEST(Meetings, AQueueIsNone) {
    DrivenTracks scene;
    const std::vector<Leg> come = {{5, 30, 30}, {4, 30, 0}, {10, 0, 0}, {4, 0, 30}, {8, 30, 30}};
    scene.drive({40, 60}, 0, come);
    scene.drive({33, 60}, 0, come);
    scene.drive({26, 60}, 0, come);
    EXPECT_THAT(scene.events(EventKind::meeting), IsEmpty());
    EventOptions options;
    options.meeting_angle_deg = 0;
    EXPECT_EQ(scene.events(EventKind::meeting, options).size(), 2U);
}

TEST(Meetings, WhereSomeoneComesFromIsHowHeDroveLast) {
    DrivenTracks scene;
    scene.drive({100 - 58.3, 60}, 0, {{5, 30, 30}, {4, 30, 0}, {10, 0, 0}, {4, 0, 30}});
    // Comes towards the other and turns about, three seconds before he stands 3 m beside him.
    scene.drive({111.1, 67.6}, 180, {{3, 20, 20}, {3, 20, 20, 60}, {2, 20, 0}, {11, 0, 0}, {4, 0, 30}});
    EXPECT_THAT(scene.events(EventKind::meeting), IsEmpty());
    EventOptions options;
    options.meeting_angle_deg = 0;
    EXPECT_EQ(scene.events(EventKind::meeting, options).size(), 1U);
}

TEST(Meetings, PassingEachOtherOrStandingFarApartIsNone) {
    DrivenTracks scene;
    const std::vector<Leg> come = {{5, 30, 30}, {4, 30, 0}, {10, 0, 0}, {4, 0, 30}};
    scene.drive({100 - 58.3, 60}, 0, come);
    scene.drive({100 + 58.3, 50}, 180, come);    // 10 m beside
    scene.drive({-10, 100}, 0, {{30, 40, 40}});  // these pass
    scene.drive({210, 97}, 180, {{30, 40, 40}});
    EXPECT_THAT(scene.events(EventKind::meeting), IsEmpty());
}

}  // namespace eyrie::several_vehicles_test
