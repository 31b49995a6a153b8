#pragma once

#include <memory>
#include <mutex>
#include <opencv2/core/mat.hpp>
#include <vector>

#include "stacking/stack_layer.h"

namespace eyrie {

/// How the layers of a stack are kept (Teutsch §5.3.3).
enum class StackArrangement {
    accumulation,    ///< a running sum: all layers ever, mean only
    circular_mean,   ///< the last H layers, pixelwise mean
    circular_median  ///< the last H layers, pixelwise median (the thesis' optimum)
};

/// Aligned upright views of one object (Teutsch §5.3). All layers are of the same size.
class ImageStack {
 public:
    /// `capacity`: H, layers kept by the circular arrangements, 1 … 4096.
    ImageStack(StackArrangement arrangement, cv::Size size, int capacity);

    void add(StackLayer layer);
    void add(const cv::Mat& pixels) { add(StackLayer(pixels)); }
    /// Layers that count at present.
    int height() const { return height_; }
    cv::Size size() const { return size_; }
    /// The stacked image (eq. 5.1 or 5.2) within `part` of the stack area, CV_8UC1; `part` must lie inside it,
    /// height() > 0. May be called from several threads at once, but not during `add`.
    cv::Mat stacked(const cv::Rect& part) const;
    cv::Mat stacked() const { return stacked({{0, 0}, size_}); }

    /// What is remembered of the frames so far, written or read; see core/state_archive.h. To be read into one of the
    /// same options.
    template <class Archive>
    void transfer(Archive& archive);

 private:
    std::vector<cv::Mat> tilesAt(cv::Point index) const;
    cv::Mat mergeTiles(const cv::Rect& part) const;

    StackArrangement arrangement_;
    cv::Size size_;
    int capacity_;
    int height_ = 0;
    int next_ = 0;
    cv::Mat sum_;                             // CV_32SC1, accumulation only
    mutable std::vector<StackLayer> layers_;  // circular arrangements; cut tiles as they are asked for
    std::unique_ptr<std::mutex> cutting_ = std::make_unique<std::mutex>();
};

}  // namespace eyrie
