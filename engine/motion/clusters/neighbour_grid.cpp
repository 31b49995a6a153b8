#include "motion/clusters/neighbour_grid.h"

#include <cmath>
#include <limits>
#include <numeric>

namespace eyrie {
namespace {

constexpr int kMostCells = 1 << 20;

bool finite(cv::Point2f p) {
    return std::isfinite(p.x) && std::isfinite(p.y);
}

/// Cell of a coordinate; places far outside come out just outside.
int cellOf(double offset, double cell, int count) {
    return static_cast<int>(std::floor(std::clamp(offset / cell, -2.0, count + 1.0)));
}

}  // namespace

NeighbourGrid::NeighbourGrid(const std::vector<cv::Point2f>& points, double reach) {
    float right = std::numeric_limits<float>::lowest();
    float bottom = right;
    left_ = top_ = std::numeric_limits<float>::max();
    for (const cv::Point2f& p : points) {
        if (!finite(p)) continue;
        left_ = std::min(left_, p.x);
        right = std::max(right, p.x);
        top_ = std::min(top_, p.y);
        bottom = std::max(bottom, p.y);
    }
    const double width = right >= left_ ? static_cast<double>(right) - left_ : 0;
    const double height = right >= left_ ? static_cast<double>(bottom) - top_ : 0;
    cell_ = std::max(reach, 1e-3);
    while ((width / cell_ + 1) * (height / cell_ + 1) > kMostCells) cell_ *= 2;
    columns_ = static_cast<int>(width / cell_) + 1;
    rows_ = static_cast<int>(height / cell_) + 1;

    starts_.assign(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_) + 1, 0);
    std::vector<int> cells(points.size(), -1);
    for (std::size_t i = 0; i < points.size(); ++i) {
        if (!finite(points[i])) continue;
        cells[i] = rowOf(points[i].y) * columns_ + columnOf(points[i].x);
        ++starts_[static_cast<std::size_t>(cells[i]) + 1];
    }
    std::partial_sum(starts_.begin(), starts_.end(), starts_.begin());
    order_.resize(static_cast<std::size_t>(starts_.back()));
    std::vector<int> fill(starts_.begin(), starts_.end() - 1);
    for (std::size_t i = 0; i < points.size(); ++i) {
        if (cells[i] >= 0)
            order_[static_cast<std::size_t>(fill[static_cast<std::size_t>(cells[i])]++)] = static_cast<int>(i);
    }
}

int NeighbourGrid::columnOf(float x) const {
    return cellOf(static_cast<double>(x) - left_, cell_, columns_);
}

int NeighbourGrid::rowOf(float y) const {
    return cellOf(static_cast<double>(y) - top_, cell_, rows_);
}

}  // namespace eyrie
