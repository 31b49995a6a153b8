#pragma once

#include <optional>
#include <vector>

#include "annotation/keyframes/interpolation.h"

namespace eyrie {

/// Boxes carried over the ground, kept for when the same is asked for again: while keyframes come and go the same
/// neighbours are carried to each other many times. Answers as carriedBox does. Used by one thread.
class CarriedBoxes {
 public:
    /// `camera` must outlive it; `boxes`: about how many are to be carried.
    CarriedBoxes(const CameraMotion& camera, std::size_t boxes);
    std::optional<OrientedBox> carried(const OrientedBox& box, FrameIndex from, FrameIndex to);

 private:
    struct Entry {
        FrameIndex from = 0;
        FrameIndex to = 0;
        bool filled = false;
        OrientedBox box;
        std::optional<OrientedBox> carried;
    };
    const CameraMotion& camera_;
    std::vector<Entry> entries_;  ///< as many as a power of two
};

}  // namespace eyrie
