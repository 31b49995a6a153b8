// Two tracks in one place, and tracks over several others.
#include <gtest/gtest.h>

#include "tracking/made_tracks.h"

namespace eyrie::track_duplicates_test {
namespace {

using test::carAt;
using test::kSlow;
using test::managerWith;
using test::trackAt;

bool duplicates(const OrientedBox& box, cv::Point2d velocity, const Track& track, const TrackerOptions& options,
                double slow_speed = kSlow) {
    std::vector<Track> tracks{track};
    return managerWith(options).wouldDuplicate(box, velocity, tracks, slow_speed);
}

/// Of two boxes that move alike the overlap and the containment decide, not their common size.
TrackerOptions byOverlap() {
    TrackerOptions options;
    options.one_vehicle = 0;
    return options;
}

}  // namespace

TEST(TrackManager, BoxesAreDuplicatesByTheirOverlapOrContainment) {
    const TrackerOptions options = byOverlap();
    const Track track = carAt({300, 200}, {2, 0});
    // (20 − d) / (20 + d) = .4 along, (10 − d) / (10 + d) = .4 across.
    for (const double side : {-1.0, 1.0}) {
        EXPECT_TRUE(duplicates({{300 + 8.5 * side, 200}, 20, 10, 0}, {2, 0}, track, options));
        EXPECT_FALSE(duplicates({{300 + 8.65 * side, 200}, 20, 10, 0}, {2, 0}, track, options));
        EXPECT_TRUE(duplicates({{300, 200 + 4.2 * side}, 20, 10, 0}, {2, 0}, track, options));
        EXPECT_FALSE(duplicates({{300, 200 + 4.35 * side}, 20, 10, 0}, {2, 0}, track, options));
        // A piece of 4 × 4 px, .7 of which lie inside.
        EXPECT_TRUE(duplicates({{300 + 9.15 * side, 200}, 4, 4, 0}, {2, 0}, track, options));
        EXPECT_FALSE(duplicates({{300 + 9.25 * side, 200}, 4, 4, 0}, {2, 0}, track, options));
    }
}

TEST(TrackManager, BoxesThatTogetherAreNoLargerThanACarAreDuplicates) {
    // 1.3 times 22.5 × 9 px and 3: 32.25 × 14.7.
    const auto duplicate = [](double along, double across) {
        return duplicates({{300 + along, 200 + across}, 16, 10, 0}, {2, 0}, trackAt({{300, 200}, 16, 10, 0}, {2, 0}),
                          TrackerOptions{});
    };
    EXPECT_TRUE(duplicate(16.2, 0));
    EXPECT_FALSE(duplicate(16.3, 0));
    EXPECT_TRUE(duplicate(0, 4.65));
    EXPECT_FALSE(duplicate(0, 4.75));
}

TEST(TrackManager, DuplicatesMoveAlike) {
    const TrackerOptions options = byOverlap();
    const OrientedBox box{{300, 200}, 20, 10, 0};
    const Track track = trackAt(box, {2, 0});
    // By .3 of the faster one's speed.
    EXPECT_TRUE(duplicates(box, {1.41, 0}, track, options));
    EXPECT_FALSE(duplicates(box, {1.39, 0}, track, options));
    EXPECT_TRUE(duplicates(box, {2.85, 0}, track, options));
    EXPECT_FALSE(duplicates(box, {2.87, 0}, track, options));
    EXPECT_TRUE(duplicates(box, {2, 0.6}, track, options));
    EXPECT_FALSE(duplicates(box, {2, -0.65}, track, options));
    EXPECT_FALSE(duplicates(box, {-2, 0}, track, options));
    const Track slow = trackAt(box, {0.05, 0});
    EXPECT_TRUE(duplicates(box, {-0.04, 0}, slow, options, 0.1));
    EXPECT_FALSE(duplicates(box, {-0.06, 0}, slow, options, 0.1));
}

TEST(TrackManager, OnlyTracksWithEvidenceKeepOthersFromStarting) {
    TrackerOptions options;
    const OrientedBox box{{300, 200}, 20, 10, 0};
    Track track = trackAt(box, {2, 0});
    track.predicted_streak = 1;
    EXPECT_TRUE(duplicates(box, {2, 0}, track, options));
    track.recognised = true;
    EXPECT_FALSE(duplicates(box, {2, 0}, track, options));
    track.recognised = false;
    track.predicted_streak = 2;
    EXPECT_FALSE(duplicates(box, {2, 0}, track, options));
    track.predicted_streak = 0;
    options.suppress_duplicates = false;
    EXPECT_FALSE(duplicates(box, {2, 0}, track, options));
}

TEST(TrackManager, OfTwoInOnePlaceTheKnownThenTheOftenerSeenThenTheOlderStays) {
    const auto left = [](TrackStatus first_status, int first_hits, TrackStatus second_status, int second_hits) {
        std::vector<Track> tracks{carAt({300, 200}), carAt({301, 200}), carAt({300, 300})};
        tracks[0].status = first_status;
        tracks[0].hits = first_hits;
        tracks[1].status = second_status;
        tracks[1].hits = second_hits;
        tracks[1].id = 2;
        tracks[2].id = 3;
        managerWith().suppressDuplicates(tracks, kSlow);
        EXPECT_EQ(tracks.size(), 2U);
        EXPECT_EQ(tracks.back().id, 3);
        return tracks.front().id;
    };
    EXPECT_EQ(left(TrackStatus::confirmed, 9, TrackStatus::confirmed, 9), 1);
    EXPECT_EQ(left(TrackStatus::confirmed, 9, TrackStatus::confirmed, 10), 2);
    EXPECT_EQ(left(TrackStatus::confirmed, 10, TrackStatus::coasting, 9), 1);
    EXPECT_EQ(left(TrackStatus::coasting, 2, TrackStatus::tentative, 10), 1);
    EXPECT_EQ(left(TrackStatus::tentative, 10, TrackStatus::coasting, 2), 2);
}

TEST(TrackManager, ALostTrackTakesOverWhatAYoungerOneFound) {
    for (const int lost_for : {1, 2}) {
        for (const StateOrigin found : {StateOrigin::detected, StateOrigin::reconstructed}) {
            std::vector<Track> tracks{carAt({300, 200}, {1, 0}), carAt({302, 200}, {1.1, 0})};
            tracks[0].predicted_streak = lost_for;
            tracks[0].missing = 5;
            tracks[0].reconstructed_streak = 3;
            tracks[0].status = TrackStatus::coasting;
            tracks[0].stopped = tracks[0].standstill.begun = true;
            tracks[0].history = 0b100;
            tracks[1].id = 2;
            tracks[1].hits = 3;
            tracks[1].status = TrackStatus::tentative;
            tracks[1].origin = found;
            tracks[1].vectors = {{77, {1, 1}, 0, 0}};
            managerWith().suppressDuplicates(tracks, kSlow);
            ASSERT_EQ(tracks.size(), 1U);
            const Track& track = tracks[0];
            const bool taken = lost_for == 2 && found == StateOrigin::detected;
            EXPECT_EQ(track.id, 1);
            EXPECT_EQ(track.filter.box().centre.x, taken ? 302 : 300);
            EXPECT_EQ(track.vectors.size(), taken ? 1U : 0U);
            EXPECT_EQ(track.hits, taken ? 101 : 100);
            EXPECT_EQ(track.history, taken ? 0b101U : 0b100U);
            EXPECT_EQ(track.missing, taken ? 0 : 5);
            EXPECT_EQ(track.reconstructed_streak, taken ? 0 : 3);
            EXPECT_EQ(track.predicted_streak, taken ? 0 : lost_for);
            EXPECT_EQ(track.stopped, !taken);
            EXPECT_EQ(track.standstill.begun, !taken);
            EXPECT_EQ(track.status, taken ? TrackStatus::confirmed : TrackStatus::coasting);
        }
    }
    std::vector<Track> tracks{carAt({300, 200}), carAt({302, 200})};
    tracks[0].recognised = true;
    tracks[0].recognised_streak = 6;
    tracks[1].hits = 3;
    managerWith().suppressDuplicates(tracks, kSlow);
    ASSERT_EQ(tracks.size(), 1U);
    EXPECT_EQ(tracks[0].filter.box().centre.x, 302) << "what was found by its look alone is found again";
    EXPECT_EQ(tracks[0].recognised_streak, 0);
    EXPECT_FALSE(tracks[0].recognised);
}

namespace {

/// Ids that are left of a large track of 40 × 30 px over two of `length` × 10 px, `apart` px from each other.
std::vector<TrackId> leftOfThree(double length, double apart, TrackStatus last = TrackStatus::confirmed) {
    std::vector<Track> tracks{trackAt({{300, 200}, 40, 30, 0}), trackAt({{300, 200 - apart / 2}, length, 10, 0}),
                              trackAt({{300, 200 + apart / 2}, length, 10, 0})};
    tracks[1].id = 2;
    tracks[2].id = 3;
    tracks[2].status = last;
    managerWith(byOverlap()).suppressDuplicates(tracks, kSlow);
    std::vector<TrackId> ids;
    for (const Track& track : tracks) ids.push_back(track.id);
    return ids;
}

}  // namespace

TEST(TrackManager, ATrackOverSeveralReliableOnesGoes) {
    EXPECT_EQ(leftOfThree(20, 14), (std::vector<TrackId>{2, 3}));
    EXPECT_EQ(leftOfThree(20, 14, TrackStatus::coasting), std::vector<TrackId>{1}) << "one of them is not reliable";
    // They lie apart by less than .3 of each other: 7.1 px.
    EXPECT_EQ(leftOfThree(20, 7.2), (std::vector<TrackId>{2, 3}));
    EXPECT_EQ(leftOfThree(20, 6.9), std::vector<TrackId>{1});
}

TEST(TrackManager, TracksOfHardlySmallerSizeAreNotHeldByALargerOne) {
    // The large one has 1 200 px², one and a half times 800.
    const auto left = [](double width) {
        std::vector<Track> tracks{trackAt({{300, 200}, 40, 30, 0}), trackAt({{300, 187}, 40, width, 0}),
                                  trackAt({{300, 213}, 40, width, 0})};
        tracks[1].id = 2;
        tracks[2].id = 3;
        TrackerOptions options = byOverlap();
        options.duplicate_overlap = 0.2;
        managerWith(options).suppressDuplicates(tracks, kSlow);
        return tracks.front().id;
    };
    EXPECT_EQ(left(19.9), 2);
    EXPECT_EQ(left(20.1), 1);
}

}  // namespace eyrie::track_duplicates_test
