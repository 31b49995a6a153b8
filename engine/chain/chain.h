#pragma once

#include <memory>
#include <opencv2/core/types.hpp>
#include <optional>
#include <vector>

#include "chain/chain_options.h"
#include "core/values/frame.h"
#include "core/values/frame_result.h"
#include "detection/cluster_search.h"
#include "detection/sliding_window/box_classifier.h"
#include "motion/differences/difference_motion.h"
#include "tracking/live_scores.h"

namespace eyrie {

/// Removal of duplicates as it suits the detector in use: boxes of a classifier are complete, so that of two the surer
/// one stays; segments may be parts (Teutsch §5.5.1).
DuplicateRemovalOptions duplicatesFor(const ChainOptions& options);

/// The detections of a frame after duplicates and outliers were rejected (Teutsch §5.5), with their probability where a
/// classifier takes part. `scale`: that of the run's first frame. `trace`, if given, receives which duplicates of what
/// were found.
std::vector<Detection> removed(std::vector<Detection> detections, const FrameMotion& motion,
                               const ChainOptions& options, const SceneScale& scale, RemovalTrace* trace = nullptr);

/// First half of the chain, pixels → motion vectors (Teutsch chapter 4). Frames must come in ascending order.
class MotionHalf {
 public:
    /// `scale`: of the run's first frame; `zoom_before`: Registration::zoom of the first frame that will come.
    MotionHalf(const ChainOptions& options, const SceneScale& scale, double zoom_before = 1);
    FrameMotion next(const Frame& frame, StageTimes& times);

    /// What is remembered of the frames so far, written or read; see core/state_archive.h. To be read into one of the
    /// same options and scale.
    template <class Archive>
    void transfer(Archive& archive);

 private:
    Registrar registrar_;
    IndependentMotion independent_motion_;
};

/// One area that a detector searched, with all steps on the way to its boxes.
struct SearchTrace {
    MotionRoi roi;  ///< what was searched: the raw image, or an image stack
    MotionRoi raw;  ///< the same cluster's area of the raw image
    DetectionTrace trace;
    std::vector<Detection> detections;  ///< before duplicates and outliers are removed
};

/// Second half of the chain, motion vectors → tracks (Teutsch chapters 5 and 6). Frames must come in ascending order.
class TrackHalf {
 public:
    /// `scale`: of the run's first frame.
    TrackHalf(const ChainOptions& options, const SceneScale& scale);
    /// `frame` gives the pixels that belong to `motion`.
    FrameResult next(const Frame& frame, FrameMotion motion, StageTimes times);
    /// Takes a frame in which nothing is to be found, for the difference images of later ones. Not for stacks.
    void remember(const Frame& frame, const FrameMotion& motion);

    /// All image stacks as they are after the last frame, which `frame` is; none where stacking is off.
    std::vector<StackView> stackViews(const Frame& frame, StackPictures pictures) const;
    /// What the difference images of the last frame showed; null where clusters come from motion vectors.
    const DifferenceResult* differences() const { return difference_ ? &last_difference_ : nullptr; }
    /// Looks once more at what clustering did with these motion vectors; empty where clusters come from difference
    /// images.
    ClusteringTrace clustering(const FrameMotion& motion) const;
    /// What duplicate removal did in the last frame.
    const RemovalTrace& removal() const { return removal_; }
    /// Looks once more at what was searched for one cluster of the last frame; several where several stacks fit it.
    std::vector<SearchTrace> trace(const Frame& frame, const FrameMotion& motion, const MotionCluster& cluster,
                                   int index) const;

    /// What is remembered of the frames so far, written or read; see core/state_archive.h. To be read into one of the
    /// same options and scale.
    template <class Archive>
    void transfer(Archive& archive);

 private:
    /// Clustering at the scale of a frame.
    MotionClustering clusteringIn(const FrameMotion& motion) const;
    std::vector<MotionCluster> findClusters(const Frame& frame, const FrameMotion& motion);
    /// What stacks offer for a cluster; nothing: it is searched in the raw image.
    std::vector<MotionRoi> stackedAreas(const Frame& frame, const FrameMotion& motion, const MotionCluster& cluster,
                                        int index) const;
    /// The same of every cluster.
    std::vector<std::vector<MotionRoi>> stackedAreas(const Frame& frame, const FrameMotion& motion,
                                                     const std::vector<MotionCluster>& clusters) const;

    ChainOptions options_;
    SceneScale scale_;
    std::unique_ptr<DifferenceMotion> difference_;  ///< null: clusters come from motion vectors
    DifferenceResult last_difference_;
    std::unique_ptr<ImageStacker> stacker_;  ///< null: no stacking
    ClusterSearch search_;
    Tracker tracker_;
    std::optional<BoxClassifier> classifier_;  ///< nothing: no classifier takes part
    std::optional<LiveScores> scores_;         ///< likewise
    RemovalTrace removal_;
};

/// The whole chain, one frame after the other, in the thesis' order.
class Chain {
 public:
    Chain(const ChainOptions& options, const SceneScale& scale)
        : motion_half_(options, scale), track_half_(options, scale) {}
    FrameResult next(const Frame& frame);

 private:
    MotionHalf motion_half_;
    TrackHalf track_half_;
};

}  // namespace eyrie
