#pragma once

#include <vector>

#include "core/geometry/homography.h"
#include "core/geometry/oriented_box.h"
#include "core/parameter.h"
#include "core/values/track_state.h"
#include "peer/sort/sort_filter.h"

namespace eyrie {

/// Parameters of SORT.
struct SortOptions {
    double min_overlap = 0.1;  ///< of a box with the prediction of its track
    int min_hits = 5;          ///< boxes in a row that confirm a track
    int max_age = 3;           ///< frames without a box after which a track ends

    /// In the group "peer".
    void describe(const ParameterDeclarer& declare);
};

/// SORT (Bewley et al. 2016, "Simple online and realtime tracking"): upright boxes, a Kalman filter of constant
/// velocity for each, association by the largest sum of overlaps, nothing else. Our one addition: predictions move with
/// the ground, without which it could follow nothing under a moving camera.
class SortTracker {
 public:
    explicit SortTracker(const SortOptions& options) : options_(options) {}

    /// The boxes of the next frame, and the way the camera went since the one before. Returns every living track by
    /// ascending id; those without a box are predicted. Boxes are taken as upright; empty ones are left out.
    std::vector<TrackState> next(const std::vector<OrientedBox>& boxes, const Homography& current_from_previous);
    /// Ends all tracks, as at a cut.
    void clear() { tracks_.clear(); }

 private:
    struct Track {
        TrackId id = 0;
        SortFilter filter;
        int age = 0;     ///< frames since the first box
        int hits = 0;    ///< boxes in all
        int in_row = 0;  ///< boxes since the last miss
        int missed = 0;  ///< frames since the last box
        bool confirmed = false;
    };
    /// For every box the track that it belongs to, −1: none.
    std::vector<int> associate(const std::vector<OrientedBox>& boxes) const;
    static TrackState stateOf(const Track& track);

    SortOptions options_;
    std::vector<Track> tracks_;  ///< by ascending id
    TrackId next_id_ = 1;
};

}  // namespace eyrie
