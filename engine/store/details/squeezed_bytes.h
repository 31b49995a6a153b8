#pragma once

#include "core/evidence/classified_box.h"
#include "store/runs/packed_arrays.h"

namespace eyrie {

/// Bytes made smaller without loss, for arrays of records of `stride` bytes each: bytes of one place in the record lie
/// side by side and are deflated. Format byte 1, the number of bytes as uint32, the stride as uint8, then a zlib
/// stream.
Bytes squeezed(ByteView bytes, std::size_t stride);
/// Nothing for bytes that no squeezing yields, and where more than `most` bytes would come out.
std::optional<Bytes> unsqueezed(ByteView bytes, std::size_t most = std::size_t{1} << 28U);

/// The same of motion vectors and of classified boxes, exact. Boxes as they were written before decisions were known
/// are read, too: of whole vehicles.
Bytes squeezeMotionVectors(std::span<const MotionVector> vectors);
std::optional<std::vector<MotionVector>> unsqueezeMotionVectors(ByteView bytes);
Bytes squeezeBoxes(std::span<const ClassifiedBox> boxes);
std::optional<std::vector<ClassifiedBox>> unsqueezeBoxes(ByteView bytes);

}  // namespace eyrie
