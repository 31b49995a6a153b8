#pragma once

#include "formats/label_formats.h"

/// CVAT for video 1.1: tracks of boxes by their unrotated edges (pixels from 0), turned clockwise about their centre by
/// degrees; only keyframes count on import, and between them the edges move linearly and the angle by the shorter arc.
/// An object ends at a keyframe with outside = 1. Frames are those of the video, from 0.
namespace eyrie {

namespace cvat {
/// Attributes of ours for what CVAT has no field for.
inline constexpr const char* kIgnoreAttribute = "ignore";
inline constexpr const char* kOcclusionAttribute = "occlusion";
}  // namespace cvat

/// Objects with their keyframes, and every frame between them as CVAT shows it. `options`: for frame_count. Throws
/// Error(input) "file:line: …", among it for document types and entities, which no export of CVAT has.
LabelFile readCvat(const std::filesystem::path& path, const ImportOptions& options);

/// Writes every frame; keyframes are as few as CVAT's interpolation allows within 0.02 px and 0.02°.
void writeCvat(const LabelStream& labels, const std::filesystem::path& path, const ExportOptions& options,
               ExportReport& report);

}  // namespace eyrie
