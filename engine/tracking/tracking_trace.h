#pragma once

#include <string>
#include <vector>

#include "core/geometry/oriented_box.h"
#include "core/values/ids.h"
#include "tracking/association/split_merge.h"

namespace eyrie {

/// One entry of the overlap matrix M_tov (Teutsch eq. 6.1): a detection and a predicted track that touch and move
/// alike.
struct TracedRelation {
    int detection = 0;  ///< position in the frame's list of detections
    TrackId track = 0;
    double overlap = 0;     ///< |D ∩ T| / |D ∪ T|
    bool accepted = false;  ///< m_ij: by overlap or by the distance gate
};

/// What a frame meant for one track.
struct TracedTrack {
    TrackId id = 0;
    OrientedBox predicted;
    double gate_px = 0;  ///< distance gate there, without the track's own uncertainty
    AssociationKind kind = AssociationKind::missed;
    std::vector<int> detections;  ///< positions in the frame's list
    std::string ended_by;         ///< the parameter that ended it in this frame; empty while it lives
    double ended_value = 0;       ///< compared with …
    double ended_limit = 0;
};

/// A detection that starts no track: it lies on one with evidence that moves alike.
struct TracedDouble {
    int detection = 0;      ///< position in the frame's list of detections
    std::string parameter;  ///< by which both are one object
};

/// How far a track that is still tentative after the frame is from being confirmed.
struct TracedTentative {
    TrackId id = 0;
    int hits = 0;    ///< detections within the last `frames`
    int frames = 0;  ///< `window`, or as many as the track has
    int needed = 0;  ///< detections within `window`
    int window = 0;
    int whole = 0;         ///< detections that a classifier took for a whole vehicle
    int whole_needed = 0;  ///< of them, which would do, too; 0: not asked

    bool reached() const { return hits >= needed || (whole_needed > 0 && whole >= whole_needed); }
};

/// How a frame's detections and tracks were joined, to be looked at.
struct TrackingTrace {
    std::vector<TracedTrack> tracks;  ///< those that lived before the frame, ascending id
    std::vector<TracedRelation> relations;
    std::vector<TracedDouble> doubled;
    std::vector<TracedTentative> tentative;        ///< ascending id
    std::vector<std::pair<int, TrackId>> started;  ///< detections that started tracks
    double min_overlap = 0;                        ///< T_tov
};

}  // namespace eyrie
