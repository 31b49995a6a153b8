#include "motion/single_linkage.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace eyrie {
namespace {

class UnionFind {
 public:
    explicit UnionFind(std::size_t count) : parents_(count) { std::iota(parents_.begin(), parents_.end(), 0); }

    int root(int i) {
        while (parent(i) != i) {
            parent(i) = parent(parent(i));
            i = parent(i);
        }
        return i;
    }
    void join(int a, int b) {
        a = root(a);
        b = root(b);
        // The smaller index stays root, so that numbering does not depend on the order of the pairs.
        if (a != b) parent(std::max(a, b)) = std::min(a, b);
    }

 private:
    int& parent(int i) { return parents_[static_cast<std::size_t>(i)]; }
    std::vector<int> parents_;
};

bool finite(const MotionVector& v) {
    return std::isfinite(v.position.x) && std::isfinite(v.position.y) && std::isfinite(v.velocity.x) &&
           std::isfinite(v.velocity.y);
}

/// Vectors sorted by the cell they lie in.
struct Grid {
    static constexpr int kMaxCells = 1 << 20;
    double cell = 1;
    float left = 0;
    float top = 0;
    int columns = 1;
    int rows = 1;
    std::vector<int> starts;  ///< first entry of a cell in `order`
    std::vector<int> order;
    std::vector<int> cell_of;  ///< −1: nowhere

    Grid(const std::vector<MotionVector>& vectors, double reach) {
        float right = 0;
        float bottom = 0;
        bool any = false;
        for (const MotionVector& v : vectors) {
            if (!finite(v)) continue;
            left = any ? std::min(left, v.position.x) : v.position.x;
            right = any ? std::max(right, v.position.x) : v.position.x;
            top = any ? std::min(top, v.position.y) : v.position.y;
            bottom = any ? std::max(bottom, v.position.y) : v.position.y;
            any = true;
        }
        cell = std::max(reach, 1e-3);
        const double width = static_cast<double>(right) - left;
        const double height = static_cast<double>(bottom) - top;
        while ((width / cell + 1) * (height / cell + 1) > kMaxCells) cell *= 2;
        columns = static_cast<int>(width / cell) + 1;
        rows = static_cast<int>(height / cell) + 1;

        starts.assign(static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows) + 1, 0);
        cell_of.assign(vectors.size(), -1);
        for (std::size_t i = 0; i < vectors.size(); ++i) {
            if (!finite(vectors[i])) continue;
            const int x = static_cast<int>((static_cast<double>(vectors[i].position.x) - left) / cell);
            const int y = static_cast<int>((static_cast<double>(vectors[i].position.y) - top) / cell);
            cell_of[i] = y * columns + x;
            ++starts[static_cast<std::size_t>(cell_of[i]) + 1];
        }
        std::partial_sum(starts.begin(), starts.end(), starts.begin());
        order.resize(static_cast<std::size_t>(starts.back()));
        std::vector<int> fill(starts.begin(), starts.end() - 1);
        for (std::size_t i = 0; i < vectors.size(); ++i) {
            if (cell_of[i] < 0) continue;
            order[static_cast<std::size_t>(fill[static_cast<std::size_t>(cell_of[i])]++)] = static_cast<int>(i);
        }
    }
};

}  // namespace

bool Linkage::joins(const MotionVector& a, const MotionVector& b) const {
    const double dx = static_cast<double>(b.position.x) - a.position.x;
    const double dy = static_cast<double>(b.position.y) - a.position.y;
    const double reach = std::max(along, across);
    if (dx * dx + dy * dy > reach * reach) return false;
    const double mx = (static_cast<double>(a.velocity.x) + b.velocity.x) / 2;
    const double my = (static_cast<double>(a.velocity.y) + b.velocity.y) / 2;
    const double vx = static_cast<double>(b.velocity.x) - a.velocity.x;
    const double vy = static_cast<double>(b.velocity.y) - a.velocity.y;
    const double speed = std::sqrt(mx * mx + my * my);
    const double allowed = std::max(velocity_floor, velocity_share * speed);
    if (vx * vx + vy * vy > allowed * allowed) return false;
    if (speed <= 0) return dx * dx + dy * dy <= std::min(along, across) * std::min(along, across);
    const double ahead = (dx * mx + dy * my) / (speed * along);
    const double aside = (dy * mx - dx * my) / (speed * across);
    return ahead * ahead + aside * aside <= 1;
}

std::vector<int> singleLinkage(const std::vector<MotionVector>& vectors, const Linkage& linkage) {
    UnionFind sets(vectors.size());
    const Grid grid(vectors, std::max(linkage.along, linkage.across));
    for (std::size_t i = 0; i < vectors.size(); ++i) {
        if (grid.cell_of[i] < 0) continue;
        const int column = grid.cell_of[i] % grid.columns;
        const int row = grid.cell_of[i] / grid.columns;
        for (int y = std::max(row - 1, 0); y <= std::min(row + 1, grid.rows - 1); ++y) {
            const int first = y * grid.columns + std::max(column - 1, 0);
            const int last = y * grid.columns + std::min(column + 1, grid.columns - 1);
            const int end = grid.starts[static_cast<std::size_t>(last) + 1];
            for (int k = grid.starts[static_cast<std::size_t>(first)]; k < end; ++k) {
                const int j = grid.order[static_cast<std::size_t>(k)];
                if (j <= static_cast<int>(i)) continue;
                if (linkage.joins(vectors[i], vectors[static_cast<std::size_t>(j)])) sets.join(static_cast<int>(i), j);
            }
        }
    }
    std::vector<int> numbers(vectors.size(), -1);
    int count = 0;
    for (std::size_t i = 0; i < vectors.size(); ++i) {
        const auto root = static_cast<std::size_t>(sets.root(static_cast<int>(i)));
        if (numbers[root] < 0) numbers[root] = count++;
        numbers[i] = numbers[root];
    }
    return numbers;
}

}  // namespace eyrie
