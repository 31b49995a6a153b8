#pragma once

#include <functional>
#include <opencv2/core/types.hpp>
#include <vector>

namespace eyrie {

/// Called for each row a polygon touches: the row, its first and one-past-last column, and per column the share of the
/// cell that the polygon covers.
using CoverageRow = std::function<void(int y, int x_begin, int x_end, const float* coverage)>;

/// Exact-to-a-quarter-row area coverage of a polygon (any shape, even-odd rule) on the grid whose cell (x, y) is the
/// unit square around (x, y), clipped to `bounds`.
void scanPolygon(const std::vector<cv::Point2d>& outline, cv::Rect bounds, const CoverageRow& row);

}  // namespace eyrie
