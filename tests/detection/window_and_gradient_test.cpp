#include "detection/sliding_window/window_and_gradient_detector.h"

#include <gtest/gtest.h>

namespace eyrie {
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

 private:
    std::vector<OrientedBox> boxes_;
    bool complete_;
    double score_;
};

std::vector<Detection> together(double decision, const std::vector<OrientedBox>& windows,
                                const std::vector<OrientedBox>& segments) {
    WindowAndGradientOptions options;
    options.sure_decision = 5;
    const WindowAndGradientDetector detector(std::make_unique<Told>(windows, true, decision),
                                             std::make_unique<Told>(segments, false, 0), options, 3);
    MotionRoi roi;
    roi.image = cv::Mat(60, 40, CV_8UC1, cv::Scalar(9));
    roi.inside = cv::Mat(60, 40, CV_8UC1, cv::Scalar(255));
    return detector.detect(roi);
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

TEST(WindowAndGradient, SegmentsBesideEachOtherDoNotCoverOneAnother) {
    EXPECT_EQ(together(7, {}, {kCar, kRear, kOther}).size(), 3U);
}

}  // namespace
}  // namespace eyrie
