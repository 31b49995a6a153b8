#include "detection/segmenters/mser_segmenter.h"

#include <algorithm>
#include <cmath>
#include <opencv2/features2d.hpp>

namespace eyrie {
namespace {

constexpr int kSmallestArea = 6;        // px²; smaller regions are noise at any scale
constexpr int kSmallestRegionSide = 5;  // px

/// Search areas are larger than vehicles, so what reaches from edge to edge is ground. Regions leave out the outermost
/// pixels.
bool spans(const cv::Rect& box, cv::Size area) {
    return (box.x <= 1 && box.br().x >= area.width - 1) || (box.y <= 1 && box.br().y >= area.height - 1);
}

}  // namespace

MserOptions MserOptions::thesis() {
    MserOptions options;
    options.keep_spanning = true;
    return options;
}

void MserOptions::describe(ParameterVisitor& visitor) {
    const ParameterDeclarer declare(visitor, ChainStage::detection);
    declare.integer(
        "mser.delta", delta, 1, 127,
        {"grey", "Regions are stable over this many grey values. Larger: fewer, stronger regions.", "Teutsch §7.4.1"});
    declare.real("mser.max_variation", max_variation, 0.01, 10,
                 {"", "Regions that grow by a larger share over that are not stable.", "Teutsch §7.4.1"});
    declare.real("mser.min_area", min_area_m2, 0, 1000, {"m²", "Smaller regions are dropped.", "Teutsch §7.4.1"});
    declare.real("mser.max_area", max_area_m2, 0.01, 100000, {"m²", "Larger regions are dropped.", "Teutsch §7.4.1"});
    declare.real("mser.max_eccentricity", max_eccentricity, 0, 1,
                 {"", "Longer regions are dropped: 0 is a disc, 1 a line.", "Teutsch §7.4.1"});
    declare.flag("mser.keep_spanning", keep_spanning,
                 {"", "Regions that reach from edge to edge of the search area, ground as a rule, are kept, too.",
                  "Teutsch §7.4.1"});
}

MserSegmenter::MserSegmenter(const MserOptions& options, const GradientOptions& components, const SceneScale& scale,
                             double cluster_margin)
    : MaskSegmenter(components, scale, cluster_margin), options_(options) {
    constexpr double kLargest = 1e8;
    const double px_per_m2 = 1 / (scale.gsd_m_per_px * scale.gsd_m_per_px);
    min_area_ = std::max(kSmallestArea, cvRound(std::min(options.min_area_m2 * px_per_m2, kLargest)));
    max_area_ = std::max(min_area_, cvRound(std::min(options.max_area_m2 * px_per_m2, kLargest)));
}

double eccentricityOf(const std::vector<cv::Point>& points) {
    if (points.empty()) return 0;
    const auto count = static_cast<double>(points.size());
    cv::Point2d mean(0, 0);
    for (const cv::Point& p : points) mean += cv::Point2d(p);
    mean *= 1 / count;
    double xx = 0;
    double xy = 0;
    double yy = 0;
    for (const cv::Point& p : points) {
        const cv::Point2d d = cv::Point2d(p) - mean;
        xx += d.x * d.x;
        xy += d.x * d.y;
        yy += d.y * d.y;
    }
    const double pixel = count / 12;  // a pixel is a square, not a point
    const double middle = (xx + yy) / 2 + pixel;
    const double spread = std::hypot((xx - yy) / 2, xy);
    return std::sqrt(std::max(0.0, 1 - (middle - spread) / (middle + spread)));
}

cv::Mat MserSegmenter::objectPixels(const MotionRoi& roi, DetectionTrace* trace) const {
    cv::Mat kept = cv::Mat::zeros(roi.image.size(), CV_8UC1);
    if (std::min(roi.image.cols, roi.image.rows) < kSmallestRegionSide) return kept;
    const auto mser = cv::MSER::create(options_.delta, min_area_, max_area_, options_.max_variation);
    std::vector<std::vector<cv::Point>> regions;
    std::vector<cv::Rect> boxes;
    mser->detectRegions(roi.image, regions, boxes);
    cv::Mat all = kept.clone();
    for (std::size_t i = 0; i < regions.size(); ++i) {
        const auto& region = regions[i];
        const bool fits = (options_.keep_spanning || !spans(boxes[i], kept.size())) &&
                          eccentricityOf(region) <= options_.max_eccentricity;
        for (const cv::Point& p : region) {
            all.at<uchar>(p) = 255;
            if (fits) kept.at<uchar>(p) = 255;
        }
    }
    addLayer(trace, TraceLayer::regions, all);
    addLayer(trace, TraceLayer::binary, kept);
    return kept;
}

}  // namespace eyrie
