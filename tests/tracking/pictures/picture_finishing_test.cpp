// Tracks that are joined, and boxes that are trimmed, by pictures: what becomes of all that is known of them.
#include "tracking/pictures/picture_finishing.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tracking/pictures/filmed_drive.h"

namespace eyrie::picture_finishing_test {
namespace {

/// One car that the tracker lost twice.
struct LostTwice {
    test::FilmedDrive drive;
    FinishedTracks finished;
    FinishingOptions options;

    LostTwice() {
        add(5, 0, 12, 0.85);
        add(3, 25, 37, 0.95);
        add(8, 47, 59, 0.9);
        for (const TrackId beside : {2, 3, 8, 5}) finished.dropped.push_back({{20 + beside, {}}, {}, beside});
    }
    void add(TrackId id, FrameIndex first, FrameIndex last, double score) {
        finished.paths.push_back(drive.path(first, last, id, score));
        TrackEvidence evidence;
        evidence.life_s = id;
        evidence.score = score;
        finished.evidence[id] = evidence;
    }
    void finish() { finishByPictures(finished, drive.ground(), options, test::FilmedDrive::kScale, drive.grayAt()); }
};

/// Cars in the sun, each in its lane and its time, whose boxes hold half of their shadows.
struct SunnyLanes {
    FinishedTracks finished;
    int frames = 60;

    SunnyLanes() {
        for (int lane = 0; lane < 5; ++lane) {
            TrackPath path{lane + 1, {}};
            // The first lane is neither the first nor the last that is used.
            for (FrameIndex frame = lane == 0 ? 12 : 3 * lane; frame <= 59 - (lane == 0 ? 12 : 12 - 3 * lane);
                 ++frame) {
                TrackState state;
                state.id = lane + 1;
                state.score = 0.9;
                const cv::Rect car = carAt(lane, frame);
                state.box = {{car.x - 0.5 + 12, car.y - 0.5 + 6}, 24, 12, 0};
                state.velocity = {4, 0};
                state.status = TrackStatus::confirmed;
                path.states.emplace_back(frame, PathState(state));
            }
            finished.paths.push_back(path);
        }
    }
    static cv::Rect carAt(int lane, FrameIndex frame) { return {40 + 4 * frame, 30 + 40 * lane, 22, 10}; }

    cv::Mat pictureOf(FrameIndex frame) const {
        cv::Mat picture(260, 400, CV_8UC1, cv::Scalar(150));
        for (int lane = 0; lane < 5; ++lane) {
            const cv::Rect car = carAt(lane, frame);
            picture(car + cv::Point(4, 4)).setTo(75);
            picture(car).setTo(230);
        }
        return picture;
    }
    void finish(const FinishingOptions& options, const SceneScale& scale = test::FilmedDrive::kScale) {
        GroundMotion ground;
        for (FrameIndex frame = 0; frame < frames; ++frame) {
            FrameMotionSummary summary = test::summaryOfFrame(frame);
            summary.image_size = {400, 260};
            ground.add(summary);
        }
        finishByPictures(finished, ground, options, scale, [this](FrameIndex frame) { return pictureOf(frame); });
    }
};

/// A lorry of 12 m whose cab was followed, with a break, and its rear as a track of its own.
struct FollowedCab {
    static constexpr int kFrames = 90;
    FinishedTracks finished;
    FinishingOptions options;
    double brightness = 150;  ///< of the ground …
    double paint = 230;       ///< … and of the lorry

