#include "chain/scale/scale_estimation.h"

#include <gtest/gtest.h>

#include "core/error.h"
#include "scene/scene_source.h"
#include "support/moving_scene.h"
#include "support/shared_data.h"

namespace eyrie::scale_estimation_test {

namespace {

constexpr double kAllowed = 0.2;  ///< share of the truth by which an estimate may be off

/// A part of a source's pictures, which does not tell what is known of its scale. All of a picture shows nothing more
/// and takes its time.
class PartWithoutScale : public FrameSource {
 public:
    PartWithoutScale(FrameSource& source, cv::Rect part) : source_(source), part_(part), info_(source.info()) {
        info_.gsd_m_per_px = 0;
        info_.size = part.size();
    }
    const VideoInfo& info() const override { return info_; }
    Frame read(FrameIndex index, bool) override {
        Frame frame = source_.read(index, false);
        frame.gray = frame.gray(part_).clone();
        return frame;
    }
    std::int64_t timeOf(FrameIndex index) const override { return source_.timeOf(index); }
    void forgetRate() { info_.frame_rate_assumed = true; }

 private:
    FrameSource& source_;
    cv::Rect part_;
    VideoInfo info_;
};

/// Looks for the scale alone, which comes before how it changes over the picture.
ChainOptions fromAbove() {
    ChainOptions options;
    options.view.oblique = false;
    return options;
}

constexpr FrameRange kBeginning{0, 27};  ///< tracks have formed and been seen for a while

/// What a part of the picture says.
std::optional<ScaleEstimate> lookAt(FrameSource& source, cv::Rect part, FrameRange range = kBeginning,
                                    const std::stop_token& stop = {}) {
    PartWithoutScale unknown(source, part);
    return chooseScale(unknown, range, fromAbove(), {}, stop).estimate;
}

cv::Rect wholeOf(const FrameSource& source) {
    return {{}, source.info().size};
}

std::unique_ptr<FrameSource> sharedSource(const char* folder, double frame_rate_hz) {
    SourceOptions options;
    options.frame_rate_hz = frame_rate_hz;
    return openSource(test::sharedData(folder), options);
}

}  // namespace

TEST(ScaleEstimation, findsTheScaleOfRealTraffic) {
    EYRIE_NEED_SHARED_DATA("collage_day");
    const auto source = openSource(test::sharedData("collage_day/frames"));
    const auto [scale, basis, of_vehicles, estimate, why_not] = chooseScale(*source, {}, fromAbove(), {}, {});
    EXPECT_FALSE(scale.gsd_known) << "a guess is no knowledge";
    EXPECT_NEAR(scale.gsd_m_per_px, 0.2, kAllowed * 0.2);
    ASSERT_TRUE(estimate);
    EXPECT_EQ(estimate->gsd_m_per_px, scale.gsd_m_per_px);
    EXPECT_GT(estimate->uncertainty, 1.1);
    EXPECT_LT(estimate->uncertainty, 1.3) << "many cars drive there";
    EXPECT_EQ(basis, (ScaleBasis{ScaleOrigin::estimated, estimate->uncertainty, estimate->vehicles}));
}

TEST(ScaleEstimation, findsTheScaleOfARenderedSceneAndIsWideWhereFewVehiclesDrive) {
    const auto scene = openScene("stops");
    const double truth = scene->info().gsd_m_per_px;
    const auto estimate = lookAt(*scene, {0, 0, 200, 300});
    ASSERT_TRUE(estimate);
    EXPECT_NEAR(estimate->gsd_m_per_px, truth, kAllowed * truth);
    EXPECT_LT(estimate->vehicles, 5);
    EXPECT_GT(estimate->uncertainty, 1.3);
}

TEST(ScaleEstimation, findsTheScaleInAFewPicturesAtTwoASecond) {
    EYRIE_NEED_SHARED_DATA("kit_ais_crossroad");
    const auto source = sharedSource("kit_ais_crossroad/img", 2);
    const auto estimate = lookAt(*source, wholeOf(*source), {});
    ASSERT_TRUE(estimate);
    EXPECT_NEAR(estimate->gsd_m_per_px, 0.13, kAllowed * 0.13);
}

TEST(ScaleEstimation, speedsSayNothingWhereNobodyKnowsTheFrameRate) {
    const auto scene = openScene("stops");
    PartWithoutScale part(*scene, {0, 0, 200, 300});
    const auto look = [&] { return chooseScale(part, kBeginning, fromAbove(), {}, {}).estimate.value(); };
    const ScaleEstimate by_speeds_too = look();
    part.forgetRate();
    EXPECT_GT(look().uncertainty, by_speeds_too.uncertainty);
}

TEST(ScaleEstimation, lampsAndBeamsOfANightAreNoTraffic) {
    EYRIE_NEED_SHARED_DATA("uavdt_m1003");
    const auto source = sharedSource("uavdt_m1003/img1", 30);
    const auto estimate = lookAt(*source, {256, 0, 512, 540});
    ASSERT_TRUE(estimate);
    EXPECT_NEAR(estimate->gsd_m_per_px, 0.2, kAllowed * 0.2);
}

TEST(ScaleEstimation, aHouseThatIsFlownRoundIsNoTraffic) {
    EYRIE_NEED_SHARED_DATA("uav123_building4");
    const auto source = sharedSource("uav123_building4", 10);
    EXPECT_FALSE(lookAt(*source, wholeOf(*source), {0, 39}));
}

TEST(ScaleEstimation, aStatedScaleIsTakenAsItIsAndItIsKeptWhoStatedIt) {
    test::MemorySource source((test::MovingScene()));
    for (const ScaleOrigin origin : {ScaleOrigin::given, ScaleOrigin::metadata}) {
        const ChosenScale chosen = chooseScale(source, {}, ChainOptions{}, {0.31, origin, {}}, {});
        EXPECT_EQ(chosen.basis, ScaleBasis{origin});
        EXPECT_TRUE(chosen.scale.gsd_known);
        EXPECT_DOUBLE_EQ(chosen.scale.gsd_m_per_px, 0.31);
        EXPECT_FALSE(chosen.estimate) << "nothing to look for";
    }
}

TEST(ScaleEstimation, aScaleReadOffVehiclesOfAnObliqueViewIsMovedToTheMiddleOneThatWasMeasuredIsNot) {
    EYRIE_NEED_SHARED_DATA("uavdt_m1003");
    const auto source = openSource(test::sharedData("uavdt_m1003/img1"));
    const ChosenScale by_person = chooseScale(*source, {}, ChainOptions{}, {0.2, ScaleOrigin::given}, {});
    ASSERT_FALSE(by_person.scale.slope.isFlat()) << "the flight tells it; few vehicles drive there";
    EXPECT_NEAR(by_person.scale.slope.down_per_px * 270, 0.5, 0.1);
    EXPECT_EQ(by_person.gsd_of_vehicles, 0.2);
    EXPECT_NEAR(by_person.scale.gsd_m_per_px, 0.175, 0.02);
    EXPECT_EQ(by_person.scale.slope.centre(), cv::Point2d(511.5, 269.5));
    EXPECT_TRUE(by_person.scale.gsd_known);
    const ChosenScale measured = chooseScale(*source, {}, ChainOptions{}, {0.2, ScaleOrigin::metadata}, {});
    EXPECT_EQ(measured.scale.gsd_m_per_px, 0.2);
    EXPECT_EQ(measured.scale.slope, by_person.scale.slope);
    EXPECT_FALSE(measured.gsd_of_vehicles);
}

TEST(ScaleEstimation, whatASourceKnowsItselfCountsAsGiven) {
    const auto scene = openScene("stops");
    const ChosenScale chosen = chooseScale(*scene, {}, ChainOptions{}, {}, {});
    EXPECT_EQ(chosen.basis, ScaleBasis{ScaleOrigin::given});
    EXPECT_EQ(chosen.scale.gsd_m_per_px, scene->info().gsd_m_per_px);
}

TEST(ScaleEstimation, isTheSameOnOneProcessor) {
    test::MemorySource source((test::MovingScene()));
    const auto beside = lookAt(source, wholeOf(source));
    cv::setNumThreads(1);
    const auto alone = lookAt(source, wholeOf(source));
    cv::setNumThreads(-1);
    ASSERT_TRUE(beside && alone);
    EXPECT_EQ(alone->gsd_m_per_px, beside->gsd_m_per_px);
    EXPECT_EQ(alone->uncertainty, beside->uncertainty);
    EXPECT_EQ(alone->vehicles, beside->vehicles);
}

TEST(ScaleEstimation, withoutTrafficItFallsBackAndDoesNotFail) {
    test::MovingScene scene;
    scene.vehicles.clear();
    scene.frames = 20;
    test::MemorySource source(scene);
    const ChosenScale chosen = chooseScale(source, {}, ChainOptions{}, {}, {});
    EXPECT_DOUBLE_EQ(chosen.scale.gsd_m_per_px, SceneScale{}.gsd_m_per_px);
    EXPECT_EQ(chosen.basis, ScaleBasis{ScaleOrigin::assumed});
}

TEST(ScaleEstimation, aStandingQueueAndOneRiderDoNotSettleTheScaleOfAllThatDrivesLater) {
    EYRIE_NEED_SHARED_DATA("uavdt_s1606");
    const auto source = sharedSource("uavdt_s1606/frames", 30);
    const auto estimate = lookAt(*source, {0, 270, 1024, 270}, {});
    ASSERT_TRUE(estimate);
    EXPECT_NEAR(estimate->gsd_m_per_px, 0.09, kAllowed * 0.09) << "the first 40 frames alone say 0.12";
}

TEST(ScaleEstimation, withoutAClassifierARunThatNeedsNoneFallsBackAndSaysWhy) {
    test::MemorySource source((test::MovingScene()));
    ChainOptions options;
    options.detection.sliding_window.model = "nowhere.eyriemodel";
    options.detection.method = DetectionMethod::gradient;
    const ChosenScale chosen = chooseScale(source, {}, options, {}, {});
    EXPECT_EQ(chosen.basis, ScaleBasis{ScaleOrigin::assumed});
    EXPECT_NE(chosen.why_not.find("nowhere.eyriemodel"), std::string::npos) << chosen.why_not;
    EXPECT_TRUE(chooseScale(source, {}, options, {0.3}, {}).why_not.empty()) << "nothing to look for";
    options.detection.method = DetectionMethod::window_and_gradient;
    EXPECT_THROW(chooseScale(source, {}, options, {}, {}), Error);
}

TEST(ScaleEstimation, tellsHowFarItIs) {
    test::MovingScene scene;
    scene.frames = 6;
    test::MemorySource source(scene);
    std::vector<RunProgress> told;
    chooseScale(source, {}, ChainOptions{}, {}, {}, [&](const RunProgress& progress) { told.push_back(progress); });
    ASSERT_FALSE(told.empty());
    int done = 0;
    int looks = 0;  // first for one scale, then, as there is none, for one that changes over the picture
    for (const RunProgress& progress : told) {
        EXPECT_TRUE(progress.estimating_scale);
        EXPECT_EQ(progress.frames_done, ++done);
        if (progress.frames_done < progress.frames_total) continue;
        EXPECT_EQ(progress.frames_done, progress.frames_total);
        ++looks;
        done = 0;
    }
    EXPECT_EQ(done, 0) << "each look ends where it said";
    EXPECT_EQ(looks, 2);
    told.clear();
    ChainOptions straight_down;
    straight_down.view.oblique = false;
    chooseScale(source, {}, straight_down, {0.3}, {}, [&](const RunProgress& progress) { told.push_back(progress); });
    EXPECT_TRUE(told.empty()) << "nothing to look for";
}

TEST(ScaleEstimation, stopsWhenAsked) {
    std::stop_source stop;
    stop.request_stop();
    test::MemorySource source((test::MovingScene()));
    EXPECT_FALSE(lookAt(source, wholeOf(source), kBeginning, stop.get_token()));
}

}  // namespace eyrie::scale_estimation_test
