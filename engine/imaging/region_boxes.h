#pragma once

#include <opencv2/core/mat.hpp>
#include <vector>

namespace eyrie {

/// A connected component and its upright box.
struct Region {
    int label = 0;     ///< value of its pixels in the label image, from 1
    cv::Rect box;      ///< pixels it covers
    int pixels = 0;    ///< number of its pixels
    bool cut = false;  ///< touches the edge of the image, so part of it may be missing
};

/// Morphological closing of a CV_8UC1 binary image with a 3×3 square (Teutsch §5.4.1): fills gaps up to 2 px. For
/// CV_32FC1, thresholding the result gives what thresholding before gives.
void closeGaps(const cv::Mat& binary, cv::Mat& closed);

/// 8-connected components of a CV_8UC1 binary image, by ascending label. Boxes with an area below `min_box_area` px²
/// are left out (Teutsch §5.4.1: 10). `labels` becomes CV_32SC1, 0 being background; it still holds what was left out.
std::vector<Region> findRegions(const cv::Mat& binary, int min_box_area, cv::Mat& labels);

/// Box of those pixels of a region that lie inside `part`; empty when there is none.
cv::Rect boxWithin(const cv::Mat& labels, const Region& region, const cv::Rect& part);

}  // namespace eyrie
