#include <CLI/CLI.hpp>
#include <cstdio>
#include <memory>

#include "cli/arguments/earlier_state.h"
#include "cli/arguments/evaluation_arguments.h"
#include "cli/arguments/input.h"
#include "cli/arguments/output_arguments.h"
#include "cli/command.h"
#include "cli/project_runs.h"
#include "core/error.h"
#include "core/utc_time.h"
#include "report/evaluation_report.h"

namespace eyrie::cli {
namespace {

struct ReportArguments {
    EvaluationRequest request;
    std::string project;
    GroundTruthArguments ground_truth;
    EvaluationArguments evaluation;
    std::optional<int> run;
    std::optional<int> against;
    std::size_t chips = ReportOptions().chips;
    std::string out;
    OutputArguments outputs;
};

void makeReport(const ReportArguments& arguments) {
    arguments.outputs.check({{arguments.out, FileKind::html}}, {arguments.project, arguments.ground_truth.file});
    EvaluationRequest request = arguments.request;
    request.project = arguments.project;
    request.truth = arguments.ground_truth.source();
    request.options = arguments.evaluation.options;
    {
        ProjectFile project = openForReading(arguments.project);
        const RunStore store(project);
        request.run_id = chosenRun(store, arguments.project, arguments.run).id;
        if (arguments.against) chosenRun(store, arguments.project, arguments.against, "--against");
    }
    request.other_run = arguments.against;
    RunEvaluator evaluator;
    const auto evaluation = evaluator.evaluate(request);
    std::unique_ptr<FrameSource> pixels;
    if (arguments.chips > 0) {
        try {
            pixels = openInput(evaluation->run.sequence.path, evaluation->run.sequence.frame_rate_hz, {});
        } catch (const Error& error) {
            std::fprintf(stderr, "eyrie-cli: the report has no chips: %s\n", error.what());
        }
    }
    ReportOptions options;
    options.made_utc = nowUtc();
    options.chips = arguments.chips;
    writeHtmlReport(arguments.out, makeEvaluationReport(*evaluation, pixels.get(), options));
    std::printf("Report: %s, f-score %.4f at T_ov %g, %zu errors\n", arguments.out.c_str(),
                evaluation->shown.detection.f_score, evaluation->options.overlap, evaluation->mistakes.size());
}

}  // namespace

void addReportCommand(CLI::App& app, int& exit_code) {
    const auto arguments = std::make_shared<ReportArguments>();
    CLI::App* command = app.add_subcommand(
        "report", "Write the evaluation of a run as one HTML file: parameters, measures, curves, errors with pictures");
    command->add_option("--project", arguments->project, "Project that holds the run")->required();
    command->add_option("--run", arguments->run, "Number of the run (default: the last)");
    arguments->ground_truth.addTo(*command, kLabelsOtherwise);
    command->add_option("--out", arguments->out, "HTML file to write")->required();
    command->add_option("--against", arguments->against,
                        "Another run over the same video; tells whether the difference is more than chance");
    command->add_flag("--detections", arguments->request.detections, "Measure the run's detections, not its tracks");
    command->add_option("--overlap", arguments->evaluation.options.overlap, "T_ov of errors and curves")
        ->capture_default_str();
    arguments->evaluation.addRuleTo(*command);
    command->add_option("--chips", arguments->chips, "Errors with a picture, at most")->capture_default_str();
    arguments->outputs.addTo(*command);
    command->callback([arguments, &exit_code] {
        makeReport(*arguments);
        exit_code = exit_ok;
    });
}

}  // namespace eyrie::cli
