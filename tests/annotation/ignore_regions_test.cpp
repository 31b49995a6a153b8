#include "annotation/edits/ignore_regions.h"

#include <gtest/gtest.h>

#include <random>

#include "annotation/scenes.h"
#include "evaluation/evaluate.h"

namespace eyrie::ignore_regions_test {
namespace {

using test::keyframe;
using test::object;

const CameraMotion flying(test::stepsOf(test::flyingView, 100));

IgnoreRegion region(int id, RegionAnchor anchor, std::vector<cv::Point2d> polygon) {
    IgnoreRegion result;
    result.id = id;
    result.polygon = std::move(polygon);
    result.anchor = anchor;
    result.reference_frame = 10;
    result.first_frame = 5;
    result.last_frame = 80;
    return result;
}

const std::vector<cv::Point2d> kSquare{{100, 100}, {200, 100}, {200, 200}, {100, 200}};

TEST(IgnoreRegions, StandInTheImageOrOnTheGround) {
    AnnotationSet set;
    set.regions[1] = region(1, RegionAnchor::image, kSquare);
    set.regions[2] = region(2, RegionAnchor::ground, kSquare);
    EXPECT_TRUE(regionsAt(set, 4, flying).empty());
    EXPECT_TRUE(regionsAt(set, 81, flying).empty());
    const auto regions = regionsAt(set, 60, flying);
    ASSERT_EQ(regions.size(), 2U);
    EXPECT_EQ(regions[0].polygon, kSquare);
    Homography truth;
    truth.matrix = test::flyingView(60) * test::flyingView(10).inv();
    const cv::Point2d apart = regions[1].polygon[2] - truth.apply({200, 200});
    EXPECT_LT(std::hypot(apart.x, apart.y), 1e-6);
    EXPECT_TRUE(regions[1].carried);
    EXPECT_FALSE(regionsAt(set, 60, CameraMotion())[1].carried);
    EXPECT_TRUE(regionsAt(set, 60, CameraMotion())[0].carried);
}

TEST(IgnoreRegions, ReachBeyondThePictureAndEndAtTheHorizon) {
    // A camera that tilts: what lies at y > 500 in frame 10 is beyond the horizon of frame 11.
    Homography tilt;
    tilt.matrix = {1, 0, 0, 0, 1, 0, 0, -0.002, 1};
    tilt.from_frame = 10;
    tilt.to_frame = 11;
    const CameraMotion camera(std::vector<Homography>{tilt});
    AnnotationSet set;
    set.regions[1] = region(1, RegionAnchor::ground, {{100, -60}, {200, -60}, {200, 200}, {100, 200}});
    set.regions[2] = region(2, RegionAnchor::ground, {{100, 300}, {200, 300}, {200, 600}, {100, 600}});
    const auto regions = regionsAt(set, 11, camera);
    ASSERT_EQ(regions.size(), 2U);
    EXPECT_TRUE(regions[0].carried);
    EXPECT_NEAR(regions[0].polygon[0].y, -60 / 1.12, 1e-6);
    EXPECT_NEAR(regions[0].polygon[2].y, 200 / 0.6, 1e-6);
    EXPECT_FALSE(regions[1].carried);
}

TEST(IgnoreRegions, ContainTheirInsideAndTheirBorder) {
    const std::vector<cv::Point2d> hook{{0, 0}, {10, 0}, {10, 10}, {6, 10}, {6, 4}, {0, 4}};
    EXPECT_TRUE(contains(hook, {1, 1}));
    EXPECT_TRUE(contains(hook, {8, 9}));
    EXPECT_FALSE(contains(hook, {3, 8}));
    EXPECT_TRUE(contains(hook, {10, 5}));
    EXPECT_TRUE(contains(hook, {0, 0}));
    EXPECT_FALSE(contains(hook, {-1, 0}));
    EXPECT_FALSE(contains({}, {0, 0}));
}

TEST(IgnoreRegions, CoveringBoxesCoverTheInsideAndLittleElse) {
    const std::vector<cv::Point2d> hook{{0, 0}, {100, 10}, {90, 120}, {60, 110}, {55, 40}, {5, 50}};
    const auto boxes = coveringBoxes(hook, 4);
    std::mt19937 dice(1);
    std::uniform_real_distribution<double> place(-10, 130);
    int wrong = 0;
    for (int i = 0; i < 4000; ++i) {
        const cv::Point2d point{place(dice), place(dice)};
        int hits = 0;
        for (const auto& box : boxes) hits += box.contains(point);
        wrong += (hits > 0) != contains(hook, point);
    }
    EXPECT_LT(wrong, 60) << "rows of 4 px are off by 2 px at a sloping border at most";
    EXPECT_TRUE(coveringBoxes({{0, 0}, {1, 1}}).empty());
    EXPECT_TRUE(coveringBoxes({{0, 0}, {5, 0}, {9, 0}}).empty());
}

TEST(IgnoreRegions, RowsOfCoveringBoxesAreAsHighAsAskedForAtMost) {
    const auto rowsOf = [](double height, double row_px) {
        const auto boxes = coveringBoxes({{10, 20}, {40, 20}, {40, 20 + height}, {10, 20 + height}}, row_px);
        double covered = 0;
        for (const OrientedBox& box : boxes) {
            EXPECT_NEAR(box.centre.x, 25, 1e-9);
            EXPECT_NEAR(box.centre.y, 20 + covered + box.width / 2, 1e-9);
            EXPECT_NEAR(box.length, 30, 1e-9);
            EXPECT_EQ(box.heading, 0);
            covered += box.width;
        }
        EXPECT_NEAR(covered, height, 1e-9);
        return boxes.size();
    };
    EXPECT_EQ(rowsOf(3, 4), 1U);
    EXPECT_EQ(rowsOf(4, 4), 1U);
    EXPECT_EQ(rowsOf(5, 4), 2U);
    EXPECT_EQ(rowsOf(8.1, 4), 3U);
    EXPECT_EQ(rowsOf(2, 0.1), 4U) << "half a pixel at least";
    EXPECT_EQ(rowsOf(4000, 0.5), 4096U) << "no more than that";
}

AnnotationSet street() {
    AnnotationSet set;
    set.objects[3] = object(3, {keyframe(0, {{50, 50}, 20, 9, 0}), keyframe(10, {{100, 50}, 20, 9, 0})}, 12);
    set.objects[4] = object(4, {keyframe(2, {{150, 150}, 20, 9, 0})}, 12);
    set.objects[5] = object(5, {keyframe(0, {{-3, 80}, 20, 9, 0})}, 12);
    set.objects[6] = object(6, {keyframe(0, {{300, 80}, 20, 9, 0})}, 12);
    set.objects[7] = object(7, {keyframe(0, {{40, 180}, 20, 9, 0})}, 12);
    set.objects[7].keyframes[0].occlusion = Occlusion::fully;
    set.objects[8] = object(8, {keyframe(0, {{40, 200}, 20, 9, 0})}, 12);
    set.objects[8].keyframes[0].outside = true;
    set.objects[4].object_class = "bus";
    set.regions[1] = region(1, RegionAnchor::image, kSquare);
    return set;
}

GroundTruthOptions options() {
    GroundTruthOptions result;
    result.last_frame = 14;
    result.image = {250, 250};
    return result;
}

TEST(GroundTruthBoxes, AreTheVisibleLabelsWithTheirFlags) {
    auto wanted = options();
    wanted.regions_as_boxes = false;
    const BoxesByFrame boxes = groundTruthBoxes(street(), CameraMotion::standing(0, 20), wanted);
    ASSERT_EQ(boxes.size(), 15U) << "empty frames are part of the truth";
    EXPECT_TRUE(boxes.at(14).empty());
    const auto& records = boxes.at(6);
    ASSERT_EQ(records.size(), 4U) << "6 is beyond the image, 8 is outside";
    EXPECT_EQ(records[0].id, 3);
    EXPECT_FALSE(records[0].ignore);
    EXPECT_NEAR(records[0].box.centre.x, 80, 1e-9);
    EXPECT_EQ(records[1].id, 4);
    EXPECT_EQ(records[1].object_class, "bus");
    EXPECT_TRUE(records[1].ignore) << "in the region";
    EXPECT_FALSE(boxes.at(3)[1].ignore) << "the region begins in frame 5";
    EXPECT_EQ(records[2].id, 5);
    EXPECT_TRUE(records[2].ignore) << "mostly beyond the border";
    EXPECT_EQ(records[3].id, 7);
    EXPECT_TRUE(records[3].ignore) << "hidden";
    wanted.only_checked = true;
    EXPECT_TRUE(groundTruthBoxes(street(), CameraMotion(), wanted).at(6)[0].ignore);
}

TEST(GroundTruthBoxes, ServeAnEvaluation) {
    const BoxesByFrame truth = groundTruthBoxes(street(), CameraMotion::standing(0, 20), options());
    // A perfect result, with something more in the ignore region.
    BoxesByFrame result;
    int expected = 0;
    for (const auto& [frame, records] : truth) {
        for (const BoxRecord& record : records) {
            if (record.ignore) continue;
            result[frame].push_back(record);
            ++expected;
        }
        if (frame < 5) continue;
        BoxRecord extra;
        extra.frame = frame;
        extra.id = 99;
        extra.box = {{160, 140}, 20, 9, 0.4};
        result[frame].push_back(extra);
    }
    EvaluationOptions evaluation;
    evaluation.overlap = 0.5;
    const Measures measures = evaluate(truth, result, evaluation);
    EXPECT_EQ(measures.detection.true_positives, expected);
    EXPECT_EQ(measures.detection.false_positives, 0);
    EXPECT_EQ(measures.detection.false_negatives, 0);
    ASSERT_TRUE(measures.tracking.has_value()) << "every box has an id";
}

}  // namespace
}  // namespace eyrie::ignore_regions_test
