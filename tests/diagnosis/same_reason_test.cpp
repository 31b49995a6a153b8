#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>
#include <string>

#include "chain/chain.h"
#include "chain/recording/run_recorder.h"
#include "diagnosis/diagnoser.h"
#include "explain/place_explainer.h"
#include "support/moving_scene.h"

namespace eyrie::same_reason_test {
namespace {

using testing::HasSubstr;

constexpr FrameIndex kFrame = 30;

/// Parameters that keep the vectors of a vehicle out of a cluster, and what both answers have to name.
struct Hindrance {
    std::string name;
    void (*hinder)(MotionClusteringOptions& options);
    std::string parameter;  ///< empty: any of clustering
    ErrorCause cause;
};

/// A run over a small drawn scene, kept in memory.
class HinderedRun {
 public:
    explicit HinderedRun(const ChainOptions& options)
        : source_(scene_), options_(options), scale_(sceneScale(source_.info(), 0.2)) {
        Chain chain(options, scale_);
        for (FrameIndex f = 0; f <= kFrame; ++f) results_[f] = chain.next(source_.read(f, false));
    }
    OrientedBox place() const { return placeAt(scene_.vehicleAt(scene_.vehicles.front(), kFrame), scale_); }
    const FrameResult& result() const { return results_.at(kFrame); }

    Explanation explanation() {
        ReplaySource replay;
        replay.options = options_;
        replay.scale = scale_;
        replay.pixels = [this](FrameIndex frame) { return source_.read(frame, false); };
        replay.result_of = [this](FrameIndex frame) { return resultOf(frame); };
        replay.motion_of = [this](FrameIndex frame) -> std::optional<FrameMotion> { return resultOf(frame)->motion; };
        return PlaceExplainer(std::move(replay)).explain(kFrame, place(), {}).value();
    }
    /// Of the vehicle that nothing was found of.
    DiagnosedError diagnosis() {
        BoxRecord vehicle;
        vehicle.frame = kFrame;
        vehicle.id = 1;
        vehicle.box = place();
        vehicle.object_class = "car";
        const BoxesByFrame truth{{kFrame, {vehicle}}};
        const EvaluationOptions evaluation;
        const BoxesByFrame found;
        const EvaluationInput input = prepareEvaluation(truth, found, evaluation);
        const auto matches = matchFrames(input, evaluation);
        DiagnosisSource source;
        source.options = options_;
        source.scale = scale_;
        source.frame_result = [this](FrameIndex frame) { return resultOf(frame); };
        auto errors = Diagnoser(std::move(source))
                          .diagnose(listErrors(truth, found, input, matches, evaluation),
                                    {truth, found, input, matches, evaluation}, {});
        EXPECT_EQ(errors.size(), 1U);
        return errors.front();
    }

 private:
    std::optional<FrameResult> resultOf(FrameIndex frame) const { return results_.at(frame); }

    test::MovingScene scene_;
    test::MemorySource source_;
    ChainOptions options_;
    SceneScale scale_;
    std::map<FrameIndex, FrameResult> results_;
};

TEST(SameReason, WhyAndTheCauseOfAMissNameTheSameParameterOfClustering) {
    const std::vector<Hindrance> hindrances{
        {"too few", [](auto& o) { o.min_members = 200; }, "clustering.min_members", ErrorCause::too_few_vectors},
        {"too far apart",
         [](auto& o) {
             o.along_m = o.across_m = 0.02;
             o.min_distance_px = o.roof_length_m = 0;
         },
         "", ErrorCause::not_clustered},
        {"too long", [](auto& o) { o.max_length_m = 0.5; }, "clustering.max_length", ErrorCause::not_clustered},
        {"too wide", [](auto& o) { o.max_width_m = 0.2; }, "clustering.max_width", ErrorCause::not_clustered},
    };
    for (const Hindrance& hindrance : hindrances) {
        ChainOptions options;
        hindrance.hinder(options.clustering);
        HinderedRun run(options);
        const Explanation told = run.explanation();
        const DiagnosedError miss = run.diagnosis();
        EXPECT_FALSE(told.found) << hindrance.name;
        ASSERT_EQ(told.parameter.substr(0, 11), "clustering.") << hindrance.name << ": " << told.sentence;
        EXPECT_THAT(miss.text, HasSubstr("(" + told.parameter + ")")) << hindrance.name << ": " << told.sentence;
        if (!hindrance.parameter.empty()) {
            EXPECT_EQ(told.parameter, hindrance.parameter) << told.sentence;
        }
        EXPECT_EQ(miss.cause, hindrance.cause) << miss.text;
    }
}

TEST(SameReason, WhereDifferenceImagesAreToFindWhatMoves) {
    ChainOptions options;
    options.difference.method = MotionMethod::two_frame_difference;
    options.difference.min_contrast = 255;
    HinderedRun run(options);
    ASSERT_TRUE(run.result().clusters.empty());
    const Explanation told = run.explanation();
    EXPECT_EQ(told.parameter, "motion.method") << told.sentence;
    const DiagnosedError miss = run.diagnosis();
    EXPECT_EQ(miss.cause, ErrorCause::not_clustered);
    EXPECT_THAT(miss.text, HasSubstr("(motion.method)"));
}

}  // namespace
}  // namespace eyrie::same_reason_test
