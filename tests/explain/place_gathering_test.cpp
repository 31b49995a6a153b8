#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>
#include <set>

#include "chain/recording/run_recorder.h"
#include "explain/place_explainer.h"
#include "support/moving_scene.h"
#include "tracking/tracker.h"

/// What is gathered for a place: which frames are asked for, whose tracks, and what is not done twice.
namespace eyrie::place_gathering_test {
namespace {

/// A run over a scene, kept in memory, that notes what is asked of it.
class NotedRun {
 public:
    NotedRun(test::MovingScene scene, FrameIndex first) : scene_(std::move(scene)), source_(scene_), first_(first) {
        options.stacking.enabled = false;
        scale = sceneScale(source_.info(), 0.2);
        // What the same run finds is found once.
        static std::map<std::pair<int, FrameIndex>, std::map<FrameIndex, FrameResult>> found;
        results = found[{scene_.frames, first}];
        if (!results.empty()) return;
        Chain chain(options, scale);
        for (FrameIndex f = first; f < scene_.frames; ++f) results[f] = chain.next(source_.read(f, false));
        found[{scene_.frames, first}] = results;
    }

    ReplaySource replaySource() {
        ReplaySource replay;
        replay.options = options;
        replay.scale = scale;
        replay.first_frame = first_;
        replay.pixels = [this](FrameIndex frame) {
            read.push_back(frame);
            if (frame == stop_at_pixels) stop.request_stop();
            return source_.read(frame, false);
        };
        replay.result_of = [this](FrameIndex frame) -> std::optional<FrameResult> {
            asked.push_back(frame);
            if (frame == stop_at_result) stop.request_stop();
            const auto found = results.find(frame);
            return found == results.end() ? std::nullopt : std::optional(found->second);
        };
        replay.motion_of = [this](FrameIndex frame) -> std::optional<FrameMotion> {
            const auto found = results.find(frame);
            return found == results.end() ? std::nullopt : std::optional(found->second.motion);
        };
        return replay;
    }

    OrientedBox vehicle(std::size_t index, FrameIndex frame) const {
        return placeAt(scene_.vehicleAt(scene_.vehicles[index], frame), scale);
    }

    ChainOptions options;
    SceneScale scale;
    std::map<FrameIndex, FrameResult> results;
    std::vector<FrameIndex> asked, read;
    std::stop_source stop;
    FrameIndex stop_at_result = -1, stop_at_pixels = -1;

