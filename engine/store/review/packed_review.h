#pragma once

#include <optional>

#include "core/review/review_edit.h"
#include "store/runs/packed_arrays.h"

namespace eyrie {

/// A step of reviewing as bytes, little-endian: format 1, then verdicts and bookmarks as they were and as they became;
/// a step that changes zones: format 2, with zones behind them; one that corrects tracks: format 3, with corrections
/// behind zones.
/// The name is not part of the bytes. As with packed_arrays.h, a layout never changes once released.
Bytes packReview(const ReviewEdit& edit);
/// Nothing for bytes that no packing yields.
std::optional<ReviewEdit> unpackReview(ByteView bytes);

/// Where a vehicle is, little-endian: format 1, then 44 bytes a frame: frame (int32), centre x, y, length, width,
/// heading (float64).
Bytes packSightings(const std::vector<Sighting>& sightings);
/// Nothing for bytes that no packing yields, and for what areSightings() denies.
std::optional<std::vector<Sighting>> unpackSightings(ByteView bytes);

}  // namespace eyrie
