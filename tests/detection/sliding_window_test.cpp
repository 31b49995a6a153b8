#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <opencv2/core.hpp>

#include "detection/sliding_window/global_sliding_window.h"
#include "detection/sliding_window/model_location.h"
#include "detection/sliding_window/sliding_window_detector.h"
#include "detection/sliding_window/window_hypotheses.h"
#include "detection/trained_window_model.h"
#include "imaging/upright_patch.h"
#include "learning/classifiers/gentle_adaboost.h"
#include "support/error_message.h"

namespace eyrie::sliding_window_test {
namespace {

using test::drivenScene;
using test::drivenSceneWindow;
using test::kContractScale;
using test::messageOf;
using test::roiOf;

}  // namespace

TEST(DecisionPeaks, KeepLocalMaximaOnly) {
    const float minus_infinity = -std::numeric_limits<float>::infinity();
    cv::Mat decision(5, 6, CV_32FC1, cv::Scalar(-1));
    decision.at<float>(1, 1) = 2;
    decision.at<float>(1, 2) = 1.5F;  // beside a larger one
    decision.at<float>(3, 4) = 0.5F;
    decision.at<float>(3, 5) = 0.5F;  // equals the one before it
    decision.at<float>(4, 0) = 0.2F;
    decision.at<float>(3, 0) = minus_infinity;
    EXPECT_THAT(decisionPeaks(decision, 0), testing::ElementsAre(cv::Point(1, 1), cv::Point(4, 3), cv::Point(0, 4)));
    EXPECT_THAT(decisionPeaks(decision, 0.5), testing::ElementsAre(cv::Point(1, 1), cv::Point(4, 3)));
    EXPECT_TRUE(decisionPeaks({}, 0).empty());
    EXPECT_TRUE(decisionPeaks(cv::Mat(3, 3, CV_32FC1, cv::Scalar(minus_infinity)), 0).empty());
    // Of equals the first in reading order.
    EXPECT_THAT(decisionPeaks(cv::Mat(3, 3, CV_32FC1, cv::Scalar(1)), 0), testing::ElementsAre(cv::Point(0, 0)));
    cv::Mat ties(6, 6, CV_32FC1, cv::Scalar(-1));
    for (const cv::Point p : {cv::Point(1, 1), {1, 2}, {4, 1}, {3, 2}, {3, 4}, {4, 5}}) ties.at<float>(p) = 2;
    EXPECT_THAT(decisionPeaks(ties, 0), testing::ElementsAre(cv::Point(1, 1), cv::Point(4, 1), cv::Point(3, 4)));
}

TEST(SuppressOverlapping, TheSurestStays) {
    const std::vector<WindowHypothesis> hypotheses{
        {{0, 0, 10, 20}, 1.0, 1}, {{5, 0, 10, 20}, 2.0, 1}, {{14, 0, 10, 20}, 1.5, 1}, {{40, 0, 10, 20}, 0.5, 1}};
    // The second overlaps the first by 1/3 and the third by 1/19.
    const auto kept = suppressOverlapping(hypotheses, 0.1);
    ASSERT_EQ(kept.size(), 3U);
    EXPECT_DOUBLE_EQ(kept[0].decision, 2.0);
    EXPECT_DOUBLE_EQ(kept[1].decision, 1.5);
    EXPECT_DOUBLE_EQ(kept[2].decision, 0.5);
    EXPECT_EQ(suppressOverlapping(hypotheses, 0.05).size(), 2U);
    EXPECT_EQ(suppressOverlapping(hypotheses, 0.5).size(), 4U);
}

TEST(SlidingWindowOptions, ScalesOfTheThreeCases) {
    SlidingWindowOptions options;
    options.smallest_scale = 0.5;
    options.largest_scale = 2;
    EXPECT_THAT(options.scales(),
                testing::ElementsAre(testing::DoubleEq(0.5), testing::DoubleEq(1), testing::DoubleEq(2)));
    options.rescaling = WindowRescaling::length_11;
    EXPECT_EQ(options.scales().size(), 11U);
    EXPECT_NEAR(options.scales()[5], 1, 1e-12);
    const SceneScale scene{0.2, 25, true};
    options.car_length_m = 4.3;
    options.car_width_m = 2;
    // At 0.2 m/px such a car has the window's own size; longer ones are shrunk, their width stays.
    EXPECT_EQ(rescaledSize({60, 100}, 1, options, scene), cv::Size(60, 100));
    EXPECT_EQ(rescaledSize({60, 100}, 2, options, scene), cv::Size(60, 50));
    options.rescaling = WindowRescaling::joint_11;
    EXPECT_EQ(rescaledSize({60, 100}, 2, options, scene), cv::Size(30, 50));
}

TEST(SlidingWindowOptions, ScalesOfDefaultsAndThesis) {
    const auto exactly = [](double value) { return testing::DoubleEq(value); };
    EXPECT_THAT(SlidingWindowOptions{}.scales(),
                testing::ElementsAre(exactly(0.85), testing::DoubleNear(1.1292, 1e-4), exactly(1.5)));
    SlidingWindowOptions thesis = SlidingWindowOptions::thesis();
    EXPECT_THAT(thesis.scales(), testing::ElementsAre(exactly(0.85), exactly(1), exactly(3.8)));
    EXPECT_GE(3.8 * thesis.car_length_m, 15) << "buses and lorries are 15 to 20 m long";
    EXPECT_LE(3.8 * thesis.car_length_m, 20);
    for (const WindowRescaling rescaling : {WindowRescaling::length_11, WindowRescaling::joint_11}) {
        thesis.rescaling = rescaling;
        const std::vector<double> scales = thesis.scales();
        ASSERT_EQ(scales.size(), 11U);
        EXPECT_EQ(std::adjacent_find(scales.begin(), scales.end(), std::greater_equal<double>()), scales.end());
        EXPECT_EQ(std::count(scales.begin(), scales.end(), 1.0), 1) << "the original size";
        EXPECT_DOUBLE_EQ(scales.front(), 0.85);
        EXPECT_DOUBLE_EQ(scales.back(), 3.8);
        EXPECT_NEAR(scales[10] / scales[9], scales[3] / scales[2], 1e-9);
    }
    for (const double outside : {0.0, 0.85, 3.8, 9.0}) {
        thesis.rescaling = WindowRescaling::length_3;
        thesis.middle_scale = outside;
        EXPECT_NEAR(thesis.scales()[1], std::sqrt(0.85 * 3.8), 1e-9) << outside;
    }
    // However near it lies to an end, it is among them, and so are both ends.
    for (const WindowRescaling rescaling : {WindowRescaling::length_3, WindowRescaling::length_11})
        for (const double near : {0.851, 3.79}) {
            thesis.rescaling = rescaling;
            thesis.middle_scale = near;
            const std::vector<double> scales = thesis.scales();
            ASSERT_EQ(scales.size(), rescaling == WindowRescaling::length_3 ? 3U : 11U);
            EXPECT_EQ(scales.at(near < 1 ? 1 : scales.size() - 2), near);
            EXPECT_DOUBLE_EQ(scales.front(), 0.85);
            EXPECT_DOUBLE_EQ(scales.back(), 3.8);
        }
}

TEST(ScanAtScale, WithoutRejectionEveryWindowIsLookedAtToTheEnd) {
    // The same model, but with a trace that no window can keep up with.
    const VehicleModel trained = loadModel(test::drivenSceneModel());
    const auto& boosted = dynamic_cast<const GentleAdaBoost&>(*trained.classifier);
    VehicleModel strict = trained;
    strict.classifier = std::make_shared<GentleAdaBoost>(boosted.dimension(), boosted.trees(),
                                                         std::vector<float>(boosted.trees().size(), 5000.F));
    const WindowScanner scanner(strict);
    ASSERT_TRUE(scanner.fast());
    const cv::Mat area = roiOf(drivenScene(0.5)).image;
    SlidingWindowOptions options = drivenSceneWindow();
    const auto lowest = [&](cv::Mat& decision) {
        scanAtScale(scanner, area, 1, options, kContractScale, decision);
        double least = 0;
        cv::minMaxLoc(decision, &least);
        return least;
    };
    cv::Mat decision;
    options.rejection_margin = 999;
    EXPECT_LT(lowest(decision), -1e30);
    options.rejection_margin = SlidingWindowOptions::thesis().rejection_margin;
    EXPECT_GT(lowest(decision), -1e30);
    cv::Mat all;
    const WindowScanner as_trained(trained);
    scanAtScale(as_trained, area, 1, options, kContractScale, all);
    EXPECT_EQ(cv::norm(decision, all, cv::NORM_INF), 0) << "a trace changes no value";
}

TEST(ScanAtScale, BoxesLieAroundTheMiddleOfTheirWindows) {
    // A car of the window's own size: nothing is scaled, and the window at (x, y) covers 16 × 32 pixels from there.
    SlidingWindowOptions options = drivenSceneWindow();
    options.car_length_m = 21.5 * kContractScale.gsd_m_per_px;
    options.car_width_m = 10 * kContractScale.gsd_m_per_px;
    options.decision_threshold = -1000;
    options.rejection_margin = SlidingWindowOptions::kNoRejection;
    const WindowScanner scanner(loadModel(test::drivenSceneModel()));
    cv::Mat decision;
    const auto found = scanAtScale(scanner, roiOf(drivenScene(0.5)).image, 1, options, kContractScale, decision);
    const auto peaks = decisionPeaks(decision, -1000);
    ASSERT_FALSE(found.empty());
    ASSERT_EQ(found.size(), peaks.size());
    for (std::size_t i = 0; i < found.size(); ++i) {
        EXPECT_NEAR(found[i].box.x + found[i].box.width / 2, peaks[i].x + 7.5, 1e-9);
        EXPECT_NEAR(found[i].box.y + found[i].box.height / 2, peaks[i].y + 15.5, 1e-9);
        EXPECT_NEAR(found[i].box.width, 10, 1e-9);
        EXPECT_NEAR(found[i].box.height, 21.5, 1e-9);
    }
}

TEST(ScanAtScale, AModelOfVehiclesThatFillTheWindowHasBoxesOfItsSize) {
    // A car of 16 × 32 pixels fills the window as it is.
    SlidingWindowOptions options = drivenSceneWindow();
    options.car_length_m = 32 * kContractScale.gsd_m_per_px;
    options.car_width_m = 16 * kContractScale.gsd_m_per_px;
    options.decision_threshold = -1000;
    options.rejection_margin = SlidingWindowOptions::kNoRejection;
    VehicleModel model = loadModel(test::drivenSceneModel());
    model.fit = WindowFit::filled();
    const WindowScanner scanner(model);
    const cv::Mat area = roiOf(drivenScene(0.5)).image;
    cv::Mat decision;
    const auto found = scanAtScale(scanner, area, 1, options, kContractScale, decision);
    EXPECT_EQ(decision.size(), cv::Size(area.cols - 15, area.rows - 31));
    const auto peaks = decisionPeaks(decision, -1000);
    ASSERT_FALSE(found.empty());
    ASSERT_EQ(found.size(), peaks.size());
    for (std::size_t i = 0; i < found.size(); ++i) {
        EXPECT_NEAR(found[i].box.x, peaks[i].x - 0.5, 1e-9);
        EXPECT_NEAR(found[i].box.y, peaks[i].y - 0.5, 1e-9);
        EXPECT_NEAR(found[i].box.width, 16, 1e-9);
        EXPECT_NEAR(found[i].box.height, 32, 1e-9);
    }
}

TEST(ScanAtScale, WhatIsShrunkInOneDirectionIsAveraged) {
    // Across nothing is scaled, along two pixels become one.
    SlidingWindowOptions options = drivenSceneWindow();
    options.car_length_m = 21.5 * kContractScale.gsd_m_per_px;
    options.car_width_m = 10 * kContractScale.gsd_m_per_px;
    options.rejection_margin = SlidingWindowOptions::kNoRejection;
    const WindowScanner scanner(loadModel(test::drivenSceneModel()));
    const cv::Mat area = roiOf(drivenScene(0.5)).image.rowRange(0, 80);
    cv::Mat shrunk, of_area, of_shrunk;
    cv::resize(area, shrunk, {area.cols, 40}, 0, 0, cv::INTER_AREA);
    scanAtScale(scanner, area, 2, options, kContractScale, of_area);
    scanAtScale(scanner, shrunk, 1, options, kContractScale, of_shrunk);
    ASSERT_FALSE(of_shrunk.empty());
    ASSERT_EQ(of_area.size(), of_shrunk.size());
    EXPECT_EQ(cv::norm(of_area, of_shrunk, cv::NORM_INF), 0);
}

TEST(ScanAtScale, WhatIsShrunkAcrossAloneIsAveragedToo) {
    // Along nothing is scaled, across two pixels become one.
    SlidingWindowOptions options = drivenSceneWindow();
    options.car_length_m = 21.5 * kContractScale.gsd_m_per_px;
    options.car_width_m = 20 * kContractScale.gsd_m_per_px;
    options.rejection_margin = SlidingWindowOptions::kNoRejection;
    const WindowScanner scanner(loadModel(test::drivenSceneModel()));
    const cv::Mat area = roiOf(drivenScene(0.5)).image.colRange(0, 40);
    ASSERT_EQ(rescaledSize(area.size(), 1, options, kContractScale, scanner.model().fit), cv::Size(20, area.rows));
    cv::Mat shrunk, of_area, of_shrunk;
    cv::resize(area, shrunk, {20, area.rows}, 0, 0, cv::INTER_AREA);
    scanAtScale(scanner, area, 1, options, kContractScale, of_area);
    scanner.scan(shrunk, WindowScanner::kNothingRejected, of_shrunk);
    ASSERT_FALSE(of_shrunk.empty());
    ASSERT_EQ(of_area.size(), of_shrunk.size());
    EXPECT_EQ(cv::norm(of_area, of_shrunk, cv::NORM_INF), 0);
}

TEST(SlidingWindow, ScoresAreDecisionValuesAndTheThresholdHolds) {
    SlidingWindowOptions options = drivenSceneWindow();
    const MotionRoi roi = roiOf(drivenScene(0.5));
    const auto found = makeSlidingWindowDetector(options, kContractScale, 0.5)->detect(roi);
    ASSERT_FALSE(found.empty());
    EXPECT_GE(found[0].score, options.decision_threshold);
    options.decision_threshold = found[0].score + 1;
    EXPECT_TRUE(makeSlidingWindowDetector(options, kContractScale, 0.5)->detect(roi).empty());
    options.fall_back = true;
    EXPECT_EQ(makeSlidingWindowDetector(options, kContractScale, 0.5)->detect(roi).size(), 1U);
}

TEST(SlidingWindow, ShowsItsDecisionsWhereTheWindowsAre) {
    SlidingWindowOptions options = drivenSceneWindow();
    options.smallest_scale = options.largest_scale = 1;
    const MotionRoi roi = roiOf(drivenScene(0.5));
    DetectionTrace trace;
    const auto found = makeSlidingWindowDetector(options, kContractScale, 0.5)->detect(roi, &trace);
    ASSERT_FALSE(found.empty());
    const auto shown = std::find_if(trace.layers.begin(), trace.layers.end(),
                                    [](const auto& layer) { return layer.kind == TraceLayer::decision; });
    ASSERT_NE(shown, trace.layers.end());
    EXPECT_EQ(shown->scale, 1);
    EXPECT_EQ(shown->image.size(), roi.image.size());
    cv::Point peak;
    cv::minMaxLoc(shown->image, nullptr, nullptr, nullptr, &peak);
    const cv::Vec2d in_image = roi.image_from_roi * cv::Vec3d(peak.x, peak.y, 1);
    // Windows have an even size: the middle lies between two places. A place is some two pixels of the search area.
    EXPECT_LT(std::hypot(in_image[0] - found[0].box.centre.x, in_image[1] - found[0].box.centre.y), 2.5);
    const auto& best = trace.checks.front();
    EXPECT_EQ(best.parameter, "sliding_window.decision_threshold");
    EXPECT_NEAR(best.value, found[0].score, 1e-6);
}

TEST(SlidingWindow, WithoutVectorsInsideAWindowIsDropped) {
    SlidingWindowOptions options = drivenSceneWindow();
    MotionRoi roi = roiOf(drivenScene(0.5));
    roi.vectors = {{-500, -500}};
    EXPECT_TRUE(makeSlidingWindowDetector(options, kContractScale, 0.5)->detect(roi).empty());
    options.need_support = false;
    EXPECT_FALSE(makeSlidingWindowDetector(options, kContractScale, 0.5)->detect(roi).empty());
    roi.inside = cv::Mat::zeros(roi.image.size(), CV_8UC1);
    EXPECT_TRUE(makeSlidingWindowDetector(options, kContractScale, 0.5)->detect(roi).empty()) << "beyond the video";
}

TEST(SlidingWindow, AWindowHoldsItsShareOfTheVectors) {
    // Of a hundred vectors the window on the vehicle holds four.
    SlidingWindowOptions options = drivenSceneWindow();
    const auto scene = drivenScene(0.5);
    MotionRoi roi = roiOf(scene);
    const cv::Point2f middle = toPatch(roi.image_from_roi, scene.vehicle.centre);
    roi.vectors.assign(96, {-500, -500});
    for (const float off : {-1.F, 0.F, 1.F, 2.F}) roi.vectors.push_back(middle + cv::Point2f(off, 0));
    for (const auto& [share, found] : {std::pair(0.04, true), {0.05, false}}) {
        options.support_share = share;
        DetectionTrace trace;
        const auto detections = makeSlidingWindowDetector(options, kContractScale, 0.5)->detect(roi, &trace);
        EXPECT_EQ(!detections.empty(), found) << share;
        for (const auto& check : trace.checks) {
            if (check.parameter != "sliding_window.support_share") continue;
            EXPECT_NEAR(check.limit, share * 100, 1e-9);
            EXPECT_EQ(check.passed, check.value >= share * 100);
        }
    }
}

TEST(SlidingWindow, TellsNoBestWindowWhereNoneFits) {
    MotionRoi roi;
    roi.image = cv::Mat(12, 6, CV_8UC1, cv::Scalar(90));
    roi.inside = cv::Mat(12, 6, CV_8UC1, cv::Scalar(255));
    roi.image_from_roi = {1, 0, 0, 0, 1, 0};
    DetectionTrace trace;
    EXPECT_TRUE(makeSlidingWindowDetector(drivenSceneWindow(), kContractScale, 0.5)->detect(roi, &trace).empty());
    EXPECT_TRUE(trace.checks.empty()) << trace.checks.front().what;
}

TEST(SlidingWindow, TheMiddleOfAWindowMustLieInTheVideo) {
    MotionRoi roi = roiOf(drivenScene(0.5));
    const auto detector = makeSlidingWindowDetector(drivenSceneWindow(), kContractScale, 0.5);
    const auto best = detector->detect(roi).at(0);
    const cv::Point middle(toPatch(roi.image_from_roi, best.box.centre));
    roi.inside = cv::Scalar(0);
    cv::circle(roi.inside, middle, 3, 255, cv::FILLED);
    ASSERT_FALSE(detector->detect(roi).empty());
    EXPECT_EQ(detector->detect(roi)[0].box.centre, best.box.centre);
    roi.inside = 255 - roi.inside;
    for (const Detection& other : detector->detect(roi)) EXPECT_GT(cv::norm(other.box.centre - best.box.centre), 2);
}

TEST(SlidingWindow, TheGlobalOneFindsTheVehicleWithoutMotion) {
    const auto scene = drivenScene(0.5);
    const WindowScanner scanner(loadModel(test::drivenSceneModel()));
    const auto found = globalSlidingWindow(scanner, scene.frame.gray, drivenSceneWindow(), kContractScale);
    ASSERT_FALSE(found.empty());
    EXPECT_GT(overlap(found[0].box, scene.vehicle), 0.5);
    for (const Detection& detection : found) {
        EXPECT_GT(detection.box.heading, -kPi / 2);
        EXPECT_LE(detection.box.heading, kPi / 2 + 1e-9);
        EXPECT_EQ(detection.cluster, -1);
    }
}

TEST(SlidingWindow, TheGlobalOnePlacesItsBoxesToTheFractionOfAPixel) {
    // One direction, downwards: the picture turned upside down, and its windows turned back.
    const cv::Mat picture = drivenScene(kPi / 2).frame.gray;
    SlidingWindowOptions options = drivenSceneWindow();
    options.smallest_scale = options.largest_scale = 1;
    options.rejection_margin = SlidingWindowOptions::kNoRejection;
    const WindowScanner scanner(loadModel(test::drivenSceneModel()));
    cv::Mat turned, decision;
    cv::rotate(picture, turned, cv::ROTATE_180);
    const auto windows = suppressOverlapping(scanAtScale(scanner, turned, 1, options, kContractScale, decision), 0.1);
    const auto found = globalSlidingWindow(scanner, picture, options, kContractScale, 1);
    ASSERT_FALSE(windows.empty());
    ASSERT_FALSE(found.empty());
    const cv::Rect2d& best = windows[0].box;
    EXPECT_NEAR(found[0].box.centre.x, picture.cols - 1 - best.x - best.width / 2, 1e-9);
    EXPECT_NEAR(found[0].box.centre.y, picture.rows - 1 - best.y - best.height / 2, 1e-9);
    EXPECT_NEAR(found[0].box.length, best.height, 1e-9);
    EXPECT_NEAR(found[0].box.width, best.width, 1e-9);
}

TEST(ModelLocation, TheModelOfTheThesisIsTrainedAsItsTextSays) {
    const VehicleModel model = loadModel(modelLocation(SlidingWindowOptions::thesis().model));
    EXPECT_EQ(model.descriptor->kind(), DescriptorKind::channel_features);
    EXPECT_EQ(model.descriptor->dimension(), 2000);
    const auto* boosted = dynamic_cast<const GentleAdaBoost*>(model.classifier.get());
    ASSERT_NE(boosted, nullptr);
    EXPECT_EQ(boosted->trees().size(), 1000U);
    const TrainingRecord& record = model.record;
    EXPECT_EQ(record.hard_negative_rounds, 0);
    EXPECT_EQ(record.vehicles, record.others) << "as many of the background as of vehicles";
    EXPECT_EQ(model.fit, WindowFit::filled()) << "the vehicle itself is cut out";
    EXPECT_THAT(record.data, testing::Not(testing::HasSubstr("rendered"))) << "pictures of the world alone";
    // Every tree sees all features and all samples, and the samples are no copies.
    for (const char* setting :
         {"training.trees = 1000\n", "training.hard_negative_rounds = 0\n", "training.feature_share = 1\n",
          "training.weight_trimming = 0\n", "training.duplicates = false\n", "training.mirrored = false\n",
          "training.varied_copies = 0\n", "training.misfit_copies = 0\n", "training.fill_window = true\n"})
        EXPECT_THAT(record.settings, testing::HasSubstr(setting));
    EXPECT_NE(modelLocation("thesis"), modelLocation(""));
}

TEST(ModelLocation, SaysWhereItLooked) {
    EXPECT_THAT(messageOf([] { modelLocation("nowhere/at/all.eyriemodel"); }),
                testing::HasSubstr("nowhere/at/all.eyriemodel: there is no such model"));
    EXPECT_EQ(modelLocation(test::drivenSceneModel()), test::drivenSceneModel());
    EXPECT_EQ(modelLocation("").filename(), kShippedModel);
    EXPECT_EQ(modelLocation("thesis").filename(), kThesisModel);
    EXPECT_THAT(messageOf([] { makeSlidingWindowDetector({}, kContractScale, 0.5); }),
                testing::AnyOf("no error", testing::HasSubstr("eyrie-cli train")));
}

}  // namespace eyrie::sliding_window_test
