#include "annotation/keyframes/dense_boxes.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace eyrie {
namespace {

using Corners = std::array<cv::Point2d, 4>;

double largestDistance(const Corners& a, const Corners& b) {
    std::array<double, 4> squares{};
    double largest = 0;
    for (std::size_t k = 0; k < a.size(); ++k) {
        const cv::Point2d apart = a[k] - b[k];
        squares[k] = apart.dot(apart);
        largest = std::max(largest, squares[k]);
    }
    // The distance to the last digit takes time, and clearly smaller ones do not matter.
    double distance = 0;
    for (std::size_t k = 0; k < a.size(); ++k) {
        if (squares[k] < largest * (1 - 1e-9)) continue;
        const cv::Point2d apart = a[k] - b[k];
        distance = std::max(distance, std::hypot(apart.x, apart.y));
    }
    return distance;
}

}  // namespace

void Deviations::set(std::size_t i, double value) {
    Block& block = blocks_[i / kBlock];
    if (value >= block.largest) {
        block.largest = value;
    } else if (values_[i] >= block.largest) {
        block.known = false;
    }
    values_[i] = value;
}

std::size_t Deviations::worstOf(std::size_t block) const {
    const auto first = values_.begin() + static_cast<std::ptrdiff_t>(block * kBlock);
    const auto last = values_.begin() + static_cast<std::ptrdiff_t>(std::min(values_.size(), (block + 1) * kBlock));
    return static_cast<std::size_t>(std::max_element(first, last) - values_.begin());
}

std::size_t Deviations::worst() {
    std::size_t worst = 0;
    for (std::size_t i = 0; i < blocks_.size(); ++i) {
        Block& block = blocks_[i];
        if (!block.known) block = {values_[worstOf(i)], true};
        if (block.largest > blocks_[worst].largest) worst = i;
    }
    return worstOf(worst);
}

DenseBoxes::DenseBoxes(const std::vector<FrameBox>& boxes, const ReductionOptions& options)
    : boxes_(boxes), options_(options) {
    corners_.reserve(boxes.size());
    for (const FrameBox& box : boxes) corners_.push_back(box.box.corners());
}

std::size_t DenseBoxes::from(FrameIndex frame) const {
    const auto place = std::lower_bound(boxes_.begin(), boxes_.end(), frame,
                                        [](const FrameBox& box, FrameIndex f) { return box.frame < f; });
    return static_cast<std::size_t>(place - boxes_.begin());
}

double DenseBoxes::deviation(std::size_t i, BoxReader& shown) const {
    const LabelledBox found = shown.at(boxes_[i].frame);
    if (!found.exists()) return std::numeric_limits<double>::max();
    double deviation = 0;
    if (options_.tolerance_px > 0) {
        deviation = largestDistance(found.box.corners(), corners_[i]) / options_.tolerance_px;
    }
    if (options_.min_overlap > 0) {
        const double missing = 1 - overlap(found.box, boxes_[i].box);
        deviation = std::max(deviation, missing / std::max(1e-9, 1 - options_.min_overlap));
    }
    return deviation;
}

}  // namespace eyrie
