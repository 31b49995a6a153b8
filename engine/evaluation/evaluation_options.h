#pragma once

#include <opencv2/core/types.hpp>
#include <optional>
#include <string>
#include <vector>

#include "core/labels/track_class.h"
#include "core/values/ids.h"

namespace eyrie {

/// Whose definitions are followed where evaluations differ.
///
/// | | thesis | trackeval |
/// | --- | --- | --- |
/// | frames | those the ground truth names | all from 0 to the last; results in empty ones are false |
/// | match | pairs of the frame before first, then one to one at maximum overlap | one assignment, pairs of the frame
/// before weigh 1000 |
/// | ignored objects | every unmatched result that touches them is ignored, too | are removed, all other results count
/// | | mostly tracked | at least 80 % | more than 80 % | | fragments | each change from tracked to not tracked |
/// tracked runs − 1 |
enum class Convention {
    thesis,    ///< Teutsch §7.1
    trackeval  ///< TrackEval, CLEAR with DO_PREPROC False
};
const char* nameOf(Convention convention);

/// What counts in an evaluation, and how.
struct EvaluationOptions {
    double overlap = 0.1;       ///< T_ov of eq. 7.1, in (0, 1]
    bool vehicles_only = false; /**< objects of the ground truth that are no vehicles count as ignored; what results
                                   say of their class is not looked at (Teutsch §7.2) */
    /// Only objects of this class count, all others are ignored, and results that name another class are left out:
    /// objects that they lie on are missed. Results without a class take part.
    std::optional<TrackClass> one_class;
    bool upright = false;         ///< compare enclosing upright boxes, for ground truth without headings
    std::optional<double> border; /**< px; results whose upright box comes closer to the image's edge are left out, for
                                     ground truth that leaves cut objects out. Needs `image_size`. */
    cv::Size image_size;          ///< px
    Convention convention = Convention::thesis;
    std::optional<int> frame_count;  ///< trackeval only: length of the sequence; default: up to the last true frame

    bool operator==(const EvaluationOptions&) const = default;
};

/// The words for `one_class`: "vehicles", "two_wheelers", "persons"; "all" stands for none.
const std::vector<std::string>& scoredClassWords();
/// Throws Error(parameter) for any other word, naming those that there are.
std::optional<TrackClass> scoredClass(const std::string& word);
std::string wordOfScored(const std::optional<TrackClass>& one_class);

/// Which objects count, for people, behind how boxes are compared: ", vehicles only"; empty where all do.
std::string countedText(const EvaluationOptions& options);

/// Throws Error(parameter) naming the option, its value and what is expected.
void check(const EvaluationOptions& options);

}  // namespace eyrie
