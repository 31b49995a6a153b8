#include <gtest/gtest.h>

#include <map>
#include <set>

#include "tracking/finishing/track_finishing.h"
#include "tracking/finishing/track_paths.h"
#include "tracking/frame_summaries.h"

namespace eyrie::track_shadows_test {
namespace {

const SceneScale kScale{0.3, 25, true};
constexpr int kFrames = 60;

/// Tracks over flat ground under a camera that stands still.
class Road {
 public:
    /// A box that drives at `speed` (px/frame), `beside` (px) a vehicle that starts at x = 100; every `detected_every`
    /// frames it is a detection, otherwise `otherwise`.
    void add(TrackId id, cv::Point2d beside, cv::Size2d size, double speed, int first, int last, int detected_every,
             StateOrigin otherwise = StateOrigin::reconstructed) {
        for (int frame = first; frame <= last; ++frame) {
            TrackState state;
            state.id = id;
            state.box = {{100 + speed * frame + beside.x, 150 + beside.y}, size.width, size.height, 0};
            state.velocity = {speed, 0};
            state.status = TrackStatus::confirmed;
            const bool detected = (frame - first) % detected_every == 0;
            state.origin = detected ? StateOrigin::detected : otherwise;
            states_.emplace_back(frame, state);
        }
    }

    std::set<TrackId> finished(const FinishingOptions& options = {}, std::vector<TimedDrop>* dropped = nullptr,
                               const SceneScale& scale = kScale) const {
        std::vector<FrameMotionSummary> motion;
        for (int frame = 0; frame < kFrames; ++frame) motion.push_back(test::summaryOfFrame(frame));
        std::set<TrackId> ids;
        for (const auto& [frame, state] : finishTracks(states_, motion, options, scale, {}, dropped))
            ids.insert(state.id);
        return ids;
    }

