#include "detection/segmenters/component_boxes.h"

#include <gtest/gtest.h>

#include <opencv2/imgproc.hpp>

namespace eyrie::component_boxes_test {
namespace {

const SceneScale kScale{0.1, 25, true};  // 1 m = 10 px

/// Every rule off.
GradientOptions bare() {
    GradientOptions options = GradientOptions::thesis();
    options.min_box_area = 1;
    return options;
}

struct Scene {
    cv::Mat binary = cv::Mat::zeros(120, 60, CV_8UC1);
    std::vector<cv::Point2f> vectors;

    std::vector<cv::Rect2d> select(const GradientOptions& options) const {
        cv::Mat labels;
        const auto regions = findRegions(binary, options.min_box_area, labels);
        return ComponentBoxes(options, kScale).select(regions, labels, vectors);
    }
};

TEST(ComponentBoxes, WithoutRulesEveryComponentIsABox) {
    Scene scene;
    scene.binary(cv::Rect(20, 30, 15, 10)).setTo(255);
    scene.binary(cv::Rect(20, 60, 15, 10)).setTo(255);
    const auto boxes = scene.select(bare());
    ASSERT_EQ(boxes.size(), 2U);
    EXPECT_EQ(boxes[0], cv::Rect2d(19.5, 29.5, 15, 10));
}

TEST(ComponentBoxes, OnlyTheClustersOwnVectorsSupport) {
    Scene scene;
    scene.binary(cv::Rect(20, 30, 15, 10)).setTo(255);
    scene.binary(cv::Rect(2, 60, 8, 40)).setTo(255);  // a standing neighbour
    scene.vectors = {{22, 31}, {30, 39}, {34, 40.3F}};
    GradientOptions options = bare();
    options.need_support = true;
    const auto boxes = scene.select(options);
    ASSERT_EQ(boxes.size(), 1U);
    EXPECT_EQ(boxes[0].x, 19.5);
    scene.vectors.clear();
    EXPECT_TRUE(scene.select(options).empty());
}

TEST(ComponentBoxes, AKerbKeepsOnlyItsPartNearTheVectors) {
    Scene scene;
    scene.binary(cv::Rect(20, 40, 15, 30)).setTo(255);
    scene.binary(cv::Rect(34, 0, 2, 120)).setTo(255);  // from edge to edge, touching the vehicle
    scene.vectors = {{21, 41}, {34, 69}, {25, 55}};
    GradientOptions options = bare();
    options.handle_cut = true;
    options.core_margin_m = 0.5;
    const auto boxes = scene.select(options);
    ASSERT_EQ(boxes.size(), 1U);
    EXPECT_EQ(boxes[0], cv::Rect2d(19.5, 35.5, 16, 39));  // vectors 41 … 69 and 5 px on either side
    // One that crosses from side to side: vectors 21 … 34, and 5 px.
    scene.binary(cv::Rect(34, 0, 2, 120)).setTo(0);
    scene.binary(cv::Rect(0, 50, 60, 2)).setTo(255);
    ASSERT_EQ(scene.select(options).size(), 1U);
    EXPECT_EQ(scene.select(options)[0].x, 15.5);
    EXPECT_EQ(scene.select(options)[0].width, 24);
}

TEST(ComponentBoxes, AKerbFarFromTheVectorsIsNoBoxAndHidesNone) {
    Scene scene;
    scene.binary(cv::Rect(50, 0, 2, 120)).setTo(255);  // found first, from edge to edge
    scene.binary(cv::Rect(20, 40, 15, 30)).setTo(255);
    scene.binary(cv::Rect(0, 80, 8, 10)).setTo(255);  // cut off, too
    scene.binary(cv::Rect(20, 72, 15, 4)).setTo(255);
    scene.vectors = {{21, 41}, {34, 69}, {25, 55}};
    GradientOptions options = bare();
    options.handle_cut = true;
    options.core_margin_m = 0.5;
    const auto boxes = scene.select(options);
    ASSERT_EQ(boxes.size(), 2U);
    EXPECT_EQ(boxes[0], cv::Rect2d(19.5, 39.5, 15, 30));
    EXPECT_EQ(boxes[1], cv::Rect2d(19.5, 71.5, 15, 4)) << "whole ones are boxes wherever they are";
    options.need_support = true;
    EXPECT_EQ(scene.select(options), std::vector(1, boxes[0])) << "what has no vectors is left out";
    options.handle_cut = false;
    EXPECT_EQ(scene.select(options), std::vector(1, boxes[0])) << "the kerb comes first and hides nothing";
}

TEST(ComponentBoxes, JoinsFrontAndRearOfOneVehicleButNotTwoVehicles) {
    Scene scene;
    scene.binary(cv::Rect(20, 20, 16, 8)).setTo(255);
    scene.binary(cv::Rect(20, 55, 16, 8)).setTo(255);  // together 43 px long: a car
    scene.binary(cv::Rect(20, 90, 16, 8)).setTo(255);  // 78 px: not one car
    GradientOptions options = bare();
    options.join_components = true;
    const auto boxes = scene.select(options);
    ASSERT_EQ(boxes.size(), 2U);
    EXPECT_EQ(boxes[0], cv::Rect2d(19.5, 19.5, 16, 43));
    EXPECT_EQ(boxes[1], cv::Rect2d(19.5, 89.5, 16, 8));
}

TEST(ComponentBoxes, JoinsFrontAndRearPastAnotherVehicleBeside) {
    Scene scene;
    scene.binary(cv::Rect(5, 20, 16, 8)).setTo(255);
    scene.binary(cv::Rect(40, 22, 16, 8)).setTo(255);  // found between front and rear
    scene.binary(cv::Rect(5, 55, 16, 8)).setTo(255);
    GradientOptions options = bare();
    options.join_components = true;
    const auto boxes = scene.select(options);
    ASSERT_EQ(boxes.size(), 2U);
    EXPECT_EQ(boxes[0], cv::Rect2d(4.5, 19.5, 16, 43));
    EXPECT_EQ(boxes[1], cv::Rect2d(39.5, 21.5, 16, 8));
}

TEST(ComponentBoxes, DoNotGrowFarBeyondTheirVectors) {
    Scene scene;
    scene.binary(cv::Rect(20, 20, 16, 80)).setTo(255);
    scene.vectors = {{22, 60}, {33, 90}};
    GradientOptions options = bare();
    options.growth_along_m = 1;
    options.growth_across_m = 5;
    const auto boxes = scene.select(options);
    ASSERT_EQ(boxes.size(), 1U);
    EXPECT_EQ(boxes[0], cv::Rect2d(19.5, 50, 16, 49.5));
}

TEST(ComponentBoxes, GrowthMayBeLimitedInOneDirectionOnly) {
    Scene scene;
    scene.binary(cv::Rect(20, 20, 16, 80)).setTo(255);
    scene.vectors = {{22, 60}, {33, 90}};
    GradientOptions options = bare();
    options.growth_along_m = 1;
    ASSERT_EQ(scene.select(options).size(), 1U);
    EXPECT_EQ(scene.select(options)[0], cv::Rect2d(19.5, 50, 16, 49.5));
    options.growth_along_m = 0;
    options.growth_across_m = 0.15;  // 1.5 px
    EXPECT_EQ(scene.select(options)[0], cv::Rect2d(20.5, 19.5, 14, 80));
    options.growth_across_m = 0.01;
    EXPECT_EQ(scene.select(options)[0], cv::Rect2d(21, 19.5, 13, 80)) << "a pixel at least";
}

TEST(ComponentBoxes, AThinLineIsABoxUnlessItsAreaIsTooSmall) {
    Scene scene;
    scene.binary(cv::Rect(20, 30, 15, 1)).setTo(255);
    scene.binary(cv::Rect(20, 60, 1, 15)).setTo(255);
    GradientOptions options = bare();
    EXPECT_EQ(scene.select(options).size(), 2U);
    options.min_box_area = 15;
    EXPECT_EQ(scene.select(options).size(), 2U);
    options.min_box_area = 16;
    EXPECT_EQ(scene.select(options).size(), 0U);
}

TEST(ComponentBoxes, ShrinkByTheWideningOfTheirPatterns) {
    Scene scene;
    scene.binary(cv::Rect(20, 20, 16, 40)).setTo(255);
    scene.binary(cv::Rect(50, 100, 2, 2)).setTo(255);
    GradientOptions options = bare();
    options.length_correction = 1;
    options.width_correction = 1;
    options.lbp_radius_max = 3;
    const auto boxes = scene.select(options);
    ASSERT_EQ(boxes.size(), 2U);
    EXPECT_EQ(boxes[0], cv::Rect2d(21, 21, 13, 37));
    EXPECT_EQ(boxes[1].width, 1) << "never to nothing";
}

TEST(ComponentBoxes, ExplainsByShareOfVectors) {
    GradientOptions options;
    options.fall_back_share = 0.6;
    const ComponentBoxes component_boxes(options, kScale);
    const std::vector<cv::Point2f> vectors = {{1, 1}, {2, 2}, {3, 3}, {50, 50}, {51, 51}};
    EXPECT_TRUE(component_boxes.explain({{0, 0, 4, 4}}, vectors));
    EXPECT_FALSE(component_boxes.explain({{0, 0, 1, 1}}, vectors));
    EXPECT_FALSE(component_boxes.explain({}, vectors));
}

TEST(ComponentBoxes, BoundsAndGrowth) {
    EXPECT_EQ(boundsOf({}), cv::Rect2d(0, 0, 0, 0));
    EXPECT_EQ(boundsOf({{3, 4}, {1, 9}}), cv::Rect2d(1, 4, 2, 5));
    EXPECT_EQ(grown({10, 10, 4, 6}, 2, 1), cv::Rect2d(9, 8, 6, 10));
    EXPECT_EQ(grown({10, 10, 4, 6}, -9, -9), cv::Rect2d(12, 13, 0, 0));
}

}  // namespace
}  // namespace eyrie::component_boxes_test
