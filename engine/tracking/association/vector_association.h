#pragma once

#include <opencv2/core/types.hpp>
#include <vector>

#include "core/geometry/oriented_box.h"
#include "core/values/motion_vector.h"

namespace eyrie {

/// A motion vector that belongs to a track, where it sits in the track's box, and that box's size (Teutsch §6.2.2,
/// §6.3).
struct AssociatedVector {
    CornerId id = 0;
    cv::Point2d in_box{0, 0};   ///< px in the axes of the track's box
    double heading_offset = 0;  ///< radians from the vector's direction to the box's heading; 0 when it was slow
    int index = -1;             ///< into the motion vectors of the current frame
    double length = 0;          ///< px: of the track's box
    double width = 0;           ///< px
};

/// The motion vectors of one frame, to be looked up by id and by place. Refers to the vectors; they must outlive it.
class FrameVectors {
 public:
    explicit FrameVectors(const std::vector<MotionVector>& vectors);

    /// Index of a corner's motion vector, −1 when it has none in this frame.
    int find(CornerId id) const;
    /// Indices of the vectors inside a box, ascending.
    std::vector<int> inside(const OrientedBox& box) const;
    const MotionVector& at(int index) const { return (*vectors_)[static_cast<std::size_t>(index)]; }
    int count() const { return static_cast<int>(vectors_->size()); }

 private:
    const std::vector<MotionVector>* vectors_;
    std::vector<int> by_x_;  ///< indices of the finite vectors in ascending x
};

/// When a motion vector moves and lies like a track.
struct VectorLimits {
    int max_vectors = 20;
    double speed_difference = 0.25;  ///< share of the track's speed
    double speed_floor = 0.1;        ///< px/frame
    double slow_speed = 0.1;         ///< px/frame below which a velocity tells no direction
    double margin = 0.25;            ///< share of the box's sides by which a vector may leave it before it is dropped
    double relative_position_gain = 0.3;

    bool similar(cv::Point2d vector, cv::Point2d track) const;
};

/// A track that motion vectors are associated to.
struct VectorClaim {
    OrientedBox box;
    cv::Point2d velocity{0, 0};                        ///< px/frame relative to the ground
    bool may_gain = true;                              ///< takes new vectors
    bool learns = true;                                ///< the box is trusted: stored places follow it
    std::vector<AssociatedVector>* vectors = nullptr;  ///< changed
};

/// Removes the vectors that are not in this frame and fills in the indices of the others.
void keepSeenVectors(std::vector<AssociatedVector>& vectors, const FrameVectors& frame);

/// Lets the stored places, directions and sizes follow the track's box by `gain`; 1: replaces them. The indices must be
/// those of the frame.
void storePlaces(std::vector<AssociatedVector>& vectors, const OrientedBox& box, const FrameVectors& frame, double gain,
                 double slow_speed);

/// Drops outliers, associates further vectors by the four criteria of Teutsch §6.2.2 (free, inside this box, inside no
/// other, similar motion) and updates the stored places. The indices must be those of the frame.
void associateVectors(const std::vector<VectorClaim>& claims, const FrameVectors& frame, const VectorLimits& limits);

}  // namespace eyrie
