#pragma once

#include <array>
#include <opencv2/core/matx.hpp>
#include <opencv2/core/types.hpp>
#include <vector>

#include "core/parameter.h"

namespace eyrie {

/// Parameters of the parallax test.
struct ParallaxTestOptions {
    bool parallax_test = true;
    double parallax_factor = 2.0;     ///< of the usual parallax, up to which a corner may be a standing one
    double parallax_agreement = 0.6;  ///< share of the strong residuals that must point along epipolar lines

    void describe(ParameterVisitor& visitor);
};

/// Tells standing things that rise above the ground from moving ones. What the ground's homography leaves of a standing
/// corner's motion points along the line to the epipole (plane and parallax), to the one side for what is higher and to
/// the other for what is lower than the plane. The epipole is found from the background's own residuals; where these
/// agree on none, because the ground is flat or the camera only turns, nothing is explained.
class ParallaxTest {
 public:
    explicit ParallaxTest(const ParallaxTestOptions& options) : options_(options) {}

    void clear();
    /// A background corner, px, and its velocity relative to the ground plane, px/frame.
    void add(cv::Point2d position, cv::Point2d velocity);
    /// To be called between the last `add` and the first `explains`. `sigma`: deviation of one component of a standing
    /// corner's velocity, px/frame. The same input gives the same result.
    void finish(double sigma);

    /// Whether the velocity may be parallax: along the epipolar line and no faster than usual for this scene.
    bool explains(cv::Point2d position, cv::Point2d velocity) const;
    bool active() const { return limits_[0] > 0 || limits_[1] > 0; }

 private:
    struct Residual {
        cv::Point2d position;
        cv::Point2d velocity;
    };
    /// Unit vector along the epipolar line through a position.
    static cv::Point2d direction(const cv::Vec3d& epipole, cv::Point2d position);
    bool onLine(const cv::Vec3d& epipole, const Residual& residual) const;
    double supportOf(const cv::Vec3d& epipole, const std::vector<Residual>& strong) const;
    cv::Vec3d refined(const cv::Vec3d& epipole, const std::vector<Residual>& strong) const;

    ParallaxTestOptions options_;
    std::vector<Residual> residuals_;
    cv::Vec3d epipole_{0, 0, 0};      ///< homogeneous, px
    std::array<double, 2> limits_{};  ///< px/frame towards and away from the epipole; 0: none explained
    double across_ = 0;               ///< px/frame, tolerance across the line
};

}  // namespace eyrie
