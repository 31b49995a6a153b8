#include "explain/place_explainer.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "chain/recording/run_recorder.h"
#include "core/error.h"
#include "support/moving_scene.h"

namespace eyrie::place_explainer_test {
namespace {

/// A run over a small scene, kept in memory.
class Fixture {
 public:
    explicit Fixture(const ChainOptions& options = {}) : source_(scene_), scale_(sceneScale(source_.info(), 0.2)) {
        Chain chain(options, scale_);
        for (FrameIndex f = 0; f < scene_.frames; ++f) results_[f] = chain.next(source_.read(f, false));
        options_ = options;
    }
    ReplaySource replaySource() {
        ReplaySource replay;
        replay.options = options_;
        replay.scale = scale_;
        replay.pixels = [this](FrameIndex frame) { return source_.read(frame, false); };
        replay.result_of = [this](FrameIndex frame) -> std::optional<FrameResult> {
            const auto found = results_.find(frame);
            return found == results_.end() ? std::nullopt : std::optional(found->second);
        };
        replay.motion_of = [this](FrameIndex frame) -> std::optional<FrameMotion> {
            const auto found = results_.find(frame);
            return found == results_.end() ? std::nullopt : std::optional(found->second.motion);
        };
        return replay;
    }
    const FrameResult& result(FrameIndex frame) const { return results_.at(frame); }
    OrientedBox vehicle(int index, FrameIndex frame) const {
        return placeAt(scene_.vehicleAt(scene_.vehicles[static_cast<std::size_t>(index)], frame), scale_);
    }

