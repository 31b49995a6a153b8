#pragma once

#include <opencv2/core/matx.hpp>
#include <optional>
#include <vector>

#include "core/values/picture_mask.h"
#include "registration/corners/corner_set.h"
#include "registration/estimation/homography_estimator.h"
#include "registration/pictures/image_pyramid.h"

namespace eyrie {

/// The camera's motion between two pictures to a fraction of a pixel, from a few hundred corners spread over the
/// picture: tracked on a pyramid from a prediction; where that fails, from coarser levels, then from an exhaustive
/// search on thumbnails, and at last, if wanted, from features that look alike. Copes with shake of tens of pixels,
/// turns of several degrees and dropped frames.
class CoarseRegistration {
 public:
    /// `graphics`: where something is drawn into both pictures, which does not tell the camera's motion.
    explicit CoarseRegistration(const HomographyEstimator& estimator, bool feature_search = true,
                                const PictureMask& graphics = {})
        : estimator_(estimator), feature_search_(feature_search), graphics_(graphics) {}

    /// `predictions` are tried in turn. Empty when the pictures do not fit together.
    std::optional<HomographyFit> find(const CornerSet& corners, const ImagePyramid& from, const ImagePyramid& to,
                                      const std::vector<cv::Matx33d>& predictions, double noise) const;

 private:
    const HomographyEstimator& estimator_;
    bool feature_search_;
    PictureMask graphics_;
};

}  // namespace eyrie
