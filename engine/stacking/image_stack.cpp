#include "stacking/image_stack.h"

#include <algorithm>
#include <opencv2/core.hpp>
#include <utility>

#include "core/error.h"
#include "stacking/stack_median.h"

namespace eyrie {

ImageStack::ImageStack(StackArrangement arrangement, cv::Size size, int capacity)
    : arrangement_(arrangement), size_(size), capacity_(std::clamp(capacity, 1, 4096)) {
    if (arrangement_ != StackArrangement::circular_median) sum_ = cv::Mat(size_, CV_32SC1, cv::Scalar(0));
}

cv::Mat ImageStack::add(cv::Mat layer) {
    if (layer.size() != size_ || layer.type() != CV_8UC1) {
        throw Error(ErrorKind::internal, "a stack layer has another size or type than its stack");
    }
    if (!sum_.empty()) cv::add(sum_, layer, sum_, {}, CV_32S);
    if (arrangement_ == StackArrangement::accumulation) {
        ++height_;
        return layer;
    }
    if (static_cast<int>(layers_.size()) < capacity_) {
        layers_.push_back(std::move(layer));
        layer.release();
    } else {
        std::swap(layer, layers_[static_cast<std::size_t>(next_)]);
        if (!sum_.empty()) cv::subtract(sum_, layer, sum_, {}, CV_32S);
    }
    next_ = (next_ + 1) % capacity_;
    height_ = static_cast<int>(layers_.size());
    return layer;
}

cv::Mat ImageStack::stacked(const cv::Rect& part) const {
    return arrangement_ == StackArrangement::circular_median ? median(part) : mean(part);
}

cv::Mat ImageStack::mean(const cv::Rect& part) const {
    cv::Mat result;
    sum_(part).convertTo(result, CV_8U, 1.0 / height_);
    return result;
}

cv::Mat ImageStack::median(const cv::Rect& part) const {
    cv::Mat result(part.size(), CV_8UC1);
    StackMedian selection;
    std::vector<const std::uint8_t*> rows(layers_.size());
    for (int y = 0; y < part.height; ++y) {
        for (std::size_t h = 0; h < layers_.size(); ++h) rows[h] = layers_[h].ptr(part.y + y) + part.x;
        selection.compute(rows, static_cast<std::size_t>(part.width), result.ptr(y));
    }
    return result;
}

}  // namespace eyrie
