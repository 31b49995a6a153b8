#pragma once

#include <opencv2/core/mat.hpp>
#include <vector>

namespace eyrie {

/// How the layers of a stack are kept (Teutsch §5.3.3).
enum class StackArrangement {
    accumulation,    ///< a running sum: all layers ever, mean only
    circular_mean,   ///< the last H layers, pixelwise mean
    circular_median  ///< the last H layers, pixelwise median (the thesis' optimum)
};

/// Grey value of pixels outside the video image: the middle of the range (Teutsch §5.3.3).
inline constexpr int kOutsideGrey = 127;

/// Aligned upright views of one object (Teutsch §5.3). All layers are CV_8UC1 of the same size.
class ImageStack {
 public:
    /// `capacity`: H, layers kept by the circular arrangements, 1 … 4096.
    ImageStack(StackArrangement arrangement, cv::Size size, int capacity);

    /// Adds a layer, whose memory the stack keeps. Returns the one that it replaces in a full circular buffer, so that
    /// its memory can be used again.
    cv::Mat add(cv::Mat layer);
    /// Layers that count at present.
    int height() const { return height_; }
    cv::Size size() const { return size_; }
    /// The stacked image (eq. 5.1 or 5.2) within `part` of the stack area; `part` must lie inside it, height() > 0.
    cv::Mat stacked(const cv::Rect& part) const;
    cv::Mat stacked() const { return stacked({{0, 0}, size_}); }

 private:
    cv::Mat mean(const cv::Rect& part) const;
    cv::Mat median(const cv::Rect& part) const;

    StackArrangement arrangement_;
    cv::Size size_;
    int capacity_;
    int height_ = 0;
    int next_ = 0;
    cv::Mat sum_;                  // CV_32SC1, accumulation and circular_mean
    std::vector<cv::Mat> layers_;  // circular arrangements
};

}  // namespace eyrie
