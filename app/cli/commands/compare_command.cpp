#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <memory>

#include "chain/scale/scale_estimation.h"
#include "cli/arguments/earlier_state.h"
#include "cli/arguments/evaluation_arguments.h"
#include "cli/arguments/input.h"
#include "cli/arguments/output_arguments.h"
#include "cli/arguments/preset_arguments.h"
#include "cli/arguments/video_arguments.h"
#include "cli/command.h"
#include "cli/common_options.h"
#include "cli/interrupt.h"
#include "cli/reports/comparison/comparison_report.h"
#include "cli/reports/console_progress.h"
#include "cli/reports/run_report.h"
#include "core/error.h"
#include "detection/sliding_window/model_location.h"
#include "evaluation/comparison/published_figures.h"
#include "io/atomic_file.h"
#include "rerun/method_run.h"
#include "scoring/scoring.h"
#include "store/sweeps/comparison_store.h"

namespace eyrie::cli {
namespace {

struct CompareArguments {
    std::string sequence;
    GroundTruthArguments ground_truth;
    EvaluationArguments evaluation;
    VideoArguments video;
    std::vector<std::string> methods;
    std::vector<std::string> stacking{"off"};
    std::vector<std::string> tracking{"off", "on"};
    PresetArguments preset;
    PeerOptions peer;
    std::string project;
    std::string csv;
    std::string published;
    OutputArguments outputs;
    bool json = false;
    bool quiet = false;
};

/// What is asked for by "on" and "off", without repetition.
std::vector<bool> switches(const std::vector<std::string>& words) {
    std::vector<bool> values;
    for (const std::string& word : words) {
        const bool on = word == "on";
        if (std::find(values.begin(), values.end(), on) == values.end()) values.push_back(on);
    }
    return values;
}

bool needsModel(const MethodVariant& variant) {
    return variant.options.detection.method == DetectionMethod::sliding_window;
}

bool hasModel(const ChainOptions& options) {
    try {
        modelLocation(options.detection.sliding_window.model);
        return true;
    } catch (const Error&) {
        return false;
    }
}

/// Takes those settings that are the peer's: they are no parameters of the chain. Throws Error(parameter).
void takePeerSettings(CompareArguments& arguments) {
    std::vector<std::string>& all = arguments.preset.settings;
    const auto others = std::stable_partition(all.begin(), all.end(),
                                              [](const std::string& setting) { return setting.starts_with("peer."); });
    applySettings(describeOf(arguments.peer), {all.begin(), others});
    all.erase(all.begin(), others);
}

/// A method to run, and how its rows are called.
struct Planned {
    std::string word;
    bool stacking = false;
    MethodVariant variant;
};

std::vector<Planned> plan(const CompareArguments& arguments, std::vector<std::string>& remarks) {
    const ChainOptions base = arguments.preset.options();
    const bool chosen = !arguments.methods.empty();
    const std::vector<std::string> words = chosen ? arguments.methods : std::vector<std::string>{"detectors", "peer"};
    std::vector<Planned> all;
    for (const std::string& group : words) {
        for (const std::string& word : methodsNamed(group)) {
            const MethodVariant variant = methodVariant(word, base, arguments.peer);
            if (!chosen && needsModel(variant) && !hasModel(base)) {
                remarks.push_back(word + " was left out: the model that comes with Eyrie is missing");
                continue;
            }
            if (variant.peer) remarks.push_back(word + " is the simplest peer: a three-frame difference with SORT");
            for (const bool stacking : switches(arguments.stacking)) {
                if (stacking && (variant.global_window || variant.peer)) continue;
                all.push_back({word, stacking, withStacking(variant, stacking)});
            }
        }
    }
    return all;
}

/// Stores every method as a run of a project.
class Recorders {
 public:
    Recorders(const std::string& project, const std::vector<Planned>& planned, const RunRecord& like) {
        for (const Planned& method : planned) {
            RunRecord run = like;
            run.name = "compare: " + method.variant.name;
            recorders_.push_back(std::make_unique<RunRecorder>(project, run, method.variant.options));
        }
    }
    void onFrame(std::size_t method, const std::shared_ptr<const FrameResult>& result, const Frame& frame) {
        recorders_[method]->onFrame(result, frame);
    }
    void finish(bool whole) {
        RunSummary summary;
        summary.outcome = whole ? RunOutcome::finished : RunOutcome::stopped;
        summary.message.clear();
        for (const auto& recorder : recorders_) recorder->finish(summary);
    }

