#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <opencv2/imgproc.hpp>
#include <set>

#include "detection/detector_factory.h"
#include "detection/segmenters/canny_harris_segmenter.h"
#include "detection/segmenters/mser_segmenter.h"
#include "detection/segmenters/segmentation_views.h"
#include "support/driven_scene.h"

namespace eyrie::literature_segmenters_test {
namespace {

using test::drivenScene;
using test::kContractScale;
using test::roiOf;

std::vector<TraceLayer> layersOf(DetectionMethod method) {
    DetectionOptions options;
    options.method = method;
    DetectionTrace trace;
    makeDetector(options, kContractScale)->detect(roiOf(drivenScene(0.4)), &trace);
    std::vector<TraceLayer> kinds;
    for (const auto& layer : trace.layers) kinds.push_back(layer.kind);
    return kinds;
}

/// An upright area of plain ground.
MotionRoi plainRoi(cv::Size size) {
    MotionRoi roi;
    roi.image = cv::Mat(size, CV_8UC1, cv::Scalar(90));
    roi.inside = cv::Mat(size, CV_8UC1, cv::Scalar(255));
    roi.image_from_roi = {1, 0, 0, 0, 1, 0};
    return roi;
}

/// A layer that a detector shows of this area; empty: there is none of that kind.
cv::Mat layerOf(const DetectionOptions& options, const MotionRoi& roi, TraceLayer kind) {
    DetectionOptions alone = options;
    alone.gradient.fall_back = false;
    DetectionTrace trace;
    makeDetector(alone, kContractScale)->detect(roi, &trace);
    for (const auto& layer : trace.layers) {
        if (layer.kind == kind) return layer.image;
    }
    return {};
}

/// Connected areas of a binary image.
int areasIn(const cv::Mat& binary) {
    cv::Mat labels;
    return cv::connectedComponents(binary > 0, labels) - 1;
}

int segmentsOf(const cv::Mat& labels) {
    return static_cast<int>(std::set<int>(labels.begin<int>(), labels.end<int>()).size());
}

}  // namespace

TEST(LiteratureSegmenters, NameTheirSteps) {
    EXPECT_THAT(layersOf(DetectionMethod::relative_connectivity),
                testing::ElementsAre(TraceLayer::raw, TraceLayer::bright_lines, TraceLayer::bright_areas,
                                     TraceLayer::dark_lines, TraceLayer::dark_areas, TraceLayer::fused,
                                     TraceLayer::components));
    EXPECT_THAT(
        layersOf(DetectionMethod::tophat_otsu),
        testing::ElementsAre(TraceLayer::raw, TraceLayer::smoothed, TraceLayer::white_tophat, TraceLayer::black_tophat,
                             TraceLayer::binary, TraceLayer::closed, TraceLayer::components));
    EXPECT_THAT(layersOf(DetectionMethod::mser),
                testing::ElementsAre(TraceLayer::raw, TraceLayer::regions, TraceLayer::binary, TraceLayer::components));
    EXPECT_THAT(layersOf(DetectionMethod::canny_harris),
                testing::ElementsAre(TraceLayer::raw, TraceLayer::edges, TraceLayer::corners, TraceLayer::clustered,
                                     TraceLayer::closed, TraceLayer::components));
}

TEST(LiteratureSegmenters, EveryMethodHasAName) {
    for (const DetectionMethod method : allDetectionMethods()) {
        DetectionOptions options;
        setParameter(describeOf(options), "detection.method", nameOf(method));
        EXPECT_EQ(options.method, method);
    }
}

TEST(LiteratureSegmenters, FallBackToTheClusterOnPlainGround) {
    for (const DetectionMethod method : {DetectionMethod::relative_connectivity, DetectionMethod::tophat_otsu,
                                         DetectionMethod::mser, DetectionMethod::canny_harris}) {
        DetectionOptions options;
        options.method = method;
        auto scene = drivenScene(0.4);
        scene.frame.gray.setTo(100);
        const auto with = makeDetector(options, kContractScale)->detect(roiOf(scene));
        ASSERT_EQ(with.size(), 1U) << nameOf(method);
        EXPECT_GT(overlap(with[0].box, scene.cluster.box), 0.9);
        options.gradient.fall_back = false;
        EXPECT_TRUE(makeDetector(options, kContractScale)->detect(roiOf(scene)).empty()) << nameOf(method);
    }
}

TEST(OtsuWithin, PartsTwoLevelsInsideTheMask) {
    cv::Mat image(10, 30, CV_8UC1, cv::Scalar(40));
    image.colRange(10, 20).setTo(200);
    image.colRange(20, 30).setTo(255);
    cv::Mat mask(image.size(), CV_8UC1, cv::Scalar(255));
    mask.colRange(20, 30).setTo(0);
    EXPECT_GE(otsuWithin(image, mask), 40);
    EXPECT_LT(otsuWithin(image, mask), 200);
    // With other levels in the mask, the border lies between those.
    mask.setTo(255);
    mask.colRange(0, 10).setTo(0);
    EXPECT_GE(otsuWithin(image, mask), 200);
    EXPECT_LT(otsuWithin(image, mask), 255);
    EXPECT_EQ(otsuWithin(image, cv::Mat::zeros(image.size(), CV_8UC1)), 255);
}

TEST(TophatOtsu, ThesisJoinsNothing) {
    // Two bars 32 px (3.5 m) apart: the transforms' disc of 27 px is wider than a bar and narrower than the gap.
    MotionRoi roi = plainRoi({100, 60});
    roi.image(cv::Rect(20, 10, 8, 40)).setTo(170);
    roi.image(cv::Rect(60, 10, 8, 40)).setTo(170);
    DetectionOptions options;
    options.method = DetectionMethod::tophat_otsu;
    EXPECT_EQ(areasIn(layerOf(options, roi, TraceLayer::closed)), 2);
    options.tophat_otsu.joining_m = 5;
    EXPECT_EQ(areasIn(layerOf(options, roi, TraceLayer::closed)), 1);
    options.tophat_otsu = TophatOtsuOptions::thesis();
    const cv::Mat binary = layerOf(options, roi, TraceLayer::binary);
    EXPECT_EQ(areasIn(binary), 2);
    EXPECT_EQ(cv::norm(binary, layerOf(options, roi, TraceLayer::closed), cv::NORM_INF), 0);
}

TEST(TophatOtsu, ThesisTakesOtsusThresholdAsItIs) {
    MotionRoi roi = plainRoi({60, 60});
    roi.image(cv::Rect(26, 10, 8, 40)).setTo(96);  // 6 grey values above the ground
    DetectionOptions options;
    options.method = DetectionMethod::tophat_otsu;
    EXPECT_EQ(areasIn(layerOf(options, roi, TraceLayer::closed)), 0) << "below the least contrast of 8";
    options.tophat_otsu = TophatOtsuOptions::thesis();
    EXPECT_EQ(areasIn(layerOf(options, roi, TraceLayer::closed)), 1);
}

TEST(Mser, ThesisKeepsRegionsFromEdgeToEdge) {
    MotionRoi roi = plainRoi({40, 60});
    roi.image(cv::Rect(0, 20, 40, 20)).setTo(180);  // 9.7 m², twice as long as wide
    // The ground comes in steps smaller than delta, so that the band is more stable than what it grows into.
    roi.image.rowRange(0, 20).setTo(94);
    DetectionOptions options;
    options.method = DetectionMethod::mser;
    EXPECT_EQ(cv::countNonZero(layerOf(options, roi, TraceLayer::binary)), 0);
    setParameter(describeOf(options), "mser.keep_spanning", "true");
    EXPECT_GT(cv::countNonZero(layerOf(options, roi, TraceLayer::binary)), 700);
    options.mser = MserOptions::thesis();
    EXPECT_GT(cv::countNonZero(layerOf(options, roi, TraceLayer::binary)), 700);
}

TEST(Mser, OnlyWhatReachesFromEdgeToEdgeIsGround) {
    // 24 px wide; down to the lower edge from the upper one, and from 2 px below it.
    DetectionOptions options;
    options.method = DetectionMethod::mser;
    options.mser.max_area_m2 = 30;
    const auto kept = [&](const cv::Rect& block) {
        MotionRoi roi = plainRoi({60, 32});
        roi.image(block).setTo(180);
        return cv::countNonZero(layerOf(options, roi, TraceLayer::binary));
    };
    EXPECT_EQ(kept({18, 0, 24, 32}), 0);
    EXPECT_GT(kept({18, 2, 24, 30}), 600);
    EXPECT_GT(kept({18, 0, 24, 29}), 600);
    // The same across: from the left edge to the right one, and up to 2 px beside either.
    const auto kept_across = [&](const cv::Rect& block) {
        MotionRoi roi = plainRoi({32, 60});
        roi.image(block).setTo(180);
        return cv::countNonZero(layerOf(options, roi, TraceLayer::binary));
    };
    EXPECT_EQ(kept_across({0, 18, 32, 24}), 0);
    EXPECT_EQ(kept_across({1, 18, 30, 24}), 0) << "a pixel of the border is not counted";
    EXPECT_GT(kept_across({2, 18, 30, 24}), 600);
    EXPECT_GT(kept_across({0, 18, 29, 24}), 600);
}

TEST(Mser, AreasNarrowerThanFivePixelsHoldNoRegion) {
    DetectionOptions options;
    options.method = DetectionMethod::mser;
    for (const cv::Size size : {cv::Size(4, 60), cv::Size(60, 4)}) {
        EXPECT_TRUE(layerOf(options, plainRoi(size), TraceLayer::regions).empty()) << size;
        const cv::Size wider(std::max(size.width, 5), std::max(size.height, 5));
        EXPECT_EQ(layerOf(options, plainRoi(wider), TraceLayer::regions).size(), wider);
    }
}

TEST(Mser, AreasAreInSquareMetres) {
    // 40 × 16 px at 0.11 m/px are 7.7 m².
    MotionRoi roi = plainRoi({60, 90});
    roi.image(cv::Rect(22, 25, 16, 40)).setTo(180);
    DetectionOptions options;
    options.method = DetectionMethod::mser;
    const auto found = [&](double smallest, double largest) {
        options.mser.min_area_m2 = smallest;
        options.mser.max_area_m2 = largest;
        return cv::countNonZero(layerOf(options, roi, TraceLayer::binary)) > 0;
    };
    EXPECT_TRUE(found(7, 8.5));
    EXPECT_FALSE(found(8.5, 20));
    EXPECT_FALSE(found(1, 7));
}

TEST(CannyHarris, ASlantingStepIsAsHighAsAnUprightOne) {
    // Sobel's masks answer to a step of height h along the diagonal with 3h both ways, 4.2h in all; the limit is 4
    // · 20.
    DetectionOptions options;
    options.method = DetectionMethod::canny_harris;
    options.canny_harris.high = 20;
    options.canny_harris.low_share = 1;
    const auto edges = [&](int height) {
        MotionRoi roi = plainRoi({60, 60});
        for (int y = 0; y < 60; ++y) {
            for (int x = 0; x < 60; ++x) roi.image.at<uchar>(y, x) = static_cast<uchar>(x + y < 60 ? 90 : 90 + height);
        }
        return cv::countNonZero(layerOf(options, roi, TraceLayer::edges));
    };
    EXPECT_EQ(edges(17), 0);
    EXPECT_GT(edges(21), 20);
}

TEST(RelativeConnectivity, CarsAreScaledToTheirLength) {
    // 4.6 m at 0.11 m/px: to this length nothing is scaled.
    const MotionRoi roi = roiOf(drivenScene(0.4));
    DetectionOptions options;
    options.method = DetectionMethod::relative_connectivity;
    const auto lines = [&](double car_length_px) {
        options.relative_connectivity.car_length = car_length_px;
        return layerOf(options, roi, TraceLayer::bright_lines);
    };
    const cv::Mat as_it_is = lines(0);
    EXPECT_EQ(cv::norm(as_it_is, lines(4.6 / 0.11), cv::NORM_INF), 0);
    EXPECT_GT(cv::norm(as_it_is, lines(24), cv::NORM_INF), 0);
}

TEST(SegmentationViews, DrawTheRightAndLowerBordersOfSegments) {
    const cv::Mat gray(4, 5, CV_8UC1, cv::Scalar(50));
    cv::Mat labels = cv::Mat::zeros(4, 5, CV_32SC1);
    labels(cv::Rect(1, 1, 2, 2)).setTo(1);
    const cv::Mat drawn = drawSegments(gray, labels, {1, 2, 3});
    const cv::Mat expected = (cv::Mat_<uchar>(4, 5) << 0, 1, 1, 0, 0,  //
                              1, 0, 1, 0, 0,                           //
                              1, 1, 1, 0, 0,                           //
                              0, 0, 0, 0, 0);
    for (int y = 0; y < 4; ++y) {
        for (int x = 0; x < 5; ++x)
            EXPECT_EQ(drawn.at<cv::Vec3b>(y, x), expected.at<uchar>(y, x) ? cv::Vec3b(1, 2, 3) : cv::Vec3b(50, 50, 50));
    }
}

TEST(LiteratureSegmenters, TakeTheThesisSettings) {
    for (const DetectionMethod method : {DetectionMethod::relative_connectivity, DetectionMethod::tophat_otsu,
                                         DetectionMethod::mser, DetectionMethod::canny_harris}) {
        DetectionOptions options = DetectionOptions::thesis();
        EXPECT_TRUE(options.mser.keep_spanning);
        EXPECT_EQ(options.tophat_otsu.min_contrast, 0);
        EXPECT_EQ(options.tophat_otsu.joining_m, 0);
        options.method = method;
        const auto detector = makeDetector(options, kContractScale);
        for (const cv::Point2d centre : {cv::Point2d(160, 120), cv::Point2d(3, 2), cv::Point2d(-400, 120)}) {
            for (const Detection& found : detector->detect(roiOf(drivenScene(0.4, centre)))) {
                EXPECT_TRUE(std::isfinite(found.box.centre.x + found.box.centre.y)) << nameOf(method);
                EXPECT_GE(found.box.area(), 10) << nameOf(method);
            }
        }
        EXPECT_TRUE(detector->detect({}).empty());
    }
}

TEST(Eccentricity, OfSimpleShapes) {
    const auto block = [](int width, int height) {
        std::vector<cv::Point> points;
        for (int y = 0; y < height; ++y) {
            for (int x = 0; x < width; ++x) points.emplace_back(x, y);
        }
        return points;
    };
    EXPECT_NEAR(eccentricityOf(block(12, 12)), 0, 1e-9);
    // A rectangle a × b has second moments as a² to b², pixels being squares.
    EXPECT_NEAR(eccentricityOf(block(20, 10)), std::sqrt(1 - 0.25), 1e-9);
    EXPECT_NEAR(eccentricityOf(block(3, 30)), std::sqrt(1 - 0.01), 1e-9);
    EXPECT_DOUBLE_EQ(eccentricityOf({}), 0);
}

TEST(SegmentationViews, CutTheRoiIntoSegments) {
    const MotionRoi roi = roiOf(drivenScene(0.4));
    const cv::Mat superpixels = superpixelSegments(roi, kContractScale);
    EXPECT_EQ(superpixels.size(), roi.image.size());
    EXPECT_GT(segmentsOf(superpixels), 10);
    const cv::Mat watershed = watershedSegments(roi);
    EXPECT_EQ(watershed.size(), roi.image.size());
    EXPECT_GT(segmentsOf(watershed), 5);
    const cv::Mat cut = graphCutSegments(roi);
    EXPECT_EQ(segmentsOf(cut), 2);
    EXPECT_GT(cv::countNonZero(cut), 100);
    EXPECT_EQ(cv::norm(cut, graphCutSegments(roi), cv::NORM_INF), 0);
    const cv::Mat contours = contourMap(roi);
    EXPECT_EQ(contours.size(), roi.image.size());
    EXPECT_GT(cv::countNonZero(contours), 20);
    EXPECT_EQ(drawContourMap(roi.image, contours).type(), CV_8UC3);
    const cv::Mat drawn = drawSegments(roi.image, cut);
    EXPECT_EQ(drawn.type(), CV_8UC3);
    EXPECT_EQ(drawn.size(), roi.image.size());
}

TEST(SegmentationViews, TakeWhateverRoiComes) {
    for (const cv::Point2d centre : {cv::Point2d(0, 0), cv::Point2d(-400, 120), cv::Point2d(160, 120)}) {
        MotionRoi roi = roiOf(drivenScene(0.3, centre));
        for (const bool with_vectors : {true, false}) {
            if (!with_vectors) roi.vectors.clear();
            EXPECT_EQ(superpixelSegments(roi, kContractScale).size(), roi.image.size());
            EXPECT_EQ(watershedSegments(roi).size(), roi.image.size());
            EXPECT_EQ(graphCutSegments(roi).size(), roi.image.size());
            EXPECT_EQ(contourMap(roi).size(), roi.image.size());
        }
    }
    MotionRoi pixel;
    pixel.image = cv::Mat(1, 1, CV_8UC1, cv::Scalar(7));
    pixel.inside = cv::Mat(1, 1, CV_8UC1, cv::Scalar(255));
    EXPECT_EQ(segmentsOf(superpixelSegments(pixel, kContractScale)), 1);
    EXPECT_EQ(segmentsOf(watershedSegments(pixel)), 1);
    EXPECT_EQ(segmentsOf(graphCutSegments(pixel)), 1);
    MotionRoi outside = roiOf(drivenScene(0.3));
    outside.inside.setTo(0);
    EXPECT_EQ(segmentsOf(graphCutSegments(outside)), 1) << "nothing of it is in the picture";
    EXPECT_TRUE(superpixelSegments({}, kContractScale).empty());
    EXPECT_TRUE(graphCutSegments({}).empty());
    EXPECT_TRUE(contourMap({}).empty());
}

}  // namespace eyrie::literature_segmenters_test
