#include "stacking/image_stack.h"

#include <algorithm>
#include <opencv2/core.hpp>
#include <utility>

#include "core/error.h"
#include "stacking/stack_median.h"

namespace eyrie {
namespace {

cv::Mat meanOf(const cv::Mat& sum, int layers) {
    cv::Mat mean;
    sum.convertTo(mean, CV_8U, 1.0 / layers);
    return mean;
}

cv::Mat meanOf(const std::vector<cv::Mat>& tiles, const cv::Rect& part) {
    cv::Mat sum(part.size(), CV_32SC1, cv::Scalar(0));
    for (const auto& tile : tiles) cv::add(sum, tile(part), sum, {}, CV_32S);
    return meanOf(sum, static_cast<int>(tiles.size()));
}

cv::Mat medianOf(const std::vector<cv::Mat>& tiles, const cv::Rect& part, StackMedian& selection) {
    cv::Mat median(part.size(), CV_8UC1);
    std::vector<const std::uint8_t*> rows(tiles.size());
    for (int y = 0; y < part.height; ++y) {
        for (std::size_t h = 0; h < tiles.size(); ++h) rows[h] = tiles[h].ptr(part.y + y) + part.x;
        selection.compute(rows, static_cast<std::size_t>(part.width), median.ptr(y));
    }
    return median;
}

}  // namespace

ImageStack::ImageStack(StackArrangement arrangement, cv::Size size, int capacity)
    : arrangement_(arrangement), size_(size), capacity_(std::clamp(capacity, 1, 4096)) {
    if (arrangement_ == StackArrangement::accumulation) sum_ = cv::Mat(size_, CV_32SC1, cv::Scalar(0));
}

void ImageStack::add(StackLayer layer) {
    if (layer.size() != size_) throw Error(ErrorKind::internal, "a stack layer has another size than its stack");
    if (arrangement_ == StackArrangement::accumulation) {
        cv::add(sum_, layer.cut({{0, 0}, size_}), sum_, {}, CV_32S);
        ++height_;
        return;
    }
    if (static_cast<int>(layers_.size()) < capacity_) {
        layers_.push_back(std::move(layer));
    } else {
        layers_[static_cast<std::size_t>(next_)] = std::move(layer);
    }
    next_ = (next_ + 1) % capacity_;
    height_ = static_cast<int>(layers_.size());
}

cv::Mat ImageStack::stacked(const cv::Rect& part) const {
    return arrangement_ == StackArrangement::accumulation ? meanOf(sum_(part), height_) : mergeTiles(part);
}

std::vector<cv::Mat> ImageStack::tilesAt(cv::Point index) const {
    const std::scoped_lock lock(*cutting_);
    std::vector<cv::Mat> tiles;
    tiles.reserve(layers_.size());
    for (auto& layer : layers_) tiles.push_back(layer.tile(index));
    return tiles;
}

cv::Mat ImageStack::mergeTiles(const cv::Rect& part) const {
    cv::Mat result(part.size(), CV_8UC1);
    StackMedian selection;
    constexpr int side = StackLayer::kTileSide;
    for (int row = part.y / side; row * side < part.br().y; ++row) {
        for (int column = part.x / side; column * side < part.br().x; ++column) {
            const cv::Rect place = StackLayer::tileRect({column, row}, size_);
            const cv::Rect wanted = place & part;
            const std::vector<cv::Mat> tiles = tilesAt({column, row});
            const cv::Rect in_tile = wanted - place.tl();
            const cv::Mat merged = arrangement_ == StackArrangement::circular_mean
                                       ? meanOf(tiles, in_tile)
                                       : medianOf(tiles, in_tile, selection);
            merged.copyTo(result(wanted - part.tl()));
        }
    }
    return result;
}

}  // namespace eyrie
