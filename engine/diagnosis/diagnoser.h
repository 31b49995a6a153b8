#pragma once

#include <functional>
#include <map>
#include <optional>
#include <stop_token>
#include <string>
#include <utility>
#include <vector>

#include "chain/chain_options.h"
#include "core/values/frame_result.h"
#include "diagnosis/error_cause.h"
#include "evaluation/error_list.h"

namespace eyrie {

/// A stored run as the search for causes needs it.
struct DiagnosisSource {
    ChainOptions options;
    SceneScale scale;
    FrameIndex first_frame = 0;                                           ///< of the run
    std::function<std::optional<FrameResult>(FrameIndex)> frame_result{}; /**< nothing: the run has no such frame; an
                                                                             empty function: nothing is stored */
};

/// An error with its probable cause.
struct DiagnosedError {
    ResultError error;
    ErrorCause cause = ErrorCause::unknown;  ///< the most frequent one of its frames, the earlier where two are
    std::string text;                        ///< the numbers behind it in frame `place`; may be empty
    std::size_t place = 0;                   ///< the place that shows the cause, index into ResultError::places
    int frames_of_cause = 0;                 ///< places with this cause
};

/// Ground truth, result and their comparison.
struct Comparison {
    const BoxesByFrame& truth;
    const BoxesByFrame& result;
    const EvaluationInput& input;
    const std::vector<FrameMatch>& matches;
    const EvaluationOptions& options;
};

/// Finds the probable causes of errors. Keeps what it looked up in the run, so that scoring again after a change of
/// the ground truth reads little. For one thread.
class Diagnoser {
 public:
    explicit Diagnoser(DiagnosisSource source) : source_(std::move(source)) {}

    /// In the order of `errors`. When `stop` is requested the rest stays unknown. Throws what the source throws.
    std::vector<DiagnosedError> diagnose(std::vector<ResultError> errors, const Comparison& comparison,
                                         const std::stop_token& stop = {});

 private:
    struct Known {
        OrientedBox box;
        BoxFacts facts;
    };
    /// Stored facts about boxes of one frame; reads the frame at most once.
    class FrameLookup;

    DiagnosisSource source_;
    std::map<FrameIndex, std::vector<Known>> known_;
    bool upright_ = false;  ///< how the known ones were compared
};

}  // namespace eyrie
