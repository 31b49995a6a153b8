#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "diagnosis/box_facts.h"
#include "evaluation/error_list.h"

namespace eyrie {

/// What probably led to an error.
enum class ErrorCause {
    unknown,             ///< nothing that is known explains it
    unregistered,        ///< the frame, or one shortly before, was not registered
    too_new,             ///< in view too shortly for its corners to be judged
    no_corners,          ///< no corner in the box
    too_slow,            ///< corners, but none moved fast enough
    too_few_vectors,     ///< motion vectors, but too few for a cluster
    not_clustered,       ///< enough motion vectors, but not linked, or linked to something too large
    not_detected,        ///< a cluster, but segmentation or classifier found no box
    removed_duplicate,   ///< detected, but fused into another detection
    removed_outlier,     ///< detected, but with too few motion vectors in the box
    removed_size,        ///< detected, but too small or too large
    not_associated,      ///< detected, but in no track
    tentative,           ///< followed, but the track is not confirmed
    track_dropped,       ///< followed, but left out when the tracks were finished
    box_off,             ///< found, but the box overlaps less than T_ov
    merged,              ///< taken for one with a neighbour
    split,               ///< found in parts
    at_border,           ///< found, but by a result so near to the image's edge that it was left out
    other_class,         ///< found, but by a result that names another class than the one that is measured
    duplicate,           ///< false: a second box on an object that is found
    ignored_object,      ///< false: beside an object that does not count
    outside_image,       ///< false: its middle lies outside the image
    coasting,            ///< false: the track went on without a detection
    shadow,              ///< false: moves along beside an object
    parallax,            ///< false: moves the way a standing thing above the ground seems to
    unlabelled,          ///< false: moves steadily, but no object is there; the truth may lack it
    swapped,             ///< switch: the two objects' tracks were exchanged
    track_ended,         ///< switch: the old track ended and a new one began
    track_left,          ///< switch: the old track went on elsewhere
    clustered_together,  ///< merge: one cluster has the vectors of both
    segmented_together,  ///< merge: one detection covers both
    tracked_together,    ///< merge: two detections, but one track
    clustered_apart,     ///< split: the object's vectors fell into several clusters
    segmented_apart,     ///< split: one cluster gave several detections
};
inline constexpr int kErrorCauses = static_cast<int>(ErrorCause::segmented_apart) + 1;
/// The words used in files and on screen: "too slow", "removed as outlier" …
const char* nameOf(ErrorCause cause);
/// One sentence for people; names the parameters that decide.
const char* explanationOf(ErrorCause cause);

/// What is known of an error in one frame.
struct ErrorEvidence {
    const std::vector<BoxRecord>& truth;   ///< records of the frame
    const std::vector<BoxRecord>& result;  ///< records of the frame
    const EvaluationFrame& frame;
    const FrameMatch& match;
    double min_overlap = 0.1;  ///< T_ov
    bool upright = false;
    const BoxFacts* facts = nullptr;            ///< at the place's box; null: nothing is stored (a result from a file)
    std::vector<const BoxFacts*> object_facts;  ///< merges: at each object's box, where stored
    bool in_split = false;                      ///< the object is split, or the result is a part of it
    bool in_merge = false;                      ///< a result covers this object and others
    bool recently_unregistered = false;         ///< false alarms: within the frames just before
    int frames_in_view = 1 << 20;               ///< misses: frames since the object, or the run, began
    int frames_needed = 0;                      ///< age at which corners are judged
};

/// A cause and the numbers behind it.
struct CauseHere {
    ErrorCause cause = ErrorCause::unknown;
    std::string text;  ///< "2 motion vectors, 6 are needed (clustering.min_members)"; may be empty
};

/// The cause that a detection was rejected for such a reason; `unknown` where it was kept.
ErrorCause causeOf(Rejection rejection);
/// The cause that a track was left out for such a reason.
ErrorCause causeOf(TrackDrop why);

/// Misses: the last stage that still had the object decides.
CauseHere causeOfMiss(const ErrorPlace& place, const ErrorEvidence& evidence);
CauseHere causeOfFalseAlarm(const ErrorPlace& place, const ErrorEvidence& evidence);
CauseHere causeOfSplit(const ErrorPlace& place, const ErrorEvidence& evidence);
CauseHere causeOfMerge(const ErrorPlace& place, const ErrorEvidence& evidence);

}  // namespace eyrie
