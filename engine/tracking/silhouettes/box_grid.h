#pragma once

#include <opencv2/core/mat.hpp>
#include <optional>

#include "core/geometry/oriented_box.h"

namespace eyrie {

/// Where something ends in the axes of a box, px from its centre: along the heading and across it to the right.
struct BoxEdges {
    double rear = 0;
    double front = 0;
    double left = 0;
    double right = 0;

    double length() const { return front - rear; }
    double width() const { return right - left; }
    double area() const { return length() * width(); }
};

/// A grid of places about a box, in its axes: columns along its heading, rows across it to the right.
class BoxGrid {
 public:
    /// `along`, `across`: px by which it reaches beyond the box; `step`: px from one place to the next.
    BoxGrid(const OrientedBox& box, double along, double across, double step);

    const OrientedBox& box() const { return box_; }
    double step() const { return step_; }
    cv::Size places() const { return places_; }
    /// A place of the grid, in columns and rows, of a point in the box's axes.
    cv::Point2d placeOf(cv::Point2d in_box) const;
    /// The places of the box itself.
    cv::Rect inBox() const;

    /// What a picture (CV_8UC1) shows at the places, which `picture_from_here` takes there; CV_8UC1. Places beyond the
    /// picture are marked with 255 in `beyond`; without it, the answer is empty where there is one.
    cv::Mat sampled(const cv::Mat& gray, const cv::Matx33d& picture_from_here, cv::Mat* beyond = nullptr) const;

    /// The edges of the connected area of a mask (CV_8UC1) that covers most of some places, without its fringe; small
    /// gaps are closed. `area` gets its mask. Nothing where none covers any.
    std::optional<BoxEdges> edgesOf(const cv::Mat& mask, const cv::Rect& covering, cv::Mat* area = nullptr) const;

 private:
    OrientedBox box_;
    double step_;
    cv::Size places_;
};

}  // namespace eyrie
