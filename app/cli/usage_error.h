#pragma once

#include <optional>
#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace eyrie::cli {

/// What is wrong with a command line that could not be parsed, where we can tell better than the parser: a misspelt
/// command or option with the nearest one, a decimal comma. `words` are the arguments without the program.
std::optional<std::string> explainUsage(CLI::App& app, const std::vector<std::string>& words);

}  // namespace eyrie::cli
