#include "detection/segmenters/segmentation_views.h"

#include <algorithm>
#include <opencv2/imgproc.hpp>
#include <opencv2/ximgproc/slic.hpp>
#include <vector>

#include "detection/segmenters/component_boxes.h"
#include "imaging/contours/contour_hierarchy.h"
#include "imaging/fixed_random.h"
#include "imaging/gradients.h"

namespace eyrie {
namespace {

constexpr int kSmallestSide = 5;  // px; smaller images are one segment

bool tooSmall(const cv::Mat& image) {
    return std::min(image.cols, image.rows) < kSmallestSide;
}

cv::Mat oneSegment(const cv::Mat& image) {
    return cv::Mat::zeros(image.size(), CV_32SC1);
}

}  // namespace

cv::Mat superpixelSegments(const MotionRoi& roi, const SceneScale& scale, double side_m) {
    if (tooSmall(roi.image)) return oneSegment(roi.image);
    constexpr int kIterations = 10;
    constexpr float kCompactness = 10;
    const int longest = std::max(roi.image.cols, roi.image.rows);
    const int side = std::clamp(cvRound(scale.px(side_m)), 3, std::max(3, longest / 2));
    const auto slic = cv::ximgproc::createSuperpixelSLIC(roi.image, cv::ximgproc::SLIC, side, kCompactness);
    slic->iterate(kIterations);
    slic->enforceLabelConnectivity();
    cv::Mat labels;
    slic->getLabels(labels);
    return labels.clone();
}

cv::Mat watershedSegments(const MotionRoi& roi, double smoothing_px) {
    if (tooSmall(roi.image)) return oneSegment(roi.image);
    cv::Mat smooth;  // never the picture itself, which others hold
    if (smoothing_px > 0)
        cv::GaussianBlur(roi.image, smooth, {}, smoothing_px);
    else
        smooth = roi.image.clone();
    cv::Mat gradient;
    simpleGradient(smooth, gradient);
    cv::Mat lowest;
    cv::erode(gradient, lowest, {});
    const cv::Mat minima = gradient <= lowest;
    cv::Mat markers;
    cv::connectedComponents(minima, markers, 8, CV_32S);
    cv::Mat colour;
    cv::cvtColor(smooth, colour, cv::COLOR_GRAY2BGR);
    cv::watershed(colour, markers);
    // Borders (−1) and what was never reached belong to no segment of their own.
    cv::Mat labels = cv::max(markers, 0);
    return labels;
}

cv::Mat graphCutSegments(const MotionRoi& roi) {
    if (tooSmall(roi.image)) return oneSegment(roi.image);
    constexpr int kIterations = 3;
    cv::Mat mask(roi.image.size(), CV_8UC1, cv::Scalar(cv::GC_PR_BGD));
    const cv::Rect2d own = roi.vectors.empty() ? cv::Rect2d(roi.image.cols / 4.0, roi.image.rows / 4.0,
                                                            roi.image.cols / 2.0, roi.image.rows / 2.0)
                                               : grown(boundsOf(roi.vectors), 2, 2);
    const cv::Rect whole({0, 0}, roi.image.size());
    mask(cv::Rect(own) & whole).setTo(cv::GC_PR_FGD);
    cv::rectangle(mask, whole, cv::Scalar(cv::GC_BGD), 1);
    mask.setTo(cv::GC_BGD, roi.inside == 0);
    if (cv::countNonZero(mask == cv::GC_PR_FGD) == 0) return oneSegment(roi.image);
    cv::Mat colour;
    cv::cvtColor(roi.image, colour, cv::COLOR_GRAY2BGR);
    cv::Mat background_model;
    cv::Mat object_model;
    const FixedRandom fixed;  // graph cuts start from k-means
    cv::grabCut(colour, mask, {}, background_model, object_model, kIterations, cv::GC_INIT_WITH_MASK);
    cv::Mat labels;
    cv::Mat(((mask == cv::GC_FGD) | (mask == cv::GC_PR_FGD)) / 255).convertTo(labels, CV_32S);
    return labels;
}

cv::Mat contourMap(const MotionRoi& roi) {
    if (tooSmall(roi.image)) return cv::Mat::zeros(roi.image.size(), CV_32FC1);
    return ContourHierarchy(probabilityOfBoundary(roi.image)).contourMap();
}

cv::Mat drawContourMap(const cv::Mat& gray, const cv::Mat& contours, const cv::Scalar& colour) {
    CV_Assert(gray.type() == CV_8UC1 && contours.type() == CV_32FC1 && gray.size() == contours.size());
    cv::Mat drawn;
    if (gray.empty()) return drawn;
    cv::cvtColor(gray, drawn, cv::COLOR_GRAY2BGR);
    double strongest = 0;
    cv::minMaxLoc(contours, nullptr, &strongest);
    if (strongest <= 0) return drawn;
    const cv::Vec3d line(colour[0], colour[1], colour[2]);
    for (int y = 0; y < gray.rows; ++y) {
        for (int x = 0; x < gray.cols; ++x) {
            const double share = contours.at<float>(y, x) / strongest;
            auto& pixel = drawn.at<cv::Vec3b>(y, x);
            pixel = cv::Vec3b(cv::Vec3d(pixel) * (1 - share) + line * share);
        }
    }
    return drawn;
}

cv::Mat drawSegments(const cv::Mat& gray, const cv::Mat& labels, const cv::Scalar& colour) {
    CV_Assert(gray.type() == CV_8UC1 && labels.type() == CV_32SC1 && gray.size() == labels.size());
    cv::Mat drawn;
    if (gray.empty()) return drawn;
    cv::cvtColor(gray, drawn, cv::COLOR_GRAY2BGR);
    const cv::Vec3b line(cv::saturate_cast<uchar>(colour[0]), cv::saturate_cast<uchar>(colour[1]),
                         cv::saturate_cast<uchar>(colour[2]));
    for (int y = 0; y < labels.rows; ++y) {
        for (int x = 0; x < labels.cols; ++x) {
            const int own = labels.at<int>(y, x);
            const bool right = x + 1 < labels.cols && labels.at<int>(y, x + 1) != own;
            const bool below = y + 1 < labels.rows && labels.at<int>(y + 1, x) != own;
            if (right || below) drawn.at<cv::Vec3b>(y, x) = line;
        }
    }
    return drawn;
}

}  // namespace eyrie
