#include "cli/common_options.h"

#include <CLI/CLI.hpp>

namespace eyrie::cli {

CLI::Option* addJson(CLI::App& command, bool& json) {
    return command.add_flag("--json", json, "Print JSON");
}

CLI::Option* addQuiet(CLI::App& command, bool& quiet) {
    return command.add_flag("--quiet", quiet, "No progress");
}

CLI::Option* addRunNumber(CLI::App& command, std::optional<int>& run) {
    return command.add_option("--run", run, "Number of the run (default: the last)");
}

CLI::Option* addSequenceNumber(CLI::App& command, std::optional<int>& sequence) {
    return command.add_option("--sequence", sequence, "Number of the project's video, where it has several");
}

CLI::Option* addStart(CLI::App& command, std::string& start) {
    return command.add_option(
        "--start", start,
        "When the video begins, UTC, e.g. 2026-11-21T08:00:00Z (default: as the project keeps it, or by its "
        "metadata, or by the creation time of its file)");
}

}  // namespace eyrie::cli
