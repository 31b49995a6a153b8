#pragma once

#include <vector>

#include "core/parameter.h"
#include "core/values/motion_cluster.h"
#include "core/values/motion_vector.h"
#include "core/values/scene_scale.h"
#include "motion/clusters/clustering_trace.h"
#include "motion/clusters/single_linkage.h"

namespace eyrie {

/// Parameters of motion clustering (Teutsch §4.2).
struct MotionClusteringOptions {
    double along_m = 3.5;                ///< linkage distance along the motion
    double across_m = 1.0;               ///< linkage distance across the motion
    double roof_length_m = 6.0;          ///< … across a plain roof without corners; 0: off
    double min_distance = 4;             ///< px, lowest linkage distance: corners are at least 2 px apart at any scale
    double min_distance_far = 6;         ///< px, … where a view at an angle shows ground beyond its middle
    double velocity_share = 0.12;        ///< velocities may differ by this share of the speed …
    double velocity_floor = 0.03;        ///< … or by this, px/frame …
    double velocity_noise_factor = 1.0;  ///< … or by this many deviations of the background's speed …
    double velocity_noise_limit = 0.06;  ///< … which are not trusted beyond this, px/frame
    int min_members = 3;                 ///< a cluster has at least this many motion vectors
    double min_density_share = 0.33;     ///< … and this share of those expected on a car at the measured density
    int max_min_members = 12;            ///< however dense the corners are, that many are enough
    double margin = 0.5;                 ///< px by which the box around the members is grown on every side
    double split_width_m = 3.2;          ///< wider clusters are linked again, more tightly; 0: never
    double split_length_m = 0;           ///< longer clusters, too; 0: never
    double max_length_m = 60;            ///< longer clusters are no vehicles, nor a queue of them; 0: no limit
    double max_width_m = 30;             ///< 0: no limit

    /// The text to the letter, which names neither direction nor density nor count: one distance, a bare box.
    static MotionClusteringOptions thesis();
    void describe(ParameterVisitor& visitor);
};

/// Groups motion vectors that lie close and move alike. Stateless. Where the camera zooms, one of the scale of the
/// frame is needed: SceneScale::zoomed().
class MotionClustering {
 public:
    MotionClustering(const MotionClusteringOptions& options, const SceneScale& scale);

    /// Clusters in the order of their first member; members ascend. `trace`, if given, receives what decided.
    std::vector<MotionCluster> cluster(const FrameMotion& motion, ClusteringTrace* trace = nullptr) const;

    /// What decided about the motion vectors at these positions of the list. `trace` is of the same frame.
    ClusteringVerdict verdictOn(const std::vector<int>& here, const FrameMotion& motion,
                                const ClusteringTrace& trace) const;
    /// The gap from a group to the next motion vector outside.
    LinkageGap gapOutside(const FrameMotion& motion, const std::vector<int>& group) const;
    /// The gap inside a cluster that held it together last; across a plain roof, if more than a linkage distance.
    LinkageGap gapInside(const FrameMotion& motion, const std::vector<int>& group) const;

    /// The linkage used for a frame with this background noise (px/frame).
    Linkage linkageFor(double background_speed_sigma) const;
    /// Smallest cluster accepted at a place of a frame; without one, at the centre of the scale's slope.
    int minMembersFor(const FrameMotion& motion, cv::Point2d place) const;
    int minMembersFor(const FrameMotion& motion) const { return minMembersFor(motion, scale_.slope.centre()); }

 private:
    /// Part of a group that was split, or a whole group.
    struct Piece {
        std::vector<int> members;
        const char* split_by = "";
    };
    /// For every motion vector the number of its group, before groups are checked or split; numbered from 0 in the
    /// order of their first vector.
    std::vector<int> linked(const FrameMotion& motion) const;
    /// Why linked vectors are no cluster, but for their number.
    TracedGroup checkSize(const MotionCluster& cluster) const;
    /// Pieces of a group that is too large for one vehicle, by tighter and tighter linkage; the group itself when it
    /// does not fall into pieces that hold most of it.
    std::vector<Piece> split(const FrameMotion& motion, Piece group, Linkage linkage, std::size_t min_members,
                             int steps_left, ClusteringTrace* trace) const;

    MotionClusteringOptions options_;
    SceneScale scale_;
};

}  // namespace eyrie
