#pragma once

#include <opencv2/core/mat.hpp>
#include <opencv2/core/matx.hpp>
#include <vector>

#include "core/values/ids.h"

namespace eyrie {

/// Grey value of pixels outside the video image: the middle of the range (Teutsch §5.3.3).
inline constexpr int kOutsideGrey = 127;

/// One layer of an image stack: the upright view of one object in one frame (Teutsch §5.3). The stack area is many
/// times larger than what searches look at, so pixels are cut out of the frame in tiles when they are first asked for.
/// What a tile holds does not depend on when it was asked for.
class StackLayer {
 public:
    /// Side of a tile, px; tiles of the last column and row may be smaller.
    static constexpr int kTileSide = 64;

    /// `gray`: CV_8UC1 frame, shared, never written from now on. `image_from_stack` maps pixels of the stack area to
    /// image pixels.
    /// `frame`: whose picture it is, for layers that are kept in a state.
    StackLayer(cv::Mat gray, const cv::Matx23d& image_from_stack, cv::Size area, FrameIndex frame = 0);
    /// Of ready pixels, CV_8UC1.
    explicit StackLayer(const cv::Mat& pixels);

    cv::Size size() const { return area_; }
    /// CV_8UC1 pixels of one tile, kept from now on; its place is `tileRect`.
    const cv::Mat& tile(cv::Point index);
    /// CV_8UC1 pixels of any part of the area, not kept. May differ from tiles by a rounding step of 1/32 px.
    cv::Mat cut(const cv::Rect& part) const;

    /// Where tile `index` (column, row) lies in a stack area.
    static cv::Rect tileRect(cv::Point index, cv::Size area);

    /// What is remembered of the picture, written or read; see core/state_archive.h. To be read into one of the
    /// same area.
    template <class Archive>
    void transfer(Archive& archive);

 private:
    cv::Mat gray_;
    cv::Matx23d image_from_stack_;
    cv::Size area_;
    FrameIndex frame_;
    bool ready_ = false;          ///< `gray_` is the layer itself
    std::vector<cv::Mat> tiles_;  ///< row by row; empty: not cut so far
};

}  // namespace eyrie
