#pragma once

#include "formats/label_formats.h"

/// COCO and KWCOCO: JSON with `images`, `categories` and `annotations` (bbox left, top, width, height; pixels from 0);
/// KWCOCO adds `videos`, `images[].frame_index` from 0 and `annotations[].track_id`. A turned box has its corners in
/// `segmentation` and its heading (radians, clockwise on screen) in `dive_detection_attributes.rotation`. iscrowd = 1
/// is ignored, and so is `ignore` in DIVE's attributes. Without a bbox the polygon tells the box; where several classes
/// are told with confidences the surest counts. A list of results ({image_id, category_id, bbox, score}) is read too.
namespace eyrie {

/// Entries that are not as above are left out one by one, with a note "file: annotations[3].bbox: …". Throws
/// Error(input) when that leaves nothing, for what is no JSON or nested deeper than labels ever are, and for several
/// videos unless options name one.
LabelFile readCoco(const std::filesystem::path& path, const ImportOptions& options);

/// Replaces the file in one step; what got lost goes into the report. Throws Error(output). KWCOCO has videos and
/// tracks besides.
void writeCoco(const LabelFile& labels, const std::filesystem::path& path, const ExportOptions& options,
               ExportReport& report);
void writeKwcoco(const LabelFile& labels, const std::filesystem::path& path, const ExportOptions& options,
                 ExportReport& report);

}  // namespace eyrie
