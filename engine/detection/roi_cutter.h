#pragma once

#include "core/values/frame.h"
#include "core/values/motion_cluster.h"
#include "core/values/motion_roi.h"
#include "core/values/motion_vector.h"
#include "core/values/scene_scale.h"
#include "detection/detection_options.h"

namespace eyrie {

/// The search area of a cluster in the image: its box extended along and across the motion (Teutsch §5.4).
OrientedBox extendedCluster(const MotionCluster& cluster, cv::Size image, const DetectionOptions& options,
                            const SceneScale& scale);

/// Cuts the search area of a cluster out of the frame, turned so that the motion points up. `cluster_index` is its
/// position among the frame's clusters. Clusters at or beyond the image's edge are allowed: see MotionRoi::inside.
MotionRoi cutMotionRoi(const Frame& frame, const MotionCluster& cluster, int cluster_index, const FrameMotion& motion,
                       const DetectionOptions& options, const SceneScale& scale);

/// The middle of a search area, without `margin` px on every side.
MotionRoi narrowed(const MotionRoi& roi, int margin);

}  // namespace eyrie
