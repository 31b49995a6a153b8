#include "ground/moving_spans.h"

#include <gtest/gtest.h>

#include "events/driven_tracks.h"

namespace eyrie::moving_spans_test {
namespace {

StoredTracks runOf(const test::DrivenTracks& scene) {
    StoredTracks run;
    run.tracks = scene.tracks;
    run.footage = scene.footage();
    for (const EventTrack& track : run.tracks) run.scores[track.id] = 0.9;
    return run;
}

std::vector<FrameSpan> spansIn(const StoredTracks& run, double min_score = 0) {
    const GroundStretches ground(run.footage);
    return movingSpans(run, ground, {}, min_score);
}

}  // namespace

TEST(MovingSpans, AreWhereAVehicleDrivesHoweverTheCameraMoves) {
    test::DrivenTracks scene;
    scene.camera = test::DrivenTracks::moving(0.2);
    // Stands for 10 s, drives for 6 s, stands again; another stands all the time.
    scene.drive({60, 60}, 0, {{10, 0, 0}, {6, 30, 30}, {20, 0, 0}});
    scene.drive({90, 80}, 0, {{39, 0, 0}});
    const auto spans = spansIn(runOf(scene));
    ASSERT_EQ(spans.size(), 1U);
    EXPECT_NEAR(spans[0].first, 250 - 25, 15);
    EXPECT_NEAR(spans[0].last, 400 + 25, 15);
}

TEST(MovingSpans, FramesThatCouldNotBeRegisteredMayHoldSomething) {
    test::DrivenTracks scene;
    scene.drive({90, 80}, 0, {{39, 0, 0}});
    StoredTracks run = runOf(scene);
    std::vector<Homography> steps;
    for (int frame = 1; frame < scene.frames; ++frame) {
        Homography step;
        step.from_frame = frame - 1;
        step.to_frame = frame;
        if (frame != 500) steps.push_back(step);
    }
    run.footage.camera = CameraMotion(steps);
    const std::vector<FrameSpan> spans = spansIn(run);
    EXPECT_EQ(spans, (std::vector<FrameSpan>{{475, 525}}));
}

TEST(MovingSpans, ASecondIsAddedAsFarAsTheVideoGoes) {
    test::DrivenTracks scene;
    scene.frames = 150;
    scene.drive({20, 60}, 0, {{6, 30, 30}});
    EXPECT_EQ(spansIn(runOf(scene)), (std::vector<FrameSpan>{{0, 149}}));
    scene.frames = 300;
    const auto spans = spansIn(runOf(scene));
    ASSERT_EQ(spans.size(), 1U);
    EXPECT_EQ(spans[0].first, 0);
    EXPECT_NEAR(spans[0].last, 149 + 25, 2);
}

TEST(MovingSpans, WhatWasFollowedTooShortlyToTellMayHaveMoved) {
    test::DrivenTracks scene;
    scene.drive({90, 80}, 0, {{20, 0, 0}});
    StoredTracks run = runOf(scene);
    EXPECT_TRUE(spansIn(run).empty());
    EventTrack glimpse = run.tracks[0];
    glimpse.id = 7;
    glimpse.boxes.assign(run.tracks[0].boxes.begin() + 200, run.tracks[0].boxes.begin() + 204);
    run.tracks.push_back(glimpse);
    EXPECT_EQ(spansIn(run), (std::vector<FrameSpan>{{175, 228}}));
}

TEST(MovingSpans, UnlikelyTracksDoNotCount) {
    test::DrivenTracks scene;
    scene.drive({20, 60}, 0, {{6, 30, 30}});
    StoredTracks run = runOf(scene);
    run.scores[1] = 0.4;
    EXPECT_EQ(spansIn(run).size(), 1U);
    EXPECT_EQ(spansIn(run, 0.4).size(), 1U) << "as likely as is asked for";
    EXPECT_EQ(spansIn(run, 0.5).size(), 0U);
    EXPECT_TRUE(spansIn(runOf(test::DrivenTracks())).empty());
}

}  // namespace eyrie::moving_spans_test
