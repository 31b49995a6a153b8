#include "motion/vectors/noise_map.h"

#include <algorithm>
#include <cmath>

#include "motion/vectors/upper_median.h"

namespace eyrie {
namespace {

constexpr double kLeast = 0.3;    ///< corners are measured no better than that, however plain the ground
constexpr double kClearly = 0.8;  ///< a share above may be chance
constexpr double kSmallestCell_px = 4;

}  // namespace

NoiseMap::NoiseMap(cv::Size image, double cell)
    : cell_(cell > 0 && image.width > 0 ? std::max(cell * image.width, kSmallestCell_px) : 0), grid_(0, 0) {
    if (cell_ <= 0) return;
    grid_ = {static_cast<int>(std::ceil(image.width / cell_)), static_cast<int>(std::ceil(image.height / cell_))};
    shares_.resize(static_cast<std::size_t>(grid_.area()));
    noise_.assign(shares_.size(), 1.0);
}

cv::Point NoiseMap::cellOf(cv::Point2f position) const {
    // Limited before it is whole: places may be far out, or no number.
    const auto inside = [this](float at, int cells) {
        return static_cast<int>(std::min(std::max(0.0, at / cell_), cells - 1.0));
    };
    return {inside(position.x, grid_.width), inside(position.y, grid_.height)};
}

void NoiseMap::add(cv::Point2f position, double share) {
    if (!shares_.empty()) shares_[index(cellOf(position))].push_back(static_cast<float>(share));
}

std::vector<float> NoiseMap::sharesAround(cv::Point cell) const {
    std::vector<float> shares;
    for (int y = std::max(0, cell.y - 1); y <= std::min(grid_.height - 1, cell.y + 1); ++y) {
        for (int x = std::max(0, cell.x - 1); x <= std::min(grid_.width - 1, cell.x + 1); ++x) {
            const std::vector<float>& here = shares_[index({x, y})];
            shares.insert(shares.end(), here.begin(), here.end());
        }
    }
    return shares;
}

void NoiseMap::finish() {
    for (int y = 0; y < grid_.height; ++y) {
        for (int x = 0; x < grid_.width; ++x) {
            std::vector<float> shares = sharesAround({x, y});
            if (shares.size() < kEnoughCorners) continue;
            const double share = upperMedianOf(shares);
            if (share <= kClearly) noise_[index({x, y})] = std::max(share, kLeast);
        }
    }
}

double NoiseMap::at(cv::Point2f position) const {
    return noise_.empty() ? 1.0 : noise_[index(cellOf(position))];
}

}  // namespace eyrie
