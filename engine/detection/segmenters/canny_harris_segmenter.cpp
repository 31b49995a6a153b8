#include "detection/segmenters/canny_harris_segmenter.h"

#include <algorithm>
#include <opencv2/imgproc.hpp>
#include <vector>

namespace eyrie {

void CannyHarrisOptions::describe(ParameterVisitor& visitor) {
    const ParameterDeclarer declare(visitor, ChainStage::detection);
    declare.real("canny_harris.high", high, 0.1, 1000,
                 {"grey", "Upper threshold of the edge detector, as height of a sharp step. Larger: fewer edges.",
                  "Teutsch §7.4.1"});
    declare.real("canny_harris.low_share", low_share, 0.01, 1,
                 {"", "The lower threshold is this share of the upper one.", "Teutsch §7.4.1"});
    declare.real("canny_harris.corner_share", corner_share, 0.0001, 1,
                 {"", "Corners have at least this share of the strongest Harris response in the search area.",
                  "Teutsch §7.4.1"});
    declare.real("canny_harris.link", link_m, 0.01, 50,
                 {"m", "Corners this close form a cluster, and edges this close belong to it; at least 3 px.",
                  "Teutsch §7.4.1"});
    declare.integer("canny_harris.min_corners", min_corners, 1, 1000,
                    {"", "Smaller clusters of corners are dropped.", "Teutsch §7.4.1"});
    declare.real("canny_harris.closing", closing_m, 0, 10,
                 {"m", "Diameter of the closing; at least 3 px.", "Teutsch §7.4.1"});
}

CannyHarrisSegmenter::CannyHarrisSegmenter(const CannyHarrisOptions& options, const GradientOptions& components,
                                           const SceneScale& scale, double cluster_margin)
    : MaskSegmenter(components, scale, cluster_margin),
      options_(options),
      link_px_(std::max(3.0, scale.px(options.link_m))),
      closing_(discElement(std::max(3.0, scale.px(options.closing_m)))) {}

cv::Mat CannyHarrisSegmenter::cornersOf(const MotionRoi& roi) const {
    cv::Mat response;
    cv::cornerHarris(roi.image, response, 3, 3, 0.04);
    double strongest = 0;
    cv::minMaxLoc(response, nullptr, &strongest, nullptr, nullptr, roi.inside);
    if (strongest <= 0) return cv::Mat::zeros(roi.image.size(), CV_8UC1);
    cv::Mat highest_near;
    cv::dilate(response, highest_near, {});
    return (response >= highest_near) & (response >= options_.corner_share * strongest) & roi.inside;
}

cv::Mat CannyHarrisSegmenter::nearClusters(const cv::Mat& corners) const {
    // Discs about corners touch where these are linked; discs of twice the size take the edges.
    cv::Mat linked;
    cv::dilate(corners, linked, discElement(link_px_));
    cv::Mat labels;
    const int count = cv::connectedComponents(linked, labels, 8, CV_32S);
    std::vector<int> members(static_cast<std::size_t>(count), 0);
    cv::Mat kept = cv::Mat::zeros(corners.size(), CV_8UC1);
    for (int pass = 0; pass < 2; ++pass) {
        for (int y = 0; y < corners.rows; ++y) {
            for (int x = 0; x < corners.cols; ++x) {
                if (corners.at<uchar>(y, x) == 0) continue;
                int& of_cluster = members[static_cast<std::size_t>(labels.at<int>(y, x))];
                if (pass == 0) {
                    ++of_cluster;
                } else if (of_cluster >= options_.min_corners) {
                    kept.at<uchar>(y, x) = 255;
                }
            }
        }
    }
    cv::dilate(kept, kept, discElement(2 * link_px_));
    return kept;
}

cv::Mat CannyHarrisSegmenter::objectPixels(const MotionRoi& roi, DetectionTrace* trace) const {
    constexpr double kStepResponse = 4;  // of Sobel's 3×3 masks to a sharp step of height 1
    const double high = options_.high * kStepResponse;
    cv::Mat edges;
    cv::Canny(roi.image, edges, options_.low_share * high, high, 3, true);
    edges &= roi.inside;
    const cv::Mat corners = cornersOf(roi);
    const cv::Mat clustered = (edges | corners) & nearClusters(corners);
    cv::Mat closed;
    cv::morphologyEx(clustered, closed, cv::MORPH_CLOSE, closing_);
    addLayer(trace, TraceLayer::edges, edges);
    addLayer(trace, TraceLayer::corners, corners);
    addLayer(trace, TraceLayer::clustered, clustered);
    addLayer(trace, TraceLayer::closed, closed);
    return closed;
}

}  // namespace eyrie
