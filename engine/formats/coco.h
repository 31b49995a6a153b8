#pragma once

#include "formats/label_formats.h"

/// COCO and KWCOCO: JSON with `images`, `categories` and `annotations` (bbox left, top, width, height; pixels from 0);
/// KWCOCO adds `videos`, `images[].frame_index` from 0 and `annotations[].track_id`. A turned box has its corners in
/// `segmentation` and its heading (radians, clockwise on screen) in `dive_detection_attributes.rotation`. iscrowd = 1
/// is ignored. A list of results ({image_id, category_id, bbox, score}) is read too.
namespace eyrie {

/// Throws Error(input) "file: annotations[3].bbox: …" for whatever is not as above, among it JSON nested deeper than
/// labels ever are, and several videos unless options name one.
LabelFile readCoco(const std::filesystem::path& path, const ImportOptions& options);

void writeCoco(const LabelFile& labels, const std::filesystem::path& path, const ExportOptions& options,
               ExportReport& report);
void writeKwcoco(const LabelFile& labels, const std::filesystem::path& path, const ExportOptions& options,
                 ExportReport& report);

}  // namespace eyrie
