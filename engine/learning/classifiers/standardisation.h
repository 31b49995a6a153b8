#pragma once

#include <opencv2/core/mat.hpp>
#include <vector>

namespace eyrie {

/// What brings each feature to mean 0 and deviation 1: (value − mean) · scale.
struct Standardisation {
    std::vector<float> mean;
    std::vector<float> scale;  ///< 1 / deviation; 0 where a feature does not vary
};

/// Of feature vectors in rows.
Standardisation standardisationOf(const cv::Mat1f& features);

}  // namespace eyrie
