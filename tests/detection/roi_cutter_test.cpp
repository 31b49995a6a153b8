#include "detection/roi_cutter.h"

#include <gtest/gtest.h>

#include "core/error.h"
#include "support/driven_scene.h"

namespace eyrie::roi_cutter_test {
namespace {

using test::drivenScene;
using test::kContractScale;

DetectionOptions segmentation() {
    DetectionOptions options;
    options.method = DetectionMethod::gradient;
    return options;
}

TEST(RoiCutter, ExtendsTheClusterAlongAndAcross) {
    MotionCluster cluster;
    cluster.box = {{100, 80}, 70, 40, 0.4};
    const OrientedBox area = extendedCluster(cluster, {320, 240}, segmentation(), kContractScale);
    EXPECT_DOUBLE_EQ(area.length, 140);
    EXPECT_DOUBLE_EQ(area.width, 50);
    EXPECT_DOUBLE_EQ(area.heading, 0.4);
    DetectionOptions wider = segmentation();
    wider.extend_across = 3;
    EXPECT_DOUBLE_EQ(extendedCluster(cluster, {320, 240}, wider, kContractScale).width, 120);
    EXPECT_DOUBLE_EQ(extendedCluster(cluster, {320, 240}, wider, kContractScale).length, 140);
    cluster.box = {{100, 80}, 3, 1, 0.4};
    const OrientedBox smallest = extendedCluster(cluster, {320, 240}, segmentation(), kContractScale);
    EXPECT_DOUBLE_EQ(smallest.length, 7 / 0.11);
    EXPECT_DOUBLE_EQ(smallest.width, 3.2 / 0.11);
    EXPECT_DOUBLE_EQ(extendedCluster(cluster, {320, 240}, DetectionOptions::thesis(), kContractScale).length, 6);
}

TEST(RoiCutter, ExtendsAsMuchAsItsParametersSay) {
    MotionCluster cluster;
    cluster.box = {{100, 80}, 70, 40, 0.4};
    const auto area = [&](const char* name, const char* factor) {
        DetectionOptions options = segmentation();
        setParameter(describeOf(options), name, factor);
        return extendedCluster(cluster, {320, 240}, options, kContractScale);
    };
    EXPECT_DOUBLE_EQ(area("detection.extend_along", "3").length, 210);
    EXPECT_DOUBLE_EQ(area("detection.extend_along", "3").width, 50);
    EXPECT_DOUBLE_EQ(area("detection.extend_across", "1.5").length, 140);
    EXPECT_DOUBLE_EQ(area("detection.extend_across", "1.5").width, 60);
}

TEST(RoiCutter, IsAtLeastAsLargeAsItsParametersSay) {
    MotionCluster cluster;
    cluster.box = {{100, 80}, 20, 8, 0.4};
    const auto area = [&](const char* name, const char* metres) {
        DetectionOptions options = DetectionOptions::thesis();
        setParameter(describeOf(options), name, metres);
        return extendedCluster(cluster, {320, 240}, options, kContractScale);
    };
    EXPECT_DOUBLE_EQ(area("detection.min_roi_length", "5.5").length, 5.5 / 0.11);
    EXPECT_DOUBLE_EQ(area("detection.min_roi_length", "5.5").width, 10);
    EXPECT_DOUBLE_EQ(area("detection.min_roi_length", "3.3").length, 40) << "the extended cluster is longer";
    EXPECT_DOUBLE_EQ(area("detection.min_roi_width", "2.2").width, 2.2 / 0.11);
    EXPECT_DOUBLE_EQ(area("detection.min_roi_width", "2.2").length, 40);
    EXPECT_DOUBLE_EQ(area("detection.min_roi_width", "1").width, 10);
    EXPECT_DOUBLE_EQ(area("detection.min_roi_length_px", "44").length, 44);
    EXPECT_DOUBLE_EQ(area("detection.min_roi_length_px", "44").width, 10);
    EXPECT_DOUBLE_EQ(area("detection.min_roi_width_px", "15").width, 15);
    EXPECT_DOUBLE_EQ(area("detection.min_roi_width_px", "15").length, 40);
}

TEST(RoiCutter, TheThesisSearchesTheExtendedClusterWithEveryMethod) {
    MotionCluster cluster;
    cluster.box = {{100, 80}, 70, 40, 0.4};
    for (const DetectionMethod method : allDetectionMethods()) {
        DetectionOptions options = DetectionOptions::thesis();
        options.method = method;
        const OrientedBox area = extendedCluster(cluster, {320, 240}, options, kContractScale);
        EXPECT_DOUBLE_EQ(area.length, 2 * 70) << nameOf(method);
        EXPECT_DOUBLE_EQ(area.width, 1.25 * 40) << nameOf(method);
    }
}

TEST(RoiCutter, WindowsGetTheirContextAndSegmentsAreLeftTheMiddle) {
    const auto scene = drivenScene(0.8);
    DetectionOptions options = segmentation();
    const MotionRoi roi = cutMotionRoi(scene.frame, scene.cluster, 0, scene.motion, options, kContractScale);
    options.method = DetectionMethod::window_and_gradient;
    options.sliding_window.context_m = 5 * 0.11;
    const MotionRoi wide = cutMotionRoi(scene.frame, scene.cluster, 0, scene.motion, options, kContractScale);
    EXPECT_NEAR(wide.box.length, roi.box.length + 10, 1e-9);
    const MotionRoi middle = narrowed(wide, 5);
    EXPECT_EQ(middle.image.size(), wide.image.size() - cv::Size(10, 10));
    EXPECT_NEAR(middle.box.width, roi.box.width, 1e-9);
    for (std::size_t i = 0; i < middle.vectors.size(); ++i) {
        const cv::Vec2d back = middle.image_from_roi * cv::Vec3d(middle.vectors[i].x, middle.vectors[i].y, 1);
        EXPECT_NEAR(back[0], scene.motion.motion_vectors[i].position.x, 1e-3);
        EXPECT_NEAR(back[1], scene.motion.motion_vectors[i].position.y, 1e-3);
    }
}

TEST(RoiCutter, NarrowingLeavesAPixelAtLeast) {
    MotionRoi roi;
    roi.image = cv::Mat(2, 20, CV_8UC1, cv::Scalar(9));
    roi.inside = cv::Mat(2, 20, CV_8UC1, cv::Scalar(255));
    EXPECT_EQ(narrowed(roi, 5).image.size(), cv::Size(10, 2)) << "too low to be narrowed in its height";
    EXPECT_EQ(narrowed(roi, 50).image.size(), cv::Size(2, 2));
    EXPECT_EQ(narrowed(roi, 0).image.size(), cv::Size(20, 2));
    EXPECT_EQ(narrowed(roi, -3).image.size(), cv::Size(20, 2));
}

TEST(RoiCutter, PlacesTheVectorsInTheRoi) {
    const auto scene = drivenScene(0.8);
    const MotionRoi roi = test::roiOf(scene, 2);
    EXPECT_EQ(roi.cluster, 2);
    ASSERT_EQ(roi.vectors.size(), scene.cluster.members.size());
    for (std::size_t i = 0; i < roi.vectors.size(); ++i) {
        const cv::Vec2d back = roi.image_from_roi * cv::Vec3d(roi.vectors[i].x, roi.vectors[i].y, 1);
        EXPECT_NEAR(back[0], scene.motion.motion_vectors[i].position.x, 1e-3);
        EXPECT_NEAR(back[1], scene.motion.motion_vectors[i].position.y, 1e-3);
    }
    // The front of the vehicle is above its rear.
    EXPECT_LT(roi.vectors.back().y, roi.vectors.front().y);
    EXPECT_EQ(roi.stack_layers, 0);
}

TEST(RoiCutter, HasASizeLimit) {
    MotionCluster cluster;
    cluster.box = {{100, 80}, 1e7, 1e7, 0};
    const OrientedBox area = extendedCluster(cluster, {300, 400}, {}, kContractScale);
    EXPECT_DOUBLE_EQ(area.length, 1000);
    EXPECT_DOUBLE_EQ(area.width, 1000);
}

TEST(RoiCutter, RefusesAFrameWithoutAnImage) {
    const auto scene = drivenScene(0.8);
    EXPECT_THROW(cutMotionRoi(Frame{}, scene.cluster, 0, scene.motion, {}, kContractScale), Error);
}

}  // namespace
}  // namespace eyrie::roi_cutter_test
