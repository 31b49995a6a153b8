#pragma once

#include <opencv2/core.hpp>
#include <vector>

#include "core/geometry/oriented_box.h"
#include "core/values/ids.h"

namespace eyrie {

/// How boxes are sampled: upright, each to the same number of samples, so that size does not matter.
struct SampleGrid {
    cv::Size box;          ///< samples of the box and its margin
    cv::Size reach;        ///< samples that it may move to either side
    double margin = 1.15;  ///< around the box, so that its outline counts

    /// `reach_along`, `reach_across`: how far boxes may move, of their length and width.
    static SampleGrid forBox(const OrientedBox& box, double reach_along, double reach_across);
    /// Samples a box and as much around it as asked for; CV_8UC1.
    cv::Mat cut(const cv::Mat& picture, const OrientedBox& at, cv::Size around) const;
    /// The box moved in its own axes, then turned (radians).
    OrientedBox moved(OrientedBox at, cv::Point2d by_samples, double turned) const;
};

/// A frame of an object's life, and where its box is found in the picture.
struct PicturePlace {
    FrameIndex frame = 0;
    OrientedBox box;
    bool by_hand = false;
    bool whole = true;   ///< not cut by the image's border
    cv::Mat picture;     ///< the part of it around the box; empty where it cannot be compared
    cv::Point2d corner;  ///< of that part
    cv::Mat wide;        ///< the box and around; empty where it cannot be compared
    cv::Mat likeness;    ///< for each way to move it, −1 … 1; CV_32F
    cv::Point step;      ///< chosen, samples
    cv::Point2d found;   ///< finer
    double turn = 0;     ///< of the box as it was, radians
};

/// Finds the way of an object through all its pictures at once: for every frame how far its box moves and turns to look
/// like those set by hand and like its neighbours, changing little from frame to frame. Boxes set by hand stay where
/// they are, boxes along the image's axes stay along them.
void findWayInPictures(std::vector<PicturePlace>& places, const SampleGrid& grid);

}  // namespace eyrie
