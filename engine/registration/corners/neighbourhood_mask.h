#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <opencv2/core/types.hpp>
#include <vector>

namespace eyrie {

/// Remembers which places of a picture are nearer than a distance to any of many points: to a third of that distance,
/// and no finer than half a pixel. Asking costs one look.
class NeighbourhoodMask {
 public:
    NeighbourhoodMask(cv::Size image, double distance)
        : per_px_(static_cast<float>(1 / std::max(finest(image), distance / 3))),
          across_(static_cast<int>(float(image.width) * per_px_) + 1),
          down_(static_cast<int>(float(image.height) * per_px_) + 1),
          marked_(std::size_t(across_) * std::size_t(down_), 0) {
        const double radius = distance * double(per_px_);
        reach_ = static_cast<int>(radius);
        for (int dy = -reach_; dy <= reach_; ++dy) {
            half_width_.push_back(static_cast<int>(std::sqrt(radius * radius - double(dy * dy))));
        }
    }

    void add(cv::Point2f point) {
        const int x = toColumn(point.x);
        const int y = toLine(point.y);
        for (int dy = std::max(-reach_, -y); dy <= std::min(reach_, down_ - 1 - y); ++dy) {
            const int half = half_width_[std::size_t(dy + reach_)];
            unsigned char* row = marked_.data() + std::ptrdiff_t(y + dy) * across_;
            for (int i = std::max(0, x - half); i <= std::min(across_ - 1, x + half); ++i) row[i] = 1;
        }
    }

    bool contains(cv::Point2f point) const {
        return marked_[std::size_t(toLine(point.y)) * std::size_t(across_) + std::size_t(toColumn(point.x))] != 0;
    }

 private:
    /// Half a pixel; a whole one where the mask would grow too large for the caches anyway.
    static double finest(cv::Size image) { return image.area() > 1'000'000 ? 1.0 : 0.5; }
    int toColumn(float x) const { return std::clamp(static_cast<int>(x * per_px_ + 0.5F), 0, across_ - 1); }
    int toLine(float y) const { return std::clamp(static_cast<int>(y * per_px_ + 0.5F), 0, down_ - 1); }

    float per_px_;
    int across_;
    int down_;
    int reach_ = 0;
    std::vector<int> half_width_;
    std::vector<unsigned char> marked_;
};

}  // namespace eyrie
