#include "cli/arguments/evaluation_arguments.h"

#include <CLI/CLI.hpp>

namespace eyrie::cli {

CLI::Option* GroundTruthArguments::addTo(CLI::App& command, const std::string& otherwise) {
    addOriginTo(command);
    return command.add_option("--ground-truth", file,
                              "Ground truth boxes, in any format that import reads" + otherwise);
}

void GroundTruthArguments::addOriginTo(CLI::App& command) {
    command.add_option("--mot-origin", mot_origin,
                       "Where the first pixel begins in MOTChallenge text (default 1, by its rules; 0 with labels.txt "
                       "beside it, as CVAT and datumaro write it)");
}

void EvaluationArguments::addTo(CLI::App& command) {
    command.add_option("--overlap", overlaps, "Overlaps T_ov from which a box counts as found")
        ->delimiter(',')
        ->capture_default_str();
    addRuleTo(command);
}

void EvaluationArguments::addRuleTo(CLI::App& command) {
    CLI::Option* vehicles = command.add_flag("--vehicles", options.vehicles_only,
                                             "Only vehicles count; other objects of the ground truth are ignored, and "
                                             "results count whatever class they name");
    command
        .add_option_function<std::string>(
            "--classes", [this](const std::string& word) { options.one_class = scoredClass(word); },
            "Only objects of this class count, others are ignored; results that name another class are left out")
        ->check(CLI::IsMember(scoredClassWords()))
        ->default_str("all")
        ->excludes(vehicles);
    command.add_flag("--upright", options.upright,
                     "Compare enclosing upright boxes, for ground truth without headings");
    command.add_option("--border", options.border, "Leave out results that come this close to the image's edge, px");
}

}  // namespace eyrie::cli
