// Which ends of tracks are followed in pictures, how far, and what is left of them afterwards.
#include <gtest/gtest.h>

#include "tracking/pictures/filmed_drive.h"

namespace eyrie::end_following_limits_test {
namespace {

/// One track of it, from frame 20 to 40 unless another is given, and what became of it.
struct Followed {
    TrackPath path;
    FollowedEnds ends;

    bool back() const { return ends.begins.contains(path.id); }
    bool on() const { return ends.ends.contains(path.id); }
};

Followed follow(test::FilmedDrive& drive, const TrackPath& path, int frames = 30,
                const SceneScale& scale = test::FilmedDrive::kScale) {
    GroundMotion ground = drive.ground();
    ground.seenAt(scale.slope);
    std::vector<TrackPath> paths{path};
    const FollowedEnds ends = followEnds(paths, ground, drive.grayAt(), frames, scale);
    EXPECT_EQ(paths.size(), 1U);
    for (std::size_t i = 1; i < paths[0].states.size(); ++i)
        EXPECT_EQ(paths[0].states[i].first, paths[0].states[i - 1].first + 1) << "every frame once, in order";
    return {paths[0], ends};
}

Followed follow(test::FilmedDrive& drive) {
    return follow(drive, drive.path(20, 40));
}

/// The first states of a path as those of the tracker's guesses.
TrackPath guessed(TrackPath path, std::size_t states) {
    for (std::size_t i = 0; i < states; ++i) path.states[i].second.origin = StateOrigin::predicted;
    return path;
}

}  // namespace

TEST(EndFollowingLimits, ReadsWhatItNeedsAndTellsWhichEndsItFollowed) {
    test::FilmedDrive drive;
    const Followed followed = follow(drive, drive.path(20, 40), 10);
    EXPECT_TRUE(followed.back());
    EXPECT_TRUE(followed.on());
    EXPECT_EQ(followed.path.firstFrame(), 10);
    EXPECT_EQ(followed.path.lastFrame(), 50);
    std::vector<FrameIndex> needed;
    for (FrameIndex frame = 10; frame <= 20; ++frame) needed.push_back(frame);
    for (FrameIndex frame = 40; frame <= 51; ++frame) needed.push_back(frame);
    EXPECT_EQ(drive.asked, needed);
    EXPECT_EQ(followed.path.at(15)->second.hits, 0) << "the tracker had not seen it";
    EXPECT_EQ(followed.path.at(45)->second.hits, 21);
    for (const auto& [frame, state] : followed.path.states) {
        EXPECT_GT(overlap(state.box, drive.boxAt(frame)), 0.85) << frame;
        EXPECT_NEAR(state.velocity.x, 4, 0.3) << frame;
        EXPECT_EQ(state.origin, frame < 20 || frame > 40 ? StateOrigin::reconstructed : StateOrigin::detected);
    }
}

TEST(EndFollowingLimits, OneFrameIsOneFrame) {
    test::FilmedDrive drive;
    const Followed one = follow(drive, drive.path(20, 40), 1);
    EXPECT_EQ(one.path.firstFrame(), 19);
    EXPECT_EQ(one.path.lastFrame(), 41);
    drive.asked.clear();
    EXPECT_EQ(follow(drive, drive.path(20, 40), 0).path.states.size(), 21U);
    EXPECT_TRUE(drive.asked.empty());
}

TEST(EndFollowingLimits, GoesOnToTheLastFrameOfTheRun) {
    test::FilmedDrive drive;
    const Followed followed = follow(drive);
    EXPECT_TRUE(followed.on());
    EXPECT_EQ(followed.path.lastFrame(), 59);
    EXPECT_EQ(followed.path.firstFrame(), 0);
}

TEST(EndFollowingLimits, WhatGainedNothingWasNotFollowed) {
    test::FilmedDrive drive;
    drive.there = [](FrameIndex frame) { return frame >= 20 && frame <= 40; };
    const Followed followed = follow(drive);
    EXPECT_FALSE(followed.back());
    EXPECT_FALSE(followed.on());
    EXPECT_EQ(followed.path.states.size(), 21U);
    test::FilmedDrive whole;
    const Followed at_ends = follow(whole, whole.path(0, 59));
    EXPECT_FALSE(at_ends.back());
    EXPECT_FALSE(at_ends.on());
}

TEST(EndFollowingLimits, OnlyScoresFromFourFifthsOn) {
    test::FilmedDrive drive;
    const Followed sure = follow(drive, drive.path(20, 40, 1, 0.81));
    EXPECT_TRUE(sure.back() && sure.on());
    const Followed doubtful = follow(drive, drive.path(20, 40, 1, 0.79));
    EXPECT_FALSE(doubtful.back() || doubtful.on());
}

TEST(EndFollowingLimits, OnlyWhatWasDetectedSixTimes) {
    test::FilmedDrive drive;
    TrackPath path = drive.path(20, 40);
    for (std::size_t i = 0; i < 15; ++i) path.states[2 * i % 21].second.origin = StateOrigin::reconstructed;
    ASSERT_EQ(path.statesOf(StateOrigin::detected), 6);
    EXPECT_TRUE(follow(drive, path).on());
    const auto detected = std::find_if(path.states.begin(), path.states.end(), [](const TimedPathState& state) {
        return state.second.origin == StateOrigin::detected;
    });
    detected->second.origin = StateOrigin::reconstructed;
    const Followed hardly = follow(drive, path);
    EXPECT_FALSE(hardly.back() || hardly.on());
}

TEST(EndFollowingLimits, OnlyEndsThatWereSeenFiveTimesInARow) {
    test::FilmedDrive drive;
    TrackPath path = drive.path(20, 40);
    path.states[path.states.size() - 5].second.origin = StateOrigin::predicted;
    const Followed lately = follow(drive, path);
    EXPECT_FALSE(lately.on());
    EXPECT_TRUE(lately.back());
    path = drive.path(20, 40);
    path.states[path.states.size() - 6].second.origin = StateOrigin::predicted;
    EXPECT_TRUE(follow(drive, path).on());
}

TEST(EndFollowingLimits, OnlyWhatMoves) {
    test::FilmedDrive drive;
    drive.place = [](double frame) { return 200 + 0.25 * frame; };  // 1.25 m/s
    const Followed slow = follow(drive);
    EXPECT_TRUE(slow.back() && slow.on());
    drive.place = [](double frame) { return 200 + 0.17 * frame; };  // 0.85 m/s
    const Followed standing = follow(drive);
    EXPECT_FALSE(standing.back() || standing.on());
    drive.place = [](double frame) { return 400 - 4 * frame; };
    const Followed to_the_left = follow(drive);
    EXPECT_TRUE(to_the_left.back() && to_the_left.on());
}

TEST(EndFollowingLimits, OnlyInMidPictureAndWhileTheBoxLiesInIt) {
    test::FilmedDrive drive;
    drive.frames = 110;
    drive.place = [](double frame) { return 7 * frame - 61.5; };
    // Nine tenths of its 24 px lie right of −0.5 from x = 9.1 on, and left of 639.5 up to x = 629.9.
    EXPECT_EQ(follow(drive).path.firstFrame(), 11);
    EXPECT_EQ(follow(drive, drive.path(40, 80)).path.lastFrame(), 98);
    const Followed through = follow(drive, drive.path(10, 99));
    EXPECT_FALSE(through.back() || through.on()) << "both ends are cut by the border";
    EXPECT_FALSE(follow(drive, guessed(drive.path(10, 60), 5)).back()) << "it came in there";
    EXPECT_FALSE(follow(drive, guessed(drive.path(9, 60), 1)).back());
}

TEST(EndFollowingLimits, WhatWasGuessedGivesWayToWhatThePicturesShow) {
    test::FilmedDrive drive;
    TrackPath path = guessed(drive.path(15, 40), 5);
    for (std::size_t i = 0; i < 5; ++i) path.states[i].second.box.centre.y += 2;
    drive.there = [](FrameIndex frame) { return frame >= 17; };
    const Followed followed = follow(drive, path);
    ASSERT_EQ(followed.path.firstFrame(), 15);
    EXPECT_TRUE(followed.back());
    for (FrameIndex frame = 15; frame < 17; ++frame) {
        EXPECT_EQ(followed.path.at(frame)->second.origin, StateOrigin::predicted) << frame;
        EXPECT_NEAR(followed.path.at(frame)->second.box.centre.x, drive.place(frame), 1e-3) << frame;
        EXPECT_NEAR(followed.path.at(frame)->second.box.centre.y, 102, 1e-3) << frame;
    }
    for (FrameIndex frame = 17; frame < 20; ++frame) {
        EXPECT_EQ(followed.path.at(frame)->second.origin, StateOrigin::reconstructed) << frame;
        EXPECT_NEAR(followed.path.at(frame)->second.box.centre.y, 100, 0.5) << frame;
    }
}

TEST(EndFollowingLimits, ALongGuessIsKept) {
    test::FilmedDrive drive;
    EXPECT_TRUE(follow(drive, guessed(drive.path(12, 40), 8)).back());
    const Followed longer = follow(drive, guessed(drive.path(11, 40), 9));
    EXPECT_FALSE(longer.back());
    EXPECT_EQ(longer.path.firstFrame(), 11);
    EXPECT_EQ(longer.path.at(15)->second.origin, StateOrigin::predicted);
}

TEST(EndFollowingLimits, StaysWhereThePictureIsFrozen) {
    test::FilmedDrive drive;
    drive.frozen = {45, 46, 47};
    drive.place = [](double frame) { return 100 + 4 * (frame <= 44 ? frame : std::max(44.0, frame - 3)); };
    const Followed followed = follow(drive);
    EXPECT_EQ(followed.path.lastFrame(), 59);
    for (const auto& [frame, state] : followed.path.states)
        EXPECT_GT(overlap(state.box, drive.boxAt(frame)), 0.85) << frame;
    EXPECT_EQ(followed.path.at(47)->second.box.centre.x, followed.path.at(44)->second.box.centre.x);
}

TEST(EndFollowingLimits, ABoxThatSlowsDownAsNoVehicleDoesIsTakenBack) {
    test::FilmedDrive drive;
    drive.frames = 80;
    // 20 m/s; what is lost of it at once, m/s, at 25 frames/s and 5 px/m.
    const auto slowing = [&](double lost) {
        drive.place = [lost](double frame) { return 100 + 4 * frame - std::max(0.0, frame - 50) * lost / 5; };
        return follow(drive, drive.path(20, 40), 60);
    };
    EXPECT_EQ(slowing(4).path.lastFrame(), 79);
    const Followed braked = slowing(6);
    EXPECT_TRUE(braked.on());
    EXPECT_NEAR(braked.path.lastFrame(), 49, 1) << "none of what followed the jolt";
    const Followed at_once = follow(drive, drive.path(20, 49), 60);
    EXPECT_EQ(at_once.path.lastFrame(), 49) << "what the tracker saw stays";
    EXPECT_FALSE(at_once.on());
    // Back in time, the same.
    const auto gathering = [&](double gained) {
        drive.place = [gained](double frame) { return 100 + 4 * frame + std::max(0.0, 20 - frame) * gained / 5; };
        return follow(drive, drive.path(30, 79), 60);
    };
    EXPECT_EQ(gathering(4).path.firstFrame(), 0);
    const Followed jolted = gathering(6);
    EXPECT_TRUE(jolted.back());
    EXPECT_NEAR(jolted.path.firstFrame(), 21, 1);
    const Followed at_once_back = follow(drive, drive.path(21, 79), 60);
    EXPECT_EQ(at_once_back.path.firstFrame(), 21);
    EXPECT_FALSE(at_once_back.back());
}

TEST(EndFollowingLimits, WhatComesNearerInAnObliqueViewDoesNotBrakeOrGatherSpeed) {
    test::FilmedDrive drive;
    SceneScale scale = test::FilmedDrive::kScale;
    scale.slope = {0.0017, 0, 320, 100};
    drive.growth = [&](double x) { return scale.slope.factorAt({x, 100}); };
    // dx/dt = 5 growth.
    drive.place = [](double frame) { return 320 + (0.78 * std::exp(0.0085 * frame) - 1) / 0.0017; };
    const Followed followed = follow(drive, drive.path(20, 35), 30, scale);
    EXPECT_EQ(followed.path.firstFrame(), 0);
    EXPECT_EQ(followed.path.lastFrame(), 59);
    for (const auto& [frame, state] : followed.path.states)
        EXPECT_NEAR(state.box.centre.x, drive.place(frame), 2) << frame;
}

TEST(EndFollowingLimits, HoldsFewPicturesWhereTheyAreLarge) {
    test::FilmedDrive drive;
    for (FrameIndex frame = 1; frame < drive.frames; ++frame) drive.frozen.insert(frame);
    drive.place = [](double) { return 200.0; };
    const auto first = [&](cv::Size size) {
        std::vector<TrackPath> paths{drive.path(20, 40)};
        for (auto& [frame, state] : paths[0].states) state.velocity = {4, 0};
        const cv::Mat picture(size, CV_8UC1, cv::Scalar(0));
        followEnds(
            paths, drive.ground(size), [&](FrameIndex) { return picture; }, 10, test::FilmedDrive::kScale);
        return paths[0].firstFrame();
    };
    EXPECT_EQ(first({640, 200}), 10);
    EXPECT_EQ(first({10000, 5000}), 17) << "200 MB";
}

}  // namespace eyrie::end_following_limits_test
