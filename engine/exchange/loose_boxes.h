#pragma once

#include "formats/label_file.h"

namespace eyrie {

/// What to make of boxes that belong to no object, as those of detectors and of COCO.
enum class LooseBoxes {
    single,  ///< each an object of one frame
    link     ///< those that overlap from frame to frame one object, the others as above
};

/// How many there were and what came of them.
struct LooseBoxCount {
    int boxes = 0;
    int objects = 0;
};

/// Gives boxes without id that are not to be ignored (those are regions) ids above all others. Linking is greedy: of
/// two neighbouring frames the pairs that overlap most (upright boxes, at least 0.3, the same class) come first, after
/// every object was moved on by its last step. An object ends where it finds no box. Good for detections that are dense
/// in time; crowded or jumping ones need a tracker.
LooseBoxCount gatherLooseBoxes(LabelFile& labels, LooseBoxes how);

}  // namespace eyrie
