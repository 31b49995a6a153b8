#include "sweep/stage_cache.h"

#include <gtest/gtest.h>

#include <array>
#include <thread>

#include "chain/chain.h"
#include "chain/chain_run.h"
#include "chain/recording/classified_vehicles.h"
#include "core/error.h"
#include "sweep/sweep_scene.h"

namespace eyrie::stage_cache_test {
namespace {

const SceneScale& kScale = test::kSweepScale;
constexpr int kFrames = test::kSweepFrames;

ClipFrames::Open opener() {
    return test::sweepSource;
}

/// What a run of its own gives: the chain over every frame, then finishing.
class OwnRun : public ChainObserver {
 public:
    explicit OwnRun(const ChainOptions& options) {
        const auto source = test::sweepSource();
        const RunSummary summary = ChainRun(options, kScale).run(*source, {}, *this, {});
        EXPECT_EQ(summary.outcome, RunOutcome::finished) << summary.message;
        for (const auto& [frame, state] :
             finishTracks(states_, motions_, options.finishing, kScale,
                          {vectorsIn(vectors_), classifiedVehicles(options, classifiedIn(classified_))}))
            tracks_.emplace_back(frame, state.id, state.box, state.velocity, state.score);
    }
    void onFrame(const std::shared_ptr<const FrameResult>& result, const Frame&) override {
        const FrameIndex frame = result->motion.frame;
        for (const Detection& d : result->detections) {
            if (d.rejection == Rejection::none) detections_.emplace_back(frame, 0, d.box, d.velocity, shownScore(d));
        }
        for (const TrackState& state : result->tracks) states_.emplace_back(frame, state);
        vectors_[frame] = result->motion.motion_vectors;
        classified_[frame] = classifiedOf(result->detections);
        motions_.push_back({frame, result->motion.registration, result->motion.image_size});
    }
    struct Box {
        Box(FrameIndex f, int i, const OrientedBox& b, cv::Point2d v, double s)
            : frame(f), id(i), box(b), velocity(v), score(s) {}
        FrameIndex frame;
        int id;
        OrientedBox box;
        cv::Point2d velocity;
        double score;
    };
    const std::vector<Box>& detections() const { return detections_; }
    const std::vector<Box>& tracks() const { return tracks_; }

