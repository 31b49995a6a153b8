#include "tracking/finishing/implied_height.h"

#include <gtest/gtest.h>

#include <cmath>
#include <opencv2/core.hpp>

#include "tracking/finishing/track_finishing.h"

namespace eyrie::implied_height_test {
namespace {

const SceneScale kScale{.gsd_m_per_px = 0.2, .frame_rate_hz = 25, .gsd_known = true};
const cv::Size kImage(1000, 600);
constexpr int kFrames = 60;
constexpr double kFlightHeight = 60;  // m
const cv::Point3d kStands(0, 0, 0);

/// A camera that circles the place it looks at.
struct Circling {
    double focal = 800;            ///< px
    double tilt = 1.0;             ///< from straight down
    double turn_a_frame = 0.0175;  ///< 1 degree
    bool moves = true;             ///< otherwise it turns where it is

    cv::Matx34d projection(FrameIndex frame) const {
        const double turn = turn_a_frame * frame;
        const cv::Vec3d right(std::cos(turn), std::sin(turn), 0);
        const cv::Vec3d back(-std::sin(turn), std::cos(turn), 0);
        const cv::Vec3d down(0, 0, -1);
        const cv::Vec3d view = down * std::cos(tilt) - back * std::sin(tilt);
        const cv::Vec3d below = back * std::cos(tilt) + down * std::sin(tilt);
        const cv::Vec3d behind = moves ? back : cv::Vec3d(0, 1, 0);
        const cv::Vec3d at = behind * (kFlightHeight * std::tan(tilt)) + cv::Vec3d(0, 0, kFlightHeight);
        const cv::Matx33d lens(focal, 0, 499.5, 0, focal, 299.5, 0, 0, 1);
        const cv::Matx34d pose(right[0], right[1], right[2], -right.dot(at), below[0], below[1], below[2],
                               -below.dot(at), view[0], view[1], view[2], -view.dot(at));
        return lens * pose;
    }
    cv::Matx33d imageFromGround(FrameIndex frame) const {
        const cv::Matx34d p = projection(frame);
        return {p(0, 0), p(0, 1), p(0, 3), p(1, 0), p(1, 1), p(1, 3), p(2, 0), p(2, 1), p(2, 3)};
    }
    cv::Point2d seen(cv::Point3d point, FrameIndex frame) const {
        const cv::Vec3d p = projection(frame) * cv::Vec4d(point.x, point.y, point.z, 1);
        return {p[0] / p[2], p[1] / p[2]};
    }
    std::vector<FrameMotionSummary> motion() const {
        std::vector<FrameMotionSummary> summaries;
        for (FrameIndex frame = 0; frame < kFrames; ++frame) {
            FrameMotionSummary summary;
            summary.frame = frame;
            summary.image_size = kImage;
            summary.registration.state = frame == 0 ? RegistrationState::first : RegistrationState::registered;
            if (frame > 0) {
                const cv::Matx33d map = imageFromGround(frame) * imageFromGround(frame - 1).inv();
                summary.registration.current_from_previous.matrix = map * (1 / map(2, 2));
            }
            summaries.push_back(summary);
        }
        return summaries;
    }

    TrackState stateAt(cv::Point3d from, cv::Point3d step, FrameIndex frame) const {
        TrackState state;
        state.id = 1;
        state.box = {seen(from + step * frame, frame), 20, 10, 0};
        state.status = TrackStatus::confirmed;
        return state;
    }
    /// The track of a point that starts somewhere and moves by `step` metres a frame.
    TrackPath pathOf(cv::Point3d from, cv::Point3d step = kStands, int frames = kFrames) const {
        TrackPath path;
        path.id = 1;
        for (FrameIndex frame = 0; frame < frames; ++frame)
            path.states.emplace_back(frame, PathState(stateAt(from, step, frame)));
        return path;
    }
    std::optional<ImpliedHeight> impliedOf(const TrackPath& path) const {
        return impliedHeightOf(path, GroundMotion(motion()));
    }
    double heightOf(cv::Point3d from) const { return impliedOf(pathOf(from)).value().height; }

