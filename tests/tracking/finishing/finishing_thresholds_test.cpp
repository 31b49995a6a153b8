#include <gtest/gtest.h>

#include <cmath>
#include <optional>
#include <set>

#include "tracking/finishing/track_finishing.h"
#include "tracking/frame_summaries.h"

namespace eyrie::finishing_thresholds_test {
namespace {

const SceneScale kScale{0.25, 25, true};

/// Nothing but what the thesis does, with one parameter set by its name.
FinishingOptions onlyWith(const std::string& name, const std::string& value) {
    FinishingOptions options = FinishingOptions::thesis();
    options.join_gap_s = 1;
    setParameter(describeOf(options), name, value);
    return options;
}

std::vector<TimedState> finished(const std::vector<TimedState>& states, const FinishingOptions& options) {
    std::vector<FrameMotionSummary> summaries;
    for (int frame = 0; frame < 200; ++frame) summaries.push_back(test::summaryOfFrame(frame));
    return finishTracks(states, summaries, options, kScale);
}

/// A car of 20 × 10 px that drives to the right.
TimedState driving(int frame, TrackId id = 1, double beside = 0) {
    TrackState state;
    state.id = id;
    state.box = {{100 + 2.0 * frame, 100 + beside}, 20, 10, 0};
    state.velocity = {2, 0};
    state.status = TrackStatus::confirmed;
    state.origin = StateOrigin::detected;
    return {frame, state};
}

/// Whether a track goes on in one that begins `gap` frames later and `beside` px beside it.
bool areJoined(int gap, double beside, const FinishingOptions& options) {
    std::vector<TimedState> states;
    for (int frame = 0; frame < 20; ++frame) states.push_back(driving(frame));
    for (int frame = 19 + gap; frame < 60; ++frame) states.push_back(driving(frame, 2, beside));
    std::set<TrackId> ids;
    for (const auto& [frame, state] : finished(states, options)) ids.insert(state.id);
    return ids.size() == 1;
}

}  // namespace

TEST(FinishingThresholds, KeepTentativeKeepsWhatCameBeforeTheConfirmation) {
    std::vector<TimedState> states;
    for (int frame = 0; frame < 10; ++frame) {
        states.push_back(driving(frame));
        if (frame < 4) states.back().second.status = TrackStatus::tentative;
    }
    EXPECT_EQ(finished(states, onlyWith("finishing.keep_tentative", "true")).front().first, 0);
    EXPECT_EQ(finished(states, onlyWith("finishing.keep_tentative", "false")).front().first, 4);
}

TEST(FinishingThresholds, JoinDistanceIsHowFarFromItsWayATrackMayGoOn) {
    // 8 px are 2 m; a vehicle may have got off its way by 0.04 px in two frames and by 4.3 px in 21.
    EXPECT_FALSE(areJoined(2, 8, onlyWith("finishing.join_distance_m", "1.95")));
    EXPECT_TRUE(areJoined(2, 8, onlyWith("finishing.join_distance_m", "2.05")));
    EXPECT_FALSE(areJoined(2, 8, onlyWith("finishing.join_distance_m", "1.5")));
    EXPECT_TRUE(areJoined(21, 8, onlyWith("finishing.join_distance_m", "1.5"))) << "it grows with the gap";
    // The larger of the two counts.
    FinishingOptions in_pixels = onlyWith("finishing.join_distance_px", "7.9");
    EXPECT_FALSE(areJoined(2, 8, in_pixels));
    setParameter(describeOf(in_pixels), "finishing.join_distance_px", "8.1");
    EXPECT_TRUE(areJoined(2, 8, in_pixels));
    EXPECT_FALSE(areJoined(2, 8, onlyWith("finishing.join_distance_px", "3")));
    in_pixels = onlyWith("finishing.join_distance_m", "2.05");
    in_pixels.join_distance_px = 0;
    EXPECT_TRUE(areJoined(2, 8, in_pixels));
}

TEST(FinishingThresholds, ExtendEntryIsHowLongAgoATrackMayHaveComeIn) {
    // Seen from frame 15 on; half of it was in the image from frame 5 on, and less than that eleven frames before.
    std::vector<TimedState> states;
    for (int frame = 15; frame < 60; ++frame) {
        states.push_back(driving(frame));
        states.back().second.box.centre.x = 2.0 * (frame - 5);
    }
    EXPECT_EQ(finished(states, onlyWith("finishing.extend_entry", "0.48")).front().first, 5);
    EXPECT_EQ(finished(states, onlyWith("finishing.extend_entry", "0.4")).front().first, 15) << "longer ago";
    EXPECT_EQ(finished(states, onlyWith("finishing.extend_entry", "0")).front().first, 15);
}

TEST(FinishingThresholds, JoinPartsMakesOneVehicleOfFrontAndRear) {
    std::vector<TimedState> states;
    for (int frame = 0; frame < 40; ++frame) {
        states.push_back(driving(frame));
        states.back().second.box.length = 16;
        states.push_back(driving(frame, 2));
        states.back().second.box.length = 12;
        states.back().second.box.centre.x -= 14;
    }
    const auto whole = finished(states, onlyWith("finishing.join_parts", "true"));
    ASSERT_EQ(whole.size(), 40U);
    for (const auto& [frame, state] : whole) EXPECT_NEAR(state.box.length, 28, 1e-3) << frame;
    EXPECT_EQ(finished(states, onlyWith("finishing.join_parts", "false")).size(), 80U);
}

TEST(FinishingThresholds, SizeWindowIsHowMuchOfALifeHasASayInASize) {
    // 20 px long for two seconds, 26 px for four: seen from the beginning, half a window of four seconds is even.
    std::vector<TimedState> states;
    for (int frame = 0; frame < 150; ++frame) {
        states.push_back(driving(frame));
        if (frame >= 50) states.back().second.box.length = 26;
    }
    for (const auto& [value, length] : {std::pair("3", 20), {"7.6", 20}, {"8.4", 26}}) {
        FinishingOptions options = onlyWith("finishing.size_window", value);
        options.constant_size = true;
        EXPECT_NEAR(finished(states, options).front().second.box.length, length, 1e-4) << value;
    }
}

TEST(FinishingThresholds, SmoothWindowIsHowWideTheFitsAre) {
    // One state lies beside the way: it moves those up to half the width before and after.
    constexpr int kBeside = 60;
    std::vector<TimedState> states;
    for (int frame = 0; frame < 120; ++frame) states.push_back(driving(frame, 1, frame == kBeside ? 1 : 0));
    for (const auto& [value, half] : {std::pair("0.4", 5), {"2", 25}}) {
        FinishingOptions options = onlyWith("finishing.smooth_window", value);
        options.smooth_path = true;
        int first = kBeside, last = kBeside;
        for (const auto& [frame, state] : finished(states, options)) {
            if (std::abs(state.box.centre.y - 100) < 1e-6) continue;
            first = std::min(first, frame);
            last = std::max(last, frame);
        }
        EXPECT_EQ(first, kBeside - half) << value;
        EXPECT_EQ(last, kBeside + half) << value;
    }
}

}  // namespace eyrie::finishing_thresholds_test
