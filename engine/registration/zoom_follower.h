#pragma once

#include <deque>
#include <opencv2/core/types.hpp>

#include "core/values/corner.h"
#include "core/values/scene_scale.h"

namespace eyrie {

/// How far the camera has zoomed since the first frame, by the homographies alone.
///
/// A zoom enlarges ground along the horizon and across it alike. Flying nearer to ground that is seen at an angle, or
/// turning the camera up and down, enlarges it by g along the horizon and by g² across, since it is also seen less at
/// an angle. So z = along² / across, whatever the angle. Seen from straight above, a climb counts as a zoom, as it
/// should. What small errors add up to over a long flight is no zoom: only what goes on for a while, or comes at once,
/// counts.
class ZoomFollower {
 public:
    /// The slope says where the horizon is; level without one. `before`: the zoom of the first frame that will come.
    explicit ZoomFollower(const SceneScale& scale, double before = 1);

    /// Takes the next frame. Pixels per metre as a multiple of those in the first frame.
    double next(const Registration& registration, cv::Size image);
    double zoom() const;
    void reset();

    /// What is remembered of the frames so far, written or read; see core/state_archive.h.
    template <class Archive>
    void transfer(Archive& archive);

 private:
    /// Logarithm of the zoom from the frame before; 0 where a homography makes no sense.
    double stepOf(const cv::Matx33d& homography, cv::Size image) const;
    /// Whether what is pending is a zoom.
    bool begins() const;
    double pendingSum() const;

    cv::Point2d level_;  ///< direction of the horizon, of length 1
    double frame_rate_hz_;
    std::size_t window_;  ///< pictures over which a zoom must go on
    double zoom_log_;     ///< logarithm of the zoom
    bool zooming_ = false;
    std::deque<double> pending_;  ///< the last steps; while not zooming they do not count yet
};

}  // namespace eyrie
