#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/values/detection.h"

namespace eyrie {

/// Two detections that became one, to be looked at.
struct RemovedDuplicate {
    int removed = 0;  ///< positions in the list of detections, which never changes its order
    int kept = 0;
    double value = 0;       ///< what was compared: the overlap, or the length of both together, px
    double limit = 0;       ///< with what
    std::string parameter;  ///< that says the limit
};

/// What duplicate removal did in a frame.
struct RemovalTrace {
    std::vector<RemovedDuplicate> duplicates;
};

/// What outlier removal found about a detection.
struct RemovalVerdict {
    Rejection rejection = Rejection::none;
    std::string parameter;  ///< that says the limit; empty where nothing was compared
    double value = 0;       ///< motion vectors that count for the box; for a size as in BrokenLimit
    double limit = 0;       ///< the same unit
    bool at_most = false;
    bool moving_alike = false;  ///< only vectors that move with the box count, not all that lie inside
};

/// A size limit that a box breaks.
struct BrokenLimit {
    std::string parameter;
    double value = 0;  ///< px, px², or the share of the box in the image
    double limit = 0;  ///< the same unit
    bool at_most = false;
};

}  // namespace eyrie
