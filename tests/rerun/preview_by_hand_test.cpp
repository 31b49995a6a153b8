#include "rerun/preview.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "rerun/run_by_hand.h"

/// What a preview says of tracks, what it is told to do and what it keeps.
namespace eyrie::preview_by_hand_test {
namespace {

using testing::ElementsAre;

std::vector<TrackId> idsOf(const std::vector<TrackState>& tracks) {
    std::vector<TrackId> ids;
    for (const TrackState& track : tracks) ids.push_back(track.id);
    return ids;
}

TrackState stateOf(TrackId id, const OrientedBox& box) {
    TrackState state;
    state.id = id;
    state.box = box;
    return state;
}

OrientedBox moved(OrientedBox box, double by) {
    box.centre.x += by;
    return box;
}

/// Ids of the tracks in frame 20 of a preview when the run has these tracks there.
std::vector<TrackId> idsWhere(test::RunByHand& run, std::vector<TrackState> stored) {
    ReplaySource source = run.source();
    source.result_of = [result_of = source.result_of, stored = std::move(stored)](FrameIndex frame) {
        auto result = result_of(frame);
        if (result && frame == 20) result->tracks = stored;
        return result;
    };
    Preview preview(std::move(source));
    const auto now = preview.now(20, run.options, 20, {});
    return now ? idsOf(now->result.tracks) : std::vector<TrackId>{};
}

TEST(PreviewIds, NewTracksAreNumberedBeyondThoseOfTheRun) {
    test::RunByHand run;
    run.vehicles = {{{20, 30}}, {{20, 60}}, {{90, 30}}};
    const OrientedBox elsewhere{{180, 10}, 15, 6, 0};
    EXPECT_THAT(idsWhere(run, {}), ElementsAre(1, 2, 3));
    EXPECT_THAT(idsWhere(run, {stateOf(3, run.boxOf(1, 20)), stateOf(7, elsewhere)}), ElementsAre(3, 8, 9));
    EXPECT_THAT(idsWhere(run, {stateOf(7, run.boxOf(0, 20)), stateOf(3, elsewhere)}), ElementsAre(7, 8, 9));
    EXPECT_THAT(idsWhere(run, {stateOf(5, run.boxOf(2, 20)), stateOf(4, run.boxOf(0, 20))}), ElementsAre(4, 5, 6));
}

TEST(PreviewIds, ATrackIsTheRunsWhereThreeTenthsAreCommon) {
    test::RunByHand run;
    EXPECT_THAT(idsWhere(run, {stateOf(5, moved(run.boxOf(0, 20), 7))}), ElementsAre(5)) << "8 of 22 px";
    EXPECT_THAT(idsWhere(run, {stateOf(5, moved(run.boxOf(0, 20), 10))}), ElementsAre(6)) << "5 of 25 px";
    EXPECT_THAT(idsWhere(run, {stateOf(5, moved(run.boxOf(0, 20), 5)), stateOf(6, moved(run.boxOf(0, 20), 1)),
                               stateOf(7, moved(run.boxOf(0, 20), -3))}),
                ElementsAre(6))
        << "the one that it lies on best";
}

TEST(PreviewIds, NoIdIsGivenTwice) {
    test::RunByHand run;
    run.vehicles = {{{20, 30}}, {{20, 42}}};
    OrientedBox both = run.boxOf(0, 20);
    both.centre.y += 6;
    both.width = 18;
    EXPECT_THAT(idsWhere(run, {stateOf(5, both)}), ElementsAre(5, 6));
}

TEST(PreviewTracks, GoOnOverFramesThatTheRunHasNot) {
    test::RunByHand run;
    run.missing = {3};
    Preview preview(run.source());
    ChainOptions options = run.options;
    options.tracking.confirm_hits = 4;
    const auto now = preview.now(20, options, 30, {});
    ASSERT_TRUE(now);
    ASSERT_EQ(now->result.tracks.size(), 1U);
    EXPECT_EQ(now->result.tracks[0].hits, 20) << "in each frame but the missing one";
    options.clustering.min_members = 4;
    const auto whole = preview.withTracks(20, options, 30, {}, {});
    ASSERT_TRUE(whole);
    ASSERT_EQ(whole->result.tracks.size(), 1U);
    EXPECT_EQ(whole->result.tracks[0].hits, 20);
}

TEST(PreviewTracks, AreFollowedThroughTheFramesAskedFor) {
    test::RunByHand run;
    ReplaySource source = run.source();
    source.first_frame = 5;
    Preview preview(std::move(source));
    ChainOptions options = run.options;
    options.clustering.min_members = 4;
    for (const auto& [range, hits] : {std::pair(0, 1), std::pair(6, 7), std::pair(15, 16), std::pair(30, 16)}) {
        const auto now = preview.now(20, options, range, {});
        ASSERT_EQ(now->result.tracks.size(), 1U);
        EXPECT_EQ(now->result.tracks[0].hits, hits) << range;
        EXPECT_FALSE(now->tracks_final) << "the frames before were not done with these parameters";
        const auto whole = preview.withTracks(20, options, range, {}, {});
        ASSERT_EQ(whole->result.tracks.size(), 1U);
        EXPECT_EQ(whole->result.tracks[0].hits, hits) << range;
        EXPECT_TRUE(whole->tracks_final);
    }
    options = run.options;
    options.tracking.confirm_hits = 4;
    EXPECT_TRUE(preview.now(20, options, 10, {})->tracks_final) << "the frames before are as the run found them";
}

TEST(PreviewTracks, TellHowManyFramesAreLeftUntilTheyAreThere) {
    test::RunByHand run;
    Preview preview(run.source());
    std::vector<int> left;
    const auto note = [&](int frames) { left.push_back(frames); };
    ChainOptions options = run.options;
    options.clustering.min_members = 4;
    ASSERT_TRUE(preview.withTracks(20, options, 4, {}, note));
    EXPECT_THAT(left, ElementsAre(4, 3, 2, 1));
    left.clear();
    ASSERT_TRUE(preview.withTracks(2, options, 4, {}, note));
    EXPECT_THAT(left, ElementsAre(2, 1)) << "the run begins there";
    left.clear();
    options = run.options;
    options.tracking.confirm_hits = 4;
    ASSERT_TRUE(preview.withTracks(20, options, 4, {}, note));
    EXPECT_TRUE(left.empty()) << "now() said it all";
}

TEST(PreviewTracks, StopOnTheWay) {
    test::RunByHand run;
    Preview preview(run.source());
    ChainOptions options = run.options;
    options.clustering.min_members = 4;
    std::stop_source stop;
    std::vector<int> left;
    EXPECT_FALSE(preview.withTracks(20, options, 9, stop.get_token(), [&](int frames) {
        left.push_back(frames);
        if (frames == 7) stop.request_stop();
    }));
    EXPECT_THAT(left, ElementsAre(9, 8, 7));
}

TEST(PreviewReach, StacksAndDifferencesEachNeedThePicturesBefore) {
    test::RunByHand run;
    Preview plain(run.source());
    ASSERT_TRUE(plain.now(30, run.options, 10, {}));
    EXPECT_THAT(run.pictures_read, ElementsAre(30));
    run.pictures_read.clear();
    ChainOptions stacking = run.options;
    stacking.stacking.enabled = true;
    stacking.stacking.capacity = 4;
    Preview stacked(run.source());
    ASSERT_TRUE(stacked.now(30, stacking, 10, {}));
    EXPECT_EQ(run.pictures_read.size(), 9U);
    EXPECT_EQ(run.pictures_read.front(), 22);
    run.pictures_read.clear();
    ChainOptions difference = run.options;
    difference.difference.method = MotionMethod::two_frame_difference;
    Preview differing(run.source());
    const auto now = differing.now(30, difference, 10, {});
    ASSERT_TRUE(now);
    EXPECT_EQ(run.pictures_read.front(), 21);
    const FrameResult whole = run.runWith(difference)[30];
    ASSERT_EQ(now->result.clusters.size(), whole.clusters.size());
    ASSERT_FALSE(whole.clusters.empty());
    EXPECT_EQ(now->result.clusters[0].box.centre, whole.clusters[0].box.centre);
}

TEST(PreviewMemory, LetsTheFramesGoThatAreFarthestAway) {
    test::RunByHand run;
    run.vehicles = {{{20, 30}, 0.5F}};
    run.frames = 200;
    Preview preview(run.source());
    const auto readFor = [&](FrameIndex frame, int range = 0) {
        const int before = run.results_read;
        EXPECT_TRUE(preview.now(frame, run.options, range, {}));
        return run.results_read - before;
    };
    EXPECT_EQ(readFor(159, 159), 160);
    EXPECT_EQ(readFor(0), 0) << "they are all there";
    EXPECT_EQ(readFor(160), 1);
    EXPECT_EQ(readFor(1), 0);
    EXPECT_EQ(readFor(159), 0);
    EXPECT_EQ(readFor(0), 1) << "it was the farthest away from 160, as 160 is from it";
    EXPECT_EQ(readFor(159), 0);
    EXPECT_EQ(readFor(160), 1);
}

}  // namespace
}  // namespace eyrie::preview_by_hand_test
