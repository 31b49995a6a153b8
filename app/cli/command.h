#pragma once

#include "core/error.h"

namespace CLI {
class App;
}

/// The commands of eyrie-cli, one file each. A command adds its subcommand to `app`; its callback throws eyrie::Error
/// for everything that goes wrong, which runProgram() turns into a message and an exit code.
namespace eyrie::cli {

/// Exit codes, documented in `eyrie-cli --help` and docs/manual.md.
enum ExitCode {
    exit_ok = 0,
    exit_internal = 1,
    exit_usage = 2,
    exit_input = 3,
    exit_output = 4,
    exit_project = 5,
    exit_stopped = 130
};

/// The exit code for an error of this kind.
int exitCodeOf(ErrorKind kind);

void addRunCommand(CLI::App& app, int& exit_code);
void addBatchCommand(CLI::App& app, int& exit_code);
void addWatchCommand(CLI::App& app, int& exit_code);
void addEvaluateCommand(CLI::App& app, int& exit_code);
void addRenderCommand(CLI::App& app, int& exit_code);
void addParamsCommand(CLI::App& app, int& exit_code);
void addBenchCommand(CLI::App& app, int& exit_code);
void addCompareCommand(CLI::App& app, int& exit_code);
void addSweepCommand(CLI::App& app, int& exit_code);
void addMergeCommand(CLI::App& app, int& exit_code);
void addInfoCommand(CLI::App& app, int& exit_code);
void addMetadataCommand(CLI::App& app, int& exit_code);
void addTrainCommand(CLI::App& app, int& exit_code);
void addClassifyCommand(CLI::App& app, int& exit_code);
void addClassifyTestCommand(CLI::App& app, int& exit_code);
void addImportCommand(CLI::App& app, int& exit_code);
void addEventsCommand(CLI::App& app, int& exit_code);
void addReportCommand(CLI::App& app, int& exit_code);
void addClipCommand(CLI::App& app, int& exit_code);
void addExportCommand(CLI::App& app, int& exit_code);
void addGeoreferenceCommand(CLI::App& app, int& exit_code);
void addCheckCommand(CLI::App& app, int& exit_code);
void addBackupsCommand(CLI::App& app, int& exit_code);
void addRestoreCommand(CLI::App& app, int& exit_code);
void addManualCommand(CLI::App& app, int& exit_code);

}  // namespace eyrie::cli
