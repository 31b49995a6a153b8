#include "tracking/finishing/implied_height.h"

#include <gtest/gtest.h>

#include <cmath>
#include <opencv2/core.hpp>

#include "tracking/finishing/track_finishing.h"

namespace eyrie {
namespace {

constexpr SceneScale kScale{.gsd_m_per_px = 0.2, .frame_rate_hz = 25, .gsd_known = true};
const cv::Size kImage(1000, 600);
constexpr int kFrames = 60;

/// A camera 60 m above the ground that circles the place it looks at, by a degree a frame.
class Circling : public testing::Test {
 protected:
    explicit Circling(double focal = 800, double tilt = 1.0) : focal_(focal), tilt_(tilt) {
        for (FrameIndex frame = 0; frame < kFrames; ++frame) {
            FrameMotionSummary summary;
            summary.frame = frame;
            summary.image_size = kImage;
            summary.registration.state = frame == 0 ? RegistrationState::first : RegistrationState::registered;
            if (frame > 0) {
                cv::Matx33d map = imageFromGround(frame) * imageFromGround(frame - 1).inv();
                summary.registration.current_from_previous.matrix = map * (1 / map(2, 2));
            }
            motion_.push_back(summary);
        }
    }

    cv::Matx34d projection(FrameIndex frame) const {
        const double turn = 0.0175 * frame;
        const cv::Vec3d right(std::cos(turn), std::sin(turn), 0);
        const cv::Vec3d back(-std::sin(turn), std::cos(turn), 0);
        const cv::Vec3d down(0, 0, -1);
        const cv::Vec3d view = down * std::cos(tilt_) - back * std::sin(tilt_);
        const cv::Vec3d below = back * std::cos(tilt_) + down * std::sin(tilt_);
        const cv::Vec3d at = back * (60 * std::tan(tilt_)) + cv::Vec3d(0, 0, 60);
        const cv::Matx33d lens(focal_, 0, 499.5, 0, focal_, 299.5, 0, 0, 1);
        const cv::Matx34d pose(right[0], right[1], right[2], -right.dot(at), below[0], below[1], below[2],
                               -below.dot(at), view[0], view[1], view[2], -view.dot(at));
        return lens * pose;
    }
    cv::Matx33d imageFromGround(FrameIndex frame) const {
        const cv::Matx34d p = projection(frame);
        return {p(0, 0), p(0, 1), p(0, 3), p(1, 0), p(1, 1), p(1, 3), p(2, 0), p(2, 1), p(2, 3)};
    }
    cv::Point2f seen(cv::Point3d point, FrameIndex frame) const {
        const cv::Vec3d p = projection(frame) * cv::Vec4d(point.x, point.y, point.z, 1);
        return {static_cast<float>(p[0] / p[2]), static_cast<float>(p[1] / p[2])};
    }

    TrackState stateAt(cv::Point3d from, cv::Point3d step, FrameIndex frame) const {
        TrackState state;
        state.id = 1;
        state.box = {seen(from + step * frame, frame), 20, 10, 0};
        state.status = TrackStatus::confirmed;
        return state;
    }
    /// Whether the track of a point stays that starts somewhere and moves by `step` metres a frame, and that looks like
    /// a vehicle in every frame.
    bool stays(cv::Point3d from, cv::Point3d step, FinishingOptions options = {}) {
        options.min_score = 0;  // judged by its motion alone
        std::vector<TimedState> states;
        for (FrameIndex frame = 0; frame < kFrames; ++frame) states.emplace_back(frame, stateAt(from, step, frame));
        const auto vehicles_at = [&](FrameIndex frame) {
            return std::vector<OrientedBox>{stateAt(from, step, frame).box};
        };
        drops_.clear();
        return !finishTracks(states, motion_, options, kScale, {{}, vehicles_at}, &drops_).empty();
    }
    double heightOf(cv::Point3d from, cv::Point3d step = {0, 0, 0}) const {
        TrackPath path;
        path.id = 1;
        for (FrameIndex frame = 0; frame < kFrames; ++frame) {
            path.states.emplace_back(frame, PathState(stateAt(from, step, frame)));
        }
        const auto implied = impliedHeightOf(path, GroundMotion(motion_));
        return implied ? implied->height : -1;
    }

    std::vector<FrameMotionSummary> motion_;
    std::vector<TimedDrop> drops_;
    double focal_;
    double tilt_;
};

class CirclingWithAWideLens : public Circling {
 protected:
    CirclingWithAWideLens() : Circling(600) {}
};

class CirclingStraightAbove : public Circling {
 protected:
    CirclingStraightAbove() : Circling(800, 0.3) {}
};

TEST_F(Circling, TheHeightOfARoofIsRead) {
    EXPECT_NEAR(heightOf({3, 4, 12}), 0.2, 0.011);
    EXPECT_NEAR(heightOf({-8, 6, 6}), 0.1, 0.011);
    EXPECT_NEAR(heightOf({5, -9, 24}), 0.4, 0.011);
}

TEST_F(Circling, ARoofIsDroppedThoughItLooksLikeAVehicle) {
    EXPECT_FALSE(stays({3, 4, 12}, {0, 0, 0}));
    ASSERT_FALSE(drops_.empty());
    EXPECT_EQ(drops_.front().second.why, TrackDrop::could_stand);
    FinishingOptions options;
    options.standing_height = 0;
    EXPECT_TRUE(stays({3, 4, 12}, {0, 0, 0}, options));
}

TEST_F(Circling, VehiclesThatDriveOnTheGroundStay) {
    EXPECT_TRUE(stays({-12, 5, 0}, {0.4, 0, 0}));
    EXPECT_TRUE(stays({3, -15, 0}, {0, 0.4, 0}));
    EXPECT_TRUE(stays({10, 10, 0}, {-0.3, -0.3, 0}));
}

TEST_F(CirclingWithAWideLens, ARoofIsDroppedJustAsWell) {
    EXPECT_FALSE(stays({3, 4, 12}, {0, 0, 0}));
    EXPECT_TRUE(stays({-12, 5, 0}, {0.4, 0, 0}));
}

TEST_F(CirclingStraightAbove, WhatLooksLikeAVehicleStays) {
    EXPECT_TRUE(stays({3, 4, 12}, {0, 0, 0})) << "from above the camera's way is not told surely";
}

}  // namespace
}  // namespace eyrie
