#include "registration/pictures/image_pyramid.h"

#include <algorithm>

namespace eyrie {

void ImagePyramid::build(const cv::Mat& gray) {
    pictures_.resize(kMaxLevels);
    pictures_[0].copyFrom(gray);
    smoothe(pictures_[0], smooth_);
    levels_ = 1;
    while (levels_ < kMaxLevels) {
        const PaddedPicture& finer = pictures_[std::size_t(levels_) - 1];
        if (std::min(finer.width(), finer.height()) / 2 < kSmallestSide) break;
        halve(finer, pictures_[std::size_t(levels_)]);
        ++levels_;
    }
}

}  // namespace eyrie
