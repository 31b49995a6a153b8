#include <CLI/CLI.hpp>
#include <cmath>
#include <cstdio>
#include <map>
#include <memory>

#include "cli/arguments/earlier_state.h"
#include "cli/arguments/evaluation_files.h"
#include "cli/arguments/output_arguments.h"
#include "cli/command.h"
#include "cli/labels_of_project.h"
#include "cli/project_runs.h"
#include "cli/reports/evaluation_text.h"
#include "core/error.h"
#include "diagnosis/label_truth.h"
#include "diagnosis/mistake_csv.h"
#include "diagnosis/run_evaluation.h"
#include "io/tables/homography_csv.h"
#include "store/runs/run_store.h"

namespace eyrie::cli {
namespace {

struct EvaluateArguments {
    std::string ground_truth;
    std::string result;
    std::string project;
    std::optional<int> run;
    bool detections = false;
    std::vector<double> overlaps{0.1, 0.2, 0.3};
    EvaluationOptions options;
    std::string size;
    std::string homographies;
    std::string convention = "thesis";
    std::optional<double> mot_origin;
    std::string errors;
    OutputArguments outputs;
    bool json = false;
};

/// The result to be measured and what is known of its video.
struct Result {
    BoxesByFrame boxes;
    std::string name;
    std::optional<RunRecord> run;
    std::vector<Registration> registrations;
};

/// Joins how each frame was registered with how that ended.
std::vector<Registration> registrationsOf(const RunStore& store, int run_id) {
    std::map<FrameIndex, RegistrationState> states;
    for (const FrameSummary& frame : store.frameSummaries(run_id)) states[frame.frame] = frame.state;
    std::vector<Registration> registrations;
    for (const Homography& homography : store.homographies(run_id)) {
        const auto state = states.find(homography.to_frame);
        if (state == states.end()) continue;
        registrations.push_back({state->second, homography, {}});
    }
    return registrations;
}

Result readResult(const EvaluateArguments& arguments) {
    Result result;
    if (arguments.project.empty()) {
        result.boxes = readResultBoxes(arguments.result, arguments.mot_origin).boxes;
        result.name = arguments.result;
        return result;
    }
    ProjectFile project = openForReading(arguments.project);
    const RunStore store(project);
    result.run = chosenRun(store, arguments.project, arguments.run);
    const int id = result.run->id;
    result.boxes = arguments.detections ? store.detectionBoxes(id) : store.trackBoxes(id);
    result.name =
        arguments.project + ", run " + std::to_string(id) + (arguments.detections ? ", detections" : ", tracks");
    if (!arguments.homographies.empty()) result.registrations = registrationsOf(store, id);
    return result;
}

/// Drops true objects of frames that the run never reached; says so.
void keepFramesOfRun(BoxesByFrame& truth, const RunRecord& run, std::vector<std::string>& remarks) {
    const FrameIndex end = run.first_frame + run.frames_done;
    const std::size_t all = truth.size();
    std::erase_if(truth, [&](const auto& entry) { return entry.first < run.first_frame || entry.first >= end; });
    if (truth.size() == all) return;
    remarks.push_back("the run covers frames " + std::to_string(run.first_frame) + " to " + std::to_string(end - 1) +
                      ", so " + std::to_string(all - truth.size()) + " of " + std::to_string(all) +
                      " frames of the ground truth were left out");
}

std::optional<cv::Size> knownImageSize(const EvaluateArguments& arguments, const Result& result) {
    if (!arguments.size.empty()) return parseSize(arguments.size);
    if (result.run) return result.run->sequence.size;
    return describedBeside(arguments.ground_truth).image_size;
}

cv::Size imageSize(const EvaluateArguments& arguments, const Result& result) {
    if (const auto known = knownImageSize(arguments, result)) return *known;
    throw Error(ErrorKind::parameter,
                "--border needs the size of the image, which neither a project nor a file beside " +
                    arguments.ground_truth + " tells; add --size WIDTHxHEIGHT");
}

RegistrationError registrationErrorOf(const EvaluateArguments& arguments, const Result& result) {
    TrueHomographies truth;
    for (const Homography& homography : readHomographyCsv(arguments.homographies)) {
        truth[homography.from_frame] = homography.matrix;
    }
    return registrationError(result.registrations, truth, result.run->sequence.size);
}

/// The list of errors at the first T_ov; causes need a stored run.
void writeErrors(const EvaluateArguments& arguments, const BoxesByFrame& truth, const Result& result,
                 EvaluationOptions options) {
    options.overlap = arguments.overlaps.empty() ? options.overlap : arguments.overlaps.front();
    const EvaluationInput input = prepareEvaluation(truth, result.boxes, options);
    const std::vector<FrameMatch> matches = matchFrames(input, options);
    DiagnosisSource source;
    std::optional<ProjectFile> project;
    std::optional<RunStore> store;
    if (result.run) {
        project = openForReading(arguments.project);
        store.emplace(*project);
        source = diagnosisSource(*store, *result.run);
    }
    Diagnoser diagnoser(std::move(source));
    writeMistakeCsv(arguments.errors, diagnoser.diagnose(listMistakes(truth, result.boxes, input, matches, options),
                                                         {truth, result.boxes, input, matches, options}));
}

/// The file that was named, else what people labelled in the project.
BoxFile readTruth(const EvaluateArguments& arguments, const Result& result) {
    BoxFile truth;
    if (!arguments.ground_truth.empty()) {
        truth = readTruthBoxes(arguments.ground_truth, arguments.mot_origin, knownImageSize(arguments, result));
        if (truth.boxes.empty()) throw Error(ErrorKind::input, arguments.ground_truth + ": holds no box");
        return truth;
    }
    ProjectFile project = openForReading(arguments.project);
    needLabels(project, *result.run);
    truth.boxes = labelTruth(project, *result.run);
    return truth;
}

void evaluateAndPrint(const EvaluateArguments& arguments) {
    arguments.outputs.check({{arguments.errors, FileKind::text}},
                            {arguments.ground_truth, arguments.result, arguments.project, arguments.homographies});
    EvaluationReport report;
    report.options = arguments.options;
    EvaluationOptions& options = report.options;
    options.convention = arguments.convention == "trackeval" ? Convention::trackeval : Convention::thesis;

    const Result result = readResult(arguments);
    BoxFile truth = readTruth(arguments, result);
    report.remarks = truth.remarks;
    if (result.run) keepFramesOfRun(truth.boxes, *result.run, report.remarks);
    report.ground_truth =
        arguments.ground_truth.empty() ? "labels of the project " + arguments.project : arguments.ground_truth;
    report.result = result.name;

    if (options.border) options.image_size = imageSize(arguments, result);
    if (options.convention == Convention::trackeval) {
        options.frame_count = arguments.ground_truth.empty() ? std::optional(result.run->sequence.frame_count)
                                                             : describedBeside(arguments.ground_truth).frame_count;
    }
    if (!options.upright && allUpright(truth.boxes) && !allUpright(result.boxes)) {
        if (!truth.has_headings) {
            options.upright = true;
            report.remarks.push_back(truth.format +
                                     ": boxes are upright, so the enclosing boxes of the result are compared");
        } else {
            report.remarks.push_back("the ground truth has upright boxes only; if it has no headings, add --upright");
        }
    }
    report.measures = evaluateAt(arguments.overlaps, truth.boxes, result.boxes, options);
    if (!arguments.homographies.empty()) report.registration = registrationErrorOf(arguments, result);
    if (!report.measures.empty()) {
        for (std::string& remark : remarksOn(report.measures.front())) report.remarks.push_back(std::move(remark));
    }
    if (!arguments.errors.empty()) writeErrors(arguments, truth.boxes, result, options);
    std::fputs((arguments.json ? jsonText(report) : tableText(report)).c_str(), stdout);
}

}  // namespace

void addEvaluateCommand(CLI::App& app, int& exit_code) {
    const auto arguments = std::make_shared<EvaluateArguments>();
    CLI::App* command = app.add_subcommand("evaluate", "Measure tracks or detections against ground truth");
    command->add_option("--ground-truth", arguments->ground_truth,
                        "Ground truth, in any format that import reads (default: the project's labels of the video)");
    CLI::Option* result = command->add_option(
        "--result", arguments->result, "Boxes to measure: Eyrie's CSV, MOTChallenge text, or what else import reads");
    CLI::Option* project =
        command->add_option("--project", arguments->project, "Measure a run of this project instead")->excludes(result);
    command->add_option("--run", arguments->run, "Number of the run (default: the last)")->needs(project);
    command->add_flag("--detections", arguments->detections, "Measure the run's detections instead of its tracks")
        ->needs(project);
    command
        ->add_option("--overlap", arguments->overlaps,
                     "Smallest overlap T_ov at which a box counts as found; several are possible")
        ->capture_default_str();
    command->add_flag("--vehicles", arguments->options.vehicles_only,
                      "Only vehicles count; other objects of the ground truth are ignored");
    command->add_flag("--upright", arguments->options.upright,
                      "Compare enclosing upright boxes, for ground truth without headings");
    command->add_option("--border", arguments->options.border,
                        "Leave out results that come this close to the image's edge, px");
    command->add_option("--size", arguments->size, "Size of the image for --border, WIDTHxHEIGHT");
    command
        ->add_option("--homographies", arguments->homographies,
                     "True homographies (frame,h00,…,h22 into a common frame) to measure the registration")
        ->needs(project);
    command->add_option("--convention", arguments->convention, "Whose definitions to follow where they differ")
        ->check(CLI::IsMember({"thesis", "trackeval"}))
        ->capture_default_str();
    command->add_option("--mot-origin", arguments->mot_origin, motOriginHelp());
    command->add_option("--errors", arguments->errors,
                        "Write every miss, false alarm, switch, fragment, split and merge at the first T_ov to this "
                        "CSV file, with probable causes where a run is measured: the most frequent cause of a stretch, "
                        "detail and box of the middle frame that shows it");
    arguments->outputs.addTo(*command);
    command->add_flag("--json", arguments->json, "Print JSON");
    command->callback([arguments, &exit_code] {
        if (arguments->result.empty() == arguments->project.empty()) {
            throw Error(ErrorKind::parameter, "evaluate needs what to measure: either --result FILE or --project FILE");
        }
        if (arguments->ground_truth.empty() && arguments->project.empty()) {
            throw Error(ErrorKind::parameter,
                        "evaluate needs ground truth: --ground-truth FILE, or the project's labels with --project");
        }
        evaluateAndPrint(*arguments);
        exit_code = exit_ok;
    });
}

}  // namespace eyrie::cli
