#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <set>

#include "detection/canny_harris_segmenter.h"
#include "detection/detector_factory.h"
#include "detection/mser_segmenter.h"
#include "detection/segmentation_views.h"
#include "support/driven_scene.h"

namespace eyrie {
namespace {

using test::drivenScene;
using test::kContractScale;
using test::roiOf;

std::vector<std::string> layersOf(DetectionMethod method) {
    DetectionOptions options;
    options.method = method;
    DetectionTrace trace;
    makeDetector(options, kContractScale)->detect(roiOf(drivenScene(0.4)), &trace);
    std::vector<std::string> names;
    for (const auto& layer : trace.layers) names.push_back(layer.name);
    return names;
}

int segmentsOf(const cv::Mat& labels) {
    return static_cast<int>(std::set<int>(labels.begin<int>(), labels.end<int>()).size());
}

}  // namespace

TEST(LiteratureSegmenters, NameTheirSteps) {
    EXPECT_THAT(
        layersOf(DetectionMethod::relative_connectivity),
        testing::ElementsAre("raw", "bright lines", "bright areas", "dark lines", "dark areas", "fused", "components"));
    EXPECT_THAT(
        layersOf(DetectionMethod::tophat_otsu),
        testing::ElementsAre("raw", "smoothed", "white tophat", "black tophat", "binary", "closed", "components"));
    EXPECT_THAT(layersOf(DetectionMethod::mser), testing::ElementsAre("raw", "regions", "binary", "components"));
    EXPECT_THAT(layersOf(DetectionMethod::canny_harris),
                testing::ElementsAre("raw", "edges", "corners", "clustered", "closed", "components"));
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
        }
    }
    MotionRoi pixel;
    pixel.image = cv::Mat(1, 1, CV_8UC1, cv::Scalar(7));
    pixel.inside = cv::Mat(1, 1, CV_8UC1, cv::Scalar(255));
    EXPECT_EQ(segmentsOf(superpixelSegments(pixel, kContractScale)), 1);
    EXPECT_EQ(segmentsOf(watershedSegments(pixel)), 1);
    EXPECT_EQ(segmentsOf(graphCutSegments(pixel)), 1);
    EXPECT_TRUE(superpixelSegments({}, kContractScale).empty());
    EXPECT_TRUE(graphCutSegments({}).empty());
}

}  // namespace eyrie
