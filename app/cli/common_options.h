#pragma once

#include <optional>
#include <string>

namespace CLI {
class App;
class Option;
}  // namespace CLI

/// Options of many commands, so that each is called and described alike in all of them. Answers are the options, for
/// what a command demands of them besides.
namespace eyrie::cli {

/// --json, of commands that print.
CLI::Option* addJson(CLI::App& command, bool& json);
/// --quiet, of commands that show how far they are.
CLI::Option* addQuiet(CLI::App& command, bool& quiet);
/// --run: which run of a project a command is about; for chosenRun().
CLI::Option* addRunNumber(CLI::App& command, std::optional<int>& run);
/// --sequence: which video of a project a command is about; for chosenSequence().
CLI::Option* addSequenceNumber(CLI::App& command, std::optional<int>& sequence);
/// --start: when the video began; for startOf().
CLI::Option* addStart(CLI::App& command, std::string& start);

}  // namespace eyrie::cli
