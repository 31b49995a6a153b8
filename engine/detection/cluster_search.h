#pragma once

#include <memory>
#include <vector>

#include "core/values/frame.h"
#include "core/values/motion_cluster.h"
#include "core/values/motion_vector.h"
#include "core/values/scene_scale.h"
#include "detection/detection_options.h"
#include "detection/detector.h"

namespace eyrie {

/// Searches the clusters of a frame with the detector in use: a cluster in the areas that stacks offer for it, without
/// any in the raw image. Remembers nothing.
class ClusterSearch {
 public:
    /// Throws Error where the parameters ask for a model file that cannot be read.
    ClusterSearch(const DetectionOptions& options, const SceneScale& scale);

    struct Found {
        std::vector<Detection> detections;  ///< in the order of the clusters
        std::vector<OrientedBox> rois;      ///< the search area of each cluster
    };
    /// All clusters, on all cores. `stacked`: what stacks offer for each; empty: nothing for any.
    Found search(const Frame& frame, const FrameMotion& motion, const std::vector<MotionCluster>& clusters,
                 std::vector<std::vector<MotionRoi>> stacked = {}) const;

    /// The areas in which one cluster is searched, `index` among the frame's.
    std::vector<MotionRoi> areasOf(const Frame& frame, const FrameMotion& motion, const MotionCluster& cluster,
                                   int index, std::vector<MotionRoi> stacked = {}) const;
    const Detector& detector() const { return *detector_; }

 private:
    DetectionOptions options_;
    SceneScale scale_;
    std::unique_ptr<Detector> detector_;
};

}  // namespace eyrie
