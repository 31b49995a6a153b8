// Every layer of the segmenters of the literature beside the same steps written down one by one.
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <opencv2/features2d.hpp>
#include <opencv2/imgproc.hpp>
#include <opencv2/ximgproc/slic.hpp>
#include <set>

#include "detection/detector_factory.h"
#include "detection/segmenters/component_boxes.h"
#include "detection/segmenters/mser_segmenter.h"
#include "detection/segmenters/relative_connectivity.h"
#include "detection/segmenters/segmentation_views.h"
#include "imaging/gradients.h"
#include "imaging/hysteresis.h"
#include "imaging/region_boxes.h"
#include "support/driven_scene.h"

namespace eyrie::segmenter_reference_test {
namespace {

using test::drivenScene;
using test::roiOf;

const SceneScale kTenToAMetre{0.1, 25, true};

std::map<TraceLayer, cv::Mat> layersOf(const DetectionOptions& options, const MotionRoi& roi) {
    DetectionTrace trace;
    makeDetector(options, kTenToAMetre)->detect(roi, &trace);
    std::map<TraceLayer, cv::Mat> layers;
    for (const auto& layer : trace.layers) layers[layer.kind] = layer.image;
    return layers;
}

void expectSame(const cv::Mat& a, const cv::Mat& b, const char* what, bool shows_something = true) {
    ASSERT_EQ(a.size(), b.size()) << what;
    cv::Mat x, y;
    a.convertTo(x, CV_32F);
    b.convertTo(y, CV_32F);
    EXPECT_EQ(cv::norm(x, y, cv::NORM_INF), 0) << what;
    EXPECT_TRUE(!shows_something || cv::countNonZero(x) > 0) << what;
}

/// A search area cut by the border of the video, so that a part of it shows nothing.
MotionRoi cutArea() {
    return roiOf(drivenScene(0.4, {306, 120}));
}

/// OpenCV's ellipse of an odd side, the nearest to this diameter.
cv::Mat disc(int side) {
    return cv::getStructuringElement(cv::MORPH_ELLIPSE, {side, side});
}

}  // namespace

TEST(SegmenterReference, CannyAndHarrisStepByStep) {
    DetectionOptions options;
    options.method = DetectionMethod::canny_harris;
    options.canny_harris.high = 30;
    options.canny_harris.low_share = 0.5;
    options.canny_harris.corner_share = 0.05;
    options.canny_harris.link_m = 0.7;     // 7 px
    options.canny_harris.closing_m = 0.5;  // 5 px
    for (const int fewest : {1, 2, 4}) {
        options.canny_harris.min_corners = fewest;
        for (const MotionRoi& roi : {cutArea(), roiOf(drivenScene(1.1))}) {
            const auto layers = layersOf(options, roi);
            cv::Mat edges, response;
            cv::Canny(roi.image, edges, 60, 120, 3, true);
            edges.setTo(0, roi.inside == 0);
            expectSame(layers.at(TraceLayer::edges), edges, "edges");
            cv::cornerHarris(roi.image, response, 3, 3, 0.04);
            float strongest = 0;
            for (int y = 0; y < response.rows; ++y) {
                for (int x = 0; x < response.cols; ++x) {
                    if (roi.inside.at<uchar>(y, x)) strongest = std::max(strongest, response.at<float>(y, x));
                }
            }
            cv::Mat corners = cv::Mat::zeros(response.size(), CV_8UC1);
            std::vector<cv::Point> places;
            for (int y = 0; y < response.rows; ++y) {
                for (int x = 0; x < response.cols; ++x) {
                    bool highest = roi.inside.at<uchar>(y, x) && response.at<float>(y, x) >= 0.05 * strongest;
                    for (int k = 0; k < 9; ++k) {
                        const cv::Point p(x + k % 3 - 1, y + k / 3 - 1);
                        if (!cv::Rect({}, response.size()).contains(p)) continue;
                        highest = highest && response.at<float>(p) <= response.at<float>(y, x);
                    }
                    if (!highest) continue;
                    corners.at<uchar>(y, x) = 255;
                    places.emplace_back(x, y);
                }
            }
            expectSame(layers.at(TraceLayer::corners), corners, "corners");
            cv::Mat linked, labels;
            cv::dilate(corners, linked, disc(7));
            cv::connectedComponents(linked, labels, 8, CV_32S);
            std::map<int, int> members;
            for (const cv::Point& p : places) ++members[labels.at<int>(p)];
            cv::Mat near = cv::Mat::zeros(corners.size(), CV_8UC1);
            for (const cv::Point& p : places) {
                if (members[labels.at<int>(p)] >= fewest) near.at<uchar>(p) = 255;
            }
            cv::dilate(near, near, disc(13));  // the odd side below 14
            const cv::Mat clustered = (edges | corners) & near;
            cv::Mat closed;
            cv::morphologyEx(clustered, closed, cv::MORPH_CLOSE, disc(5));
            expectSame(layers.at(TraceLayer::clustered), clustered, "clustered", fewest == 1);
            expectSame(layers.at(TraceLayer::closed), closed, "closed", fewest == 1);
        }
    }
    // Lengths are 3 px at least.
    options.canny_harris.link_m = options.canny_harris.closing_m = 0.01;
    DetectionOptions least = options;
    least.canny_harris.link_m = least.canny_harris.closing_m = 0.3;
    for (const TraceLayer kind : {TraceLayer::clustered, TraceLayer::closed})
        expectSame(layersOf(options, cutArea()).at(kind), layersOf(least, cutArea()).at(kind), "3 px", false);
}

TEST(SegmenterReference, TophatStepByStep) {
    DetectionOptions options;
    options.method = DetectionMethod::tophat_otsu;
    options.tophat_otsu.element_m = 1.9;
    options.tophat_otsu.smoothing_m = 0.5;
    options.tophat_otsu.joining_m = 0.7;
    for (const double least : {0.0, 90.0}) {
        options.tophat_otsu.min_contrast = least;
        const MotionRoi roi = cutArea();
        const auto layers = layersOf(options, roi);
        cv::Mat smooth, opened, closed;
        cv::morphologyEx(roi.image, smooth, cv::MORPH_CLOSE, disc(5));
        cv::morphologyEx(smooth, smooth, cv::MORPH_OPEN, disc(5));
        expectSame(layers.at(TraceLayer::smoothed), smooth, "smoothed");
        cv::morphologyEx(smooth, opened, cv::MORPH_OPEN, disc(19));
        cv::morphologyEx(smooth, closed, cv::MORPH_CLOSE, disc(19));
        const cv::Mat white = smooth - opened, black = closed - smooth;
        expectSame(layers.at(TraceLayer::white_tophat), white, "white");
        expectSame(layers.at(TraceLayer::black_tophat), black, "black");
        const cv::Mat strongest = cv::max(white, black);
        // Otsu: the level that parts the values of the area into classes that lie farthest apart.
        double counts[256] = {}, all = 0, sum = 0;
        for (int y = 0; y < strongest.rows; ++y) {
            for (int x = 0; x < strongest.cols; ++x) {
                if (!roi.inside.at<uchar>(y, x)) continue;
                ++counts[strongest.at<uchar>(y, x)];
                ++all;
                sum += strongest.at<uchar>(y, x);
            }
        }
        double most = 0, level = 0, below = 0, below_sum = 0;
        for (int value = 0; value < 255; ++value) {
            below += counts[value];
            below_sum += value * counts[value];
            if (below == 0 || below == all) continue;
            const double apart = below_sum / below - (sum - below_sum) / (all - below);
            const double between = below * (all - below) * apart * apart;
            if (between > most * (1 + 1e-9)) {
                most = between;
                level = value;
            }
        }
        const cv::Mat binary = (strongest > std::max(level, least)) & roi.inside;
        expectSame(layers.at(TraceLayer::binary), binary, "binary");
        cv::Mat joined;
        cv::morphologyEx(binary, joined, cv::MORPH_CLOSE, disc(7));
        expectSame(layers.at(TraceLayer::closed), joined, "closed");
    }
    EXPECT_EQ(cv::norm(discElement(6.9), disc(7), cv::NORM_INF), 0);
    EXPECT_EQ(discElement(4.1).size(), cv::Size(5, 5));
    EXPECT_EQ(discElement(3.9).size(), cv::Size(3, 3));
    EXPECT_EQ(discElement(-4).size(), cv::Size(1, 1));
}

TEST(SegmenterReference, StableRegionsAreThoseOfSizeAndShape) {
    DetectionOptions options;
    options.method = DetectionMethod::mser;
    options.mser.delta = 3;
    options.mser.min_area_m2 = 0.5;  // 50 px²
    options.mser.max_area_m2 = 9;
    options.mser.max_variation = 0.4;
    options.mser.max_eccentricity = 0.9;
    const MotionRoi roi = cutArea();
    const auto layers = layersOf(options, roi);
    std::vector<std::vector<cv::Point>> regions;
    std::vector<cv::Rect> boxes;
    cv::MSER::create(3, 50, 900, 0.4)->detectRegions(roi.image, regions, boxes);
    cv::Mat all = cv::Mat::zeros(roi.image.size(), CV_8UC1), kept = all.clone();
    int dropped = 0;
    for (std::size_t i = 0; i < regions.size(); ++i) {
        const bool spans = (boxes[i].x <= 1 && boxes[i].br().x >= all.cols - 1) ||
                           (boxes[i].y <= 1 && boxes[i].br().y >= all.rows - 1);
        const bool fits = !spans && eccentricityOf(regions[i]) <= 0.9;
        dropped += !fits;
        for (const cv::Point& p : regions[i]) {
            all.at<uchar>(p) = 255;
            if (fits) kept.at<uchar>(p) = 255;
        }
    }
    EXPECT_GT(dropped, 0);
    expectSame(layers.at(TraceLayer::regions), all, "regions");
    if (cv::countNonZero(kept) > 0) expectSame(layers.at(TraceLayer::binary), kept, "binary");
    // However small the limits, six pixels make a region at least.
    options.mser.min_area_m2 = 0;
    cv::MSER::create(3, 6, 900, 0.4)->detectRegions(roi.image, regions, boxes);
    all = cv::Mat::zeros(roi.image.size(), CV_8UC1);
    for (const auto& region : regions) {
        for (const cv::Point& p : region) all.at<uchar>(p) = 255;
    }
    expectSame(layersOf(options, roi).at(TraceLayer::regions), all, "regions from six pixels on");
    // Slanting points have the eccentricity of upright ones.
    std::vector<cv::Point> along, slanting;
    for (int i = 0; i < 60; ++i) {
        for (int k = 0; k < 12; ++k) {
            along.emplace_back(i, k);
            slanting.emplace_back(i - k, i + k);
        }
    }
    EXPECT_NEAR(eccentricityOf(slanting), eccentricityOf(along), 1e-3);
    EXPECT_NEAR(eccentricityOf({{0, 0}, {1, 0}}), std::sqrt(1 - 2 / 12. / (2 / 12. + 0.5)), 1e-9);
}

TEST(SegmenterReference, RelativeConnectivityStepByStep) {
    DetectionOptions options;
    options.method = DetectionMethod::relative_connectivity;
    options.relative_connectivity.deviations = 0.5;
    options.relative_connectivity.min_points = 4;
    options.relative_connectivity.low = 10;
    options.relative_connectivity.high_factor = 1.5;
    const MotionRoi roi = cutArea();
    // A car of 4.6 m is 46 px long: about half that, as it is, and half more.
    for (const double factor : {0.513, 1.0, 1.493}) {
        options.relative_connectivity.car_length = 46 * factor;
        const auto layers = layersOf(options, roi);
        const cv::Size size(cvRound(factor * roi.image.cols), cvRound(factor * roi.image.rows));
        cv::Mat image = roi.image, inside = roi.inside;
        if (factor != 1) {
            cv::resize(roi.image, image, size, 0, 0, factor < 1 ? cv::INTER_AREA : cv::INTER_CUBIC);
            cv::resize(roi.inside, inside, size, 0, 0, cv::INTER_NEAREST);
        }
        double sum = 0, squares = 0, count = 0;
        for (int y = 0; y < image.rows; ++y) {
            for (int x = 0; x < image.cols; ++x) {
                if (!inside.at<uchar>(y, x)) continue;
                sum += image.at<uchar>(y, x);
                squares += std::pow(image.at<uchar>(y, x), 2);
                ++count;
            }
        }
        const double mean = sum / count, deviation = std::sqrt(squares / count - mean * mean);
        cv::Mat fused = cv::Mat::zeros(image.size(), CV_8UC1);
        for (const bool bright : {true, false}) {
            cv::Mat belonging = cv::Mat::zeros(image.size(), CV_8UC1);
            for (int y = 0; y < image.rows; ++y) {
                for (int x = 0; x < image.cols; ++x) {
                    const double off = (image.at<uchar>(y, x) - mean) * (bright ? 1 : -1);
                    if (inside.at<uchar>(y, x) && off >= 0.5 * deviation) belonging.at<uchar>(y, x) = 255;
                }
            }
            const cv::Mat lines = relativeConnectivity(belonging, 4);
            cv::Mat closed, shown;
            closeGaps(hysteresis(lines, 10, 15), closed);
            lines.convertTo(shown, CV_32F);
            if (factor != 1) {
                cv::resize(shown, shown, roi.image.size(), 0, 0, cv::INTER_LINEAR);
            }
            expectSame(layers.at(bright ? TraceLayer::bright_lines : TraceLayer::dark_lines), shown, "lines");
            fused = cv::max(fused, closed);
        }
        if (factor != 1) cv::resize(fused, fused, roi.image.size(), 0, 0, cv::INTER_AREA);
        expectSame(layers.at(TraceLayer::fused), fused >= 128, "fused");
    }
    // Enlarged and reduced eight times at most.
    options.relative_connectivity.car_length = 200;
    const SceneScale coarse{1, 25, true};
    DetectionTrace trace;
    makeDetector(options, coarse)->detect(roi, &trace);
    const cv::Mat eight_times = trace.layers.at(1).image;
    options.relative_connectivity.car_length = 4.6 * 8;
    trace = {};
    makeDetector(options, coarse)->detect(roi, &trace);
    expectSame(trace.layers.at(1).image, eight_times, "eight times");
}

TEST(SegmenterReference, TooSmallAnAreaHasNoInside) {
    DetectionOptions options;
    options.gradient.fall_back = false;
    for (const DetectionMethod method : {DetectionMethod::tophat_otsu, DetectionMethod::canny_harris}) {
        options.method = method;
        MotionRoi roi;
        roi.image_from_roi = {1, 0, 0, 0, 1, 0};
        const auto layers = [&](cv::Size size) {
            roi.image = cv::Mat(size, CV_8UC1, cv::Scalar(90));
            roi.inside = cv::Mat(size, CV_8UC1, cv::Scalar(255));
            DetectionTrace trace;
            makeDetector(options, kTenToAMetre)->detect(roi, &trace);
            return trace.layers.size();
        };
        EXPECT_GT(layers({3, 40}), 3U);
        EXPECT_LE(layers({2, 40}), 2U);
        EXPECT_LE(layers({40, 2}), 2U);
    }
}

TEST(SegmenterReference, ViewsAreTheAlgorithmsOfTheirNames) {
    const MotionRoi roi = cutArea();
    const auto slic = [&](int side) {
        auto cells = cv::ximgproc::createSuperpixelSLIC(roi.image, cv::ximgproc::SLIC, side, 10);
        cells->iterate(10);
        cells->enforceLabelConnectivity();
        cv::Mat labels;
        cells->getLabels(labels);
        return labels.clone();
    };
    expectSame(superpixelSegments(roi, kTenToAMetre, 1.2), slic(12), "superpixels of 1.2 m");
    expectSame(superpixelSegments(roi, kTenToAMetre, 0.01), slic(3), "3 px at least");
    expectSame(superpixelSegments(roi, kTenToAMetre, 1000), slic(std::max(roi.image.cols, roi.image.rows) / 2),
               "half of the area at most");
    for (const double smoothing : {0.0, 1.5}) {
        cv::Mat smooth = roi.image.clone(), gradient, lowest, markers, colour;
        if (smoothing > 0) cv::GaussianBlur(roi.image, smooth, {}, smoothing);
        simpleGradient(smooth, gradient);
        cv::erode(gradient, lowest, cv::Mat::ones(3, 3, CV_8UC1));
        cv::connectedComponents(gradient == lowest, markers, 8, CV_32S);
        cv::cvtColor(smooth, colour, cv::COLOR_GRAY2BGR);
        cv::watershed(colour, markers);
        markers.setTo(0, markers < 0);
        const cv::Mat before = roi.image.clone();
        expectSame(drawSegments(roi.image, watershedSegments(roi, smoothing)).reshape(1),
                   drawSegments(roi.image, markers).reshape(1), "watershed");
        EXPECT_EQ(cv::norm(roi.image, before, cv::NORM_INF), 0) << "a view changes nothing";
    }
}

TEST(SegmenterReference, AGraphCutBeginsWithTheVectorsSurroundings) {
    for (const bool with_vectors : {true, false}) {
        MotionRoi roi = cutArea();
        if (!with_vectors) roi.vectors.clear();
        cv::Rect2d own(roi.image.cols / 4., roi.image.rows / 4., roi.image.cols / 2., roi.image.rows / 2.);
        if (with_vectors) {
            const cv::Rect2d bounds = boundsOf(roi.vectors);
            own = {bounds.x - 2, bounds.y - 2, bounds.width + 4, bounds.height + 4};
        }
        cv::Mat mask(roi.image.size(), CV_8UC1, cv::Scalar(cv::GC_PR_BGD));
        mask(cv::Rect(own) & cv::Rect({}, mask.size())).setTo(cv::GC_PR_FGD);
        for (int y = 0; y < mask.rows; ++y) {
            for (int x = 0; x < mask.cols; ++x) {
                const bool outermost = x == 0 || y == 0 || x == mask.cols - 1 || y == mask.rows - 1;
                if (outermost || !roi.inside.at<uchar>(y, x)) mask.at<uchar>(y, x) = cv::GC_BGD;
            }
        }
        cv::Mat colour, background, object;
        cv::cvtColor(roi.image, colour, cv::COLOR_GRAY2BGR);
        const auto before = cv::theRNG().state;
        const cv::Mat labels = graphCutSegments(roi);
        EXPECT_EQ(cv::theRNG().state, before) << "what is drawn elsewhere does not change";
        // Graph cuts draw their first colours; a few pixels may come out otherwise.
        cv::grabCut(colour, mask, {}, background, object, 3, cv::GC_INIT_WITH_MASK);
        const cv::Mat expected = (mask == cv::GC_FGD) | (mask == cv::GC_PR_FGD);
        EXPECT_LT(cv::countNonZero((labels == 1) != expected), 0.05 * static_cast<double>(mask.total()));
        EXPECT_GT(cv::countNonZero(labels), 20);
    }
}

TEST(SegmenterReference, WithoutVectorsAGraphCutFindsWhatFillsTheMiddleAlone) {
    // Two alike, of which one lies within the middle half and the other below it: only the one is asked for.
    MotionRoi roi;
    roi.image = cv::Mat(64, 64, CV_8UC1);
    cv::RNG random(3);
    random.fill(roi.image, cv::RNG::NORMAL, 90, 4);
    for (const int top : {17, 49}) {
        cv::Mat vehicle = roi.image(cv::Rect(20, top, 24, 8));
        random.fill(vehicle, cv::RNG::NORMAL, top == 17 ? 180 : 30, 4);
    }
    roi.inside = cv::Mat(roi.image.size(), CV_8UC1, cv::Scalar(255));
    const cv::Mat labels = graphCutSegments(roi);
    EXPECT_GT(cv::countNonZero(labels(cv::Rect(20, 17, 24, 8))), 150) << "in the upper half of the middle";
    EXPECT_EQ(cv::countNonZero(labels(cv::Rect(20, 49, 24, 8))), 0) << "below the middle";
}

TEST(SegmenterReference, TheThesisDeliversWhatItsGradientFindsAndNothingElse) {
    using Method = GradientMethod;
    for (const Method method : {Method::lbp, Method::simple, Method::canny, Method::morphological}) {
        DetectionOptions options;
        options.method = DetectionMethod::gradient;
        options.gradient = GradientOptions::thesis(method);
        // Table 7.3.
        EXPECT_EQ(options.gradient.effectiveQuantile(), method == Method::lbp      ? 0.12
                                                        : method == Method::simple ? 0.15
                                                        : method == Method::canny  ? 0.14
                                                                                   : 0.16);
        MotionRoi plain = roiOf(drivenScene(0.4));
        plain.image.setTo(90);
        EXPECT_TRUE(makeDetector(options, kTenToAMetre)->detect(plain).empty()) << "no box of the cluster instead";
        EXPECT_FALSE(makeDetector(options, kTenToAMetre)->detect(roiOf(drivenScene(0.4))).empty());
    }
}

TEST(SegmenterReference, ContoursAreBlendedInByTheirStrength) {
    const cv::Mat gray = (cv::Mat_<uchar>(2, 3) << 100, 100, 40, 40, 200, 200);
    const cv::Mat contours = (cv::Mat_<float>(2, 3) << 0, 2, 4, 1, 3, 0);
    const cv::Mat drawn = drawContourMap(gray, contours, {20, 120, 220});
    for (int y = 0; y < 2; ++y) {
        for (int x = 0; x < 3; ++x) {
            const double share = contours.at<float>(y, x) / 4;
            for (int c = 0; c < 3; ++c) {
                const double line = 20 + 100 * c;
                EXPECT_NEAR(drawn.at<cv::Vec3b>(y, x)[c], gray.at<uchar>(y, x) * (1 - share) + line * share, 1);
            }
        }
    }
    const cv::Mat none = drawContourMap(gray, cv::Mat::zeros(2, 3, CV_32FC1));
    EXPECT_EQ(none.at<cv::Vec3b>(1, 1), cv::Vec3b(200, 200, 200));
}

TEST(SegmenterReference, ComponentsTellWhatKeptOrDroppedThem) {
    GradientOptions options = GradientOptions::thesis();
    options.need_support = true;
    options.support_share = 0.3;
    options.min_box_area = 60;
    const ComponentBoxes boxes(options, kTenToAMetre);
    cv::Mat binary = cv::Mat::zeros(60, 60, CV_8UC1);
    binary(cv::Rect(10, 10, 10, 8)).setTo(255);
    binary(cv::Rect(40, 30, 9, 9)).setTo(255);
    const std::vector<cv::Point2f> vectors{{12, 12}, {19.4F, 17.4F}, {20.6F, 12}, {9, 8.4F}, {44, 34}};
    cv::Mat labels;
    DetectionTrace trace;
    const auto selected = boxes.select(findRegions(binary, 60, labels), labels, vectors, &trace);
    ASSERT_EQ(selected.size(), 1U);
    EXPECT_EQ(selected[0], cv::Rect2d(9.5, 9.5, 10, 8));
    ASSERT_EQ(trace.checks.size(), 3U);
    // A px about the box belongs to it: 8.5 … 20.5 × 8.5 … 18.5.
    EXPECT_EQ(trace.checks[0].value, 2);
    EXPECT_EQ(trace.checks[0].limit, 1.5);
    EXPECT_TRUE(trace.checks[0].passed);
    EXPECT_EQ(trace.checks[1].value, 1);
    EXPECT_FALSE(trace.checks[1].passed);
    EXPECT_FALSE(trace.checks[1].at_most);
    EXPECT_EQ(trace.checks[2].value, 80);
    EXPECT_EQ(trace.checks[2].limit, 60);
    EXPECT_TRUE(trace.checks[2].passed);
    EXPECT_EQ(trace.checks[2].box, selected[0]);
    // Where all are too small, the largest is told.
    trace = {};
    cv::Mat specks = cv::Mat::zeros(60, 60, CV_8UC1);
    specks(cv::Rect(0, 10, 5, 2)).setTo(255);
    specks(cv::Rect(30, 40, 3, 7)).setTo(255);
    specks(cv::Rect(59, 59, 1, 1)).setTo(255);
    cv::Mat specks_labels;
    EXPECT_TRUE(boxes.select(findRegions(specks, 60, specks_labels), specks_labels, vectors, &trace).empty());
    ASSERT_EQ(trace.checks.size(), 1U);
    EXPECT_EQ(trace.checks[0].limit, 60);
    EXPECT_FALSE(trace.checks[0].passed);
    trace = {};
    EXPECT_TRUE(boxes.select({}, (cv::Mat_<int>(2, 4) << 1, 1, 0, 2, 0, 0, 0, 2), vectors, &trace).empty());
    EXPECT_EQ(trace.checks.at(0).value, 2);
}

TEST(SegmenterReference, JoinedBoxesFitIntoOneVehicleOfAtLeastFourPixels) {
    GradientOptions options = GradientOptions::thesis();
    options.min_box_area = 1;
    options.join_components = true;
    options.vehicle_length_m = 3;  // 30 px
    options.vehicle_width_m = 1;   // 10 px
    const auto joined = [&](const cv::Rect& a, const cv::Rect& b) {
        cv::Mat binary = cv::Mat::zeros(60, 60, CV_8UC1);
        binary(a).setTo(255);
        binary(b).setTo(255);
        cv::Mat labels;
        return ComponentBoxes(options, kTenToAMetre).select(findRegions(binary, 1, labels), labels, {}).size() == 1;
    };
    EXPECT_TRUE(joined({10, 10, 6, 6}, {14, 34, 6, 6}));
    EXPECT_FALSE(joined({10, 10, 6, 6}, {14, 35, 6, 6}));
    EXPECT_FALSE(joined({10, 10, 6, 6}, {15, 34, 6, 6}));
    options.vehicle_width_m = 0.01;
    EXPECT_TRUE(joined({10, 10, 2, 6}, {12, 30, 2, 6}));
    EXPECT_FALSE(joined({10, 10, 2, 6}, {13, 30, 2, 6}));
    // The smallest union first: the middle one goes to its nearer neighbour.
    options.vehicle_width_m = 1;
    cv::Mat binary = cv::Mat::zeros(80, 20, CV_8UC1);
    for (const int top : {0, 22, 40}) binary(cv::Rect(4, top, 6, 4)).setTo(255);
    cv::Mat labels;
    const auto boxes = ComponentBoxes(options, kTenToAMetre).select(findRegions(binary, 1, labels), labels, {});
    ASSERT_EQ(boxes.size(), 2U);
    EXPECT_EQ(boxes[1], cv::Rect2d(3.5, 21.5, 6, 22));
}

}  // namespace eyrie::segmenter_reference_test