 private:
    test::MovingScene scene_;
    test::MemorySource source_;
    FrameIndex first_;
};

const OrientedBox kNowhere{{40, 200}, 4, 4, 0};

NotedRun shortRun() {
    return {test::MovingScene{}, 0};
}

/// Longer than tracks are followed anew.
test::MovingScene longScene() {
    test::MovingScene scene;
    scene.size = {200, 120};
    scene.frames = 140;
    scene.camera_per_frame = {0.2, 0.1};
    scene.vehicles = {{{20, 40}, {1.2, 0}, {24, 11}}, {{190, 90}, {-1.1, 0}, {22, 10}}};
    return scene;
}

void expectSameTracks(const std::vector<TrackState>& a, const std::vector<TrackState>& b) {
    ASSERT_EQ(a.size(), b.size());
    for (std::size_t i = 0; i < a.size(); ++i) {
        EXPECT_EQ(a[i].id, b[i].id);
        EXPECT_EQ(a[i].box.centre, b[i].box.centre);
        EXPECT_EQ(a[i].status, b[i].status);
    }
}

TEST(PlaceGathering, TracksAreFollowedAnewOverTheHundredAndTwentyFramesBefore) {
    for (const FrameIndex first : {0, 9}) {
        NotedRun run(longScene(), first);
        // One frame that the run lost.
        run.results.erase(70);
        for (const FrameIndex frame : {135, 60}) {
            run.asked.clear();
            run.read.clear();
            PlaceExplainer explainer(run.replaySource());
            ASSERT_TRUE(explainer.explain(frame, run.vehicle(0, frame), {}));
            const FrameIndex begin = std::max(first, frame - 120);
            std::vector<FrameIndex> expected{frame};
            for (FrameIndex f = begin; f < frame; ++f) expected.push_back(f);
            EXPECT_EQ(run.asked, expected) << "the frame, then those before it in their order";
            Tracker tracker(run.options.tracking, run.scale);
            TrackingTrace trace;
            const auto pixels = [&](FrameIndex f) { return [&run, f] { return run.replaySource().pixels(f).gray; }; };
            for (FrameIndex f = begin; f < frame; ++f)
                if (run.results.count(f) > 0)
                    tracker.next(run.results[f].motion, run.results[f].detections, nullptr, pixels(f));
            const FrameResult& last = run.results[frame];
            expectSameTracks(explainer.evidence().unfinished,
                             tracker.next(last.motion, last.detections, &trace, pixels(frame)));
            EXPECT_FALSE(explainer.evidence().unfinished.empty());
            ASSERT_TRUE(explainer.evidence().tracking);
            expectSameTracks(explainer.evidence().result.tracks, last.tracks);
        }
    }
}

TEST(PlaceGathering, CornersAreJudgedOverAsManyFramesAsMotionLooksBack) {
    for (const FrameIndex frame : {35, 6}) {
        NotedRun run = shortRun();
        PlaceExplainer explainer(run.replaySource());
        ASSERT_TRUE(explainer.explain(frame, kNowhere, {}));
        const int reach = MotionWindow::reachFor(run.options.motion, run.scale);
        ASSERT_GT(reach, 6);
        ASSERT_LT(reach, 35);
        EXPECT_EQ(*std::min_element(run.read.begin(), run.read.end()), std::max(0, frame - reach));
        MotionWindow window(run.options.registration, run.scale);
        ASSERT_TRUE(window.cover(std::max(0, frame - reach), frame, run.replaySource().pixels, {}));
        CornerVerdicts verdicts;
        window.motions(run.options.motion, 1, &verdicts);
        ASSERT_TRUE(explainer.evidence().corners);
        ASSERT_EQ(explainer.evidence().corners->size(), verdicts.size());
        for (std::size_t i = 0; i < verdicts.size(); ++i) {
            EXPECT_EQ((*explainer.evidence().corners)[i].fate, verdicts[i].fate);
            EXPECT_EQ((*explainer.evidence().corners)[i].position, verdicts[i].position);
        }
    }
    // Nothing is judged in the first frame, so that nothing is known of its corners.
    NotedRun run = shortRun();
    PlaceExplainer explainer(run.replaySource());
    ASSERT_TRUE(explainer.explain(0, kNowhere, {}));
    EXPECT_FALSE(explainer.evidence().corners);
}

TEST(PlaceGathering, SpeaksOfTheFinishedTracksAndOfThoseThatWereConfirmedOnce) {
    NotedRun run = shortRun();
    FrameResult& result = run.results[35];
    ASSERT_FALSE(result.tracks.empty());
    result.tracks[0].id = 71;
    result.dropped = {
        {81, result.tracks[0].box, TrackDrop::unconfirmed, 0},
        {82, result.tracks[0].box, static_cast<TrackDrop>(static_cast<int>(TrackDrop::unconfirmed) + 1), 0},
        {83, result.tracks[0].box, static_cast<TrackDrop>(static_cast<int>(TrackDrop::unconfirmed) + 2), 0}};
    ReplaySource source = run.replaySource();
    std::set<TrackId> asked;
    source.evidence_of = [&](TrackId track) -> std::optional<TrackEvidence> {
        asked.insert(track);
        if (track == 83) return std::nullopt;
        return TrackEvidence{.detected = 0.01 * track, .life_s = 2, .score = 0.8};
    };
    PlaceExplainer explainer(std::move(source));
    ASSERT_TRUE(explainer.explain(35, run.vehicle(0, 35), {}));
    std::set<TrackId> expected{82, 83};
    for (const TrackState& track : result.tracks) expected.insert(track.id);
    EXPECT_EQ(asked, expected);
    expected.erase(83);
    const auto& judged = explainer.evidence().judged;
    ASSERT_EQ(judged.size(), expected.size());
    for (const TrackId id : expected) EXPECT_EQ(judged.at(id).detected, 0.01 * id);
    EXPECT_EQ(explainer.evidence().result.tracks[0].id, 71) << "those of the run, not of the replay";
    ASSERT_EQ(explainer.evidence().result.dropped.size(), 3U);
    // Those of another frame do not stay.
    ASSERT_TRUE(explainer.explain(1, run.vehicle(0, 1), {}));
    EXPECT_EQ(judged.count(82), 0U);
    EXPECT_TRUE(explainer.evidence().result.dropped.empty());
}

TEST(PlaceGathering, SearchesAreThoseOfTheAreasThatThePlaceTouches) {
    NotedRun run = shortRun();
    const FrameIndex frame = 35;
    PlaceExplainer explainer(run.replaySource());
    Replay replay(run.replaySource());
    const ReplayedFrame* replayed = replay.at(frame, {});
    ASSERT_NE(replayed, nullptr);
    const FrameResult result = replayed->result;
    ASSERT_GE(result.clusters.size(), 2U);
    int none = 0, one = 0;
    for (int y = 0; y < 240; y += 12)
        for (int x = 0; x < 320; x += 12)
            for (const double side : {0.0, 9.0}) {
                const OrientedBox place{cv::Point2d(x, y), side, side, 0};
                ASSERT_TRUE(explainer.explain(frame, place, {}));
                const auto& searches = explainer.evidence().searches;
                std::size_t next = 0;
                for (std::size_t k = 0; k < result.clusters.size(); ++k) {
                    const OrientedBox& area = result.rois.at(k);
                    if (!area.contains(place.centre) && intersectionArea(area, place) <= 0) continue;
                    for (const SearchTrace& each : replay.trace(static_cast<int>(k))) {
                        ASSERT_LT(next, searches.size());
                        EXPECT_EQ(searches[next].detections.size(), each.detections.size());
                        EXPECT_EQ(searches[next].raw.box.centre, each.raw.box.centre);
                        ++next;
                    }
                }
                EXPECT_EQ(next, searches.size()) << place.centre;
                EXPECT_EQ(explainer.evidence().area.centre, place.centre);
                ++(next > 0 ? one : none);
            }
    EXPECT_GT(one, 10);
    EXPECT_GT(none, 100);
}

TEST(PlaceGathering, WhatWasDoneForAFrameServesItsOtherPlaces) {
    NotedRun run = shortRun();
    PlaceExplainer explainer(run.replaySource());
    ASSERT_TRUE(explainer.explain(30, run.vehicle(0, 30), {}));
    run.asked.clear();
    run.read.clear();
    std::stop_source stopped;
    stopped.request_stop();
    EXPECT_TRUE(explainer.explain(30, kNowhere, stopped.get_token())) << "nothing is left to do there";
    EXPECT_TRUE(explainer.evidence().searches.empty());
    EXPECT_FALSE(explainer.explain(30, run.vehicle(0, 30), stopped.get_token())) << "its area would be searched";
    EXPECT_TRUE(explainer.explain(30, run.vehicle(0, 30), {}));
    EXPECT_TRUE(run.asked.empty());
    EXPECT_TRUE(run.read.empty());
    // Another frame is gathered anew, and the first once more after it.
    EXPECT_TRUE(explainer.explain(31, run.vehicle(0, 31), {}));
    EXPECT_FALSE(run.asked.empty());
    run.asked.clear();
    EXPECT_TRUE(explainer.explain(30, run.vehicle(0, 30), {}));
    EXPECT_FALSE(run.asked.empty());
}

TEST(PlaceGathering, WhateverStopsItItCanBeAskedAgain) {
    const FrameIndex frame = 30;
    const auto whole = [&] {
        NotedRun run = shortRun();
        return PlaceExplainer(run.replaySource()).explain(frame, run.vehicle(0, frame), {})->sentence;
    }();
    for (int which = 0; which < 6; ++which) {
        NotedRun run = shortRun();
        const int when = which % 3;
        if (when == 0) run.stop_at_pixels = 26;     // while corners are found anew
        if (when == 1) run.stop_at_result = 10;     // while tracks are followed
        if (when == 2) run.stop_at_result = frame;  // before the frame is replayed
        PlaceExplainer explainer(run.replaySource());
        // Of what is found there, or not, only a part would be known.
        const OrientedBox place = which < 3 ? kNowhere : run.vehicle(0, frame);
        EXPECT_FALSE(explainer.explain(frame, place, run.stop.get_token())) << which;
        if (when == 1) {
            EXPECT_EQ(run.asked.back(), 10) << "it goes no further";
        }
        run.stop = {};
        run.stop_at_pixels = run.stop_at_result = -1;
        const auto told = explainer.explain(frame, run.vehicle(0, frame), run.stop.get_token());
        ASSERT_TRUE(told) << which;
        EXPECT_EQ(told->sentence, whole) << which;
    }
    // A frame that the run has but cannot be replayed is not explained.
    NotedRun run = shortRun();
    ReplaySource source = run.replaySource();
    source.motion_of = [](FrameIndex) { return std::optional<FrameMotion>(); };
    EXPECT_FALSE(PlaceExplainer(std::move(source)).explain(frame, run.vehicle(0, frame), {}));
}

}  // namespace
}  // namespace eyrie::place_gathering_test
