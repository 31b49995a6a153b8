#pragma once

#include <optional>
#include <vector>

#include "core/labels/annotation_edit.h"
#include "store/runs/packed_arrays.h"

/// Labels as bytes, little-endian, beginning with a format byte. As with packed_arrays.h, a layout never changes once
/// released. Unpacking answers nothing for bytes that no packing yields.
namespace eyrie {

/// Format 1, then per keyframe 45 bytes: frame (int32), centre x, y, length, width, heading (float64), flags (uint8).
Bytes packKeyframes(const std::vector<Keyframe>& keyframes);
/// Frames that do not ascend and numbers that are not finite are nothing that was packed.
std::optional<std::vector<Keyframe>> unpackKeyframes(ByteView bytes);

/// Format 1, then x, y (float64) per corner.
Bytes packPolygon(const std::vector<cv::Point2d>& polygon);
std::optional<std::vector<cv::Point2d>> unpackPolygon(ByteView bytes);

/// A step of work. Of an object that is changed only the keyframes that differ are packed; the others come from the
/// labels at unpacking.
Bytes packEdit(const AnnotationEdit& edit);
/// The step as it was done. `done`: `set` holds what it made; otherwise what it started from. Nothing, too, when the
/// step does not fit the labels. The name is not part of the bytes.
std::optional<AnnotationEdit> unpackEdit(ByteView bytes, const AnnotationSet& set, bool done);

}  // namespace eyrie
