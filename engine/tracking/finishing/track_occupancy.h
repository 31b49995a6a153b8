#pragma once

#include <unordered_map>
#include <vector>

#include "core/geometry/oriented_box.h"
#include "tracking/finishing/track_paths.h"

namespace eyrie {

/// Where tracks are, frame by frame, so that what extends one keeps off the others. Looks them up in the tracks
/// themselves, which must outlive it where they are.
class TrackOccupancy {
 public:
    explicit TrackOccupancy(const std::vector<TrackPath>& paths);

    /// All boxes in a frame.
    std::vector<OrientedBox> in(FrameIndex frame) const;
    /// Whether a box of that frame overlaps no other by more than 0.15.
    bool isFree(FrameIndex frame, const OrientedBox& box) const;
    /// Whether it touches no other.
    bool isBare(FrameIndex frame, const OrientedBox& box) const;
    /// To be told when a track got earlier states.
    void extended(const TrackPath& path);
    /// To be told when a track got a state in one frame.
    void reaches(const TrackPath& path, FrameIndex frame);

 private:
    /// Whether it is so for all boxes of a frame.
    template <class Holds>
    bool all(FrameIndex frame, Holds holds) const;

    std::unordered_map<int, std::vector<const TrackPath*>> alive_;  ///< by span of frames
};

}  // namespace eyrie
