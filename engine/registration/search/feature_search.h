#pragma once

#include <optional>

#include "core/values/picture_mask.h"
#include "registration/estimation/homography_estimator.h"
#include "registration/pictures/image_pyramid.h"

namespace eyrie {

/// The camera's motion between two pictures without any prediction, by features that look alike (AKAZE; Alcantarilla
/// et al. 2013), to a pixel or two: for jumps, low frame rates, fast flight near the ground. Takes a tenth of a second.
/// Empty when too few features agree for it to be more than chance. Features on `graphics`, drawn into both, are left
/// out.
std::optional<HomographyFit> searchFeatures(const ImagePyramid& from, const ImagePyramid& to,
                                            const HomographyEstimator& estimator, const PictureMask& graphics = {});

}  // namespace eyrie
