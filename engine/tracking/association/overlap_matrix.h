#pragma once

#include <limits>
#include <opencv2/core/types.hpp>
#include <vector>

#include "core/geometry/oriented_box.h"

namespace eyrie {

/// A predicted track or a detection, as far as their association needs it.
struct MovingBox {
    OrientedBox box;
    cv::Point2d velocity{0, 0};  ///< px/frame relative to the ground
    double gate_along = 0;       ///< tracks: reach of the distance gate along the heading, px; 0: no gate
    double gate_across = 0;      ///< the same across the heading
    double fastest = std::numeric_limits<double>::infinity();   ///< tracks: px/frame of a detection they may take
    double farthest = std::numeric_limits<double>::infinity();  ///< tracks: px from their centre to that of one
};

/// When a detection may belong to a track.
struct OverlapGate {
    double min_overlap = 0.2;   ///< T_tov
    double max_turn = 4;        ///< radians between the velocities; ≥ π: not tested
    double slow_speed = 0;      ///< px/frame below which a velocity tells no direction
    double max_size_ratio = 3;  ///< between areas, for the distance gate
    cv::Size image;             ///< overlaps are taken inside the image; empty: everywhere
};

/// How a detection and a track lie on each other.
struct BoxRelation {
    int detection = 0;
    int track = 0;
    double overlap = 0;          ///< |D ∩ T| / |D ∪ T|
    double detection_share = 0;  ///< |D ∩ T| / |D|
    double track_share = 0;      ///< |D ∩ T| / |T|
    bool accepted = false;       ///< the entry m_ij of the overlap matrix, or the distance gate
    double score = 0;            ///< orders accepted pairs: the overlap, or less than T_tov through the distance gate
};

/// The overlap matrix M_tov of detections and predicted tracks (Teutsch §6.2.1, eq. 6.1), sparse: only pairs that
/// touch or pass the distance gate, and move alike, are listed.
class OverlapMatrix {
 public:
    OverlapMatrix(const std::vector<MovingBox>& detections, const std::vector<MovingBox>& tracks,
                  const OverlapGate& gate);

    const std::vector<BoxRelation>& relations() const { return relations_; }
    /// Indices into `relations` of one detection (a column) or one track (a row), ascending.
    const std::vector<int>& ofDetection(int detection) const;
    const std::vector<int>& ofTrack(int track) const;
    int detectionCount() const { return static_cast<int>(by_detection_.size()); }
    int trackCount() const { return static_cast<int>(by_track_.size()); }

 private:
    std::vector<BoxRelation> relations_;
    std::vector<std::vector<int>> by_detection_;
    std::vector<std::vector<int>> by_track_;
};

}  // namespace eyrie
