#pragma once

#include <opencv2/core/mat.hpp>

#include "core/geometry/oriented_box.h"
#include "core/parameter.h"
#include "core/values/scene_scale.h"

namespace eyrie {

/// Parameters of the shadow test.
struct ShadowTestOptions {
    bool shadow_test = true;
    double shadow_darkest = 0.3;        ///< share of the ground's brightness; darker is no cast shadow
    double shadow_brightest = 0.75;     ///< a shadow is darker than this share of the ground's brightness
    double shadow_bright_near = 1.2;    ///< anything brighter than this near the corner belongs to a vehicle
    double shadow_radius_m = 0.7;       ///< what counts as near
    double shadow_ground_m = 12;        ///< side of the window whose median is the ground's brightness
    double shadow_lit = 0.85;           ///< ground at least this bright between shadow and vehicle parts them
    double shadow_min_brightness = 60;  ///< grey values; on darker ground (night) the test is not used
    double shadow_reach_m = 2.5;  ///< a shadow ends at most this far from its vehicle; farther dark things are vehicles
    double shadow_owner_length_m = 2.2;  ///< vectors that own a shadow spread over at least this length …
    double shadow_owner_width_m = 0.9;   ///< … and width

    void describe(ParameterVisitor& visitor);
};

/// Tells corners on the outline of a moving shadow from those on vehicles: ground on one side, an even half-dark on the
/// other, nothing bright and nothing very dark near.
class ShadowTest {
 public:
    ShadowTest(const ShadowTestOptions& options, const SceneScale& scale);

    /// Measures the ground's brightness of a CV_8UC1 image, which must live until the last `isShadow`.
    void prepare(const cv::Mat& gray);
    /// Whether a corner (px) belongs to a shadow; false without an image.
    bool isShadow(cv::Point2f corner) const;
    /// Whether lit ground lies between a corner and a vehicle (px): a shadow on flat ground reaches to what casts it.
    bool litUpTo(const OrientedBox& vehicle, cv::Point2f corner) const;

 private:
    double groundAt(cv::Point2d place) const;

    ShadowTestOptions options_;
    int radius_;  ///< px
    int block_;   ///< px, side of a cell of `ground_`
    int window_;  ///< cells, odd
    cv::Mat gray_;
    cv::Mat ground_;  ///< CV_8UC1, median brightness by cell
};

}  // namespace eyrie
