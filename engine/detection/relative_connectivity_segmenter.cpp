#include "detection/relative_connectivity_segmenter.h"

#include <opencv2/core.hpp>

#include "detection/relative_connectivity.h"
#include "imaging/hysteresis.h"
#include "imaging/region_boxes.h"

namespace eyrie {

void RelativeConnectivityOptions::describe(ParameterVisitor& visitor) {
    visitor.real("relative_connectivity.deviations", deviations, -5, 5,
                 {"",
                  "Points of a line are brighter than the mean of the search area by this many deviations (a). Larger: "
                  "fewer points.",
                  "Teutsch §7.3.2"});
    visitor.integer("relative_connectivity.min_points", min_points, 2, 100,
                    {"", "A line has at least this many points (T_m).", "Teutsch §5.4.2, algorithm 1"});
    visitor.real(
        "relative_connectivity.low", low, 1, 100000,
        {"", "Contours are at least this strong (T_l). Larger: fewer and shorter contours.", "Teutsch §7.3.2"});
    visitor.real("relative_connectivity.high_factor", high_factor, 1, 100,
                 {"", "Somewhere a contour is this many times as strong as T_l (b).", "Teutsch §7.3.2"});
    visitor.flag(
        "relative_connectivity.follow_scale", follow_scale,
        {"", "T_l grows in proportion to the size of vehicles in pixels, as lines have more points then.", ""});
    visitor.real("relative_connectivity.reference_gsd", reference_gsd_m, 0.001, 100,
                 {"m/px", "Ground sampling distance at which T_l holds.", "Teutsch §7.2"});
}

RelativeConnectivitySegmenter::RelativeConnectivitySegmenter(const RelativeConnectivityOptions& options,
                                                             const GradientOptions& components, const SceneScale& scale,
                                                             double cluster_margin_px)
    : MaskSegmenter(components, scale, cluster_margin_px),
      options_(options),
      low_(options.follow_scale ? options.low * scale.px(options.reference_gsd_m) : options.low) {}

cv::Mat RelativeConnectivitySegmenter::objectPixels(const MotionRoi& roi, DetectionTrace* trace) const {
    cv::Scalar mean;
    cv::Scalar deviation;
    cv::meanStdDev(roi.image, mean, deviation, roi.inside);
    const auto areas = [&](const cv::Mat& image, double mean_grey, const char* lines_name, const char* binary_name) {
        const cv::Mat belonging = (image >= mean_grey + options_.deviations * deviation[0]) & roi.inside;
        const cv::Mat accumulator = relativeConnectivity(belonging, options_.min_points);
        cv::Mat closed;
        closeGaps(hysteresis(accumulator, low_, options_.high_factor * low_), closed);
        addLayer(trace, lines_name, accumulator);
        addLayer(trace, binary_name, closed);
        return closed;
    };
    if (deviation[0] <= 0) return cv::Mat::zeros(roi.image.size(), CV_8UC1);
    const cv::Mat bright = areas(roi.image, mean[0], "bright lines", "bright areas");
    const cv::Mat inverted = 255 - roi.image;
    const cv::Mat dark = areas(inverted, 255 - mean[0], "dark lines", "dark areas");
    const cv::Mat fused = cv::max(bright, dark);
    addLayer(trace, "fused", fused);
    return fused;
}

}  // namespace eyrie
