#pragma once

#include <opencv2/core/matx.hpp>
#include <vector>

#include "core/parameter.h"
#include "core/values/scene_scale.h"
#include "registration/corners/corner_set.h"
#include "registration/estimation/correspondences.h"
#include "registration/estimation/homography_estimator.h"
#include "registration/pictures/image_pyramid.h"

namespace eyrie {

/// How corners are followed and when they are given up.
struct TrackingOptions {
    double window_m = 0.6;
    double max_residual = 0.3;
    double max_speed_m_s = 60;
    double max_jerk = 0.5;
    int patch_life = 100;
    double patch_deformation = 0.08;
    bool leave_out_stuck = false;

    void describe(ParameterVisitor& visitor);
};

/// Where a corner went. Index by index with the corners it was asked for.
struct TrackedPosition {
    bool found = false;
    cv::Point2f position{0, 0};  ///< of the corner, px in the new picture
    cv::Point2f offset{0, 0};    ///< from the patch's centre, in the new picture
    float residual = 0;
    float contrast = 0;
    float position_variance = 0;
};

/// Kanade–Lucas–Tomasi tracking of many corners with small windows (Teutsch §4.2; Shi and Tomasi 1994): each starts
/// where the camera's motion, and its own motion so far, would take it, is aligned with the patch stored when it was
/// detected (turned and scaled with the picture), so that errors do not add up from frame to frame, and is tried again
/// at half and quarter resolution when it does not fit. Results do not depend on the number of threads.
class CornerTracker {
 public:
    CornerTracker(const TrackingOptions& options, const SceneScale& scale);

    /// Sets how far anything may move in a frame; the window stays as it is, since patches are of its size.
    void setFastest(const SceneScale& scale);

    /// Side of the window, px; odd.
    int window() const { return window_; }
    /// px that a new corner must keep from the border.
    int margin() const { return window_ / 2 + 4; }

    /// Adds corners seen in `picture`; the ids count up from `next_id`, which moves on.
    void add(CornerSet& set, const std::vector<cv::Point2f>& positions, const PaddedPicture& picture,
             CornerId& next_id) const;

    /// Looks for all corners of `set`, which belongs to `from`, in the picture `to`. `to_from` is the camera's motion,
    /// to about a pixel; `noise` in grey levels; `frames` lie between the two pictures (1: neighbours).
    std::vector<TrackedPosition> track(const CornerSet& set, const ImagePyramid& from, const ImagePyramid& to,
                                       const cv::Matx33d& to_from, double noise, int frames) const;

    /// The found corners as correspondences for the homography, index by index with the set. Weight 0: not found, or
    /// known to move by itself or to stick to the picture; noisy corners weigh less, and so do those in crowded parts
    /// of the picture.
    Correspondences correspondences(const CornerSet& set, const std::vector<TrackedPosition>& found, cv::Size image,
                                    double noise) const;

    /// Moves the set to the new picture: drops corners that were lost, jumped, left the picture or ran into an older
    /// one; renews patches that no longer fit. `fit` is the final homography.
    void advance(CornerSet& set, const std::vector<TrackedPosition>& found, const HomographyFit& fit,
                 const PaddedPicture& to, int frames, double merge_distance_px) const;

 private:
    TrackingOptions options_;
    int window_;
    double max_step_px_ = 0;  ///< farthest that anything moves over the ground in one frame
};

}  // namespace eyrie
