#pragma once

#include <opencv2/core/types.hpp>
#include <vector>

#include "core/values/scene_scale.h"
#include "detection/detection_trace.h"
#include "detection/segmenters/gradient_options.h"
#include "imaging/region_boxes.h"

/// From connected components to the boxes of vehicles, in ROI coordinates (motion points up, so a box's height is the
/// vehicle's length). Boxes are given by their edges: pixel 0 covers −0.5 … 0.5.
namespace eyrie {

/// Smallest box around points, without extent of its own; empty at the origin when there is none.
cv::Rect2d boundsOf(const std::vector<cv::Point2f>& points);
/// The box with its sides moved out by `along` (up and down) and `across` px; sides never pass each other.
cv::Rect2d grown(const cv::Rect2d& box, double along, double across);
/// Which of the points lie in the box grown by `margin` px.
std::vector<cv::Point2f> pointsWithin(const cv::Rect2d& box, const std::vector<cv::Point2f>& points, double margin);

/// The motion vectors that a box holds and those that it has to hold to be believed.
struct BoxSupport {
    double inside = 0;
    double needed = 0;
    bool enough() const { return inside >= needed; }
};
/// `vectors`: those of the cluster, of which the box has to hold this share (0 … 1), and one at least. What lies 1 px
/// beside the box counts, since corners lie on outlines.
BoxSupport supportOf(const cv::Rect2d& box, const std::vector<cv::Point2f>& vectors, double share);

/// Applies what GradientOptions says about components, in this order: cut ones, support, joining, limits of growth,
/// correction of size. Lengths are turned into pixels once.
class ComponentBoxes {
 public:
    ComponentBoxes(const GradientOptions& options, const SceneScale& scale);

    /// `vectors`: the cluster's own; `labels`: as found by `findRegions`. `trace`, if given, receives the checks.
    std::vector<cv::Rect2d> select(const std::vector<Region>& regions, const cv::Mat& labels,
                                   const std::vector<cv::Point2f>& vectors, DetectionTrace* trace = nullptr) const;

    /// Whether the boxes together hold enough of the vectors to be believed.
    bool explain(const std::vector<cv::Rect2d>& boxes, const std::vector<cv::Point2f>& vectors,
                 DetectionTrace* trace = nullptr) const;

 private:
    cv::Rect2d boxOf(const Region& region, const cv::Mat& labels, const cv::Rect2d& core) const;
    void join(std::vector<cv::Rect2d>& boxes) const;
    cv::Rect2d limited(const cv::Rect2d& box, const std::vector<cv::Point2f>& vectors) const;

    GradientOptions options_;
    double core_margin_;
    double vehicle_length_;
    double vehicle_width_;
    double growth_along_;
    double growth_across_;
    double too_long_;  ///< px
    double too_wide_;  ///< px
};

}  // namespace eyrie
