#pragma once

#include <vector>

#include "core/labels/box_record.h"
#include "evaluation/evaluation_input.h"
#include "evaluation/matching.h"

namespace eyrie {

/// What can be wrong with a result (Teutsch §7.1; splits and merges: §6.2).
enum class ResultErrorKind {
    miss,         ///< an object that no result found
    false_alarm,  ///< a result that found no object
    id_switch,    ///< an object whose result has another id than the last one had
    fragment,     ///< an object that was followed and is not any more
    split,        ///< several results lie side by side in one object
    merge         ///< one result covers several objects, at least one of which is missed
};
/// The word used in files and on screen: "miss", "false alarm", "switch", "fragment", "split", "merge".
const char* nameOf(ResultErrorKind kind);

/// An error in one frame. Numbers are indices into the frame's records.
struct ErrorPlace {
    FrameIndex frame = 0;
    OrientedBox box;           ///< of the object; of the result for false alarms and merges
    std::vector<int> truth;    ///< the objects concerned
    std::vector<int> results;  ///< the results concerned
};

/// An error over consecutive frames of the ground truth.
struct ResultError {
    ResultErrorKind kind = ResultErrorKind::miss;
    std::vector<int> objects;  ///< ids of the objects concerned, where they have any
    std::vector<int> tracks;   ///< ids of the tracks concerned; of a switch: the one before, the one after
    FrameIndex first_frame = 0;
    FrameIndex last_frame = 0;
    /// Ascending frames, never empty. A switch has one, the frame of the new id, and its range begins where the object
    /// had the old one last; a fragment has one, its first frame, and its range ends where the object is found again
    /// or ends.
    std::vector<ErrorPlace> places;

    /// How often it counts: boxes for misses and false alarms, else 1 … frames.
    int count() const { return static_cast<int>(places.size()); }
};

/// Everything that is wrong, by first frame, then kind. All misses together are the false negatives, all false alarms
/// the false positives, and switches and fragments are as many as the tracking measures count; splits and merges are
/// other views of the same boxes. Without ids there are no switches and fragments, and boxes of neighbouring frames
/// that overlap are taken for one. `input` and `matches` are made from `truth`, `result` and `options`.
std::vector<ResultError> listErrors(const BoxesByFrame& truth, const BoxesByFrame& result, const EvaluationInput& input,
                                    const std::vector<FrameMatch>& matches, const EvaluationOptions& options);

}  // namespace eyrie
