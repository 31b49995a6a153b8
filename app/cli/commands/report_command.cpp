#include <CLI/CLI.hpp>
#include <cstdio>
#include <memory>

#include "cli/arguments/earlier_state.h"
#include "cli/arguments/evaluation_arguments.h"
#include "cli/arguments/event_arguments.h"
#include "cli/arguments/input.h"
#include "cli/arguments/output_arguments.h"
#include "cli/arguments/video_arguments.h"
#include "cli/command.h"
#include "cli/common_options.h"
#include "cli/interrupt.h"
#include "cli/project_runs.h"
#include "cli/reports/console_progress.h"
#include "cli/reports/pdf_report.h"
#include "core/error.h"
#include "core/time/utc_time.h"
#include "io/file_digest.h"
#include "report/evaluation_report.h"
#include "report/review/review_report.h"

namespace eyrie::cli {
namespace {

struct ReportArguments {
    EvaluationRequest request;
    bool of_events = false;
    EventArguments events;  ///< and the run of either report
    std::vector<int> numbers;
    std::string start;
    GroundTruthArguments ground_truth;
    EvaluationArguments evaluation;
    std::optional<int> against;
    std::size_t chips = ReportOptions().chips;
    std::string out;
    OutputArguments outputs;
};

/// The video of a run; null, with the reason told, where it cannot be read.
std::unique_ptr<FrameSource> pixelsOf(const RunRecord& run, const char* without, const std::stop_token& stop) {
    try {
        return openInput(run.sequence.path, 0, stop, run.sequence.frame_rate_hz);
    } catch (const Error& error) {
        if (stop.stop_requested()) throw;
        std::fprintf(stderr, "eyrie-cli: the report has no %s: %s\n", without, error.what());
        return nullptr;
    }
}

std::string digestOf(const std::string& video, const std::stop_token& stop) {
    ConsoleProgress progress("% of the video hashed");
    try {
        return sha256Of(
            video, [&](double share) { progress.showShare(share); }, stop);
    } catch (const Error& error) {
        std::fprintf(stderr, "eyrie-cli: the report has no hash of the video: %s\n", error.what());
        return {};
    }
}

/// Answers the exit code.
int makeEventReport(const ReportArguments& arguments, const std::stop_token& stop) {
    EventArguments events = arguments.events;
    // Who names events has judged what goes into the report.
    if (events.verdicts.empty() && arguments.numbers.empty())
        events.verdicts = {nameOf(Judgement::relevant), nameOf(Judgement::unsure)};
    if (events.verdicts == std::vector<std::string>{"all"}) events.verdicts.clear();
    EventChoice choice = events.choice();
    choice.numbers = arguments.numbers;
    const auto start = startOf(arguments.start);
    ProjectFile project = openForReading(arguments.events.project);
    const RunRecord run = chosenRun(RunStore(project), arguments.events.project, arguments.events.run);
    arguments.outputs.check({{arguments.out, kindOfReport(arguments.out)}},
                            {arguments.events.project, events.zones, run.sequence.path});
    checkReportCanBeWritten(arguments.out);
    const std::unique_ptr<FrameSource> pixels = pixelsOf(run, "pictures", stop);
    ReviewReportInput input = gatherReviewReport(project, run, choice, pixels.get(), start, stop);
    events.tellZones(input.reviewed);
    for (const int number : arguments.numbers) checkEventNumber(number, input.reviewed);
    if (pixels && pixels->info().container != "scene") input.video_digest = digestOf(run.sequence.path, stop);
    input.made_utc = nowUtc();
    ReportFile report;
    {
        ConsoleProgress progress("% of the pictures");
        report = makeReviewReport(
            input, pixels.get(), [&](double share) { progress.showShare(share); }, stop);
    }
    if (stop.stop_requested()) return exit_stopped;
    if (!writeReport(arguments.out, report, stop)) return exit_stopped;
    std::printf("Report: %s, %s, %zu of %zu events\n", arguments.out.c_str(), runText(run).c_str(),
                countOfEvents(input), input.reviewed.events.size());
    if (countOfEvents(input) == 0 && !input.reviewed.events.empty())
        std::fprintf(stderr, "No event fits the choice%s\n",
                     events.verdicts.empty() ? "" : "; --verdict all leaves verdicts out of it");
    return exit_ok;
}

/// Answers the exit code.
int makeReport(const ReportArguments& arguments) {
    arguments.outputs.check({{arguments.out, kindOfReport(arguments.out)}},
                            {arguments.events.project, arguments.ground_truth.file});
    checkReportCanBeWritten(arguments.out);
    EvaluationRequest request = arguments.request;
    request.project = arguments.events.project;
    request.truth = arguments.ground_truth.source();
    request.options = arguments.evaluation.options;
    {
        ProjectFile project = openForReading(arguments.events.project);
        const RunStore store(project);
        request.run_id = chosenRun(store, arguments.events.project, arguments.events.run).id;
        if (arguments.against) chosenRun(store, arguments.events.project, arguments.against, "--against");
    }
    request.other_run = arguments.against;
    RunEvaluator evaluator;
    const auto evaluation = evaluator.evaluate(request);
    std::unique_ptr<FrameSource> pixels;
    if (arguments.chips > 0) {
        pixels = pixelsOf(evaluation->run, "chips", {});
    }
    ReportOptions options;
    options.made_utc = nowUtc();
    options.chips = arguments.chips;
    const ReportFile report = makeEvaluationReport(*evaluation, pixels.get(), options);
    const InterruptGuard interrupt;
    if (!writeReport(arguments.out, report, interrupt.token())) return exit_stopped;
    std::printf("Report: %s, %s, f-score %.4f at T_ov %g, %zu errors\n", arguments.out.c_str(),
                runText(evaluation->run).c_str(), evaluation->shown.detection.f_score, evaluation->options.overlap,
                evaluation->errors.size());
    return exit_ok;
}

}  // namespace

void addReportCommand(CLI::App& app, int& exit_code) {
    const auto arguments = std::make_shared<ReportArguments>();
    CLI::App* command = app.add_subcommand("report",
                                           "Write one HTML or PDF file about a run: its evaluation, with measures, "
                                           "curves and errors, or its events as judged");
    arguments->events.addRunTo(*command);
    arguments->ground_truth.addTo(*command, kLabelsOtherwise);
    command
        ->add_option("--out", arguments->out,
                     "File to write: PDF where its name ends so (needs the program eyrie beside this one), else "
                     "HTML")
        ->required();
    command->add_option("--against", arguments->against,
                        "Another run over the same video; tells whether the difference is more than chance");
    command->add_flag("--detections", arguments->request.detections, "Measure the run's detections, not its tracks");
    command->add_option("--overlap", arguments->evaluation.options.overlap, "T_ov of errors and curves")
        ->capture_default_str();
    arguments->evaluation.addRuleTo(*command);
    command->add_option("--chips", arguments->chips, "Errors with a picture, at most")->capture_default_str();
    command->add_flag("--events", arguments->of_events,
                      "Report what happened, with pictures and verdicts; needs no ground truth");
    arguments->events.addChoiceTo(*command, "relevant,unsure; all for every event");
    command
        ->add_option("--event", arguments->numbers,
                     "Only these events, by the numbers that eyrie-cli events lists, whatever their verdict: 3,7,12")
        ->delimiter(',');
    arguments->events.addSearchTo(*command);
    addStart(*command, arguments->start);
    arguments->outputs.addTo(*command);
    command->callback([arguments, command, &exit_code] {
        const std::vector<const char*> of_events{"--kind", "--verdict", "--tag",         "--event",
                                                 "--zone", "--set",     "--uncorrected", "--start"};
        const std::vector<const char*> of_evaluations{"--ground-truth", "--against", "--detections", "--overlap",
                                                      "--chips"};
        for (const char* option : arguments->of_events ? of_evaluations : of_events) {
            if (command->count(option) == 0) continue;
            throw Error(
                ErrorKind::parameter,
                std::string(option) + (arguments->of_events ? " belongs to the report of an evaluation; leave "
                                                              "it out, or leave out --events"
                                                            : " belongs to the report of events; add --events"));
        }
        if (arguments->of_events) {
            exit_code = untilStopped([&](const std::stop_token& stop) { return makeEventReport(*arguments, stop); });
            return;
        }
        exit_code = makeReport(*arguments);
    });
}

}  // namespace eyrie::cli
