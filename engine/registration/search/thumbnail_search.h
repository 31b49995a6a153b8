#pragma once

#include <opencv2/core/matx.hpp>
#include <optional>

#include "core/values/picture_mask.h"
#include "registration/pictures/image_pyramid.h"

namespace eyrie {

/// The shift and turn between two pictures, found without any prediction by trying all of them on pictures of about
/// 48 px: up to 40 % of the picture and ±10°. To about half a thumbnail pixel. Empty when nothing correlates (a cut).
/// `graphics`, drawn into both, count for nothing.
std::optional<cv::Matx33d> searchThumbnails(const ImagePyramid& from, const ImagePyramid& to,
                                            const PictureMask& graphics = {});

}  // namespace eyrie
