// When two tracks are fragments of one vehicle, and that it does not matter which way it drives.
#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "core/geometry/angle.h"
#include "tracking/finishing/track_finishing.h"
#include "tracking/frame_summaries.h"

namespace eyrie::track_joining_test {
namespace {

const SceneScale kJoiningScale{0.25, 25, true};  // 3 m/s² are .0192 px/frame²
constexpr int kSeen = 25;                        ///< frames of either fragment

/// A vehicle that is lost and comes back. Velocities and the offset are those of one that drives along +x.
struct Fragments {
    double speed = 2;  ///< px/frame before …
    double later_speed = 2;
    double turn_deg = 0;       ///< … and how the later one is turned
    cv::Point2d offset{0, 0};  ///< px, of where it comes back from where it would be
    int unseen = 8;            ///< frames in between
    cv::Size2d size{20, 10};   ///< px, before …
    cv::Size2d later_size{20, 10};

    bool joined(const FinishingOptions& options, double heading) const {
        const auto turned = [&](cv::Point2d p) {
            return cv::Point2d(std::cos(heading) * p.x - std::sin(heading) * p.y,
                               std::sin(heading) * p.x + std::cos(heading) * p.y);
        };
        const double later_turn = radiansFromDegrees(turn_deg);
        const cv::Point2d velocity = turned({speed, 0});
        const cv::Point2d later = turned(cv::Point2d(std::cos(later_turn), std::sin(later_turn)) * later_speed);
        std::vector<TimedState> states;
        std::vector<FrameMotionSummary> motion;
        const int back = kSeen + unseen;
        for (int frame = 0; frame < back + kSeen; ++frame) {
            motion.push_back(test::summaryOfFrame(frame));
            if (frame >= kSeen && frame < back) continue;
            const bool first = frame < kSeen;
            TrackState state;
            state.id = first ? 1 : 2;
            state.velocity = first ? velocity : later;
            state.box.centre = cv::Point2d(320, 180) + velocity * (std::min(frame, back) - back);
            if (!first) state.box.centre += turned(offset) + later * (frame - back);
            state.box.length = (first ? size : later_size).width;
            state.box.width = (first ? size : later_size).height;
            state.box.heading = heading + (first ? 0 : later_turn);
            state.status = TrackStatus::confirmed;
            state.origin = StateOrigin::detected;
            states.emplace_back(frame, state);
        }
        std::set<TrackId> ids;
        for (const auto& [frame, state] : finishTracks(states, motion, options, kJoiningScale)) ids.insert(state.id);
        return ids.size() == 1;
    }
};

void expectJoined(bool expected, const Fragments& fragments, const FinishingOptions& options = {}) {
    for (const double heading : {0.0, 0.7, kPi / 2, -2.2})
        EXPECT_EQ(fragments.joined(options, heading), expected) << "heading " << heading;
}

}  // namespace

TEST(TrackJoining, aVehicleThatComesBackWhereItIsExpectedIsOne) {
    expectJoined(true, {});
    FinishingOptions short_gap;
    short_gap.join_gap_s = 8 / 25.;
    expectJoined(false, {}, short_gap);
    short_gap.join_gap_s = 9 / 25.;
    expectJoined(true, {}, short_gap);
}

TEST(TrackJoining, itMayBeBesideItsPlaceByADistanceOnTheGroundOrInThePicture) {
    // 1 m and what 3 m/s² make of nine frames: 4 + .78 px.
    FinishingOptions options;
    options.join_distance_m = 1;
    options.join_distance_px = 2;
    for (const cv::Point2d direction : {cv::Point2d(1, 0), {0, 1}, {-0.6, 0.8}}) {
        Fragments fragments;
        fragments.offset = 4.6 * direction;
        expectJoined(true, fragments, options);
        fragments.offset = 5.0 * direction;
        expectJoined(false, fragments, options);
    }
    options.join_distance_px = 10;
    Fragments fragments;
    fragments.offset = {0, 10.6};
    expectJoined(true, fragments, options);
    fragments.offset = {0, 11};
    expectJoined(false, fragments, options);
}

TEST(TrackJoining, speedsMayDifferByAShareOfTheFasterAndWhatIsGainedMeanwhile) {
    // 40 % of the faster one's and .17 px/frame.
    for (const auto& [later, expected] : {std::pair(1.05, true), {1.0, false}, {3.55, true}, {3.7, false}}) {
        Fragments fragments;
        fragments.later_speed = later;
        expectJoined(expected, fragments);
    }
}

TEST(TrackJoining, fastOnesDoNotTurnByMoreThanSixtyDegreesUnseen) {
    FinishingOptions options;
    options.join_gap_s = 4;
    Fragments fragments;
    fragments.speed = fragments.later_speed = 1.5;
    fragments.unseen = 60;
    for (const double side : {-1, 1}) {
        fragments.turn_deg = 55 * side;
        expectJoined(true, fragments, options);
        fragments.turn_deg = 64 * side;
        expectJoined(false, fragments, options);
    }
    fragments.speed = fragments.later_speed = 0.9;
    expectJoined(true, fragments, options);
}

TEST(TrackJoining, areasMayDifferByLittleMoreThanTheDouble) {
    for (const auto& [share, expected] : {std::pair(2.1, true), {2.3, false}, {1 / 2.1, true}, {1 / 2.3, false}}) {
        Fragments fragments;
        fragments.later_size = {20 * std::sqrt(share), 10 * std::sqrt(share)};
        expectJoined(expected, fragments);
    }
}

TEST(TrackJoining, ofTwoThatMightContinueItTheOneThatMovesAlikeDoes) {
    // Both come back 5 px beside the place where they would be, one of them faster.
    FinishingOptions options;
    options.join_distance_m = 3;
    for (const double side : {-1.0, 1.0}) {
        std::vector<TimedState> states;
        std::vector<FrameMotionSummary> motion;
        for (int frame = 0; frame < 60; ++frame) {
            motion.push_back(test::summaryOfFrame(frame));
            for (const TrackId id : {1, 2, 3}) {
                if ((id == 1) != (frame < 25) || (frame >= 25 && frame < 33)) continue;
                TrackState state;
                state.id = id;
                state.velocity = {id == 3 ? 2.5 : 2.0, 0};
                state.box = {{200.0 + 2 * std::min(frame, 33), 180}, 20, 8, 0};
                if (id != 1)
                    state.box.centre += cv::Point2d((frame - 33) * state.velocity.x, id == 2 ? 5 * side : -5 * side);
                state.status = TrackStatus::confirmed;
                state.origin = StateOrigin::detected;
                states.emplace_back(frame, state);
            }
        }
        int later = 0;
        for (const auto& [frame, state] : finishTracks(states, motion, options, kJoiningScale)) {
            if (state.id != 1 || frame < 36) continue;
            ++later;
            EXPECT_GT((state.box.centre.y - 180) * side, 0) << frame;
        }
        EXPECT_EQ(later, 24);
    }
}

TEST(TrackJoining, aFrameThatCouldNotBeRegisteredIsBridgedByItsGuess) {
    std::vector<TimedState> states;
    std::vector<FrameMotionSummary> motion;
    for (int frame = 0; frame < 60; ++frame) {
        motion.push_back(test::summaryOfFrame(frame));
        if (frame >= 25 && frame < 33) continue;
        TrackState state;
        state.id = frame < 25 ? 1 : 2;
        state.velocity = {2, 0};
        state.box = {{200.0 + 2 * frame, 180}, 20, 8, 0};
        state.status = TrackStatus::confirmed;
        state.origin = StateOrigin::detected;
        states.emplace_back(frame, state);
    }
    motion[28].registration.state = RegistrationState::failed;
    std::set<TrackId> ids;
    int between = 0;
    for (const auto& [frame, state] : finishTracks(states, motion, {}, kJoiningScale)) {
        ids.insert(state.id);
        if (frame < 25 || frame >= 33) continue;
        ++between;
        EXPECT_NEAR(state.box.centre.x, 200 + 2 * frame, 1) << frame;
    }
    EXPECT_EQ(ids, std::set<TrackId>{1});
    EXPECT_EQ(between, 8);
}

}  // namespace eyrie::track_joining_test
