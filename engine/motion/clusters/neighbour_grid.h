#pragma once

#include <algorithm>
#include <opencv2/core/types.hpp>
#include <vector>

namespace eyrie {

/// Points sorted into square cells, so that the neighbours of a place are found without looking at all of them. Points
/// that are not finite are nobody's neighbours.
class NeighbourGrid {
 public:
    /// `reach`: side of a cell and farthest neighbour, px; > 0.
    NeighbourGrid(const std::vector<cv::Point2f>& points, double reach);

    /// Calls `visit(index)` for every point within the reach of a finite place, and for some that lie farther away.
    template <typename Visit>
    void around(cv::Point2f place, Visit&& visit) const {
        const int column = columnOf(place.x);
        const int row = rowOf(place.y);
        for (int y = std::max(row - 1, 0); y <= std::min(row + 1, rows_ - 1); ++y) {
            const int first = y * columns_ + std::clamp(column - 1, 0, columns_ - 1);
            const int last = y * columns_ + std::clamp(column + 1, 0, columns_ - 1);
            const int end = starts_[static_cast<std::size_t>(last) + 1];
            for (int k = starts_[static_cast<std::size_t>(first)]; k < end; ++k)
                visit(static_cast<std::size_t>(order_[static_cast<std::size_t>(k)]));
        }
    }

 private:
    int columnOf(float x) const;
    int rowOf(float y) const;

    double cell_ = 1;
    float left_ = 0;
    float top_ = 0;
    int columns_ = 1;
    int rows_ = 1;
    std::vector<int> starts_;  ///< first entry of a cell in `order_`
    std::vector<int> order_;
};

}  // namespace eyrie
