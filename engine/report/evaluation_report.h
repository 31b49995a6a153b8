#pragma once

#include <functional>
#include <stop_token>
#include <string>
#include <vector>

#include "diagnosis/run_evaluation.h"
#include "io/video/frame_source.h"
#include "report/report_file.h"

namespace eyrie {

/// What a report of an evaluation shows.
struct ReportOptions {
    std::string title;       ///< empty: made from the video's name
    std::string made_utc;    ///< when it is made, ISO 8601; empty: not told
    std::size_t chips = 48;  ///< the errors with most frames get a picture
    std::size_t rows = 400;  ///< errors listed in all
};

/// Parameters that differ from the default come first, then figures, tables, the errors with most frames as chips, all
/// errors, all parameters. `pixels` may be null: then there are no chips; what of it cannot be read is left out and
/// said. `progress` (0 … 1) may be empty. When `stop` is requested the rest of the chips is left out.
ReportFile makeEvaluationReport(const RunEvaluation& evaluation, FrameSource* pixels, const ReportOptions& options = {},
                                const std::function<void(double)>& progress = {}, const std::stop_token& stop = {});

}  // namespace eyrie
