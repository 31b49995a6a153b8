#pragma once

#include <optional>
#include <vector>

#include "core/values/scene_scale.h"
#include "tracking/association/overlap_matrix.h"
#include "tracking/association/vector_association.h"
#include "tracking/tracker_options.h"

namespace eyrie {

/// What the detections of a frame mean for one track (Teutsch §6.2.1, fig. 6.2).
enum class AssociationKind {
    missed,   ///< no detection
    matched,  ///< one detection
    split,    ///< several detections are parts of it
    merged    ///< its detection covers other tracks, too
};

/// The detections of one track.
struct TrackAssociation {
    AssociationKind kind = AssociationKind::missed;
    int detection = -1;      ///< matched: its index
    std::vector<int> parts;  ///< split: the detections that are parts of the object; they are fused
    bool in_parts = false;   ///< several separate detections of fair size lie in the predicted box
    bool abreast = false;    ///< … side by side, as no vehicle falls apart
};

/// How far a track may claim detections.
struct TrackAuthority {
    bool confirmed = false;
    bool established = false;     ///< its size is known: it may own parts and be merged
    bool mergeable = false;       ///< seen often enough to be merged with an established one
    bool gives_up_parts = false;  ///< it was in parts for too long
};

/// The association of all detections and tracks of a frame.
struct FrameAssociation {
    std::vector<TrackAssociation> tracks;
    std::vector<char> used;  ///< for each detection: 1 when it must not start a track
};

/// Length and width, px, of a box that holds one vehicle at most; 0: unknown.
struct VehicleLimit {
    double length = 0;  ///< at the slope's centre
    double width = 0;   ///< there
    double margin = 0;  ///< px in both that do not depend on the scale
    ScaleSlope slope = {};
    /// The usual car of the options times `one_vehicle`, and what gradients widen a box by.
    static VehicleLimit of(const TrackerOptions& options, const SceneScale& scale);
    bool holds(const OrientedBox& box) const {
        if (slope.isFlat()) return box.length <= length && box.width <= width;
        const double factor = slope.factorAt(box.centre);
        return box.length <= (length - margin) * factor + margin && box.width <= (width - margin) * factor + margin;
    }
};

/// Recognises split, merged and missed detections and pairs the others one to one at the largest total overlap
/// (Teutsch §6.2.1, §6.3).
FrameAssociation associateDetections(const OverlapMatrix& matrix, const std::vector<MovingBox>& detections,
                                     const std::vector<MovingBox>& tracks, const std::vector<TrackAuthority>& authority,
                                     SplitMergeRule rule, double part_containment,
                                     const VehicleLimit& one_vehicle = {});

/// A box rebuilt from motion vectors.
struct Reconstruction {
    OrientedBox box;
    cv::Point2d velocity{0, 0};  ///< px/frame relative to the ground
    bool heading_known = false;  ///< the vectors were fast enough to tell it
    bool size_known = false;     ///< told by the vectors, not predicted
    int vectors = 0;             ///< how many agreed
};

/// The median of the boxes that a track's associated motion vectors suggest by their stored places (Teutsch §6.3, fig.
/// 6.5). `stored`: of centre, size and heading, each vector with its own heading; `predicted`: the size is kept, and
/// all places are turned by the median heading. `slow_speed`: px/frame below which a vector tells no heading. Nothing
/// when fewer than `min_vectors` of them are in the frame and agree, that is, put the centre within `agreement` of the
/// shorter side (or 1.5 px); 0: they need not agree.
std::optional<Reconstruction> reconstructBox(const std::vector<AssociatedVector>& vectors, const FrameVectors& frame,
                                             const OrientedBox& predicted, int min_vectors, double slow_speed,
                                             double agreement = 1.0 / 3, RebuiltSize size = RebuiltSize::predicted);

}  // namespace eyrie
