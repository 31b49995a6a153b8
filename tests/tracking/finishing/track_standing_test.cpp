#include <gtest/gtest.h>

#include <set>

#include "tracking/finishing/track_finishing.h"

namespace eyrie::track_standing_test {
namespace {

const SceneScale kScale{.gsd_m_per_px = 0.2, .frame_rate_hz = 25, .gsd_known = true};
const cv::Size kImage(1000, 600);

/// A camera that flies on over the ground, which so moves by `flow_px` a frame to the right through the picture.
class Standing : public testing::Test {
 protected:
    explicit Standing(double flow_px = 2) {
        for (FrameIndex frame = 0; frame < kFrames; ++frame) {
            FrameMotionSummary summary;
            summary.frame = frame;
            summary.image_size = kImage;
            summary.registration.state = frame == 0 ? RegistrationState::first : RegistrationState::registered;
            summary.registration.current_from_previous.matrix(0, 2) = frame == 0 ? 0 : flow_px;
            motion_.push_back(summary);
        }
        flow_px_ = flow_px;
    }

    /// Whether a track stays that moves by `own` px/frame over the ground.
    bool stays(cv::Point2d own, const ClassifiedAt& classified_at, FinishingOptions options = {}) {
        options.min_score = 0;  // judged by its motion alone
        std::vector<TimedState> states;
        for (FrameIndex frame = 0; frame < kFrames; ++frame) {
            TrackState state;
            state.id = 1;
            state.box = {place(own, frame), 20, 10, 0};
            state.velocity = own;
            state.status = TrackStatus::confirmed;
            states.emplace_back(frame, state);
        }
        drops_.clear();
        return !finishTracks(states, motion_, options, scale_, {{}, classified_at}, &drops_).empty();
    }
    cv::Point2d place(cv::Point2d own, FrameIndex frame) const {
        return {300 + (flow_px_ + own.x) * frame, 300 + own.y * frame};
    }

    static std::vector<ClassifiedBox> none(FrameIndex) { return {}; }
    static constexpr int kFrames = 60;
    std::vector<FrameMotionSummary> motion_;
    std::vector<TimedDrop> drops_;
    SceneScale scale_ = kScale;
    double flow_px_;
};

class UnderHoveringCamera : public Standing {
 protected:
    UnderHoveringCamera() : Standing(0.05) {}
};

TEST_F(Standing, AThingOfAFifthOfTheFlightHeightMovesAQuarterOfTheFlowAndIsDropped) {
    EXPECT_FALSE(stays({0.5, 0}, none));
    ASSERT_FALSE(drops_.empty());
    EXPECT_EQ(drops_.front().second.why, TrackDrop::could_stand);
}

TEST_F(Standing, FasterThanAnythingStandingAlongTheFlowStays) {
    EXPECT_FALSE(stays({0.9, 0}, none)) << "a third of the flight height moves half of the flow";
    EXPECT_TRUE(stays({1.2, 0}, none));
}

TEST_F(Standing, AgainstTheFlowSlowerOnesAreDroppedAndAcrossItNone) {
    EXPECT_TRUE(stays({-0.9, 0}, none));
    EXPECT_FALSE(stays({-0.4, 0}, none)) << "the plane of the registration may lie above the ground";
    EXPECT_TRUE(stays({0, 0.6}, none));
    EXPECT_FALSE(stays({0, 0.3}, none)) << "that slow in every window it never moved";
}

TEST_F(Standing, WhatTheClassifierTookForAVehicleStays) {
    const cv::Point2d own(0.5, 0);
    EXPECT_TRUE(stays(own, [&](FrameIndex frame) {
        return frame == 30 ? std::vector<ClassifiedBox>{{{place(own, frame), 22, 11, 0}, true}}
                           : std::vector<ClassifiedBox>{};
    }));
    EXPECT_FALSE(stays(own, [&](FrameIndex frame) {
        return std::vector<ClassifiedBox>{{{place(own, frame) + cv::Point2d(40, 0), 22, 11, 0}, true}};
    })) << "another vehicle speaks for nobody else";
}

TEST_F(Standing, WithoutAClassifierNothingIsDropped) {
    EXPECT_TRUE(stays({0.5, 0}, {}));
}

TEST_F(Standing, HeightsOfZeroDropNothing) {
    FinishingOptions options;
    options.standing_height = 0;
    options.standing_depth = 0;
    EXPECT_TRUE(stays({0.5, 0}, none, options));
}

TEST_F(UnderHoveringCamera, NothingStandingMoves) {
    EXPECT_TRUE(stays({0.5, 0}, none));
}

TEST_F(UnderHoveringCamera, WhatRisesAboveTheHorizonIsDroppedWhateverItLooksLike) {
    const cv::Point2d own(0, 1);  // from y = 300 to 359
    const auto like_a_vehicle = [&](FrameIndex frame) {
        return std::vector<ClassifiedBox>{{{place(own, frame), 22, 11, 0}, true}};
    };
    // A horizon at y = 350, surely at 340: 35 of 60 boxes lie above that, and 25 when it is 10 px higher.
    scale_.slope = {0, 0.01, 500, 450};
    EXPECT_FALSE(stays(own, like_a_vehicle));
    ASSERT_FALSE(drops_.empty());
    EXPECT_EQ(drops_.front().second.why, TrackDrop::could_stand);
    scale_.slope.centre_y = 440;
    EXPECT_TRUE(stays(own, like_a_vehicle));
    FinishingOptions options;
    options.standing_height = 0;
    scale_.slope.centre_y = 450;
    EXPECT_TRUE(stays(own, like_a_vehicle, options));
}

}  // namespace
}  // namespace eyrie::track_standing_test
