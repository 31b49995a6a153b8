#pragma once

#include <opencv2/core/mat.hpp>
#include <opencv2/core/matx.hpp>

#include "core/geometry/oriented_box.h"

namespace eyrie {

/// An oriented area of an image, turned so that its heading points up (−y). One patch pixel per image pixel.
struct UprightPatch {
    cv::Mat image;                 ///< CV_8UC1; beyond the image its border pixels are repeated
    cv::Mat inside;                ///< CV_8UC1: 255 where the pixel lies in the image, 0 in the padding
    cv::Matx23d image_from_patch;  ///< maps patch pixels to image pixels
};

/// Size in whole pixels of the patch for an area; at least 1×1, at most `kLargestPatchSide` a side.
cv::Size patchSize(const OrientedBox& area);
inline constexpr int kLargestPatchSide = 8192;

/// The map from the patch of `size` that is centred on `area` into the image.
cv::Matx23d imageFromPatch(const OrientedBox& area, cv::Size size);

/// Cuts `area` out of a CV_8UC1 image. Areas partly or wholly outside the image are allowed; `gray` must not be empty.
UprightPatch cutUpright(const cv::Mat& gray, const OrientedBox& area);

/// CV_8UC1 of size `patch`: 255 where a patch pixel lies in an image of size `image`, else 0.
cv::Mat insideMask(const cv::Matx23d& image_from_patch, cv::Size patch, cv::Size image);

/// Image point of a patch point and back; the map must be a turn and a shift, as made by `imageFromPatch`.
cv::Point2d toImage(const cv::Matx23d& image_from_patch, cv::Point2d in_patch);
cv::Point2d toPatch(const cv::Matx23d& image_from_patch, cv::Point2d in_image);

/// The oriented box in the image of an upright box in the patch, given by its edges (pixel 0 covers −0.5 … 0.5).
OrientedBox boxInImage(const cv::Matx23d& image_from_patch, const cv::Rect2d& in_patch);

}  // namespace eyrie
