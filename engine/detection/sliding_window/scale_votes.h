#pragma once

#include <opencv2/core/mat.hpp>
#include <vector>

#include "core/geometry/oriented_box.h"
#include "detection/sliding_window/sliding_window_options.h"
#include "learning/models/window_scanner.h"

namespace eyrie {

/// At what scale something looks like a vehicle to the classifier.
struct ScaleVote {
    cv::Point2d place{0, 0};  ///< px, image
    double gsd_m_per_px = 0;  ///< at which it has the size of a usual car
    double decision = 0;      ///< of the window there
};

/// Scales between which is looked.
struct ScaleRange {
    double finest_m_per_px = 0.05;
    double coarsest_m_per_px = 0.5;
};

/// Looks at places of a picture at many scales. Immutable: may be used by several threads.
class ScaleLooker {
 public:
    /// Throws Error(input) when the model of the options is missing or damaged.
    explicit ScaleLooker(const SlidingWindowOptions& options);

    /// What moves within a box, whose heading is its motion's, in a CV_8UC1 picture. `vectors` are the places of its
    /// motion vectors: a window counts that is filled by those that it holds. Of windows on one place, whatever their
    /// scales, the surest stays.
    std::vector<ScaleVote> votesOn(const cv::Mat& gray, const OrientedBox& moving,
                                   const std::vector<cv::Point2f>& vectors, const ScaleRange& range) const;

 private:
    SlidingWindowOptions options_;
    WindowScanner scanner_;
};

}  // namespace eyrie
