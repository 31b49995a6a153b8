#include <CLI/CLI.hpp>
#include <cstdio>
#include <exception>
#include <string>

#include "chain/run_recorder.h"
#include "cli/command.h"
#include "cli/usage_error.h"
#include "core/error.h"

namespace {

int exitCodeOf(eyrie::ErrorKind kind) {
    switch (kind) {
        case eyrie::ErrorKind::parameter:
            return eyrie::cli::exit_usage;
        case eyrie::ErrorKind::input:
            return eyrie::cli::exit_input;
        case eyrie::ErrorKind::output:
            return eyrie::cli::exit_output;
        case eyrie::ErrorKind::project:
            return eyrie::cli::exit_project;
        case eyrie::ErrorKind::internal:
            break;
    }
    return eyrie::cli::exit_internal;
}

}  // namespace

int main(int argc, char** argv) {
    CLI::App app("Eyrie finds, outlines and follows every small moving vehicle in video from a moving aircraft.",
                 "eyrie-cli");
    app.set_version_flag("--version", eyrie::engineVersion());
    app.require_subcommand(1);
    app.footer(
        "Exit codes: 0 done, 1 a defect of Eyrie, 2 wrong usage or parameter, 3 an input cannot be read\n"
        "or is incomplete, 4 an output cannot be written, 5 the project file cannot be used, 130 stopped by Ctrl-C\n"
        "(results so far are kept).");
    int exit_code = eyrie::cli::exit_ok;
    eyrie::cli::addRunCommand(app, exit_code);
    eyrie::cli::addEvaluateCommand(app, exit_code);
    eyrie::cli::addReportCommand(app, exit_code);
    eyrie::cli::addRenderCommand(app, exit_code);
    eyrie::cli::addParamsCommand(app, exit_code);
    eyrie::cli::addBenchCommand(app, exit_code);
    eyrie::cli::addCompareCommand(app, exit_code);
    eyrie::cli::addSweepCommand(app, exit_code);
    eyrie::cli::addMergeCommand(app, exit_code);
    eyrie::cli::addInfoCommand(app, exit_code);
    eyrie::cli::addTrainCommand(app, exit_code);
    eyrie::cli::addClassifyCommand(app, exit_code);
    eyrie::cli::addClassifyTestCommand(app, exit_code);
    eyrie::cli::addImportCommand(app, exit_code);
    eyrie::cli::addExportCommand(app, exit_code);
    try {
        app.parse(argc, argv);
        return exit_code;
    } catch (const CLI::ParseError& error) {
        const bool asked = error.get_exit_code() == 0;  // for help or the version
        const auto better = asked ? std::nullopt : eyrie::cli::explainUsage(app, {argv + 1, argv + argc});
        if (better) {
            std::fprintf(stderr, "eyrie-cli: %s\n", better->c_str());
        } else {
            app.exit(error);
        }
        return asked ? eyrie::cli::exit_ok : eyrie::cli::exit_usage;
    } catch (const eyrie::Error& error) {
        std::fprintf(stderr, "eyrie-cli: %s\n", error.what());
        return exitCodeOf(error.kind());
    } catch (const std::exception& error) {
        std::fprintf(stderr, "eyrie-cli: unexpected: %s\n", error.what());
        return eyrie::cli::exit_internal;
    }
}
