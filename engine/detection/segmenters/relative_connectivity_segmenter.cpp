#include "detection/segmenters/relative_connectivity_segmenter.h"

#include <algorithm>
#include <opencv2/imgproc.hpp>

#include "detection/segmenters/relative_connectivity.h"
#include "imaging/hysteresis.h"
#include "imaging/region_boxes.h"

namespace eyrie {

namespace {

constexpr double kCarLength = 4.6;  // m
constexpr double kLargestEnlargement = 8;

cv::Mat resized(const cv::Mat& image, cv::Size size, int interpolation) {
    if (image.size() == size) return image;
    cv::Mat result;
    cv::resize(image, result, size, 0, 0, interpolation);
    return result;
}

}  // namespace

RelativeConnectivityOptions RelativeConnectivityOptions::thesis() {
    RelativeConnectivityOptions options;
    options.deviations = 1.2;
    options.low = 40;
    options.car_length = 0;
    return options;
}

void RelativeConnectivityOptions::describe(ParameterVisitor& visitor) {
    const ParameterDeclarer declare(visitor, ChainStage::detection);
    declare.real("relative_connectivity.deviations", deviations, -5, 5,
                 {"",
                  "Points of a line are brighter than the mean of the search area by this many deviations (a). Larger: "
                  "fewer points.",
                  "Teutsch §7.3.2"});
    declare.integer("relative_connectivity.min_points", min_points, 2, 100,
                    {"", "A line has at least this many points (T_m).", "Teutsch §5.4.2, algorithm 1"});
    declare.real(
        "relative_connectivity.low", low, 1, 100000,
        {"", "Contours are at least this strong (T_l). Larger: fewer and shorter contours.", "Teutsch §7.3.2"});
    declare.real("relative_connectivity.high_factor", high_factor, 1, 100,
                 {"", "Somewhere a contour is this many times as strong as T_l (b).", "Teutsch §7.3.2"});
    declare.real("relative_connectivity.car_length", car_length, 0, 200,
                 {"px",
                  "Search areas are scaled until a car is this long, as T_l counts points and holds for one size of "
                  "vehicles. 0: never.",
                  ""});
}

RelativeConnectivitySegmenter::RelativeConnectivitySegmenter(const RelativeConnectivityOptions& options,
                                                             const GradientOptions& components, const SceneScale& scale,
                                                             double cluster_margin)
    : MaskSegmenter(components, scale, cluster_margin),
      options_(options),
      enlargement_(options.car_length > 0 ? std::clamp(options.car_length / scale.px(kCarLength),
                                                       1 / kLargestEnlargement, kLargestEnlargement)
                                          : 1) {}

cv::Mat RelativeConnectivitySegmenter::objectPixels(const MotionRoi& roi, DetectionTrace* trace) const {
    const cv::Size size(std::max(3, cvRound(enlargement_ * roi.image.cols)),
                        std::max(3, cvRound(enlargement_ * roi.image.rows)));
    const cv::Mat scaled = resized(roi.image, size, enlargement_ < 1 ? cv::INTER_AREA : cv::INTER_CUBIC);
    const cv::Mat inside = resized(roi.inside, size, cv::INTER_NEAREST);
    cv::Scalar mean;
    cv::Scalar deviation;
    cv::meanStdDev(scaled, mean, deviation, inside);
    const auto areas = [&](const cv::Mat& image, double mean_grey, TraceLayer lines_kind, TraceLayer areas_kind) {
        const cv::Mat belonging = (image >= mean_grey + options_.deviations * deviation[0]) & inside;
        const cv::Mat accumulator = relativeConnectivity(belonging, options_.min_points);
        cv::Mat closed;
        closeGaps(hysteresis(accumulator, options_.low, options_.high_factor * options_.low), closed);
        if (trace != nullptr) {
            cv::Mat strength;
            accumulator.convertTo(strength, CV_32F);
            addLayer(trace, lines_kind, resized(strength, roi.image.size(), cv::INTER_LINEAR));
            addLayer(trace, areas_kind, resized(closed, roi.image.size(), cv::INTER_NEAREST));
        }
        return closed;
    };
    if (deviation[0] <= 0) return cv::Mat::zeros(roi.image.size(), CV_8UC1);
    const cv::Mat bright = areas(scaled, mean[0], TraceLayer::bright_lines, TraceLayer::bright_areas);
    const cv::Mat inverted = 255 - scaled;
    const cv::Mat dark = areas(inverted, 255 - mean[0], TraceLayer::dark_lines, TraceLayer::dark_areas);
    // Of a scaled-down mask pixels that are mostly covered remain.
    const cv::Mat fused = resized(cv::max(bright, dark), roi.image.size(), cv::INTER_AREA) >= 128;
    addLayer(trace, TraceLayer::fused, fused);
    return fused;
}

}  // namespace eyrie
