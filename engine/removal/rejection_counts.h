#pragma once

#include <array>
#include <numeric>
#include <vector>

#include "core/values/detection.h"

namespace eyrie {

/// What became of the boxes that a detector delivered for one cluster.
struct RejectionCounts {
    std::array<int, kRejectionCount> of{};  ///< by Rejection

    int operator[](Rejection rejection) const { return of[static_cast<std::size_t>(rejection)]; }
    int kept() const { return (*this)[Rejection::none]; }
    int delivered() const { return std::accumulate(of.begin(), of.end(), 0); }
};

/// Counts among the detections of a frame, as removal left them, those of a cluster.
inline RejectionCounts countRejections(const std::vector<Detection>& detections, int cluster) {
    RejectionCounts counts;
    for (const Detection& detection : detections) {
        if (detection.cluster == cluster) ++counts.of[static_cast<std::size_t>(detection.rejection)];
    }
    return counts;
}

}  // namespace eyrie
