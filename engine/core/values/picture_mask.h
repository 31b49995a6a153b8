#pragma once

#include <algorithm>
#include <opencv2/core/mat.hpp>

namespace eyrie {

/// Marked places of a picture, in square cells. Copies share them.
struct PictureMask {
    cv::Mat cells;    ///< CV_8UC1, not 0 where marked; never written once shared; empty: nothing is marked
    int cell_px = 1;  ///< width of a cell; what the cells leave at the right and lower border belongs to the last ones

    bool empty() const { return cells.empty(); }
    /// Whether a place of the picture, px, is marked; what lies outside counts as the nearest place inside.
    bool marks(cv::Point2d place) const {
        if (cells.empty()) return false;
        const auto cellAt = [&](double px, int count) {
            return static_cast<int>(std::clamp((px + 0.5) / cell_px, 0.0, count - 1.0));
        };
        return cells.at<uchar>(cellAt(place.y, cells.rows), cellAt(place.x, cells.cols)) != 0;
    }
};

}  // namespace eyrie
