#pragma once

#include <vector>

#include "core/parameter.h"
#include "core/values/detection.h"
#include "core/values/motion_vector.h"
#include "core/values/scene_scale.h"
#include "removal/part_joining.h"

namespace eyrie {

/// What becomes of duplicates (Teutsch §5.5.1).
enum class DuplicateStrategy {
    fuse,        ///< union of the boxes, for segmentation
    suppress,    ///< the higher score stays (non-maximum suppression), for classifiers
    by_detector  ///< what suits the detector in use: the chain decides; fuse where it did not
};

/// How strong two boxes overlap.
enum class DuplicateMeasure {
    containment,  ///< share of the smaller box inside the other
    overlap       ///< intersection over union
};

/// Parameters of duplicate removal (Teutsch §5.5.1).
struct DuplicateRemovalOptions {
    DuplicateStrategy strategy = DuplicateStrategy::by_detector;
    DuplicateMeasure measure = DuplicateMeasure::containment;
    double threshold = 0.7;
    double max_turn_deg = 30;      ///< duplicates have similar headings
    bool compare_speed = true;     ///< … and similar velocities
    double velocity_floor = 0.08;  ///< px/frame
    double velocity_share = 0.1;
    double growth_limit = 1.5;  ///< a union larger than this many times the larger box is not formed; 0: no limit
    PartJoiningOptions parts;

    /// The text to the letter: everything of similar orientation that overlaps is fused.
    static DuplicateRemovalOptions thesis();
    void describe(ParameterVisitor& visitor);
};

/// Removes duplicates, after joining the parts of vehicles: boxes of a classifier from the highest score down, then the
/// others, the strongest overlap first. Fused or suppressed detections
/// stay in the list with Rejection::duplicate. Vectors and velocity of every detection that is kept are measured anew
/// from the motion vectors inside its box. `trace`, if given, is added to.
std::vector<Detection> removeDuplicates(std::vector<Detection> detections, const FrameMotion& motion,
                                        const DuplicateRemovalOptions& options, const SceneScale& scale,
                                        RemovalTrace* trace = nullptr);

}  // namespace eyrie