    /// Why such a track is dropped though it looks like a vehicle in every frame, or in none; nothing: it stays.
    std::optional<TrackDrop> dropped(cv::Point3d from, cv::Point3d step, FinishingOptions options = {},
                                     bool looks = true) const {
        options.min_score = 0;  // judged by its motion alone
        std::vector<TimedState> states;
        for (FrameIndex frame = 0; frame < kFrames; ++frame) states.emplace_back(frame, stateAt(from, step, frame));
        const auto vehicles_at = [&](FrameIndex frame) {
            return looks ? std::vector<ClassifiedBox>{{stateAt(from, step, frame).box, true}}
                         : std::vector<ClassifiedBox>{};
        };
        std::vector<TimedDrop> drops;
        if (!finishTracks(states, motion(), options, kScale, {{}, vehicles_at}, &drops).empty()) return std::nullopt;
        return drops.at(0).second.why;
    }
    bool stays(cv::Point3d from, cv::Point3d step = kStands, FinishingOptions options = {}) const {
        return !dropped(from, step, options);
    }
};

/// A roof at so many shares of the flight height.
cv::Point3d roofAt(double height) {
    return {3, 4, height * kFlightHeight};
}

}  // namespace

TEST(ImpliedHeight, IsThatOfARoofAsAShareOfTheFlightHeight) {
    const Circling camera;
    EXPECT_NEAR(camera.heightOf({3, 4, 12}), 0.2, 0.003);
    EXPECT_NEAR(camera.heightOf({-8, 6, 6}), 0.1, 0.003);
    EXPECT_NEAR(camera.heightOf({5, -9, 24}), 0.4, 0.003);
    EXPECT_NEAR(camera.heightOf({2, 3, -6}), -0.1, 0.003) << "a pit";
    EXPECT_NEAR(camera.impliedOf(camera.pathOf(roofAt(0.2)))->rest, 0, 0.1) << "explained to the tenth of a pixel";
    EXPECT_NEAR(camera.impliedOf(camera.pathOf(roofAt(0.2)))->oblique, std::cos(camera.tilt), 0.01);
}

TEST(ImpliedHeight, LiesBetweenAFifthBelowTheGroundAndNineTenthsOfTheFlightHeight) {
    const Circling camera;
    EXPECT_NEAR(camera.heightOf(roofAt(-0.28)), -0.2, 0.003);
    // A circle about what is that near leads it out of the picture; where it would be is enough.
    EXPECT_NEAR(camera.heightOf(roofAt(0.89)), 0.89, 0.003);
    EXPECT_NEAR(camera.heightOf(roofAt(0.95)), 0.9, 0.003);
}

TEST(ImpliedHeight, IsReadInViewsThatAreNearlyLevelToo) {
    EXPECT_NEAR(Circling{.tilt = 1.36}.heightOf(roofAt(0.2)), 0.2, 0.003) << "12 degrees below the horizon";
    EXPECT_NEAR(Circling{.tilt = 0.5}.heightOf(roofAt(0.2)), 0.2, 0.003);
    EXPECT_NEAR((Circling{.turn_a_frame = -0.0175}.heightOf(roofAt(0.2))), 0.2, 0.003) << "the other way round";
}

TEST(ImpliedHeight, MovedIsHowFarItGotOffTheGroundInAboutASecond) {
    const Circling camera;
    const auto movedWithin = [&](FrameIndex first, FrameIndex last) {
        const cv::Point2d from = camera.seen(roofAt(0.2), first);
        const cv::Vec3d carried =
            camera.imageFromGround(last) * camera.imageFromGround(first).inv() * cv::Vec3d(from.x, from.y, 1);
        const cv::Point2d off = camera.seen(roofAt(0.2), last) - cv::Point2d(carried[0], carried[1]) / carried[2];
        return std::hypot(off.x, off.y);
    };
    EXPECT_NEAR(camera.impliedOf(camera.pathOf(roofAt(0.2), kStands, 9))->moved, movedWithin(0, 8), 0.1)
        << "a shorter track as a whole";
    // Of two windows, which begin six frames apart and end with the track, the longer one.
    EXPECT_NEAR(camera.impliedOf(camera.pathOf(roofAt(0.2), kStands, 15))->moved, movedWithin(0, 14), 0.1);
    // Of 49 frames five windows of 24 and three shorter ones: of equal speeds the middle ones have 24 and 18.
    const double all = camera.impliedOf(camera.pathOf(roofAt(0.2), kStands, 49))->moved;
    EXPECT_GT(all, movedWithin(20, 43));
    EXPECT_LT(all, movedWithin(0, 25));
}

TEST(ImpliedHeight, NeedsEightFramesOfSomethingThatDoesNotStandOverGroundThatIsKnown) {
    const Circling camera;
    EXPECT_TRUE(camera.impliedOf(camera.pathOf(roofAt(0.2), kStands, 9)));
    EXPECT_FALSE(camera.impliedOf(camera.pathOf(roofAt(0.2), kStands, 8)));
    for (const std::size_t stands : {0U, 8U}) {
        TrackPath path = camera.pathOf(roofAt(0.2), kStands, 9);
        path.states[stands].second.origin = StateOrigin::standing;
        EXPECT_FALSE(camera.impliedOf(path)) << "a standstill at one end says nothing of how it moves";
    }
    auto motion = camera.motion();
    motion.erase(motion.begin() + 5);
    EXPECT_FALSE(impliedHeightOf(camera.pathOf(roofAt(0.2), kStands, 9), GroundMotion(motion)));
}

TEST(ImpliedHeight, ACameraThatTurnsWhereItIsTellsNone) {
    // Nothing moves against anything else, so that no height explains more than another.
    const Circling still{.turn_a_frame = 0};
    EXPECT_FALSE(still.impliedOf(still.pathOf(roofAt(0.2))));
    const Circling turning{.moves = false};
    EXPECT_TRUE(turning.stays(roofAt(0.2)));
}

TEST(ImpliedHeight, ARoofIsDroppedThoughItLooksLikeAVehicle) {
    const Circling camera;
    EXPECT_EQ(camera.dropped(roofAt(0.2), kStands), TrackDrop::could_stand);
    FinishingOptions options;
    options.standing_height = 0;
    EXPECT_TRUE(camera.stays(roofAt(0.2), kStands, options));
    const Circling wide{.focal = 600};
    EXPECT_FALSE(wide.stays(roofAt(0.2))) << "the lens need not be known well";
    EXPECT_TRUE(wide.stays({-12, 5, 0}, {0.4, 0, 0}));
}

TEST(ImpliedHeight, VehiclesThatDriveOnTheGroundStay) {
    const Circling camera;
    EXPECT_TRUE(camera.stays({-12, 5, 0}, {0.4, 0, 0}));
    EXPECT_TRUE(camera.stays({3, -15, 0}, {0, 0.4, 0}));
    EXPECT_TRUE(camera.stays({10, 10, 0}, {-0.3, -0.3, 0}));
}

TEST(ImpliedHeight, RoofsAreHigherThanVehiclesAndNoHigherThanAskedFor) {
    const Circling camera;
    EXPECT_TRUE(camera.stays(roofAt(0.02))) << "1.2 m: a car has as much";
    EXPECT_FALSE(camera.stays(roofAt(0.04)));
    EXPECT_FALSE(camera.stays(roofAt(0.32)));
    EXPECT_TRUE(camera.stays(roofAt(0.35)));
    FinishingOptions options;
    options.standing_height = 0.4;
    EXPECT_FALSE(camera.stays(roofAt(0.35), kStands, options));
}

TEST(ImpliedHeight, WhatNeverLookedLikeAVehicleMayStandHigher) {
    const Circling camera;
    const auto unlikeStays = [&](double height, FinishingOptions options = {}) {
        return !camera.dropped(roofAt(height), kStands, options, false);
    };
    EXPECT_TRUE(camera.stays(roofAt(0.36)));
    EXPECT_FALSE(unlikeStays(0.36));
    EXPECT_FALSE(unlikeStays(0.32));
    EXPECT_TRUE(unlikeStays(0.4)) << "vehicles that come towards the flight along its way move so";
    FinishingOptions lower;
    lower.roof_height = 0;
    EXPECT_TRUE(unlikeStays(0.36, lower));
    EXPECT_FALSE(unlikeStays(0.3, lower)) << "standing_height holds for them, too";
}

TEST(ImpliedHeight, FromAboveWhatLooksLikeAVehicleStays) {
    EXPECT_TRUE(Circling{.tilt = 0.3}.stays(roofAt(0.2))) << "the camera's way is not told surely";
    EXPECT_TRUE(Circling{.tilt = 0.62}.stays(roofAt(0.2))) << "cosine .81";
    EXPECT_FALSE(Circling{.tilt = 0.67}.stays(roofAt(0.2))) << "cosine .78";
}

TEST(ImpliedHeight, WhatGotOffTheGroundByFourPixelsIsTold) {
    for (const double height : {0.05, 0.1, 0.15, 0.2}) {
        // Slow enough for some of them only.
        const Circling slow{.turn_a_frame = 0.0015};
        const double moved = slow.impliedOf(slow.pathOf(roofAt(height)))->moved;
        EXPECT_EQ(slow.stays(roofAt(height)), moved < 4) << moved;
    }
}

TEST(ImpliedHeight, WhatMovesByItselfWouldLeaveARest) {
    // On a roof that seems to move by 40 px in a window, across that way: 15 % are 6 px.
    const Circling camera;
    const auto restWith = [&](double step) {
        const auto implied = camera.impliedOf(camera.pathOf(roofAt(0.1), {0, step, 0}));
        return implied->rest / implied->moved;
    };
    for (const double step : {0.01, 0.02, 0.03, 0.04, 0.05, 0.06, 0.08, 0.1}) {
        const bool explained = restWith(step) < 0.15;
        EXPECT_EQ(camera.stays(roofAt(0.1), {0, step, 0}), !explained) << step << ": " << restWith(step);
    }
    EXPECT_LT(restWith(0.01), 0.15);
    EXPECT_GT(restWith(0.1), 0.15);
}

}  // namespace eyrie::implied_height_test
