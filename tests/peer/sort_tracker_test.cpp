#include "peer/sort/sort_tracker.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/error.h"
#include "peer/peer_options.h"

namespace eyrie::sort_tracker_test {
namespace {

const SortOptions kQuick{0.3, 3, 2};

Homography stillCamera() {
    return {};
}

Homography shiftedBy(double x, double y) {
    Homography map;
    map.matrix(0, 2) = x;
    map.matrix(1, 2) = y;
    return map;
}

OrientedBox boxAt(double x, double y, double length = 20, double width = 10) {
    return {{x, y}, length, width, 0};
}

/// The id of the track at a place; 0 where none is.
TrackId idAt(const std::vector<TrackState>& states, const OrientedBox& box) {
    for (const TrackState& state : states) {
        if (overlap(state.box, box) > 0.5) return state.id;
    }
    return 0;
}

}  // namespace

TEST(SortTracker, BoxesInARowConfirmATrack) {
    SortTracker tracker(kQuick);
    EXPECT_TRUE(tracker.next({}, stillCamera()).empty());
    std::vector<TrackStatus> seen;
    for (int i = 0; i < 4; ++i) {
        const auto states = tracker.next({boxAt(50 + 3 * i, 40)}, stillCamera());
        ASSERT_EQ(states.size(), 1U);
        EXPECT_EQ(states[0].id, 1);
        EXPECT_EQ(states[0].age, i);
        EXPECT_EQ(states[0].hits, i + 1);
        EXPECT_EQ(states[0].origin, StateOrigin::detected);
        seen.push_back(states[0].status);
    }
    EXPECT_THAT(seen, testing::ElementsAre(TrackStatus::tentative, TrackStatus::tentative, TrackStatus::confirmed,
                                           TrackStatus::confirmed));
}

TEST(SortTracker, BoxesWithGapsConfirmNothing) {
    SortTracker tracker(kQuick);
    for (int i = 0; i < 20; ++i) {
        std::vector<OrientedBox> boxes;
        if (i % 3 != 2) boxes.push_back(boxAt(50, 40));
        for (const TrackState& state : tracker.next(boxes, stillCamera()))
            EXPECT_EQ(state.status, TrackStatus::tentative) << i;
    }
}

TEST(SortTracker, AMissIsPredictedAndTheTrackTakenUpAgain) {
    SortTracker tracker(kQuick);
    for (int i = 0; i < 12; ++i) tracker.next({boxAt(50 + 4 * i, 40)}, stillCamera());
    for (int i = 12; i < 14; ++i) {
        const auto states = tracker.next({}, stillCamera());
        ASSERT_EQ(states.size(), 1U);
        EXPECT_EQ(states[0].status, TrackStatus::coasting);
        EXPECT_EQ(states[0].origin, StateOrigin::predicted);
        EXPECT_NEAR(states[0].box.centre.x, 50 + 4 * i, 0.5);
        EXPECT_NEAR(states[0].velocity.x, 4, 0.1);
        EXPECT_NEAR(states[0].box.length, 20, 0.5);
        EXPECT_NEAR(states[0].box.width, 10, 0.5);
    }
    const auto states = tracker.next({boxAt(50 + 4 * 14, 40)}, stillCamera());
    ASSERT_EQ(states.size(), 1U);
    EXPECT_EQ(states[0].id, 1);
    EXPECT_EQ(states[0].status, TrackStatus::confirmed);
    EXPECT_NEAR(states[0].score, 13.0 / 15, 1e-12);
}

TEST(SortTracker, ATrackMissedForTooLongEndsAndItsIdIsNotUsedAgain) {
    SortTracker tracker(kQuick);
    for (int i = 0; i < 5; ++i) tracker.next({boxAt(50, 40)}, stillCamera());
    EXPECT_EQ(tracker.next({}, stillCamera()).size(), 1U);
    EXPECT_EQ(tracker.next({}, stillCamera()).size(), 1U);
    EXPECT_TRUE(tracker.next({}, stillCamera()).empty());
    const auto states = tracker.next({boxAt(50, 40)}, stillCamera());
    ASSERT_EQ(states.size(), 1U);
    EXPECT_EQ(states[0].id, 2);
    tracker.clear();
    EXPECT_TRUE(tracker.next({}, stillCamera()).empty());
}

TEST(SortTracker, VehiclesThatCrossKeepTheirIds) {
    SortTracker tracker(kQuick);
    TrackId across = 0;
    TrackId down = 0;
    for (int i = 0; i < 40; ++i) {
        const OrientedBox a = boxAt(20 + 4 * i, 60);
        const OrientedBox b = boxAt(100, -20 + 4 * i, 10, 20);
        // The order of boxes must not matter.
        const auto states = tracker.next(i % 2 == 0 ? std::vector{a, b} : std::vector{b, a}, stillCamera());
        ASSERT_EQ(states.size(), 2U) << i;
        if (i == 5) {
            across = idAt(states, a);
            down = idAt(states, b);
        }
    }
    const auto states = tracker.next({boxAt(180, 60), boxAt(100, 140, 10, 20)}, stillCamera());
    EXPECT_EQ(idAt(states, boxAt(180, 60)), across);
    EXPECT_EQ(idAt(states, boxAt(100, 140, 10, 20)), down);
    EXPECT_NE(across, down);
}

TEST(SortTracker, TheLargestSumOfOverlapsDecides) {
    SortTracker tracker({0.1, 1, 2});
    tracker.next({boxAt(50, 40), boxAt(63, 40)}, stillCamera());
    // The first box overlaps the second track most; taken by it, nothing would be left for the other box.
    const auto states = tracker.next({boxAt(58, 40), boxAt(72, 40)}, stillCamera());
    ASSERT_EQ(states.size(), 2U);
    EXPECT_EQ(states[0].origin, StateOrigin::detected);
    EXPECT_EQ(states[1].origin, StateOrigin::detected);
    EXPECT_LT(states[0].box.centre.x, states[1].box.centre.x);
}

TEST(SortTracker, PredictionsMoveWithTheGround) {
    SortTracker tracker(kQuick);
    // The camera pans by more than a box a frame; the vehicle stands.
    for (int i = 0; i < 10; ++i) {
        const auto states = tracker.next({boxAt(400 - 30 * i, 40)}, shiftedBy(-30, 0));
        ASSERT_EQ(states.size(), 1U) << i;
        EXPECT_EQ(states[0].id, 1);
        EXPECT_NEAR(states[0].velocity.x, 0, 1e-6);
    }
    // It comes nearer.
    Homography nearer;
    nearer.matrix(0, 0) = nearer.matrix(1, 1) = 2;
    const auto states = tracker.next({}, nearer);
    ASSERT_EQ(states.size(), 1U);
    EXPECT_NEAR(states[0].box.centre.x, 2 * (400 - 30 * 9), 1);
    EXPECT_NEAR(states[0].box.length, 40, 0.5);
}

TEST(SortTracker, BoxesAreTakenAsUprightAndEmptyOnesLeftOut) {
    SortTracker tracker(kQuick);
    const auto states = tracker.next({{{50, 40}, 20, 10, 1.5707963267948966}, boxAt(90, 40, 0, 10)}, stillCamera());
    ASSERT_EQ(states.size(), 1U);
    EXPECT_NEAR(states[0].box.length, 10, 1e-9);
    EXPECT_NEAR(states[0].box.width, 20, 1e-9);
    EXPECT_EQ(states[0].box.heading, 0);
}

TEST(SortTracker, ASingularMapLeavesTracksWhereTheyWere) {
    SortTracker tracker(kQuick);
    tracker.next({boxAt(50, 40)}, stillCamera());
    Homography singular;
    singular.matrix = cv::Matx33d::zeros();
    const auto states = tracker.next({boxAt(50, 40)}, singular);
    ASSERT_EQ(states.size(), 1U);
    EXPECT_NEAR(states[0].box.centre.x, 50, 1e-6);
}

TEST(PeerOptions, AreDeclaredOnceAndRefuseWhatMakesNoSense) {
    PeerOptions options;
    const auto declared = listParameters(describeOf(options));
    EXPECT_LE(declared.size(), 10U) << "a handful";
    for (const Parameter& parameter : declared) {
        EXPECT_TRUE(parameter.name.starts_with("peer.")) << parameter.name;
        EXPECT_EQ(parameter.effect.stage, ChainStage::none);
        EXPECT_FALSE(parameter.text.help.empty());
    }
    setParameter(describeOf(options), "peer.min_hits", "7");
    EXPECT_EQ(options.sort.min_hits, 7);
    for (const auto& [name, value] : std::vector<std::pair<std::string, std::string>>{{"peer.gap", "0"},
                                                                                      {"peer.threshold", "-1"},
                                                                                      {"peer.min_overlap", "0"},
                                                                                      {"peer.max_age", "many"},
                                                                                      {"peer.magic", "1"}}) {
        EXPECT_THROW(setParameter(describeOf(options), name, value), Error) << name;
    }
}

}  // namespace eyrie::sort_tracker_test
