#include <gtest/gtest.h>

#include <set>

#include "tracking/finishing/track_finishing.h"

namespace eyrie::track_graphics_test {
namespace {

const SceneScale kScale{.gsd_m_per_px = 0.2, .frame_rate_hz = 25, .gsd_known = true};
const cv::Size kImage(400, 300);
constexpr int kFrames = 50;

/// A track that stays in the picture about a place while the ground goes on by 2 px a frame, and one that drives.
std::vector<TimedState> statesWith(cv::Point2d place, cv::Point2d per_frame) {
    std::vector<TimedState> states;
    for (FrameIndex frame = 0; frame < kFrames; ++frame) {
        TrackState state;
        state.id = 1;
        state.box = {place + per_frame * frame, 20, 10, 0};
        state.velocity = per_frame - cv::Point2d(2, 0);
        state.status = TrackStatus::confirmed;
        states.emplace_back(frame, state);
    }
    return states;
}

/// Text in the upper left corner, 120 × 20 px.
FoundInFrames withText() {
    FoundInFrames found;
    found.graphics = {cv::Mat::zeros(kImage.height / 2, kImage.width / 2, CV_8UC1), 2};
    found.graphics.cells(cv::Rect(5, 5, 60, 10)).setTo(255);
    return found;
}

std::vector<TimedDrop> droppedOf(const std::vector<TimedState>& states, const FoundInFrames& found,
                                 std::size_t& finished) {
    std::vector<FrameMotionSummary> motion;
    for (FrameIndex frame = 0; frame < kFrames; ++frame) {
        FrameMotionSummary summary;
        summary.frame = frame;
        summary.image_size = kImage;
        summary.registration.state = frame == 0 ? RegistrationState::first : RegistrationState::registered;
        summary.registration.current_from_previous.matrix(0, 2) = frame == 0 ? 0 : 2;
        motion.push_back(summary);
    }
    std::vector<TimedDrop> dropped;
    finished = finishTracks(states, motion, {}, kScale, found, &dropped).size();
    return dropped;
}

}  // namespace

TEST(TracksOnGraphics, AreLeftOutAndSayWhy) {
    std::size_t finished = 0;
    const auto dropped = droppedOf(statesWith({60, 20}, {0.1, 0}), withText(), finished);
    EXPECT_EQ(finished, 0U);
    ASSERT_FALSE(dropped.empty());
    EXPECT_EQ(dropped.front().second.why, TrackDrop::on_graphics);
    EXPECT_EQ(textOf(dropped.front().second), "track 1 is text or a mark that is drawn into the picture");
    EXPECT_STREQ(parameterOf(TrackDrop::on_graphics), "registration.leave_out_graphics");
}

TEST(TracksOnGraphics, AreNotThoseThatPassBelowThemOrBesideThem) {
    std::size_t finished = 0;
    droppedOf(statesWith({60, 50}, {0.1, 0}), withText(), finished);
    EXPECT_GT(finished, 0U) << "beside";
    droppedOf(statesWith({60, 8}, {0, 4}), withText(), finished);
    EXPECT_GT(finished, 0U) << "it drives on from below the text";
    droppedOf(statesWith({60, 20}, {0.1, 0}), {}, finished);
    EXPECT_GT(finished, 0U) << "no graphics are known";
}

}  // namespace eyrie::track_graphics_test
