#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/labels/box_record.h"
#include "evaluation/evaluation_options.h"
#include "evaluation/measures/box_errors.h"
#include "evaluation/measures/detection_measures.h"
#include "evaluation/measures/hota.h"
#include "evaluation/measures/identity_measures.h"
#include "evaluation/measures/tracking_measures.h"

namespace eyrie {

/// Every measure of one result against one ground truth at one T_ov.
struct Measures {
    Convention convention = Convention::thesis;
    double overlap = 0;  ///< T_ov
    DetectionMeasures detection;
    BoxErrors boxes;
    std::optional<TrackingMeasures> tracking;  ///< absent where a box has no id
    std::optional<IdentityMeasures> identity;  ///< likewise
    std::optional<HotaMeasures> hota;          ///< likewise; does not depend on T_ov
    TrackTallies tracks;                       ///< empty where a box has no id

    int results_not_counted = 0;  ///< results in frames outside the evaluation
    int shared_frames = 0;        ///< frames in which truth and result both have boxes
    int repeated_ids = 0;         ///< boxes whose id another box of the same frame has too
};

/// Throws Error(parameter | input); see prepareEvaluation().
Measures evaluate(const BoxesByFrame& truth, const BoxesByFrame& result, const EvaluationOptions& options);

/// The same at several T_ov; `options.overlap` is not used. HOTA is computed once.
std::vector<Measures> evaluateAt(const std::vector<double>& overlaps, const BoxesByFrame& truth,
                                 const BoxesByFrame& result, const EvaluationOptions& options);

/// A measure as data, for tables, files and lists.
struct NamedMeasure {
    std::string group;            ///< "detection", "tracking", "identity" or "boxes"
    std::string key;              ///< in files: "f_score"
    std::string label;            ///< for people: "f-score"
    std::string help;             ///< one line
    std::optional<double> value;  ///< empty where it is not defined
    int decimals = 4;             ///< 0 for counts
    bool higher_is_better = true;
};

/// Whether the measures of a group need tracks: detections, which have no ids, have none of them.
inline bool isOfTracks(std::string_view group) {
    return group == "tracking" || group == "identity";
}

/// All scalar measures in the order of the thesis; HOTA and its parts as means over the thresholds.
std::vector<NamedMeasure> listMeasures(const Measures& measures);

/// What a reader should know before trusting the figures: no shared frames, boxes that were not counted, repeated ids.
std::vector<std::string> remarksOn(const Measures& measures);

}  // namespace eyrie
