#pragma once

#include <opencv2/core/types.hpp>
#include <vector>

#include "core/parameter.h"
#include "core/values/picture_mask.h"
#include "core/values/scene_scale.h"
#include "registration/pictures/padded_picture.h"

namespace eyrie {

/// Where corners are looked for and how many are kept.
struct CornerOptions {
    double corner_spacing_m = 0.6;
    double min_corner_distance = 2;
    int max_corners = 12000;
    double corner_deviation = 0.5;
    double min_roundness = 0.05;
    int tensor_window = 3;
    bool favour_movers = true;  ///< the cap does not thin out corners near moving ones

    /// How many corners a picture may have: `max_corners` up to 1280×720, more by its area in a larger one, where as
    /// many would leave small vehicles without any, but twice as many at the most.
    int mostCorners(cv::Size image) const;
    void describe(ParameterVisitor& visitor);
};

/// What the detector has to respect.
struct CornerSurroundings {
    std::vector<cv::Point2f> living;  ///< corners that are tracked already; new ones keep their distance
    std::vector<cv::Point2f> movers;  ///< those of them that move by themselves: around them the cap on the number of
                                      ///< corners does not thin out, so that small vehicles keep their vectors
    double noise = 1;                 ///< grey levels, see noiseLevel
    int margin = 5;                   ///< px that corners keep to the border of the picture
    PictureMask graphics;             ///< no corner is wanted there
};

/// Förstner–Harris corners (Teutsch §4.2; Förstner and Gülch 1987): maxima of the Förstner strength det N / tr N of the
/// structure tensor whose roundness suffices, sub-pixel, spread over the picture by a grid. The strength a corner needs
/// follows from the noise of the picture, so that one setting serves bright day and dusk.
class CornerDetector {
 public:
    CornerDetector(const CornerOptions& options, const SceneScale& scale);

    /// New corners, in an order that does not depend on threads. Together with the living ones there are at most
    /// CornerOptions::mostCorners(). Places nothing in constant padding at the border of the picture.
    std::vector<cv::Point2f> detect(const PaddedPicture& picture, const CornerSurroundings& surroundings) const;

    /// Distance between corners, px.
    double spacing() const { return spacing_px_; }

 private:
    CornerOptions options_;
    double spacing_px_;
};

}  // namespace eyrie
