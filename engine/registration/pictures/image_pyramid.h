#pragma once

#include <opencv2/core/types.hpp>
#include <vector>

#include "registration/pictures/padded_picture.h"

namespace eyrie {

/// A picture and its halves, level 0 the full size, down to about `kSmallestSide` pixels; and the full size smoothed,
/// in which corners are aligned: interpolation between unsmoothed pixels errs more than the corners' noise.
class ImagePyramid {
 public:
    static constexpr int kSmallestSide = 24;
    static constexpr int kMaxLevels = 7;

    /// `gray` is CV_8UC1.
    void build(const cv::Mat& gray);

    bool empty() const { return levels_ == 0; }
    int levels() const { return levels_; }
    const PaddedPicture& level(int index) const { return pictures_[std::size_t(index)]; }
    /// The full picture under the binomial mask [1 2 1] in both directions.
    const PaddedPicture& smooth() const { return smooth_; }
    cv::Size size() const { return empty() ? cv::Size() : cv::Size(level(0).width(), level(0).height()); }

    /// A point of the full picture in the coordinates of a level, and back.
    static cv::Point2f toLevel(cv::Point2f point, int level) {
        const float scale = 1.0F / float(1 << level);
        return {(point.x + 0.5F) * scale - 0.5F, (point.y + 0.5F) * scale - 0.5F};
    }
    static cv::Point2f fromLevel(cv::Point2f point, int level) {
        const auto scale = float(1 << level);
        return {(point.x + 0.5F) * scale - 0.5F, (point.y + 0.5F) * scale - 0.5F};
    }

 private:
    PaddedPicture smooth_;
    int levels_ = 0;
    std::vector<PaddedPicture> pictures_;
};

}  // namespace eyrie
