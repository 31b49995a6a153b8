#pragma once

#include <map>
#include <vector>

#include "tracking/finishing/track_finishing.h"

namespace eyrie {

/// What the classifier said of the detected states of a track.
struct TrackLooks {
    int alike = 0;            ///< states in which it took it for a whole vehicle
    int looked_at = 0;        ///< states of whose detection the decision is known
    double decision_sum = 0;  ///< of those, each held to the limits of TrackEvidence::decision

    /// Adds a detected state of this box; `classified` is what is known of its frame.
    void add(const OrientedBox& box, const std::vector<ClassifiedBox>& classified);
    /// Mean; NaN where nobody looked.
    double decision() const;
};

/// Tracks may be missing of which the classifier says nothing.
using VehicleLooks = std::map<TrackId, TrackLooks>;

/// Asks for each frame once.
VehicleLooks looksOf(const std::vector<TrackPath>& paths, const ClassifiedAt& classified_at);

}  // namespace eyrie