 private:
    test::MovingScene scene_;
    test::MemorySource source_;
    SceneScale scale_;
    ChainOptions options_;
    std::map<FrameIndex, FrameResult> results_;
};

TEST(PlaceExplainer, tellsWhatSpeaksForTheTrackWhereTheRunKnows) {
    Fixture run;
    ReplaySource source = run.replaySource();
    source.evidence_of = [](TrackId) {
        return std::optional(TrackEvidence{.detected = 0.9, .life_s = 2, .score = 0.8});
    };
    PlaceExplainer explainer(std::move(source));
    const auto told = explainer.explain(35, run.vehicle(0, 35), {});
    ASSERT_TRUE(told && told->found);
    EXPECT_TRUE(std::any_of(told->steps.begin(), told->steps.end(), [](const ExplanationStep& step) {
        return step.stage == "score" && step.text.find("detected in 90 %") != std::string::npos;
    }));
}

TEST(PlaceExplainer, tellsHowMuchOfTheBoxesWasTakenAsShadowAndWhereThatFalls) {
    Fixture run;
    ReplaySource source = run.replaySource();
    source.trim_of = [](TrackId) { return std::optional(BoxTrim{LightOutcome::shadows, 0.5, 0.5, 0.2}); };
    source.shadow_of = [](FrameIndex frame) { return std::optional(FrameShadow{frame, 0, 10}); };
    PlaceExplainer explainer(std::move(source));
    const auto told = explainer.explain(35, run.vehicle(0, 35), {});
    ASSERT_TRUE(told && told->found);
    EXPECT_TRUE(std::any_of(told->steps.begin(), told->steps.end(), [](const ExplanationStep& step) {
        return step.text ==
                   "its shadow was taken out of its boxes: 20 % of their area; shadows fall to 0° (to the right), 2.0 "
                   "m "
                   "beyond most vehicles in this frame" &&
               step.parameter == "finishing.trim_shadows" && step.verdict == StepVerdict::note;
    }));
}

TEST(PlaceExplainer, tellsWhatWasFoundAndWhy) {
    Fixture run;
    PlaceExplainer explainer(run.replaySource());
    const auto told = explainer.explain(35, run.vehicle(0, 35), {});
    ASSERT_TRUE(told);
    EXPECT_TRUE(told->found) << told->sentence;
    EXPECT_GT(told->steps.size(), 8U);
    // The corners were judged anew as in the run: nearly all of its vectors are among those that move.
    std::size_t moving = 0;
    for (const CornerVerdict& verdict : *explainer.evidence().corners) moving += verdict.fate == CornerFate::moving;
    const std::vector<MotionVector> vectors = run.result(35).motion.motion_vectors;
    const auto stored = std::count_if(vectors.begin(), vectors.end(), [](const auto& v) { return !v.isInferred(); });
    EXPECT_NEAR(static_cast<double>(moving), static_cast<double>(stored), 0.2 * static_cast<double>(stored) + 2);
    // What was searched reaches beyond the cluster, and so does what is told of the search.
    const OrientedBox roi = explainer.evidence().result.rois.at(0);
    const OrientedBox end{roi.centre + (roi.length / 2 - 1) * cv::Point2d(std::cos(roi.heading), std::sin(roi.heading)),
                          1, 1, roi.heading};
    ASSERT_EQ(intersectionArea(explainer.evidence().result.clusters.at(0).box, end), 0);
    ASSERT_TRUE(explainer.explain(35, end, {}));
    EXPECT_FALSE(explainer.evidence().searches.empty());
    ASSERT_TRUE(explainer.explain(35, {{40, 200}, 4, 4, 0}, {}));
    EXPECT_TRUE(explainer.evidence().searches.empty());
}

TEST(PlaceExplainer, tellsWhyTheGroundWasNot) {
    Fixture run;
    PlaceExplainer explainer(run.replaySource());
    const auto told = explainer.explain(30, {{40, 200}, 20, 20, 0}, {});
    ASSERT_TRUE(told);
    EXPECT_FALSE(told->found);
    EXPECT_EQ(told->parameter.substr(0, 7), "motion.") << told->sentence;
}

TEST(PlaceExplainer, namesTheParameterThatWasMadeToDecide) {
    ChainOptions options;
    options.clustering.min_members = 200;
    Fixture crowded(options);
    const auto told = PlaceExplainer(crowded.replaySource()).explain(30, crowded.vehicle(0, 30), {});
    ASSERT_TRUE(told);
    EXPECT_FALSE(told->found);
    EXPECT_EQ(told->parameter, "clustering.min_members") << told->sentence;
    options = {};
    options.outliers.min_vectors = 500;
    Fixture outliers(options);
    const auto removed = PlaceExplainer(outliers.replaySource()).explain(30, outliers.vehicle(0, 30), {});
    EXPECT_EQ(removed->parameter, "outliers.min_vectors") << removed->sentence;
    options = {};
    options.motion.min_speed_m_s = 49;
    options.motion.find_slow = false;
    Fixture slow(options);
    const auto still = PlaceExplainer(slow.replaySource()).explain(30, slow.vehicle(0, 30), {});
    EXPECT_EQ(still->parameter.substr(0, 7), "motion.") << still->sentence;
    options = {};
    options.tracking.confirm_hits = 64;
    options.tracking.confirm_window = 64;
    Fixture tentative(options);
    const auto young = PlaceExplainer(tentative.replaySource()).explain(30, tentative.vehicle(0, 30), {});
    EXPECT_EQ(young->parameter, "tracking.confirm_hits") << young->sentence;
}

TEST(PlaceExplainer, stopsAndRefusesWhatTheRunHasNot) {
    Fixture run;
    PlaceExplainer explainer(run.replaySource());
    std::stop_source stop;
    stop.request_stop();
    EXPECT_FALSE(explainer.explain(30, run.vehicle(0, 30), stop.get_token()));
    EXPECT_TRUE(explainer.explain(30, run.vehicle(0, 30), {}));
    EXPECT_THROW(explainer.explain(300, run.vehicle(0, 30), {}), Error);
}

TEST(MotionWindow, otherParametersNeedNoOtherRegistration) {
    Fixture run;
    const ReplaySource source = run.replaySource();
    MotionWindow window({}, source.scale);
    int read = 0;
    const auto pixels = [&](FrameIndex frame) {
        ++read;
        return source.pixels(frame);
    };
    ASSERT_TRUE(window.cover(0, 30, pixels, {}));
    EXPECT_EQ(read, 31);
    // From the first frame on it is what the run did.
    const auto same = window.motions({}, 2);
    ASSERT_EQ(same.size(), 2U);
    for (int i = 0; i < 2; ++i) {
        const auto& stored = run.result(29 + i).motion;
        ASSERT_EQ(same[static_cast<std::size_t>(i)].motion_vectors.size(), stored.motion_vectors.size());
        for (std::size_t v = 0; v < stored.motion_vectors.size(); ++v)
            EXPECT_EQ(same[static_cast<std::size_t>(i)].motion_vectors[v].velocity, stored.motion_vectors[v].velocity);
    }
    ASSERT_TRUE(window.cover(0, 30, pixels, {}));
    EXPECT_EQ(read, 31);
    IndependentMotionOptions deaf;
    deaf.min_speed_px = 10;
    EXPECT_TRUE(window.motions(deaf, 1).front().motion_vectors.empty());
}

TEST(MotionWindow, reachesAsFarBackAsAreasLook) {
    Fixture run;
    const ReplaySource source = run.replaySource();
    // Nothing but areas finds anything here, and nothing but they looks back as far.
    IndependentMotionOptions options;
    options.sigma_factor = 1e6;
    options.silhouettes.silhouettes = false;
    options.areas.area_few_corners = options.areas.area_max_corners = 1e6;
    options.areas.area_gap_s = 14 / source.scale.frame_rate_hz;
    const FrameIndex frame = 45;
    const auto vectorsFrom = [&](FrameIndex first) {
        MotionWindow window({}, source.scale);
        EXPECT_TRUE(window.cover(first, frame, source.pixels, {}));
        return window.motions(options, 1).front().motion_vectors.size();
    };
    const int reach = MotionWindow::reachFor(options, source.scale);
    EXPECT_GT(vectorsFrom(frame - reach), 0U);
    EXPECT_EQ(vectorsFrom(frame - reach + 1), 0U) << "a frame less does not suffice";
}

}  // namespace
}  // namespace eyrie::place_explainer_test
