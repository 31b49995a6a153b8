#include "motion/vectors/local_background.h"

#include <algorithm>
#include <cmath>

#include "motion/vectors/upper_median.h"

namespace eyrie {

void LocalBackgroundOptions::describe(ParameterVisitor& visitor) {
    const ParameterDeclarer declare(visitor, ChainStage::motion);
    declare.flag("motion.local_background", local_background,
                 {"",
                  "Subtract the median residual velocity of the corners around. Helps against parallax, harms large "
                  "vehicles.",
                  ""});
    declare.real("motion.local_background_cell", local_background_cell_m, 1, 200,
                 {"m", "Side of the cells; at least 24 px.", ""});
    declare.integer("motion.local_background_min_corners", local_background_min_corners, 1, 1000,
                    {"", "Cells with fewer corners are not corrected.", ""});
}

LocalBackground::LocalBackground(const LocalBackgroundOptions& options, const SceneScale& scale)
    : options_(options), cell_(std::max(24.0, scale.px(options.local_background_cell_m))) {}

void LocalBackground::prepare(cv::Size image) {
    grid_ = {std::max(1, static_cast<int>(std::ceil(image.width / cell_))),
             std::max(1, static_cast<int>(std::ceil(image.height / cell_)))};
    cells_.assign(static_cast<std::size_t>(grid_.area()), {});
}

std::size_t LocalBackground::cellOf(cv::Point2f position) const {
    const int x = std::clamp(static_cast<int>(position.x / cell_), 0, grid_.width - 1);
    const int y = std::clamp(static_cast<int>(position.y / cell_), 0, grid_.height - 1);
    return static_cast<std::size_t>(y * grid_.width + x);
}

void LocalBackground::add(cv::Point2f position, cv::Point2d velocity) {
    Cell& cell = cells_[cellOf(position)];
    cell.x.push_back(static_cast<float>(velocity.x));
    cell.y.push_back(static_cast<float>(velocity.y));
}

void LocalBackground::finish() {
    for (Cell& cell : cells_) {
        if (static_cast<int>(cell.x.size()) < options_.local_background_min_corners) continue;
        cell.median = {upperMedianOf(cell.x), upperMedianOf(cell.y)};
    }
}

cv::Point2d LocalBackground::at(cv::Point2f position) const {
    return cells_.empty() ? cv::Point2d(0, 0) : cells_[cellOf(position)].median;
}

}  // namespace eyrie
