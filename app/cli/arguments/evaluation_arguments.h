#pragma once

#include <optional>
#include <string>
#include <vector>

#include "evaluation/evaluation_options.h"
#include "scoring/ground_truth.h"

namespace CLI {
class App;
class Option;
}  // namespace CLI

namespace eyrie::cli {

/// What is taken where no --ground-truth is named, by commands that measure a run.
inline constexpr char kLabelsOtherwise[] = " (default: the project's labels of the video)";

/// The arguments --ground-truth and --mot-origin, shared by all commands that measure.
struct GroundTruthArguments {
    std::string file;
    std::optional<double> mot_origin;

    /// `otherwise` says what is taken where no file is named. Answers --ground-truth.
    CLI::Option* addTo(CLI::App& command, const std::string& otherwise = "");
    /// Without --ground-truth, for commands that take several.
    void addOriginTo(CLI::App& command);
    GroundTruthSource source() const { return {file, mot_origin}; }
};

/// The arguments --overlap, --vehicles, --upright and --border: what counts in an evaluation.
struct EvaluationArguments {
    std::vector<double> overlaps{0.1, 0.2, 0.3};
    EvaluationOptions options;  ///< without an overlap

    void addTo(CLI::App& command);
    /// Without --overlap, for commands that take one of their own.
    void addRuleTo(CLI::App& command);
};

}  // namespace eyrie::cli