 private:
    std::vector<TimedState> states_;
};

constexpr double kSpeed = 1.5;  ///< px/frame, 11 m/s
const cv::Size2d kCar{15, 6};
const cv::Size2d kShadow{12, 5};

TEST(DropShadows, OneThatTouchesAVehicleAndMovesAsItDoesGoes) {
    Road road;
    road.add(1, {0, 0}, kCar, kSpeed, 0, 59, 1);
    road.add(2, {3, 5.8}, kShadow, kSpeed, 10, 50, 3, StateOrigin::predicted);
    EXPECT_EQ(road.finished(), std::set<TrackId>{1});
    FinishingOptions options;
    options.drop_shadows = false;
    EXPECT_EQ(road.finished(options), (std::set<TrackId>{1, 2}));
}

TEST(DropShadows, AVehicleInTheNextLaneStays) {
    Road road;
    road.add(1, {0, 0}, kCar, kSpeed, 0, 59, 1);
    road.add(2, {3, 10}, kCar, kSpeed, 10, 50, 3, StateOrigin::predicted);
    EXPECT_EQ(road.finished().size(), 2U);
}

TEST(DropShadows, WhatIsDetectedAsWellAsTheVehicleStays) {
    Road road;
    road.add(1, {0, 0}, kCar, kSpeed, 0, 59, 1);
    road.add(2, {3, 5.8}, kShadow, kSpeed, 10, 50, 1);
    EXPECT_EQ(road.finished().size(), 2U);
}

TEST(DropShadows, WhatOvertakesStays) {
    Road road;
    road.add(1, {0, 0}, kCar, kSpeed, 0, 59, 1);
    road.add(2, {-8, 5.8}, kShadow, 1.25 * kSpeed, 10, 50, 3, StateOrigin::predicted);
    EXPECT_EQ(road.finished().size(), 2U);
}

TEST(DropShadows, SlowTrafficStays) {
    Road road;
    road.add(1, {0, 0}, kCar, 0.25, 0, 59, 1);  // 1.9 m/s
    road.add(2, {3, 5.8}, kShadow, 0.25, 10, 50, 3, StateOrigin::predicted);
    EXPECT_EQ(road.finished().size(), 2U);
}

TEST(DropHardlyDetected, ATrackGuessedRatherThanSeenGoes) {
    Road road;
    road.add(1, {0, 0}, kCar, kSpeed, 0, 59, 1);
    road.add(2, {0, 60}, kCar, kSpeed, 10, 34, 3);  // 9 of 25 frames
    EXPECT_EQ(road.finished(), std::set<TrackId>{1});
    FinishingOptions options;
    options.min_detected = 0.3;
    EXPECT_EQ(road.finished(options), (std::set<TrackId>{1, 2}));
}

TEST(DropTooSmall, SizesCountWhereTheScaleIsEstimatedButNotWhereItIsAssumed) {
    Road road;
    road.add(1, {0, 0}, kCar, kSpeed, 0, 59, 1);
    road.add(2, {0, -60}, {4, 2}, kSpeed, 0, 59, 1);   // 1.2 m at .3 m/px
    road.add(3, {0, 60}, {5.4, 3}, kSpeed, 0, 59, 1);  // 1.62 m: too small for sure only where the scale is sure
    EXPECT_EQ(road.finished(), std::set<TrackId>{1});
    EXPECT_EQ(road.finished({}, nullptr, {0.3, 25, false}), (std::set<TrackId>{1, 3}));
    EXPECT_EQ(road.finished({}, nullptr, SceneScale{}), (std::set<TrackId>{1, 2, 3}));
}

TEST(DropWiderThanLong, WhatStaysAFifthWiderThanLongIsNoVehicle) {
    Road road;
    road.add(1, {0, 0}, kCar, kSpeed, 0, 59, 1);
    road.add(2, {0, -60}, {10, 12.5}, kSpeed, 0, 59, 1);  // as a rider from the side
    road.add(3, {0, 60}, {10, 11.5}, kSpeed, 0, 59, 1);   // as a car from behind
    std::vector<TimedDrop> dropped;
    EXPECT_EQ(road.finished({}, &dropped), (std::set<TrackId>{1, 3}));
    ASSERT_FALSE(dropped.empty());
    EXPECT_EQ(dropped.front().second.why, TrackDrop::wider_than_long);
    EXPECT_EQ(road.finished({}, nullptr, SceneScale{}), (std::set<TrackId>{1, 3})) << "whatever the scale";
    FinishingOptions options;
    options.max_aspect = 1.3;
    EXPECT_EQ(road.finished(options), (std::set<TrackId>{1, 2, 3}));
    options.max_aspect = 1.1;
    EXPECT_EQ(road.finished(options), std::set<TrackId>{1});
    options.max_aspect = 0;
    EXPECT_EQ(road.finished(options), (std::set<TrackId>{1, 2, 3}));
}

TEST(DropWiderThanLong, ItIsSoInMostOfItsLifeHoweverWideItIsMeanwhile) {
    const auto kept = [](int wide_states) {
        TrackPath path{1, {}};
        for (int frame = 0; frame < 11; ++frame) {
            PathState state;
            state.box = OrientedBox{{0, 0}, 10, frame < wide_states ? 50.0 : 5.0, 0};
            path.states.emplace_back(frame, state);
        }
        std::vector<TrackPath> paths{path};
        DropList dropped;
        dropWiderThanLong(paths, 1.2, dropped);
        EXPECT_EQ(dropped.size(), 1 - paths.size());
        return !paths.empty();
    };
    EXPECT_TRUE(kept(5));
    EXPECT_FALSE(kept(6));
}

TEST(DroppedTracks, AreToldWithTheirReason) {
    Road road;
    road.add(1, {0, 0}, kCar, kSpeed, 0, 59, 1);
    road.add(2, {3, 5.8}, kShadow, kSpeed, 10, 50, 3, StateOrigin::predicted);
    road.add(3, {0, 60}, kCar, kSpeed, 10, 34, 3);
    road.add(4, {0, -60}, {4, 2}, kSpeed, 0, 59, 1);
    road.add(5, {2, 1}, kCar, kSpeed, 20, 40, 1);
    std::vector<TimedDrop> dropped;
    EXPECT_EQ(road.finished({}, &dropped), std::set<TrackId>{1});
    std::map<TrackId, std::vector<TimedDrop>> by_track;
    for (const TimedDrop& drop : dropped) by_track[drop.second.id].push_back(drop);
    ASSERT_EQ(by_track.size(), 4U);
    EXPECT_EQ(by_track[2].front().second.why, TrackDrop::shadow);
    EXPECT_EQ(by_track[2].front().second.beside, 1);
    EXPECT_EQ(by_track[2].size(), 40U) << "the frame predicted at its end is trimmed";
    EXPECT_EQ(by_track[3].front().second.why, TrackDrop::hardly_detected);
    EXPECT_EQ(by_track[4].front().second.why, TrackDrop::too_small);
    EXPECT_EQ(by_track[5].front().second.why, TrackDrop::shares_place);
    EXPECT_EQ(by_track[5].front().second.beside, 1);
    EXPECT_EQ(by_track[5].front().first, 20);
    EXPECT_EQ(textOf(by_track[5].front().second), "track 5 lies on track 1, which was detected more often");
}

TEST(DropHardlyDetected, PredictedFramesDoNotCountAgainstATrack) {
    Road road;
    road.add(1, {0, 60}, kCar, kSpeed, 10, 34, 3, StateOrigin::predicted);
    EXPECT_EQ(road.finished(), std::set<TrackId>{1});
}

TEST(DropHardlyDetected, FourTenthsOfASecondOfDetectionsAreEnough) {
    Road road;
    road.add(1, {0, 60}, kCar, kSpeed, 0, 59, 4);  // 15 of 60 frames
    EXPECT_EQ(road.finished(), std::set<TrackId>{1});
}

}  // namespace
}  // namespace eyrie::track_shadows_test