    FollowedCab() {
        add(1, 10, 39, 0, 4 * 5);
        add(4, 41, 75, 0, 4 * 5);
        add(3, 20, 50, -40, 4 * 5);
        options.follow_ends_s = 0;
        options.trim_shadows = false;
    }
    static double frontAt(FrameIndex frame) { return 70 + 5.0 * frame; }
    /// `back`: px from the cab's middle.
    void add(TrackId id, FrameIndex first, FrameIndex last, double back, double length) {
        TrackPath path{id, {}};
        for (FrameIndex frame = first; frame <= last; ++frame) {
            TrackState state;
            state.id = id;
            state.score = id == 3 ? 0.4 : 0.9;
            state.box = {{frontAt(frame) - 10 + back, 60}, length, 12, 0};
            state.velocity = {5, 0};
            state.status = TrackStatus::confirmed;
            path.states.emplace_back(frame, PathState(state));
        }
        finished.paths.push_back(path);
        TrackEvidence evidence;
        evidence.score = id == 4 ? 0.9 : 0.8;
        finished.evidence[id] = evidence;
    }
    void finish() {
        GroundMotion ground;
        for (FrameIndex frame = 0; frame < kFrames; ++frame) {
            FrameMotionSummary summary = test::summaryOfFrame(frame);
            summary.image_size = {640, 120};
            ground.add(summary);
        }
        finishByPictures(finished, ground, options, test::FilmedDrive::kScale, [this](FrameIndex frame) {
            cv::Mat picture(120, 640, CV_8UC1, cv::Scalar(brightness));
            picture(cv::Rect(cvRound(frontAt(frame)) - 60, 54, 60, 12)).setTo(paint);
            return picture;
        });
    }
};

}  // namespace

TEST(PictureFinishing, ALorryOfWhichPartsWereFollowedIsOneTrackAndOneBox) {
    FollowedCab lorry;
    lorry.finish();
    const FinishedTracks& finished = lorry.finished;
    ASSERT_EQ(finished.paths.size(), 1U);
    EXPECT_EQ(finished.paths[0].id, 1);
    EXPECT_EQ(finished.paths[0].firstFrame(), 10);
    EXPECT_EQ(finished.paths[0].lastFrame(), 75);
    for (const auto& [frame, state] : finished.paths[0].states) {
        EXPECT_NEAR(state.box.length, 60, 1.6) << frame;
        EXPECT_NEAR(state.box.centre.x, FollowedCab::frontAt(frame) - 30, 1.2) << frame;
        EXPECT_FLOAT_EQ(state.score, 0.9F) << frame;
    }
    ASSERT_EQ(finished.dropped.size(), 1U);
    EXPECT_EQ(finished.dropped[0].path.id, 3);
    EXPECT_EQ(finished.dropped[0].beside, 1);
    EXPECT_FALSE(finished.evidence.contains(4));
}

TEST(PictureFinishing, BoxesStayAsLongAsTheyAreWhereNobodyAskedOrItIsDark) {
    FollowedCab unasked;
    unasked.options.whole_lorries = false;
    FollowedCab night;
    night.brightness = 40;
    night.paint = 100;
    for (FollowedCab* lorry : {&unasked, &night}) {
        lorry->finish();
        ASSERT_EQ(lorry->finished.paths.size(), 3U);
        for (const TrackPath& path : lorry->finished.paths)
            EXPECT_FLOAT_EQ(path.states.back().second.box.length, 20) << path.id;
    }
}

TEST(PictureFinishing, WhatIsJoinedKeepsTheOldestIdAndTheBestScore) {
    LostTwice scene;
    scene.finish();
    const FinishedTracks& finished = scene.finished;
    ASSERT_EQ(finished.paths.size(), 1U);
    EXPECT_EQ(finished.paths[0].id, 5);
    EXPECT_EQ(finished.paths[0].firstFrame(), 0);
    EXPECT_EQ(finished.paths[0].lastFrame(), 59);
    ASSERT_EQ(finished.evidence.size(), 1U);
    EXPECT_EQ(finished.evidence.at(5).score, 0.95);
    EXPECT_EQ(finished.evidence.at(5).life_s, 3) << "with all that speaks for it";
    for (const auto& [frame, state] : finished.paths[0].states) EXPECT_FLOAT_EQ(state.score, 0.95F) << frame;
    std::vector<TrackId> beside;
    for (const DroppedPath& path : finished.dropped) beside.push_back(path.beside);
    EXPECT_EQ(beside, (std::vector<TrackId>{2, 5, 5, 5}));
}

TEST(PictureFinishing, WhatIsNotJoinedKeepsItsOwnScore) {
    LostTwice scene;
    scene.drive.there = [](FrameIndex frame) { return frame < 14 || frame > 23; };
    scene.options.join_gap_s = 0.1;
    scene.finish();
    const FinishedTracks& finished = scene.finished;
    ASSERT_EQ(finished.paths.size(), 2U);
    EXPECT_EQ(finished.paths[0].id, 5);
    EXPECT_EQ(finished.paths[1].id, 3);
    EXPECT_EQ(finished.evidence.at(5).score, 0.85);
    EXPECT_EQ(finished.evidence.at(3).score, 0.95);
    for (const auto& [frame, state] : finished.paths[0].states) EXPECT_FLOAT_EQ(state.score, 0.85F) << frame;
    for (const auto& [frame, state] : finished.paths[1].states) EXPECT_FLOAT_EQ(state.score, 0.95F) << frame;
    std::vector<TrackId> beside;
    for (const DroppedPath& path : finished.dropped) beside.push_back(path.beside);
    EXPECT_EQ(beside, (std::vector<TrackId>{2, 3, 3, 5}));
}

TEST(PictureFinishing, TrimsTheBoxesOfAllTracksHoweverLongTheyLived) {
    SunnyLanes lanes;
    lanes.finish({});
    ASSERT_EQ(lanes.finished.paths.size(), 5U);
    for (const TrackPath& path : lanes.finished.paths) {
        for (const auto& [frame, state] : path.states) {
            const cv::Rect car = SunnyLanes::carAt(path.id - 1, frame);
            EXPECT_NEAR(state.box.length, 22, 0.8) << path.id << " in " << frame;
            EXPECT_NEAR(state.box.width, 10, 0.8) << path.id << " in " << frame;
            EXPECT_NEAR(state.box.centre.x, car.x + 10.5, 0.5) << path.id << " in " << frame;
            EXPECT_NEAR(state.box.centre.y, car.y + 4.5, 0.5) << path.id << " in " << frame;
        }
    }
}

TEST(PictureFinishing, TrimsNothingWhereNobodyKnowsAMetreOrNobodyAskedForIt) {
    SunnyLanes unknown;
    unknown.finish({}, {.gsd_m_per_px = SceneScale().gsd_m_per_px, .frame_rate_hz = 25});
    FinishingOptions options;
    options.trim_shadows = false;
    SunnyLanes unasked;
    unasked.finish(options);
    for (const SunnyLanes* lanes : {&unknown, &unasked}) {
        for (const TrackPath& path : lanes->finished.paths)
            EXPECT_NEAR(path.states[path.states.size() / 2].second.box.length, 24, 1e-4) << path.id;
    }
}

TEST(PictureFinishing, TellsHowShadowsFallAndWhatWasTakenOutOfWhichBoxes) {
    SunnyLanes lanes;
    lanes.finish({});
    const RunLight& light = lanes.finished.light;
    ASSERT_EQ(light.findings.size(), 1U);
    const LightFinding& finding = light.findings[0];
    EXPECT_EQ(finding.outcome, LightOutcome::shadows);
    EXPECT_NEAR(finding.heading, CV_PI / 4, 0.1) << "4 px to the right and 4 down";
    const double metre = test::FilmedDrive::kScale.px(1);
    EXPECT_NEAR(finding.reach_m * metre, std::hypot(4, 4), 0.6);
    EXPECT_EQ(finding.vehicles, 5);
    EXPECT_GT(finding.agreement, 0.99);
    ASSERT_TRUE(finding.darkening);
    EXPECT_NEAR(*finding.darkening, 0.5, 0.02) << "75 on ground of 150";
    EXPECT_EQ(finding.trimmed, 5);
    EXPECT_EQ(light.frames.size(), static_cast<std::size_t>(finding.last_frame - finding.first_frame) + 1);
    ASSERT_EQ(light.trims.size(), 5U);
    for (const auto& [track, trim] : light.trims) {
        EXPECT_EQ(trim.what, LightOutcome::shadows);
        EXPECT_NEAR(trim.along, 0.5, 0.2) << track;
        EXPECT_NEAR(trim.taken, 1 - 22 * 10 / (24.0 * 12), 0.05) << track;
    }
}

TEST(PictureFinishing, WhoIsNoSureVehicleSaysNothingOfShadows) {
    SunnyLanes lanes;
    for (const std::size_t unsure : {0U, 3U}) {
        for (auto& [frame, state] : lanes.finished.paths[unsure].states) state.score = 0.45F;
    }
    lanes.finish({});
    ASSERT_EQ(lanes.finished.light.findings.size(), 1U);
    EXPECT_EQ(lanes.finished.light.findings[0].outcome, LightOutcome::few_vehicles);
    EXPECT_EQ(lanes.finished.light.findings[0].vehicles, 3);
}

TEST(PictureFinishing, TellsWhyShadowsWereNotLookedFor) {
    const auto outcomeOf = [](const SunnyLanes& lanes) { return lanes.finished.light.findings.at(0).outcome; };
    SunnyLanes unknown;
    unknown.finish({}, {.gsd_m_per_px = SceneScale().gsd_m_per_px, .frame_rate_hz = 25});
    EXPECT_EQ(outcomeOf(unknown), LightOutcome::no_scale);
    FinishingOptions options;
    options.trim_shadows = false;
    SunnyLanes unasked;
    unasked.finish(options);
    EXPECT_EQ(outcomeOf(unasked), LightOutcome::switched_off);
    LostTwice unseen;
    finishByPictures(unseen.finished, unseen.drive.ground(), unseen.options, test::FilmedDrive::kScale, nullptr);
    EXPECT_EQ(unseen.finished.light.findings.at(0).outcome, LightOutcome::no_pictures);
    EXPECT_EQ(unseen.finished.light.findings.at(0).last_frame, 59);
}

TEST(PictureFinishing, NothingHappensWithoutPicturesOrTracks) {
    LostTwice scene;
    finishByPictures(scene.finished, scene.drive.ground(), scene.options, test::FilmedDrive::kScale, nullptr);
    EXPECT_EQ(scene.finished.paths.size(), 3U);
    EXPECT_EQ(scene.finished.evidence.size(), 3U);
    scene.finished.paths.clear();
    scene.finish();
    EXPECT_TRUE(scene.finished.paths.empty());
    EXPECT_TRUE(scene.drive.asked.empty());
}

}  // namespace eyrie::picture_finishing_test
