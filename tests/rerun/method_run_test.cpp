#include "rerun/method_run.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "chain/chain.h"
#include "core/error.h"
#include "support/moving_scene.h"

namespace eyrie::method_run_test {
namespace {

const SceneScale kScale{0.2, 25, true};

test::MovingScene shortScene() {
    test::MovingScene scene;
    scene.frames = 34;
    return scene;
}

double bestOverlap(const std::vector<Detection>& detections, const OrientedBox& vehicle) {
    double best = 0;
    for (const auto& detection : detections) {
        if (detection.rejection == Rejection::none) best = std::max(best, overlap(detection.box, vehicle));
    }
    return best;
}

OrientedBox trueBox(const test::MovingScene& scene, std::size_t vehicle, int frame) {
    const auto& v = scene.vehicles[vehicle];
    return {scene.vehicleAt(v, frame), v.size.width, v.size.height, std::atan2(v.velocity.y, v.velocity.x)};
}

}  // namespace

TEST(MethodVariants, WordsAndGroups) {
    EXPECT_THAT(methodsNamed("detectors"),
                testing::ElementsAre("clusters", "gradient", "relative_connectivity", "sliding_window",
                                     "window_and_gradient", "tophat_otsu", "mser", "canny_harris"));
    EXPECT_EQ(methodsNamed("gradients").size(), 4U);
    EXPECT_EQ(methodsNamed("rescaling").size(), 3U);
    EXPECT_EQ(methodsNamed("motion").size(), 4U);
    EXPECT_THAT(methodsNamed("peer"), testing::ElementsAre("three_frame_difference_sort"));
    EXPECT_THAT(methodsNamed("mser"), testing::ElementsAre("mser"));
    for (const std::string& word : methodWords()) EXPECT_EQ(methodVariant(word, {}).name, word);
    EXPECT_EQ(methodVariant("mser", {}).options.detection.method, DetectionMethod::mser);
    EXPECT_TRUE(methodVariant("global_sliding_window", {}).global_window);
    EXPECT_FALSE(methodVariant("mser", {}).peer.has_value());
    PeerOptions peer;
    peer.sort.min_hits = 9;
    EXPECT_EQ(methodVariant("three_frame_difference_sort", {}, peer).peer->sort.min_hits, 9);
    EXPECT_EQ(withStacking(methodVariant("mser", {}), true).name, "mser + stacking");
    EXPECT_THROW(methodVariant("magic", {}), Error);
    // The LBP gradient stays as the base says; the others keep their distance to it in table 7.3.
    ChainOptions base;
    base.detection.gradient.quantile = 0.36;
    EXPECT_DOUBLE_EQ(methodVariant("gradient_lbp", base).options.detection.gradient.quantile, 0.36);
    EXPECT_NEAR(methodVariant("gradient_simple", base).options.detection.gradient.quantile, 0.45, 1e-12);
    // With the thesis' preset each has the optimum of that table.
    const std::vector<std::pair<std::string, double>> optima{
        {"gradient_lbp", 0.12}, {"gradient_simple", 0.15}, {"gradient_canny", 0.14}, {"gradient_morphological", 0.16}};
    for (const auto& [word, optimum] : optima) {
        const MethodVariant variant = methodVariant(word, builtInPreset("thesis"));
        EXPECT_DOUBLE_EQ(variant.options.detection.gradient.effectiveQuantile(), optimum) << word;
    }
}

TEST(MethodRun, EachMethodGivesWhatItGivesAlone) {
    const test::MovingScene scene = shortScene();
    test::MemorySource source(scene);
    std::vector<MethodVariant> methods{methodVariant("gradient", {}), methodVariant("clusters", {}),
                                       withStacking(methodVariant("gradient", {}), true)};
    methods[2].options.stacking.min_height = 5;
    std::vector<std::vector<std::shared_ptr<const FrameResult>>> seen(methods.size());
    runMethods(source, {}, methods, kScale, {}, {},
               [&](std::size_t method, const std::shared_ptr<const FrameResult>& result, const Frame&) {
                   seen[method].push_back(result);
               });
    for (std::size_t i = 0; i < methods.size(); ++i) {
        Chain alone(methods[i].options, kScale);
        for (int frame = 0; frame < scene.frames; ++frame) {
            const FrameResult expected = alone.next(source.read(frame, false));
            const FrameResult& found = *seen[i].at(static_cast<std::size_t>(frame));
            ASSERT_EQ(expected.detections.size(), found.detections.size()) << methods[i].name << " " << frame;
            for (std::size_t k = 0; k < expected.detections.size(); ++k) {
                EXPECT_EQ(expected.detections[k].box.centre, found.detections[k].box.centre);
                EXPECT_EQ(expected.detections[k].box.length, found.detections[k].box.length);
            }
            ASSERT_EQ(expected.tracks.size(), found.tracks.size());
        }
    }
}

TEST(MethodRun, EveryKindOfMotionAndStackingFindsTheVehicles) {
    const test::MovingScene scene = shortScene();
    test::MemorySource source(scene);
    ChainOptions base;
    base.difference.gap = 4;
    base.difference.background_frames = 9;
    base.difference.background_step = 3;
    base.stacking.min_height = 5;
    std::vector<MethodVariant> methods;
    for (const std::string& word : methodsNamed("motion")) methods.push_back(methodVariant(word, base));
    methods.push_back(withStacking(methodVariant("gradient", base), true));
    std::vector<int> hits(methods.size(), 0);
    const auto results =
        runMethods(source, {}, methods, kScale, {}, {},
                   [&](std::size_t method, const std::shared_ptr<const FrameResult>& result, const Frame& frame) {
                       if (frame.index < 30) return;
                       for (std::size_t v = 0; v < scene.vehicles.size(); ++v) {
                           hits[method] += bestOverlap(result->detections, trueBox(scene, v, frame.index)) > 0.3;
                       }
                   });
    for (std::size_t i = 0; i < methods.size(); ++i) {
        EXPECT_GE(hits[i], 7) << methods[i].name << " of 8";
        EXPECT_FALSE(results[i].detections.empty());
        EXPECT_EQ(results[i].name, methods[i].name);
    }
}

TEST(MethodRun, ThePeerFollowsVehiclesBesideOthersAndTellsEveryFrameOnce) {
    const test::MovingScene scene = shortScene();
    test::MemorySource source(scene);
    std::vector<std::vector<FrameIndex>> told(2);
    const std::vector<MethodVariant> methods{methodVariant("clusters", {}),
                                             methodVariant("three_frame_difference_sort", {})};
    const auto results =
        runMethods(source, {}, methods, kScale, {}, {},
                   [&](std::size_t method, const std::shared_ptr<const FrameResult>& result, const Frame& frame) {
                       EXPECT_EQ(result->motion.frame, frame.index);
                       told[method].push_back(frame.index);
                   });
    EXPECT_EQ(told[0].size(), static_cast<std::size_t>(scene.frames));
    EXPECT_EQ(told[0], told[1]);
    int found = 0;
    std::set<std::pair<std::size_t, int>> ids;
    for (const auto& [frame, boxes] : results[1].tracks) {
        for (std::size_t v = 0; v < scene.vehicles.size(); ++v) {
            for (const BoxRecord& box : boxes) {
                if (overlap(box.box, trueBox(scene, v, frame).upright()) < 0.4) continue;
                ++found;
                ids.emplace(v, box.id.value());
            }
        }
    }
    EXPECT_GE(found, 2 * (scene.frames - 8))
        << "but for the first and last pictures, which nothing lies before or after";
    EXPECT_EQ(ids.size(), 2U);
    EXPECT_FALSE(results[1].detections.empty());
}

TEST(MethodRun, RefusesNothingToDoAndRangesOutsideTheVideo) {
    test::MemorySource source(shortScene());
    EXPECT_THROW(runMethods(source, {}, {}, kScale, {}), Error);
    EXPECT_THROW(runMethods(source, {0, 1000}, {methodVariant("gradient", {})}, kScale, {}), Error);
    MethodVariant without_model = methodVariant("sliding_window", {});
    without_model.options.detection.sliding_window.model = "nowhere.eyriemodel";
    EXPECT_THROW(runMethods(source, {}, {without_model}, kScale, {}), Error);
}

TEST(TrackHalf, ShowsItsStacksAndDifferences) {
    const test::MovingScene scene = shortScene();
    test::MemorySource source(scene);
    ChainOptions options;
    options.stacking.enabled = true;
    MotionHalf motion(options, kScale);
    TrackHalf stacked(options, kScale);
    options.stacking.enabled = false;
    options.difference.method = MotionMethod::two_frame_difference;
    TrackHalf differing(options, kScale);
    for (int i = 0; i < 25; ++i) {
        const Frame frame = source.read(i, false);
        StageTimes times{};
        const FrameMotion found = motion.next(frame, times);
        stacked.next(frame, found, {});
        differing.next(frame, found, {});
        if (i < 24) continue;
        EXPECT_EQ(stacked.differences(), nullptr);
        EXPECT_FALSE(stacked.stackViews(frame, StackPictures::none).empty());
        EXPECT_TRUE(differing.stackViews(frame, StackPictures::none).empty());
        ASSERT_NE(differing.differences(), nullptr);
        EXPECT_EQ(differing.differences()->difference.values.size(), scene.size);
    }
}

}  // namespace eyrie::method_run_test
