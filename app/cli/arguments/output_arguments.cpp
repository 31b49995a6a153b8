#include "cli/arguments/output_arguments.h"

#include <unistd.h>

#include <CLI/CLI.hpp>
#include <cstdio>

#include "cli/arguments/earlier_state.h"
#include "core/error.h"

namespace eyrie::cli {
namespace {

bool personAtTerminal() {
    return ::isatty(STDIN_FILENO) == 1 && ::isatty(STDERR_FILENO) == 1;
}

bool agrees(const std::string& files, bool several) {
    std::fprintf(stderr, "%s exist%s already. Replace %s? [y/N] ", files.c_str(), several ? "" : "s",
                 several ? "them" : "it");
    std::fflush(stderr);
    const int answer = std::getchar();
    for (int rest = answer; rest != '\n' && rest != EOF;) rest = std::getchar();
    return answer == 'y' || answer == 'Y';
}

}  // namespace

void OutputArguments::addTo(CLI::App& command) {
    command.add_flag("--force", force, "Replace files of the same kind that exist already, without a question");
}

void OutputArguments::check(const std::vector<OutputFile>& outputs,
                            const std::vector<std::filesystem::path>& inputs) const {
    const auto replaced = filesToReplace(outputs, inputs);
    for (const OutputFile& output : outputs) {
        std::error_code failed;
        if (output.kind == FileKind::project && output.grows && std::filesystem::is_regular_file(output.path, failed))
            openForReading(output.path);
    }
    if (replaced.empty() || force) return;
    const std::string files = shortList(replaced);
    const bool several = replaced.size() > 1;
    if (personAtTerminal() && agrees(files, several)) return;
    throw Error(ErrorKind::output, files + (several ? " exist" : " exists") +
                                       " already and would be replaced; add --force if that is meant, or choose "
                                       "another name");
}

}  // namespace eyrie::cli
