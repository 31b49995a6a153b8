#include "stacking/stack_layer.h"

#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>
#include <utility>

#include "core/error.h"
#include "imaging/upright_patch.h"

namespace eyrie {
namespace {

int tilesAlong(int side) {
    return (side + StackLayer::kTileSide - 1) / StackLayer::kTileSide;
}

}  // namespace

StackLayer::StackLayer(cv::Mat gray, const cv::Matx23d& image_from_stack, cv::Size area, FrameIndex frame)
    : gray_(std::move(gray)), image_from_stack_(image_from_stack), area_(area), frame_(frame) {
    if (gray_.type() != CV_8UC1) throw Error(ErrorKind::internal, "a stack layer's image is not of grey values");
    tiles_.resize(static_cast<std::size_t>(tilesAlong(area_.width)) *
                  static_cast<std::size_t>(tilesAlong(area_.height)));
}

StackLayer::StackLayer(const cv::Mat& pixels) : StackLayer(pixels, cv::Matx23d(), pixels.size()) {
    ready_ = true;
}

cv::Rect StackLayer::tileRect(cv::Point index, cv::Size area) {
    return cv::Rect(index * kTileSide, cv::Size(kTileSide, kTileSide)) & cv::Rect({0, 0}, area);
}

cv::Mat StackLayer::cut(const cv::Rect& part) const {
    if (ready_) return gray_(part);
    cv::Matx23d image_from_part = image_from_stack_;
    const cv::Point2d origin = toImage(image_from_stack_, part.tl());
    image_from_part(0, 2) = origin.x;
    image_from_part(1, 2) = origin.y;
    cv::Mat pixels;
    cv::warpAffine(gray_, pixels, image_from_part, part.size(), cv::INTER_LINEAR | cv::WARP_INVERSE_MAP,
                   cv::BORDER_CONSTANT, cv::Scalar(kOutsideGrey));
    return pixels;
}

const cv::Mat& StackLayer::tile(cv::Point index) {
    cv::Mat& tile = tiles_[static_cast<std::size_t>(index.y * tilesAlong(area_.width) + index.x)];
    if (tile.empty()) tile = cut(tileRect(index, area_));
    return tile;
}

}  // namespace eyrie
