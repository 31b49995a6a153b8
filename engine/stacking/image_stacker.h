#pragma once

#include <map>
#include <optional>
#include <vector>

#include "core/parameter.h"
#include "core/values/detection.h"
#include "core/values/frame.h"
#include "core/values/motion_cluster.h"
#include "core/values/motion_roi.h"
#include "core/values/motion_vector.h"
#include "core/values/scene_scale.h"
#include "stacking/image_stack.h"
#include "stacking/master_vector.h"

namespace eyrie {

/// What new stacks are made from (Teutsch §5.3.1).
enum class StackInitialisation {
    detections,  ///< the detections of the frame before (the thesis' optimum)
    k_means      ///< k-means on the motion vectors of each cluster
};

/// Parameters of image stacking (Teutsch §5.3; optima of §7.3.4).
struct StackingOptions {
    bool enabled = false;
    StackInitialisation initialisation = StackInitialisation::detections;
    StackArrangement arrangement = StackArrangement::circular_median;
    int capacity = 50;                   ///< H
    int min_height = 25;                 ///< H_min
    double area_length_m = 119;          ///< 345 px at 0.345 m/px
    double area_width_m = 39.7;          ///< 115 px at 0.345 m/px
    int neighbours = 3;                  ///< k of the k-NN vote
    bool follow_lone_vectors = false;    ///< a stack's vectors carry it outside every cluster, too
    double max_speed_difference = 0.25;  ///< of the cluster's speed
    double max_turn_deg = 20;
    double vehicle_length_m = kCarLength_m;  ///< for k of k-means

    void describe(ParameterVisitor& visitor);
    static StackingOptions thesis();
};

/// How much of the stacks' pictures is made for looking at them. Whole areas of many stacks take a second and more
/// where the GSD is fine.
enum class StackPictures {
    none,          ///< pose, height and vectors only
    surroundings,  ///< the middle: 2.5 vehicle lengths along the motion, 1.25 across
    whole_area
};

/// A stack as it can be looked at.
struct StackView {
    int id = 0;
    MasterPose pose;
    int height = 0;
    bool searched = false;  ///< high enough to be searched in place of the raw image
    std::vector<CornerId> related;
    cv::Mat stacked;  ///< CV_8UC1 upright; empty without pictures
    cv::Mat raw;      ///< CV_8UC1 upright, the same part of the current frame; empty without pictures
};

/// Keeps one image stack per object and offers stacked images in place of the raw ones (Teutsch §5.3). Frames must come
/// in ascending order: update(t), replace(t), remember(detections of t).
class ImageStacker {
 public:
    ImageStacker(const StackingOptions& options, const SceneScale& scale);

    /// Moves the master vectors with their related vectors, adds the current areas as layers, relates new vectors,
    /// drops the dead and starts stacks (§5.3.1–5.3.3).
    void update(const Frame& frame, const FrameMotion& motion, const std::vector<MotionCluster>& found);

    /// The ROIs of suitable stacks for a cluster whose extended box is `extended` (§5.3.4); empty: use the raw image.
    std::vector<MotionRoi> replace(const MotionCluster& cluster, int cluster_index, const OrientedBox& extended,
                                   const FrameMotion& motion) const;

    /// Detections of this frame, from which stacks are started in the next.
    void remember(const FrameMotion& motion, const std::vector<Detection>& detections);

    std::vector<StackView> views(const Frame& frame, StackPictures pictures) const;
    void reset();

    /// What is remembered of the frames so far, written or read; see core/state_archive.h. To be read into one of the
    /// same options.
    template <class Archive>
    void transfer(Archive& archive);

 private:
    struct Entry {
        bool isSearched(const StackingOptions& options) const { return stack.height() >= options.min_height; }

        MasterVector master;
        ImageStack stack;

        template <class Archive>
        void transfer(Archive& archive);
    };
    /// A motion vector with the direction its cluster lends it; outside every cluster with its own.
    struct Placed {
        const MotionVector* vector = nullptr;
        double direction = 0;
        int cluster = -1;
    };
    std::vector<Placed> placeVectors(const FrameMotion& motion, const std::vector<MotionCluster>& clusters) const;
    void moveMasters(const std::vector<Placed>& placed);
    void relateNewVectors(const std::vector<Placed>& placed, const std::vector<MotionCluster>& clusters);
    void startFromDetections(const std::vector<Placed>& placed);
    void startFromClusters(const std::vector<Placed>& placed, const std::vector<MotionCluster>& clusters,
                           const SceneScale& scale);
    void start(const std::vector<const Placed*>& members);
    cv::Rect shownPart(StackPictures pictures) const;
    StackLayer layerOf(const Frame& frame, const MasterPose& pose) const;

    StackingOptions options_;
    SceneScale scale_;
    cv::Size area_;
    std::vector<Entry> entries_;
    std::map<CornerId, int> owner_;                  // motion vector → master vector
    std::vector<std::vector<CornerId>> remembered_;  // vectors of last frame's detections
    int next_id_ = 1;
};

}  // namespace eyrie
