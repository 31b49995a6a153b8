#pragma once

#include <opencv2/core/types.hpp>
#include <vector>

#include "core/parameter.h"
#include "core/values/scene_scale.h"

namespace eyrie {

/// Parameters of the local background correction.
struct LocalBackgroundOptions {
    bool local_background = false;
    double local_background_cell_m = 15;    ///< side of a cell
    int local_background_min_corners = 12;  ///< a cell with fewer is not corrected

    void describe(ParameterVisitor& visitor);
};

/// Residual velocity of the background by image cell: what one homography leaves over where the ground is not a plane
/// (parallax). Subtracting it keeps poles and kerbs from moving, at the risk of large vehicles that fill a cell.
class LocalBackground {
 public:
    LocalBackground(const LocalBackgroundOptions& options, const SceneScale& scale);

    void prepare(cv::Size image);
    void add(cv::Point2f position, cv::Point2d velocity);
    void finish();
    /// Median velocity of the cell, px/frame; 0 where too few corners are known.
    cv::Point2d at(cv::Point2f position) const;

 private:
    struct Cell {
        std::vector<float> x;
        std::vector<float> y;
        cv::Point2d median{0, 0};
    };
    std::size_t cellOf(cv::Point2f position) const;

    LocalBackgroundOptions options_;
    double cell_;  ///< px
    cv::Size grid_{0, 0};
    std::vector<Cell> cells_;
};

}  // namespace eyrie
