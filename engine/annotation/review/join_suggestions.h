#pragma once

#include <vector>

#include "annotation/keyframes/camera_motion.h"
#include "core/labels/annotation.h"

namespace eyrie {

/// Another object that may be the same vehicle, earlier or later.
struct JoinSuggestion {
    ObjectId object = 0;
    bool later = true;        ///< it begins after this one ends; false: it ends before this one begins
    int gap = 0;              ///< frames between the two in which neither exists
    double distance_px = 0;   ///< over the ground, from where the earlier is expected to be (going on at its speed or
                              ///< standing, whichever is nearer) to where the later begins, px of that frame
    double heading_turn = 0;  ///< radians between the headings where the later begins, 0 … π
    bool over_ground = true;  ///< false: the frames are not connected, the distance is measured in the image
};

/// How far apart two objects may be that are suggested to be one.
struct SuggestionOptions {
    int max_gap = 250;             ///< frames
    double max_distance_px = 200;  ///< at least; grows by `px_per_gap_frame` for each frame of the gap
    double px_per_gap_frame = 1;
    int max_count = 8;
};

/// Candidates to join with an object, nearest over the ground first.
std::vector<JoinSuggestion> suggestJoins(const AnnotationSet& set, ObjectId object, const CameraMotion& camera,
                                         const SuggestionOptions& options = {});

/// An object that overlaps this one in time and space, to be fused with it.
struct FuseSuggestion {
    ObjectId object = 0;
    int shared_frames = 0;    ///< frames looked at in which both are visible
    double mean_overlap = 0;  ///< in those
};
/// Candidates to fuse with an object, largest overlap first; at most 50 common frames are looked at.
std::vector<FuseSuggestion> suggestFusions(const AnnotationSet& set, ObjectId object, const CameraMotion& camera,
                                           double min_overlap = 0.3);

}  // namespace eyrie