 private:
    std::vector<std::unique_ptr<RunRecorder>> recorders_;
};

double laterMs(const StageTimes& times) {
    double sum = 0;
    for (const Stage stage : {Stage::clustering, Stage::stacking, Stage::detection, Stage::removal, Stage::tracking})
        sum += static_cast<double>(times[static_cast<std::size_t>(stage)]);
    return sum;
}

/// Measures every result; the first row is what the others are compared with.
std::vector<ComparisonRow> rowsAt(double overlap, const CompareArguments& arguments, const Scoring& scoring,
                                  const std::vector<Planned>& planned, const std::vector<MethodResult>& results,
                                  const ScoredFrames& frames, double frame_rate_hz) {
    const BoxesByFrame& truth = scoring.truth.boxes;
    EvaluationOptions options = scoring.options;
    options.overlap = overlap;
    std::vector<ComparisonRow> rows;
    std::vector<PairedTallies> tallies;
    for (std::size_t i = 0; i < results.size(); ++i) {
        for (const bool tracking : switches(arguments.tracking)) {
            if (tracking && planned[i].variant.global_window) continue;
            const BoxesByFrame& boxes = tracking ? results[i].tracks : results[i].detections;
            ComparisonRow row;
            row.method = planned[i].word;
            row.stacking = planned[i].stacking;
            row.tracking = tracking;
            row.ms_per_frame = laterMs(results[i].median_ms);
            row.measures = evaluate(truth, boxes, options);
            if (!tracking) row.measures.tracking.reset();  // a frame without results looks like one with ids
            const TrackTallies* tracks = row.measures.tracking ? &row.measures.tracks : nullptr;
            tallies.push_back(pairedTallies(truth, matchFrames(truth, boxes, options), tracks, frames,
                                            std::max(1, cvRound(frame_rate_hz))));
            row.f_score = fScoreInterval(tallies.back());
            if (!rows.empty()) {
                // Like with like: tracks with the first method's tracks, those themselves with its detections.
                const auto like = std::find_if(rows.begin(), rows.end(),
                                               [&](const ComparisonRow& other) { return other.tracking == tracking; });
                const auto reference = static_cast<std::size_t>(like == rows.end() ? 0 : like - rows.begin());
                row.compared_with = rows[reference].name();
                row.difference = methodDifference(tallies.back(), tallies[reference]);
            }
            rows.push_back(std::move(row));
        }
    }
    return rows;
}

int compare(const CompareArguments& arguments) {
    arguments.video.check();
    arguments.outputs.check({growingProject(arguments.project), {arguments.csv, FileKind::text}},
                            {arguments.sequence, arguments.ground_truth.file, arguments.preset.preset});
    ComparisonReport report;
    const std::vector<Planned> planned = plan(arguments, report.remarks);
    return untilStopped([&](const std::stop_token& stop) {
        const auto source = openInput(arguments.sequence, arguments.video.frame_rate_hz.value_or(0), stop,
                                      rememberedRate(arguments.project, arguments.sequence));
        const VideoInfo& video = source->info();
        GroundTruth truth = readGroundTruth(arguments.ground_truth.source(), video.size);
        FrameRange range = arguments.video.range();
        if (range.last < 0) range.last = video.frame_count - 1;
        const StatedScale stated = statedScale(*source, range.first, range.last,
                                               arguments.video.gsd_m_per_px.value_or(0), ScaleOrigin::given, stop);
        const ChosenScale chosen = chooseScale(*source, range, planned.front().variant.options, stated, stop);
        for (std::string& remark : remarksOn(stated, chosen)) report.remarks.push_back(std::move(remark));
        const SceneScale& scale = chosen.scale;

        std::vector<MethodVariant> methods;
        for (const Planned& method : planned) methods.push_back(method.variant);
        std::optional<Recorders> recorders;
        if (!arguments.project.empty()) {
            if (!keepEarlierState(arguments.project, stop)) return exit_stopped;
            RunRecord like = plannedRun(video, scale, range, arguments.preset.preset);
            like.scale_basis = chosen.basis;
            recorders.emplace(arguments.project, planned, like);
        }
        ConsoleProgress console("frames");
        FrameIndex reached = range.first - 1;
        const std::vector<MethodResult> results = runMethods(
            *source, range, methods, scale, stop,
            [&](const RunProgress& progress) {
                reached = range.first + progress.frames_done - 1;
                if (!arguments.quiet) {
                    console.show(progress.frames_done, progress.frames_total, progress.frames_per_second,
                                 progress.seconds_left);
                }
            },
            [&](std::size_t method, const std::shared_ptr<const FrameResult>& result, const Frame& frame) {
                if (recorders) recorders->onFrame(method, result, frame);
            });
        const bool whole = reached == range.last;
        if (recorders) recorders->finish(whole);

        EvaluationOptions wishes = arguments.evaluation.options;
        wishes.image_size = video.size;
        const Scoring scoring = scoringOf(std::move(truth), wishes, ScoredFrames{range.first, reached});
        report.sequence = arguments.sequence;
        report.ground_truth = scoring.truth.name;
        report.frames = reached - range.first + 1;
        report.options = scoring.options;
        report.remarks.insert(report.remarks.end(), scoring.truth.remarks.begin(), scoring.truth.remarks.end());
        for (const double overlap : arguments.evaluation.overlaps) {
            report.blocks.push_back(
                rowsAt(overlap, arguments, scoring, planned, results, {range.first, reached}, scale.frame_rate_hz));
        }
        if (!arguments.project.empty()) {
            ProjectFile project = ProjectFile::open(arguments.project);
            addComparison(project, video.path.string(), jsonText(report));
        }
        if (!arguments.csv.empty()) writeFileAtomically(arguments.csv, csvText(report));
        report.published = arguments.published;
        std::fputs((arguments.json ? jsonText(report) : tableText(report)).c_str(), stdout);
        return whole ? exit_ok : exit_stopped;
    });
}

}  // namespace

void addCompareCommand(CLI::App& app, int& exit_code) {
    const auto arguments = std::make_shared<CompareArguments>();
    CLI::App* command = app.add_subcommand("compare", "Measure several methods on one sequence with ground truth");
    command->add_option("--sequence", arguments->sequence, "A video file, a folder of images, or scene:NAME")
        ->required();
    arguments->ground_truth.addTo(*command)->required();
    command
        ->add_option("--methods", arguments->methods,
                     "Methods, or groups of them: detectors and peer (default; the simplest competitor, three-frame "
                     "difference with SORT), gradients, rescaling, motion; the first one is what the others are "
                     "compared with")
        ->delimiter(',');
    command->add_option("--stacking", arguments->stacking, "off, on, or both: off,on")
        ->delimiter(',')
        ->check(CLI::IsMember({"on", "off"}))
        ->capture_default_str();
    command->add_option("--tracking", arguments->tracking, "off: detections are measured; on: tracks")
        ->delimiter(',')
        ->check(CLI::IsMember({"on", "off"}))
        ->capture_default_str();
    arguments->evaluation.addTo(*command);
    arguments->video.addTo(*command);
    arguments->preset.addTo(*command);
    command->add_option("--project", arguments->project,
                        "Store every method as a run of this project, and the figures beside them");
    command->add_option("--csv", arguments->csv, "Write the figures as CSV, too");
    command
        ->add_option("--published", arguments->published,
                     "Also print what the thesis publishes for this sequence: seq1, seq2, egtest01")
        ->check(CLI::IsMember(publishedSequences()));
    arguments->outputs.addTo(*command);
    addJson(*command, arguments->json);
    addQuiet(*command, arguments->quiet);
    command->callback([arguments, &exit_code] {
        takePeerSettings(*arguments);
        exit_code = compare(*arguments);
    });
}

}  // namespace eyrie::cli
