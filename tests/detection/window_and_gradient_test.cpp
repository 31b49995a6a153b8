#include "detection/sliding_window/window_and_gradient_detector.h"

#include <gtest/gtest.h>

#include <opencv2/core.hpp>

namespace eyrie::window_and_gradient_test {
namespace {

/// Delivers what it is told to, in image coordinates.
class Told : public Detector {
 public:
    Told(std::vector<OrientedBox> boxes, bool complete, double score)
        : boxes_(std::move(boxes)), complete_(complete), score_(score) {}
    std::vector<Detection> detect(const MotionRoi&, DetectionTrace*) const override {
        std::vector<Detection> found;
        for (const OrientedBox& box : boxes_) {
            Detection detection;
            detection.box = box;
            detection.complete = complete_;
            detection.score = score_;
            found.push_back(detection);
        }
        return found;
    }
    const VehicleModel* model() const override { return nullptr; }

 private:
    std::vector<OrientedBox> boxes_;
    bool complete_;
    double score_;
};

std::vector<Detection> together(double decision, const std::vector<OrientedBox>& windows,
                                const std::vector<OrientedBox>& segments, DetectionTrace* trace = nullptr,
                                double most_covered = WindowAndGradientOptions{}.most_covered) {
    WindowAndGradientOptions options;
    options.sure_decision = 5;
    options.most_covered = most_covered;
    const WindowAndGradientDetector detector(std::make_unique<Told>(windows, true, decision),
                                             std::make_unique<Told>(segments, false, 0), options, 3);
    MotionRoi roi;
    roi.image = cv::Mat(60, 40, CV_8UC1, cv::Scalar(9));
    roi.inside = cv::Mat(60, 40, CV_8UC1, cv::Scalar(255));
    roi.image_from_roi = {1, 0, 0, 0, 1, 0};
    return detector.detect(roi, trace);
}

const OrientedBox kCar{{20, 20}, 16, 8, 0};
const OrientedBox kRear{{14, 20}, 5, 6, 0};
const OrientedBox kOther{{20, 40}, 14, 7, 0};

TEST(WindowAndGradient, ASureWindowTakesItsSegments) {
    const auto found = together(7, {kCar}, {kRear, kOther});
    ASSERT_EQ(found.size(), 2U);
    EXPECT_TRUE(found[0].complete);
    EXPECT_EQ(found[0].box.centre, kCar.centre);
    EXPECT_FALSE(found[1].complete);
    EXPECT_EQ(found[1].box.centre, kOther.centre);
}

TEST(WindowAndGradient, AnUnsureWindowLeavesThePlaceToSegments) {
    const auto found = together(3, {kCar}, {kRear});
    ASSERT_EQ(found.size(), 1U);
    EXPECT_FALSE(found[0].complete);
    EXPECT_EQ(found[0].box.centre, kRear.centre);
}

TEST(WindowAndGradient, ASegmentIsCoveredByMoreThanItsShare) {
    // A third of a box of 6 × 8 px that ends 2 px inside the car.
    const OrientedBox third{{11, 20}, 6, 8, 0};
    EXPECT_EQ(together(7, {kCar}, {third}, nullptr, 0.3).size(), 1U);
    EXPECT_EQ(together(7, {kCar}, {third}, nullptr, 0.35).size(), 2U);
    EXPECT_EQ(together(7, {kCar}, {kOther}, nullptr, 0).size(), 2U) << "what is not touched is never covered";
    EXPECT_EQ(together(5, {kCar}, {kRear}).size(), 1U) << "sure from the limit on";
}

TEST(WindowAndGradient, TellsSharesOnlyBesideASureWindow) {
    DetectionTrace trace;
    together(3, {kCar}, {kRear}, &trace);
    for (const auto& check : trace.checks) EXPECT_NE(check.parameter, "window_and_gradient.most_covered");
    trace = {};
    together(7, {kCar}, {kRear, kOther}, &trace);
    std::vector<double> shares;
    std::vector<cv::Rect2d> boxes;
    for (const auto& check : trace.checks) {
        if (check.parameter != std::string("window_and_gradient.most_covered")) continue;
        shares.push_back(check.value);
        boxes.push_back(check.box);
        EXPECT_TRUE(check.at_most);
        EXPECT_EQ(check.passed, check.value <= check.limit) << "what is covered does not pass";
    }
    ASSERT_EQ(shares.size(), 2U);
    EXPECT_NEAR(shares[0], 0.9, 1e-6) << "half a pixel of five lies behind the car";
    EXPECT_EQ(shares[1], 0);
    EXPECT_EQ(boxes[0], cv::Rect2d(11, 17.5, 6, 5)) << "upright in the area: its length points upwards";
    EXPECT_EQ(boxes[1], cv::Rect2d(16.5, 33, 7, 14));
}

/// Shows the search area that it was given, with a box and a check in it.
class Shown : public Detector {
 public:
    std::vector<Detection> detect(const MotionRoi& roi, DetectionTrace* trace) const override {
        trace->add(TraceLayer::raw, roi.image);
        trace->add(TraceLayer::binary, roi.image, {{2, 4, 6, 8}});
        trace->checks.push_back({"of a box", "a", 1, 1, false, true, {2, 4, 6, 8}});
        trace->checks.push_back({"of the area", "b", 1, 1, false, true});
        return {};
    }
    const VehicleModel* model() const override { return nullptr; }
};

TEST(WindowAndGradient, LayersOfTheMiddleAreShownWhereTheyLieInTheSearchArea) {
    constexpr int kContext = 3;
    const WindowAndGradientDetector detector(std::make_unique<Told>(std::vector<OrientedBox>{}, true, 0),
                                             std::make_unique<Shown>(), {}, kContext);
    MotionRoi roi;
    roi.image = cv::Mat(60, 40, CV_8UC1);
    cv::RNG(5).fill(roi.image, cv::RNG::UNIFORM, 1, 255);
    roi.inside = cv::Mat(60, 40, CV_8UC1, cv::Scalar(255));
    roi.image_from_roi = {1, 0, 0, 0, 1, 0};
    DetectionTrace trace;
    detector.detect(roi, &trace);
    ASSERT_EQ(trace.layers.size(), 1U) << "the search area itself is not shown again";
    const auto& layer = trace.layers[0];
    EXPECT_EQ(layer.kind, TraceLayer::binary);
    cv::Mat expected = cv::Mat::zeros(roi.image.size(), CV_8UC1);
    const cv::Rect middle(kContext, kContext, 40 - 2 * kContext, 60 - 2 * kContext);
    roi.image(middle).copyTo(expected(middle));
    ASSERT_EQ(layer.image.size(), expected.size());
    EXPECT_EQ(cv::norm(layer.image, expected, cv::NORM_INF), 0);
    EXPECT_EQ(layer.boxes.at(0), cv::Rect2d(2 + kContext, 4 + kContext, 6, 8));
    ASSERT_EQ(trace.checks.size(), 2U);
    EXPECT_EQ(trace.checks[0].box, cv::Rect2d(2 + kContext, 4 + kContext, 6, 8));
    EXPECT_EQ(trace.checks[1].box.area(), 0) << "about the whole area";
}

TEST(WindowAndGradient, SegmentsBesideEachOtherDoNotCoverOneAnother) {
    EXPECT_EQ(together(7, {}, {kCar, kRear, kOther}).size(), 3U);
}

}  // namespace
}  // namespace eyrie::window_and_gradient_test
