#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include "core/geometry/angle.h"
#include "detection/detector.h"
#include "support/driven_scene.h"

/// What every detector must do, whatever its method. Include it in one source file of a test program and use it as
///     INSTANTIATE_TEST_SUITE_P(Gradient, DetectorContract, testing::Values(DetectorMaker{"lbp", [] { return … ; }}));
namespace eyrie::test {

/// A name and a function that makes the detector; its options must fit vehicles of 40×16 px.
struct DetectorMaker {
    std::string name;
    std::function<std::unique_ptr<Detector>()> make;
};

inline void PrintTo(const DetectorMaker& maker, std::ostream* out) {
    *out << maker.name;
}

class DetectorContract : public testing::TestWithParam<DetectorMaker> {
 protected:
    void SetUp() override { detector_ = GetParam().make(); }

    static OrientedBox best(const std::vector<Detection>& detections, const OrientedBox& vehicle) {
        OrientedBox found;
        for (const Detection& detection : detections) {
            if (overlap(detection.box, vehicle) >= overlap(found, vehicle)) found = detection.box;
        }
        return found;
    }
    std::unique_ptr<Detector> detector_;
};

TEST_P(DetectorContract, FindsTheVehicleInImageCoordinates) {
    for (const double heading : {0.0, 0.7, kPi / 2, 2.5, -2.0}) {
        const DrivenScene scene = drivenScene(heading);
        const auto detections = detector_->detect(roiOf(scene));
        ASSERT_FALSE(detections.empty());
        EXPECT_GT(overlap(best(detections, scene.vehicle), scene.vehicle), 0.6) << "heading " << heading;
    }
}

TEST_P(DetectorContract, CarriesHeadingVelocityAndCluster) {
    const DrivenScene scene = drivenScene(1.1);
    for (const Detection& detection : detector_->detect(roiOf(scene, 5))) {
        EXPECT_NEAR(turnBetween(detection.box.heading, 1.1), 0, 1e-6);
        EXPECT_EQ(detection.velocity, scene.cluster.velocity);
        EXPECT_EQ(detection.cluster, 5);
        EXPECT_EQ(detection.rejection, Rejection::none);
        EXPECT_GT(detection.box.length, 0);
        EXPECT_GT(detection.box.width, 0);
    }
}

TEST_P(DetectorContract, TurningTheSceneTurnsTheBoxes) {
    const DrivenScene ahead = drivenScene(0.3);
    const DrivenScene turned = drivenScene(0.3 + kPi / 3);
    const OrientedBox a = best(detector_->detect(roiOf(ahead)), ahead.vehicle);
    const OrientedBox b = best(detector_->detect(roiOf(turned)), turned.vehicle);
    EXPECT_NEAR(a.length, b.length, 3);
    EXPECT_NEAR(a.width, b.width, 3);
    EXPECT_NEAR(turnBetween(a.heading, b.heading), kPi / 3, 1e-6);
}

TEST_P(DetectorContract, IsRepeatableAndLeavesTheRoiAlone) {
    const MotionRoi roi = roiOf(drivenScene(0.3));
    const cv::Mat before = roi.image.clone();
    const auto first = detector_->detect(roi);
    const auto second = detector_->detect(roi);
    ASSERT_EQ(first.size(), second.size());
    for (std::size_t i = 0; i < first.size(); ++i) EXPECT_EQ(first[i].box.centre, second[i].box.centre);
    EXPECT_EQ(cv::norm(before, roi.image, cv::NORM_INF), 0);
}

TEST_P(DetectorContract, TracesItsStepsWithoutChangingTheResult) {
    const MotionRoi roi = roiOf(drivenScene(-0.9));
    DetectionTrace trace;
    const auto with = detector_->detect(roi, &trace);
    const auto without = detector_->detect(roi);
    ASSERT_EQ(with.size(), without.size());
    for (std::size_t i = 0; i < with.size(); ++i) EXPECT_EQ(with[i].box.length, without[i].box.length);
    ASSERT_FALSE(trace.layers.empty());
    EXPECT_EQ(trace.layers.front().kind, TraceLayer::raw);
    for (const auto& layer : trace.layers)
        EXPECT_EQ(layer.image.size(), roi.image.size()) << static_cast<int>(layer.kind);
}

TEST_P(DetectorContract, DecidesWhatItDetectsPreparedOrNot) {
    const MotionRoi roi = roiOf(drivenScene(0.3));
    const auto expected = detector_->detect(roi);
    const auto prepared = detector_->prepare(roi);
    for (const auto& decided : {detector_->decide(roi, prepared.get()), detector_->decide(roi, nullptr)}) {
        ASSERT_EQ(decided.size(), expected.size());
        for (std::size_t i = 0; i < expected.size(); ++i) {
            EXPECT_EQ(decided[i].box.centre, expected[i].box.centre);
            EXPECT_EQ(decided[i].box.length, expected[i].box.length);
            EXPECT_EQ(decided[i].box.width, expected[i].box.width);
            EXPECT_EQ(decided[i].score, expected[i].score);
        }
    }
}

TEST_P(DetectorContract, MayBeCalledForSeveralRoisAtOnce) {
    std::vector<MotionRoi> rois;
    for (int i = 0; i < 8; ++i) rois.push_back(roiOf(drivenScene(0.4 * i, {150.0 + i, 118}, 3)));
    std::vector<std::vector<Detection>> one_by_one;
    for (const MotionRoi& roi : rois) one_by_one.push_back(detector_->detect(roi));
    std::vector<std::vector<Detection>> at_once(rois.size());
    {
        std::vector<std::jthread> threads;
        for (std::size_t i = 0; i < rois.size(); ++i)
            threads.emplace_back([&, i] { at_once[i] = detector_->detect(rois[i]); });
    }
    for (std::size_t i = 0; i < rois.size(); ++i) {
        ASSERT_EQ(at_once[i].size(), one_by_one[i].size());
        for (std::size_t k = 0; k < at_once[i].size(); ++k)
            EXPECT_EQ(at_once[i][k].box.centre, one_by_one[i][k].box.centre);
    }
}

TEST_P(DetectorContract, TakesWhateverRoiComes) {
    const auto check = [&](const MotionRoi& roi) {
        for (const Detection& detection : detector_->detect(roi)) {
            EXPECT_TRUE(std::isfinite(detection.box.centre.x + detection.box.centre.y + detection.box.heading));
            EXPECT_TRUE(std::isfinite(detection.box.area()));
        }
    };
    check({});
    for (const cv::Point2d centre : {cv::Point2d(0, 0), cv::Point2d(319, 120), cv::Point2d(-400, 120)}) {
        check(roiOf(drivenScene(0.3, centre)));
    }
    DrivenScene flat = drivenScene(0.3);
    flat.frame.gray.setTo(0);
    check(roiOf(flat));
    flat.frame.gray.setTo(255);
    check(roiOf(flat));
    DrivenScene no_vectors = drivenScene(0.3);
    no_vectors.cluster.members.clear();
    check(roiOf(no_vectors));
    MotionRoi pixel = roiOf(drivenScene(0.3));
    pixel.image = cv::Mat(1, 1, CV_8UC1, cv::Scalar(7));
    pixel.inside = cv::Mat(1, 1, CV_8UC1, cv::Scalar(255));
    pixel.vectors = {{0, 0}};
    check(pixel);
    DrivenScene tiny = drivenScene(0.3);
    tiny.frame.gray = cv::Mat(1, 1, CV_8UC1, cv::Scalar(3));
    check(roiOf(tiny));
}

}  // namespace eyrie::test
