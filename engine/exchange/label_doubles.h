#pragma once

#include <map>

#include "annotation/keyframes/camera_motion.h"
#include "core/labels/annotation.h"
#include "formats/label_file.h"

namespace eyrie {

/// What to do with objects of a file that a project has already.
enum class Doubles {
    skip,  ///< they are left out
    add    ///< they are taken like all others
};

/// Objects of a file (by their ids there) that are labelled already, and the object that shows the same boxes: the
/// corners within `tolerance_px` in at least four of five frames. Of long objects some frames are looked at, spread
/// over their lives.
std::map<int, ObjectId> alreadyLabelled(const LabelFile& labels, const AnnotationSet& present,
                                        const CameraMotion& camera, double tolerance_px);

/// Whether a set has an ignore region over the same frames with the same corners.
bool hasRegion(const AnnotationSet& present, const IgnoreRegion& region, double tolerance_px);

}  // namespace eyrie
