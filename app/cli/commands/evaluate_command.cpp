#include <CLI/CLI.hpp>
#include <cmath>
#include <cstdio>
#include <memory>

#include "cli/arguments/described_sequence.h"
#include "cli/arguments/earlier_state.h"
#include "cli/arguments/evaluation_arguments.h"
#include "cli/arguments/output_arguments.h"
#include "cli/command.h"
#include "cli/common_options.h"
#include "cli/project_runs.h"
#include "cli/reports/evaluation_text.h"
#include "cli/reports/score_curve_csv.h"
#include "core/error.h"
#include "diagnosis/error_csv.h"
#include "diagnosis/run_evaluation.h"
#include "evaluation/measures/score_curve.h"
#include "io/atomic_file.h"
#include "io/tables/homography_csv.h"
#include "scoring/scoring.h"
#include "store/runs/doubtful_tracks.h"
#include "store/runs/run_store.h"

namespace eyrie::cli {
namespace {

struct EvaluateArguments {
    GroundTruthArguments ground_truth;
    EvaluationArguments evaluation;
    std::string result;
    std::string project;
    std::optional<int> run;
    bool detections = false;
    std::string size;
    std::string homographies;
    std::string convention = "thesis";
    std::string errors;
    std::string score_curve;
    OutputArguments outputs;
    bool json = false;
};

/// The result to be measured and what is known of its video.
struct Result {
    BoxesByFrame boxes;
    std::string name;
    BoxesByFrame doubtful;  ///< of tracks that only their score kept out of the result; for the score curve
    std::optional<RunRecord> run;
    std::vector<Registration> registrations;
};

Result readResult(const EvaluateArguments& arguments) {
    Result result;
    if (arguments.project.empty()) {
        result.boxes = readResultBoxes({arguments.result, arguments.ground_truth.mot_origin});
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
    if (!arguments.detections && !arguments.score_curve.empty()) result.doubtful = store.doubtful().boxes(id);
    if (!arguments.homographies.empty()) result.registrations = store.registrations(id);
    return result;
}

std::optional<cv::Size> knownImageSize(const EvaluateArguments& arguments, const Result& result) {
    if (!arguments.size.empty()) return parseSize(arguments.size);
    if (result.run) return result.run->sequence.size;
    return describedBeside(arguments.ground_truth.file).image_size;
}

cv::Size imageSize(const EvaluateArguments& arguments, const Result& result) {
    if (const auto known = knownImageSize(arguments, result)) return *known;
    throw Error(ErrorKind::parameter,
                "--border needs the size of the image, which neither a project nor a file beside " +
                    arguments.ground_truth.file + " states; add --size WIDTHxHEIGHT");
}

RegistrationError registrationErrorOf(const EvaluateArguments& arguments, const Result& result) {
    TrueHomographies truth;
    for (const Homography& homography : readHomographyCsv(arguments.homographies)) {
        truth[homography.from_frame] = homography.matrix;
    }
    return registrationError(result.registrations, truth, result.run->sequence.size);
}

/// The list of errors at the first T_ov; causes need a stored run.
void writeErrors(const EvaluateArguments& arguments, const Scoring& scoring, const Result& result) {
    const BoxesByFrame& truth = scoring.truth.boxes;
    EvaluationOptions options = scoring.options;
    if (!arguments.evaluation.overlaps.empty()) options.overlap = arguments.evaluation.overlaps.front();
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
    writeErrorCsv(arguments.errors, diagnoser.diagnose(listErrors(truth, result.boxes, input, matches, options),
                                                       {truth, result.boxes, input, matches, options}));
}

/// Precision and recall by score at the first T_ov.
void writeScoreCurve(const EvaluateArguments& arguments, const Scoring& scoring, const Result& result) {
    EvaluationOptions options = scoring.options;
    if (!arguments.evaluation.overlaps.empty()) options.overlap = arguments.evaluation.overlaps.front();
    BoxesByFrame boxes = result.boxes;
    for (const auto& [frame, doubtful] : result.doubtful)
        boxes[frame].insert(boxes[frame].end(), doubtful.begin(), doubtful.end());
    writeFileAtomically(arguments.score_curve, scoreCurveCsv(scoreCurve(scoring.truth.boxes, boxes, options)));
}

GroundTruth readTruth(const EvaluateArguments& arguments, const Result& result) {
    const GroundTruthSource source = arguments.ground_truth.source();
    if (!source.file.empty()) return readGroundTruth(source, knownImageSize(arguments, result));
    ProjectFile project = openForReading(arguments.project);
    return readGroundTruth(source, project, *result.run);
}

void evaluateAndPrint(const EvaluateArguments& arguments) {
    const std::string& truth_file = arguments.ground_truth.file;
    arguments.outputs.check({{arguments.errors, FileKind::text}, {arguments.score_curve, FileKind::text}},
                            {truth_file, arguments.result, arguments.project, arguments.homographies});
    EvaluationOptions wishes = arguments.evaluation.options;
    wishes.convention = arguments.convention == "trackeval" ? Convention::trackeval : Convention::thesis;
    const Result result = readResult(arguments);
    GroundTruth truth = readTruth(arguments, result);
    if (wishes.border) wishes.image_size = imageSize(arguments, result);
    if (wishes.convention == Convention::trackeval) {
        wishes.frame_count = truth_file.empty() ? std::optional(result.run->sequence.frame_count)
                                                : describedBeside(truth_file).frame_count;
    }
    const auto covered = result.run ? std::optional(coveredFrames(*result.run)) : std::nullopt;
    const Scoring scoring = scoringOf(std::move(truth), wishes, covered);

    EvaluationReport report;
    report.options = scoring.options;
    report.remarks = scoring.truth.remarks;
    report.ground_truth = scoring.truth.name;
    report.result = result.name;
    report.measures = evaluateAt(arguments.evaluation.overlaps, scoring.truth.boxes, result.boxes, scoring.options);
    if (!arguments.homographies.empty()) report.registration = registrationErrorOf(arguments, result);
    if (!report.measures.empty()) {
        for (std::string& remark : remarksOn(report.measures.front())) report.remarks.push_back(std::move(remark));
    }
    if (!arguments.errors.empty()) writeErrors(arguments, scoring, result);
    if (!arguments.score_curve.empty()) writeScoreCurve(arguments, scoring, result);
    std::fputs((arguments.json ? jsonText(report) : tableText(report)).c_str(), stdout);
}

}  // namespace

void addEvaluateCommand(CLI::App& app, int& exit_code) {
    const auto arguments = std::make_shared<EvaluateArguments>();
    CLI::App* command = app.add_subcommand("evaluate", "Measure tracks or detections against ground truth");
    arguments->ground_truth.addTo(*command, kLabelsOtherwise);
    CLI::Option* result = command->add_option(
        "--result", arguments->result, "Boxes to measure: Eyrie's CSV, MOTChallenge text, or what else import reads");
    CLI::Option* project =
        command->add_option("--project", arguments->project, "Measure a run of this project instead")->excludes(result);
    addRunNumber(*command, arguments->run)->needs(project);
    command->add_flag("--detections", arguments->detections, "Measure the run's detections instead of its tracks")
        ->needs(project);
    arguments->evaluation.addTo(*command);
    command->add_option("--size", arguments->size, "Size of the image for --border, WIDTHxHEIGHT");
    command
        ->add_option("--homographies", arguments->homographies,
                     "True homographies (frame,h00,…,h22 into a common frame) to measure the registration")
        ->needs(project);
    command->add_option("--convention", arguments->convention, "Whose definitions to follow where they differ")
        ->check(CLI::IsMember({"thesis", "trackeval"}))
        ->capture_default_str();
    command->add_option("--errors", arguments->errors,
                        "Write every miss, false alarm, switch, fragment, split and merge at the first T_ov to this "
                        "CSV file, with probable causes where a run is measured: the most frequent cause of a stretch, "
                        "detail and box of the middle frame that shows it");
    command->add_option("--score-curve", arguments->score_curve,
                        "Write precision, recall and f-score at the first T_ov by the score that a box must have to "
                        "this CSV file; of a run also for tracks that only their score (finishing.min_score) kept out");
    arguments->outputs.addTo(*command);
    addJson(*command, arguments->json);
    command->callback([arguments, &exit_code] {
        if (arguments->result.empty() == arguments->project.empty()) {
            throw Error(ErrorKind::parameter,
                        "evaluate needs something to measure: either --result FILE or --project FILE");
        }
        if (arguments->ground_truth.file.empty() && arguments->project.empty()) {
            throw Error(ErrorKind::parameter,
                        "evaluate needs ground truth: --ground-truth FILE, or the project's labels with --project");
        }
        evaluateAndPrint(*arguments);
        exit_code = exit_ok;
    });
}

}  // namespace eyrie::cli
