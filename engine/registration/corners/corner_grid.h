#pragma once

#include <algorithm>
#include <opencv2/core/types.hpp>
#include <vector>

namespace eyrie {

/// Points sorted into square cells, to ask for neighbours. Points outside the picture belong to the nearest cell.
class CornerGrid {
 public:
    CornerGrid(cv::Size image, float cell_px, const std::vector<cv::Point2f>& points)
        : cell_px_(cell_px),
          across_(static_cast<int>(float(image.width) / cell_px) + 1),
          down_(static_cast<int>(float(image.height) / cell_px) + 1),
          head_(std::size_t(across_) * std::size_t(down_), -1),
          next_(points.size(), -1),
          points_(points) {
        for (int i = static_cast<int>(points.size()) - 1; i >= 0; --i) {
            int& head = head_[std::size_t(cellOf(points[std::size_t(i)]))];
            next_[std::size_t(i)] = head;
            head = i;
        }
    }

    int cells() const { return across_ * down_; }
    int cellOf(cv::Point2f p) const {
        const int x = std::clamp(static_cast<int>(p.x / cell_px_), 0, across_ - 1);
        const int y = std::clamp(static_cast<int>(p.y / cell_px_), 0, down_ - 1);
        return y * across_ + x;
    }

    /// Calls `visit(cell)` for the cell and its up to eight neighbours.
    template <class Visit>
    void forNeighbours(int cell, Visit visit) const {
        const int x = cell % across_;
        const int y = cell / across_;
        for (int ny = std::max(0, y - 1); ny <= std::min(down_ - 1, y + 1); ++ny) {
            for (int nx = std::max(0, x - 1); nx <= std::min(across_ - 1, x + 1); ++nx) visit(ny * across_ + nx);
        }
    }

    /// Calls `visit(index)` for the points of a cell in ascending order.
    template <class Visit>
    void forPointsIn(int cell, Visit visit) const {
        for (int i = head_[std::size_t(cell)]; i >= 0; i = next_[std::size_t(i)]) visit(i);
    }

    /// Whether the point's cell or a neighbour of it holds a point.
    bool anyInOrAround(cv::Point2f p) const {
        bool any = false;
        forNeighbours(cellOf(p), [&](int cell) { any = any || head_[std::size_t(cell)] >= 0; });
        return any;
    }

    /// The nearest point in the cell of `p` or its neighbours; −1 when there is none.
    int nearest(cv::Point2f p) const {
        int best = -1;
        float best_square = 0;
        forNeighbours(cellOf(p), [&](int cell) {
            forPointsIn(cell, [&](int i) {
                const cv::Point2f d = points_[std::size_t(i)] - p;
                const float square = d.x * d.x + d.y * d.y;
                if (best >= 0 && square >= best_square) return;
                best = i;
                best_square = square;
            });
        });
        return best;
    }

 private:
    float cell_px_;
    int across_;
    int down_;
    std::vector<int> head_;
    std::vector<int> next_;
    std::vector<cv::Point2f> points_;
};

}  // namespace eyrie
