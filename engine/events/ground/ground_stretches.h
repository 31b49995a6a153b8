#pragma once

#include <opencv2/core/matx.hpp>
#include <optional>
#include <vector>

#include "annotation/keyframes/camera_motion.h"
#include "core/geometry/oriented_box.h"
#include "core/values/ids.h"
#include "core/values/scene_scale.h"

namespace eyrie {

/// What was searched: which frames, how large, and how the camera moved over the ground meanwhile.
struct Footage {
    CameraMotion camera;
    cv::Size image_size;  ///< px
    FrameIndex first_frame = 0;
    FrameIndex last_frame = 0;  ///< included
    SceneScale scale;
};

/// Consecutive frames that share one ground: the plane of the reference frame, measured in metres by the scale.
struct GroundStretch {
    FrameIndex first_frame = 0;  ///< also the reference frame
    FrameIndex last_frame = 0;
    double metres_per_px = 1;   ///< of the reference frame
    bool begins_anew = true;    ///< nothing connects it with the frame before
    bool ends_for_good = true;  ///< nothing connects it with the frame after
};

/// Brings places of all frames to the ground. A new ground begins where a frame could not be registered, and where the
/// picture has become so unlike the reference frame (height, tilt, way flown) that its plane is no measure any more.
class GroundStretches {
 public:
    explicit GroundStretches(const Footage& footage);

    const std::vector<GroundStretch>& all() const { return stretches_; }
    /// The stretch of a frame; null where the frame was not searched.
    const GroundStretch* of(FrameIndex frame) const;
    int indexOf(FrameIndex frame) const;

    /// Metres on the ground of the frame's stretch, from px in the frame. Only for frames that were searched.
    cv::Point2d toGround(FrameIndex frame, cv::Point2d image) const;
    /// The box on the ground, m.
    OrientedBox toGround(FrameIndex frame, const OrientedBox& box) const;
    /// px in a frame of the stretch, from metres on its ground; nothing for what lies behind the camera.
    std::optional<cv::Point2d> toImage(FrameIndex frame, cv::Point2d ground) const;
    /// Metres on the ground for a pixel here; the ground knows the scale in the middle of the picture.
    double metresPerPixel(FrameIndex frame, cv::Point2d image) const;
    /// Metres by the scale at a place, of a metre on the ground: 1 unless the view is oblique.
    double metresByPlace(FrameIndex frame, cv::Point2d image) const;
    /// Metres by the scale at a place for a pixel there.
    double metresHere(FrameIndex frame, cv::Point2d image) const;
    bool inImage(cv::Point2d image) const;

    const Footage& footage() const { return footage_; }

 private:
    const cv::Matx33d& map(FrameIndex frame) const {
        return reference_from_image_[static_cast<std::size_t>(frame - footage_.first_frame)];
    }

    const Footage& footage_;
    std::vector<GroundStretch> stretches_;
    std::vector<int> stretch_of_;
    std::vector<cv::Matx33d> reference_from_image_;
};

}  // namespace eyrie
