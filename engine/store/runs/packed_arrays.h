#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "core/values/motion_vector.h"

/// Arrays as bytes, little-endian. Their layout is part of the file format: it never changes, new layouts get new
/// format bytes. Unpacking answers nothing for bytes that no packing yields.
namespace eyrie {

using Bytes = std::vector<std::byte>;
using ByteView = std::span<const std::byte>;

/// Per vector 28 bytes: id (int64), x, y, vx, vy (float32), age (int32). Exact.
Bytes packMotionVectors(std::span<const MotionVector> vectors);
std::optional<std::vector<MotionVector>> unpackMotionVectors(ByteView bytes);

/// A format byte, then x and y per point in fixed point of 1/16 px, rounded, so exact to 1/32 px. Format 2: uint16,
/// when every coordinate lies in 0 … 4,095 px; format 4: int32. What is not finite becomes 0.
Bytes packPoints(std::span<const cv::Point2f> points);
std::optional<std::vector<cv::Point2f>> unpackPoints(ByteView bytes);

/// Per number an int32.
Bytes packIndices(std::span<const int> indices);
std::optional<std::vector<int>> unpackIndices(ByteView bytes);

}  // namespace eyrie