 private:
    std::vector<Box> detections_;
    std::vector<Box> tracks_;
    std::vector<TimedState> states_;
    std::vector<FrameMotionSummary> motions_;
    VectorsByFrame vectors_;
    ClassifiedByFrame classified_;
};

void expectSame(const std::vector<OwnRun::Box>& expected, const BoxesByFrame& found, const std::string& what) {
    std::vector<BoxRecord> flat;
    for (const auto& entry : found) flat.insert(flat.end(), entry.second.begin(), entry.second.end());
    ASSERT_EQ(expected.size(), flat.size()) << what;
    for (std::size_t i = 0; i < flat.size(); ++i) {
        EXPECT_EQ(expected[i].frame, flat[i].frame) << what;
        EXPECT_EQ(expected[i].id, flat[i].id.value_or(0)) << what;
        EXPECT_EQ(expected[i].box.centre, flat[i].box.centre) << what;
        EXPECT_EQ(expected[i].box.length, flat[i].box.length) << what;
        EXPECT_EQ(expected[i].box.width, flat[i].box.width) << what;
        EXPECT_EQ(expected[i].box.heading, flat[i].box.heading) << what;
        EXPECT_EQ(expected[i].velocity, flat[i].velocity) << what;
        EXPECT_EQ(expected[i].score, flat[i].score) << what;
    }
}

/// Frames, places and sizes of all boxes.
std::vector<std::array<double, 5>> placesOf(const BoxesByFrame& boxes) {
    std::vector<std::array<double, 5>> places;
    for (const auto& [frame, records] : boxes)
        for (const BoxRecord& record : records)
            places.push_back({static_cast<double>(frame), record.box.centre.x, record.box.centre.y, record.box.length,
                              record.box.width});
    return places;
}

void expectAsARunOfItsOwn(StageCache& cache, const ChainOptions& options, const std::string& what) {
    const auto found = cache.run(options, {});
    ASSERT_TRUE(found.has_value());
    const OwnRun expected(options);
    expectSame(expected.detections(), *found->detections, what + ", detections");
    expectSame(expected.tracks(), *found->tracks, what + ", tracks");
}

ChainOptions base() {
    return test::sweepBase();
}

}  // namespace

TEST(StageCache, GivesWhatARunOfItsOwnGivesWhateverChangesAndInWhateverOrder) {
    const std::vector<std::vector<std::pair<std::string, std::string>>> changes{
        {},
        {{"gradient.quantile", "0.05"}},
        {{"gradient.quantile", "0.6"}},
        {{"gradient.method", "canny"}},
        {{"clustering.along", "1.5"}, {"clustering.min_distance", "2"}},
        {{"clustering.along", "1.5"}, {"clustering.min_distance", "2"}, {"gradient.quantile", "0.1"}},
        {{"clustering.along", "6"}},
        {{"outliers.min_vectors", "1"}, {"outliers.min_density_share", "0"}},
        {{"duplicates.strategy", "suppress"}},
        {{"tracking.min_overlap", "0.05"}},
        {{"tracking.appearance", "lost"}, {"tracking.max_supported", "0"}},
        {{"finishing.constant_size", "false"}},
        // Found late, and so traced back over the vectors of the frames before.
        {{"finishing.keep_tentative", "false"}, {"tracking.confirm_hits", "8"}},
        {{"outliers.min_vectors", "16"}},
        {{"stacking.enabled", "true"}, {"stacking.min_height", "4"}},
        {{"stacking.enabled", "true"}, {"stacking.min_height", "4"}, {"gradient.quantile", "0.2"}},
        {{"stacking.enabled", "true"}, {"stacking.min_height", "4"}, {"tracking.min_overlap", "0.05"}},
        {{"motion.method", "two_frame_difference"}, {"difference.gap", "4"}},
        {{"detection.method", "clusters"}},
        {{"detection.method", "mser"}},
        {{"motion.min_speed", "4"}},
        {{"registration.max_corners", "3000"}},
        {},
    };
    StageCache cache(opener(), {}, kScale);
    for (const auto& change : changes) {
        ChainOptions options = base();
        std::string what = "base";
        for (const auto& [name, value] : change) {
            setParameter(describeOf(options), name, value);
            what += ", " + name + " = " + value;
        }
        expectAsARunOfItsOwn(cache, options, what);
    }
}

TEST(StageCache, AScaleThatIsTheSameEverywhereIsThatOfPointsThatLookForNoOther) {
    SceneScale sloped = kScale;
    sloped.slope = ScaleSlope::ofPicture({320, 240}, 0, 0.008);
    ChainOptions looks = base();
    looks.view.oblique = true;
    ChainOptions flat = base();
    flat.view.oblique = false;
    StageCache oblique(opener(), {}, sloped);
    const auto by_place = oblique.run(looks, {});
    // As a run of its own whose scale has no slope; with it other boxes are found.
    expectAsARunOfItsOwn(oblique, flat, "view.oblique = false");
    StageCache straight_down(opener(), {}, kScale);
    const auto everywhere = straight_down.run(looks, {});
    ASSERT_TRUE(by_place && everywhere);
    EXPECT_NE(placesOf(*by_place->tracks), placesOf(*everywhere->tracks));
}

TEST(StageCache, ASlopeThatNobodyLookedForIsLookedForWhereAPointAsks) {
    // Two vehicles tell no slope; the look changes nothing else.
    StageCache cache(opener(), {}, kScale, {.looked_for_slope = false});
    ChainOptions looks = base();
    looks.view.oblique = true;
    expectAsARunOfItsOwn(cache, looks, "view.oblique = true");
}

TEST(StageCache, WhatIsFoundWithASlopeThatWasLookedForDoesNotDependOnThePointsBefore) {
    // The look sees more in some points than in others, as one with another classifier would.
    const StageCacheOptions looking{.looked_for_slope = false,
                                    .look_for_slope = [](const ChainOptions& options, const std::stop_token&) {
                                        const bool tells = options.detection.gradient.quantile < 0.3;
                                        return tells ? ScaleSlope::ofPicture({320, 240}, 0, 0.008) : ScaleSlope{};
                                    }};
    std::vector<ChainOptions> points(2, base());
    for (ChainOptions& point : points) point.view.oblique = true;
    points[0].detection.gradient.quantile = 0.1;
    points[1].detection.gradient.quantile = 0.5;
    StageCache forwards(opener(), {}, kScale, looking), backwards(opener(), {}, kScale, looking);
    const auto first = forwards.run(points[0], {}), second = forwards.run(points[1], {});
    const auto second_alone = backwards.run(points[1], {}), first_after = backwards.run(points[0], {});
    ASSERT_TRUE(first && second && second_alone && first_after);
    EXPECT_EQ(placesOf(*first->detections), placesOf(*first_after->detections));
    EXPECT_EQ(placesOf(*first->tracks), placesOf(*first_after->tracks));
    EXPECT_EQ(placesOf(*second->detections), placesOf(*second_alone->detections));
    EXPECT_EQ(placesOf(*second->tracks), placesOf(*second_alone->tracks));
    EXPECT_NE(placesOf(*first->tracks), placesOf(*second->tracks));
}

TEST(StageCache, DoesOnlyWhatLiesBehindTheChange) {
    StageCache cache(opener(), {}, kScale);
    ChainOptions options = base();
    const auto times = [&] {
        std::vector<int> all;
        for (int i = 1; i < kChainStageCount; ++i) all.push_back(cache.timesComputed(static_cast<ChainStage>(i)));
        return all;
    };
    // motion, clustering, stacking, detection, removal, tracking, finishing
    ASSERT_TRUE(cache.run(options, {}));
    EXPECT_EQ(times(), (std::vector<int>{1, 1, 0, 1, 1, 1, 1}));
    ASSERT_TRUE(cache.run(options, {}));
    EXPECT_EQ(times(), (std::vector<int>{1, 1, 0, 1, 1, 1, 1}));
    options.finishing.constant_size = false;
    ASSERT_TRUE(cache.run(options, {}));
    EXPECT_EQ(times(), (std::vector<int>{1, 1, 0, 1, 1, 1, 2}));
    options.tracking.min_overlap = 0.05;
    ASSERT_TRUE(cache.run(options, {}));
    EXPECT_EQ(times(), (std::vector<int>{1, 1, 0, 1, 1, 2, 3}));
    options.outliers.min_vectors = 1;
    ASSERT_TRUE(cache.run(options, {}));
    EXPECT_EQ(times(), (std::vector<int>{1, 1, 0, 1, 2, 3, 4}));
    options.detection.gradient.quantile = 0.1;
    ASSERT_TRUE(cache.run(options, {}));
    EXPECT_EQ(times(), (std::vector<int>{1, 1, 0, 2, 3, 4, 5}));
    options.clustering.along_m = 3.6;
    const long searched = cache.areasSearched();
    ASSERT_TRUE(cache.run(options, {}));
    EXPECT_EQ(times(), (std::vector<int>{1, 2, 0, 3, 4, 5, 6}));
    // Nearly all clusters are as before, so nearly no area is searched again.
    EXPECT_LT(cache.areasSearched() - searched, searched / 4);
    EXPECT_GT(cache.areasKnown(), searched / 4);
}

TEST(StageCache, SeveralThreadsShareWhatTheyHaveInCommon) {
    StageCache cache(opener(), {}, kScale);
    std::vector<std::optional<ClipResult>> results(6);
    {
        std::vector<std::jthread> threads;
        for (std::size_t i = 0; i < results.size(); ++i) {
            threads.emplace_back([&, i] {
                ChainOptions options = base();
                options.detection.gradient.quantile = 0.05 + 0.1 * static_cast<double>(i % 3);
                results[i] = cache.run(options, {});
            });
        }
    }
    EXPECT_EQ(cache.timesComputed(ChainStage::motion), 1);
    EXPECT_EQ(cache.timesComputed(ChainStage::clustering), 1);
    EXPECT_EQ(cache.timesComputed(ChainStage::detection), 3);
    for (std::size_t i = 0; i < 3; ++i) EXPECT_EQ(results[i]->tracks, results[i + 3]->tracks);
}

TEST(StageCache, FramesThatDoNotFitIntoMemoryAreReadAgain) {
    StageCacheOptions small;
    small.frame_bytes = 1000;
    small.area_bytes = 1000;
    small.all_cores = false;
    StageCache cache(opener(), {}, kScale, small);
    EXPECT_FALSE(cache.frames().inMemory());
    expectAsARunOfItsOwn(cache, base(), "read again");
    ChainOptions other = base();
    other.detection.gradient.quantile = 0.1;
    expectAsARunOfItsOwn(cache, other, "read again, other quantile");
}

TEST(StageCache, StopsAndGoesOn) {
    std::stop_source stop;
    StageCache cache(opener(), {}, kScale);
    cache.tellProgress([&](ChainStage, int done, int) {
        if (done == 5) stop.request_stop();
    });
    EXPECT_FALSE(cache.run(base(), stop.get_token()).has_value());
    EXPECT_TRUE(cache.run(base(), {}).has_value());
}

TEST(StageCache, UsesTheMotionOfAStoredRun) {
    std::vector<FrameMotion> stored;
    {
        const auto source = test::sweepSource();
        MotionHalf half(base(), kScale);
        for (int i = 4; i < 28; ++i) {
            StageTimes times{};
            stored.push_back(half.next(source->read(i, false), times));
        }
    }
    StageCache with(opener(), {4, 27}, kScale);
    with.useStoredMotion(base(), stored);
    StageCache without(opener(), {4, 27}, kScale);
    const auto a = with.run(base(), {});
    const auto b = without.run(base(), {});
    EXPECT_EQ(with.timesComputed(ChainStage::motion), 0);
    ASSERT_FALSE(b->tracks->empty());
    ASSERT_EQ(a->tracks->size(), b->tracks->size());
    for (const auto& [frame, boxes] : *b->tracks) {
        ASSERT_EQ(a->tracks->at(frame).size(), boxes.size());
        EXPECT_EQ(a->tracks->at(frame).front().box.centre, boxes.front().box.centre);
    }
    EXPECT_THROW(without.useStoredMotion(base(), {stored.begin(), stored.begin() + 3}), Error);
}

TEST(StageCache, ReportsWhatCannotBeDone) {
    EXPECT_THROW(StageCache(opener(), {0, 1000}, kScale), Error);
    EXPECT_THROW(StageCache(opener(), {-1, 4}, kScale), Error);
    StageCache cache(opener(), {}, kScale);
    ChainOptions options = base();
    options.detection.method = DetectionMethod::sliding_window;
    options.detection.sliding_window.model = "nowhere.eyriemodel";
    EXPECT_THROW(cache.run(options, {}), Error);
    EXPECT_TRUE(cache.run(base(), {}).has_value());
    const auto broken = [] {
        return std::make_unique<test::MemorySource>(kFrames, cv::Size(320, 240), [](int index) -> cv::Mat {
            if (index == 20) throw Error(ErrorKind::input, "frame 20 cannot be decoded");
            return test::sweepPictures()[static_cast<std::size_t>(index)];
        });
    };
    StageCache damaged(broken, {}, kScale);
    EXPECT_THROW(damaged.run(base(), {}), Error);
}

}  // namespace eyrie::stage_cache_test
