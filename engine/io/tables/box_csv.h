#pragma once

#include <filesystem>

#include "core/labels/box_record.h"

namespace eyrie {

/// Our tables of boxes. Results: `frame,id,x,y,length,width,heading,class,score,vx,vy,origin` (id empty for
/// detections); ground truth: `frame,id,x,y,length,width,heading,class,ignore`. px, px/frame, degrees clockwise from +x
/// in [0, 360).

/// Reads either table. Columns are found by name, in any order; frame, x, y, length, width and heading must be there,
/// the others have defaults, unknown ones are skipped, and so is a word for the origin that is none of ours. An ignored
/// object may have a name for an id ("i18"); it gets a number above all others. Throws Error(input) naming file, line
/// and column.
BoxesByFrame readBoxCsv(const std::filesystem::path& path);

/// Lengths with 4 decimals. Throws Error(output); the file is either complete or as it was before.
void writeResultCsv(const std::filesystem::path& path, const BoxesByFrame& boxes);
void writeGroundTruthCsv(const std::filesystem::path& path, const BoxesByFrame& boxes);
/// The same for boxes one by one; those of a frame follow each other.
void writeResultCsv(const std::filesystem::path& path, const VisitBoxes& boxes);
void writeGroundTruthCsv(const std::filesystem::path& path, const VisitBoxes& boxes);

}  // namespace eyrie
