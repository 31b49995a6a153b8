#pragma once

#include <unordered_map>
#include <vector>

#include "core/oriented_box.h"
#include "tracking/track_paths.h"

namespace eyrie {

/// Where tracks are, frame by frame, so that what extends one keeps off the others.
class TakenPlaces {
 public:
    explicit TakenPlaces(const std::vector<TrackPath>& paths);

    /// All boxes in a frame; valid until the next `take`.
    const std::vector<OrientedBox>& in(FrameIndex frame) const;
    /// Whether a box of that frame overlaps no other by more than 0.15.
    bool isFree(FrameIndex frame, const OrientedBox& box) const;
    void take(FrameIndex frame, const OrientedBox& box) { boxes_[frame].push_back(box); }

 private:
    std::unordered_map<FrameIndex, std::vector<OrientedBox>> boxes_;
};

}  // namespace eyrie
