#include "annotation/edits/carried_boxes.h"

#include <algorithm>
#include <bit>

namespace eyrie {
namespace {

/// Neighbours a box is carried to, before and behind it.
constexpr std::size_t kFramesAround = 8;
constexpr std::size_t kMostEntries = 4096;

bool same(const OrientedBox& a, const OrientedBox& b) {
    return a.centre == b.centre && a.length == b.length && a.width == b.width && a.heading == b.heading;
}

}  // namespace

CarriedBoxes::CarriedBoxes(const CameraMotion& camera, std::size_t boxes)
    : camera_(camera),
      entries_(camera.empty() ? 1 : std::bit_ceil(std::min(kFramesAround * boxes + 1, kMostEntries))) {}

std::optional<OrientedBox> CarriedBoxes::carried(const OrientedBox& box, FrameIndex from, FrameIndex to) {
    if (from == to) return box;
    const auto hash = kFramesAround * static_cast<std::size_t>(from) + static_cast<std::size_t>(to - from);
    Entry& entry = entries_[hash & (entries_.size() - 1)];
    if (!entry.filled || entry.from != from || entry.to != to || !same(entry.box, box))
        entry = {from, to, true, box, carriedBox(box, from, to, camera_)};
    return entry.carried;
}

}  // namespace eyrie
