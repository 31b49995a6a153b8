#pragma once

#include <optional>

#include "core/review/review_edit.h"
#include "store/runs/packed_arrays.h"

namespace eyrie {

/// A step of reviewing as bytes, little-endian: format 1, then verdicts and bookmarks as they were and as they became;
/// a step that changes zones: format 2, with zones behind them.
/// The name is not part of the bytes. As with packed_arrays.h, a layout never changes once released.
Bytes packReview(const ReviewEdit& edit);
/// Nothing for bytes that no packing yields.
std::optional<ReviewEdit> unpackReview(ByteView bytes);

}  // namespace eyrie
