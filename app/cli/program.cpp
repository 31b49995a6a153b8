#include "cli/program.h"

#include <CLI/CLI.hpp>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <new>
#include <string>

#include "chain/recording/run_recorder.h"
#include "cli/command.h"
#include "cli/standard_streams.h"
#include "cli/usage_error.h"
#include "core/error.h"
#include "core/text.h"

namespace eyrie::cli {

int exitCodeOf(ErrorKind kind) {
    switch (kind) {
        case ErrorKind::parameter:
            return exit_usage;
        case ErrorKind::input:
            return exit_input;
        case ErrorKind::output:
            return exit_output;
        case ErrorKind::project:
            return exit_project;
        case ErrorKind::internal:
            break;
    }
    return exit_internal;
}

}  // namespace eyrie::cli

namespace {

int commandOf(int argc, char** argv) {
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
    eyrie::cli::addBatchCommand(app, exit_code);
    eyrie::cli::addWatchCommand(app, exit_code);
    eyrie::cli::addEvaluateCommand(app, exit_code);
    eyrie::cli::addEventsCommand(app, exit_code);
    eyrie::cli::addReportCommand(app, exit_code);
    eyrie::cli::addRenderCommand(app, exit_code);
    eyrie::cli::addParamsCommand(app, exit_code);
    eyrie::cli::addBenchCommand(app, exit_code);
    eyrie::cli::addCompareCommand(app, exit_code);
    eyrie::cli::addSweepCommand(app, exit_code);
    eyrie::cli::addMergeCommand(app, exit_code);
    eyrie::cli::addInfoCommand(app, exit_code);
    eyrie::cli::addMetadataCommand(app, exit_code);
    eyrie::cli::addTrainCommand(app, exit_code);
    eyrie::cli::addClassifyCommand(app, exit_code);
    eyrie::cli::addClassifyTestCommand(app, exit_code);
    eyrie::cli::addImportCommand(app, exit_code);
    eyrie::cli::addExportCommand(app, exit_code);
    eyrie::cli::addGeoreferenceCommand(app, exit_code);
    eyrie::cli::addClipCommand(app, exit_code);
    eyrie::cli::addCheckCommand(app, exit_code);
    eyrie::cli::addBackupsCommand(app, exit_code);
    eyrie::cli::addRestoreCommand(app, exit_code);
    eyrie::cli::addManualCommand(app, exit_code);
    try {
        app.parse(argc, argv);
        return exit_code;
    } catch (const CLI::ParseError& error) {
        const bool asked = error.get_exit_code() == 0;  // for help or the version
        const auto better = asked ? std::nullopt : eyrie::cli::explainUsage(app, {argv + 1, argv + argc});
        if (better) {
            std::fprintf(stderr, "eyrie-cli: %s\n", better->c_str());
        } else if (asked) {
            app.exit(error);
        } else {
            const auto chosen = app.get_subcommands();
            std::fprintf(stderr, "eyrie-cli: %s; eyrie-cli %s--help tells more\n", error.what(),
                         chosen.empty() ? "" : (chosen.front()->get_name() + ' ').c_str());
        }
        return asked ? eyrie::cli::exit_ok : eyrie::cli::exit_usage;
    } catch (const eyrie::Error& error) {
        std::fprintf(stderr, "eyrie-cli: %s\n", error.what());
        return eyrie::cli::exitCodeOf(error.kind());
    } catch (const std::filesystem::filesystem_error& error) {
        std::fprintf(stderr, "eyrie-cli: %s: %s\n", eyrie::displayText(error.path1()).c_str(),
                     error.code().message().c_str());
        return eyrie::cli::exit_input;
    } catch (const std::bad_alloc&) {
        std::fputs("eyrie-cli: not enough memory; close other programs or use fewer frames\n", stderr);
        return eyrie::cli::exit_input;
    } catch (const std::exception& error) {
        std::fprintf(stderr, "eyrie-cli: unexpected: %s\n", error.what());
        return eyrie::cli::exit_internal;
    }
}

}  // namespace

namespace eyrie::cli {

int runProgram(int argc, char** argv) {
    prepareStreams();
    const int exit_code = commandOf(argc, argv);
    const bool printed = finishOutput();
    return exit_code == exit_ok && !printed ? exit_output : exit_code;
}

}  // namespace eyrie::cli
