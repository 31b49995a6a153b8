#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <memory>

#include "chain/recording/run_recorder.h"
#include "cli/arguments/earlier_state.h"
#include "cli/arguments/output_arguments.h"
#include "cli/arguments/preset_arguments.h"
#include "cli/arguments/sweep_arguments.h"
#include "cli/batch/batch_inputs.h"
#include "cli/command.h"
#include "cli/common_options.h"
#include "cli/interrupt.h"
#include "cli/project_runs.h"
#include "cli/reports/console_progress.h"
#include "core/error.h"
#include "io/atomic_file.h"
#include "io/tables/preset_file.h"
#include "sweep/results/sweep_report.h"
#include "sweep/sweep_lock.h"

namespace eyrie::cli {
namespace {

struct SweepArguments {
    SweepSources sources;
    std::vector<std::string> axes;
    PresetArguments preset;
    bool preset_given = false;
    std::string out;
    std::string name;
    std::string shard;
    bool resume = false;
    bool yes = false;
    std::string criterion = "f_score";
    std::string of;
    std::string csv;
    std::string save_preset;
    OutputArguments outputs;
    bool json = false;
    bool quiet = false;
};

/// The positions to do, of "3/8" those of that part.
std::vector<int> chosenPositions(const SweepPlan& plan, const std::string& shard) {
    const std::vector<int> order = workOrder(plan);
    if (shard.empty()) return order;
    const Shard chosen = shardFrom(shard);
    return shardOf(order, chosen.part, chosen.parts);
}

/// Parameters that all points share. Of stored runs they are those of the first, unless a preset is named.
ChainOptions baseOptions(const SweepArguments& arguments, const std::vector<StoredRun>& runs) {
    if (runs.empty() || arguments.preset_given) return arguments.preset.options();
    ChainOptions options = runs.front().options;
    PresetArguments settings = arguments.preset;
    settings.preset = "default";
    settings.applySettings(options);
    return options;
}

SweepCriterion criterionOf(const SweepArguments& arguments, const SweepPlan& plan) {
    SweepCriterion criterion = usualCriterion(plan);
    criterion.key = measureText(arguments.criterion).key;
    if (!arguments.of.empty()) criterion.tracks = arguments.of == "tracks";
    if (isOfTracks(measureText(criterion.key).group)) criterion.tracks = true;
    return criterion;
}

/// Before anything is read: a million values take their time.
void refuseTooMany(const std::vector<std::string>& axes, bool yes) {
    double points = 1;
    for (const std::string& axis : axes) points *= countValues(axis);
    if (yes || points <= kManyPoints) return;
    char text[40];
    std::snprintf(text, sizeof text, "%.0f", points);
    throw Error(ErrorKind::parameter,
                "the sweep has " + std::string(text) + " points; add --yes if that is meant, or use a larger step");
}

/// Runs what is missing; answers whether all was done.
bool runMissing(const SweepArguments& arguments, const SweepPlan& plan, const std::vector<SweepInput>& inputs,
                std::vector<int> positions, ProjectFile& project, int sweep, const std::stop_token& stop) {
    const std::set<int> done = SweepStore(project).pointsDone(sweep);
    std::erase_if(positions, [&](int position) { return done.count(position) > 0; });
    if (positions.empty()) return true;
    const auto lock = lockSweep(project, sweep);
    ConsoleProgress console("points");
    SweepRunOptions options;
    options.on_point = [&](const SweepPoint& point) { storePoint(project, sweep, point); };
    std::string doing;
    options.on_progress = [&](const SweepProgress& progress) {
        if (arguments.quiet) return;
        if (progress.doing.empty() || progress.points_done > 0) {
            console.show(progress.points_done, progress.points_total, progress.points_per_second,
                         progress.seconds_left);
            return;
        }
        const std::string stage = progress.doing.substr(0, progress.doing.find(','));
        if (stage != doing) std::fprintf(stderr, "%s once for all points\n", stage.c_str());
        doing = stage;
    };
    const int reached = runSweep(plan, inputs, positions, stop, options);
    return reached == static_cast<int>(positions.size());
}

void savePreset(const std::string& file, const SweepTable& table, const SweepCriterion& criterion) {
    const auto best = bestPoint(table, criterion);
    if (!best) throw Error(ErrorKind::parameter, "--save-preset: there is no best point yet");
    const ChainOptions options = table.plan.optionsOf(best->position);
    writePreset(file, {"best of " + table.plan.describe(best->position), parameterValues(options)});
}

void checkOutputs(const SweepArguments& arguments) {
    const SweepSources& sources = arguments.sources;
    std::vector<std::filesystem::path> inputs(sources.sequences.begin(), sources.sequences.end());
    inputs.insert(inputs.end(), sources.ground_truths.begin(), sources.ground_truths.end());
    inputs.insert(inputs.end(), {sources.project, arguments.preset.preset});
    OutputArguments outputs = arguments.outputs;
    outputs.force = outputs.force || arguments.resume;  // the same command again replaces what it wrote
    outputs.check({growingProject(arguments.out.empty() ? sources.project : arguments.out),
                   {arguments.csv, FileKind::text},
                   {arguments.save_preset, FileKind::json}},
                  inputs);
}

int sweep(const SweepArguments& arguments) {
    if (arguments.sources.sequences.empty() == arguments.sources.project.empty()) {
        throw Error(ErrorKind::parameter,
                    "sweep needs something to work on: either --sequence with --ground-truth, or --project");
    }
    if (arguments.out.empty() && arguments.sources.project.empty())
        throw Error(ErrorKind::parameter,
                    "--out: name the file that the points are written to, e.g. --out sweep.eyrie");
    measureText(arguments.criterion);
    refuseTooMany(arguments.axes, arguments.yes);
    checkOutputs(arguments);
    std::vector<StoredRun> runs;
    if (!arguments.sources.project.empty()) {
        ProjectFile project = ProjectFile::open(arguments.sources.project, ProjectFile::Mode::read_only);
        for (const int run : arguments.sources.runs) runs.push_back(readStoredRun(project, run));
        if (runs.empty())
            runs.push_back(readStoredRun(project, chosenRun(RunStore(project), project.path().string(), {}).id));
    }
    const ChainOptions base = baseOptions(arguments, runs);
    SweepPlan plan;
    plan.engine_version = engineVersion();
    for (const std::string& axis : arguments.axes) plan.axes.push_back(parseAxis(axis, base));
    plan.base = parameterValues(base);
    const EvaluationArguments& evaluation = arguments.sources.evaluation;
    plan.overlaps = evaluation.overlaps;
    plan.vehicles_only = evaluation.options.vehicles_only;
    plan.one_class = evaluation.options.one_class;
    plan.border = evaluation.options.border;
    chosenPositions(plan, arguments.shard);  // shows a wrong shard before anything is opened

    return untilStopped([&](const std::stop_token& stop) {
        OpenedClips opened = runs.empty() ? openSequences(arguments.sources, base, arguments.out, stop)
                                          : openStoredRuns(arguments.sources, std::move(runs), base);
        plan.clips = opened.clips;
        check(plan);
        const std::string& out = arguments.out.empty() ? arguments.sources.project : arguments.out;
        if (!keepEarlierState(out, stop)) return exit_stopped;
        ProjectFile project = ProjectFile::openOrCreate(out);
        const bool goes_on = arguments.resume || !arguments.shard.empty();
        const int id = beginSweep(project, plan, arguments.name, goes_on ? SweepFound::resumed : SweepFound::refused);
        const bool whole =
            runMissing(arguments, plan, opened.inputs, chosenPositions(plan, arguments.shard), project, id, stop);

        const SweepTable table = readSweep(project, id);
        const SweepCriterion criterion = criterionOf(arguments, plan);
        if (!arguments.csv.empty()) writeFileAtomically(arguments.csv, csvText(table));
        // Stopped before its first point it has no best one.
        if (!arguments.save_preset.empty() && (whole || bestPoint(table, criterion)))
            savePreset(arguments.save_preset, table, criterion);
        std::fputs((arguments.json ? jsonText(table, criterion) : tableText(table, criterion)).c_str(), stdout);
        for (const std::string& remark : opened.remarks) std::fprintf(stderr, "note: %s\n", remark.c_str());
        if (!whole) {
            std::fprintf(stderr,
                         "stopped; %s keeps the finished points, the same command with --resume does the rest\n",
                         project.path().string().c_str());
        }
        return whole ? exit_ok : exit_stopped;
    });
}

void addBest(CLI::App& command, std::string& criterion) {
    command.add_option("--best", criterion, "The measure that decides which point is best")->capture_default_str();
}

void addFiguresCsv(CLI::App& command, std::string& csv) {
    command.add_option("--csv", csv, "Write all figures as CSV");
}

}  // namespace

void addSweepCommand(CLI::App& app, int& exit_code) {
    const auto arguments = std::make_shared<SweepArguments>();
    CLI::App* command =
        app.add_subcommand("sweep", "Try many values of one or two parameters on sequences with ground truth");
    SweepSources& sources = arguments->sources;
    CLI::Option* sequence = command->add_option("--sequence", sources.sequences,
                                                "A video file, a folder of images, or scene:NAME; may be repeated");
    command->add_option("--ground-truth", sources.ground_truths,
                        "Ground truth of each sequence, in any format that import reads (with --project: default the "
                        "project's labels)");
    command->add_option("--project", sources.project, "Sweep over a stored run, whose motion vectors are used again")
        ->excludes(sequence);
    command
        ->add_option("--run", sources.runs,
                     "Numbers of the runs, e.g. 2 or 2,5 (default: the last); parameters are those of the first")
        ->delimiter(',')
        ->needs("--project");
    command
        ->add_option("--parameter", arguments->axes,
                     "What to change: NAME=FIRST:STEP:LAST or NAME=VALUE,VALUE,…; once or twice")
        ->required();
    sources.evaluation.addTo(*command);
    command->add_option("--gsd", sources.gsds,
                        "Ground sampling distance in metres per pixel: one, or one for each sequence");
    sources.video.addTimeTo(*command);
    sources.ground_truth.addOriginTo(*command);
    arguments->preset.addTo(*command);
    command->add_option("--out", arguments->out, "Project file for the points; made when it does not exist");
    command->add_option("--name", arguments->name, "A name for the sweep");
    command->add_option("--shard", arguments->shard,
                        "Do only one part of the points, PART/PARTS, e.g. 2/8; eyrie-cli merge joins them");
    command->add_flag("--resume", arguments->resume, "Resume a sweep that was stopped");
    command->add_flag("--yes", arguments->yes, "Start even with more than 10000 points");
    addBest(*command, arguments->criterion);
    command->add_option("--of", arguments->of, "Judge detections or tracks (default: by the parameters)")
        ->check(CLI::IsMember({"detections", "tracks"}));
    addFiguresCsv(*command, arguments->csv);
    command->add_option("--save-preset", arguments->save_preset, "Write the parameters of the best point as a preset");
    arguments->outputs.addTo(*command);
    addJson(*command, arguments->json);
    addQuiet(*command, arguments->quiet);
    command->callback([arguments, command, &exit_code] {
        arguments->preset_given = command->count("--preset") > 0;
        exit_code = sweep(*arguments);
    });
}

void addMergeCommand(CLI::App& app, int& exit_code) {
    struct MergeArguments {
        std::vector<std::string> files;
        std::string out;
        std::string criterion = "f_score";
        std::string csv;
        OutputArguments outputs;
        bool add = false;
        bool json = false;
    };
    const auto arguments = std::make_shared<MergeArguments>();
    CLI::App* command = app.add_subcommand("merge", "Join the parts of a sweep that several machines did");
    command->add_option("files", arguments->files, "Project files written by sweep --shard")->required();
    command->add_option("--out", arguments->out, "Project file for the whole sweep, none of the parts")->required();
    command->add_flag("--add", arguments->add, "Add the sweep to --out where that project exists already");
    addBest(*command, arguments->criterion);
    addFiguresCsv(*command, arguments->csv);
    arguments->outputs.addTo(*command);
    addJson(*command, arguments->json);
    command->callback([arguments, &exit_code] {
        std::error_code ignored;
        const bool exists = std::filesystem::exists(arguments->out, ignored);
        const bool is_part = std::any_of(arguments->files.begin(), arguments->files.end(), [&](const auto& file) {
            return std::filesystem::equivalent(file, arguments->out, ignored);
        });
        if (exists && !is_part && !arguments->add) {
            throw Error(ErrorKind::parameter, "--out " + arguments->out +
                                                  ": exists already; choose another name, or use --add to put the "
                                                  "sweep into that project");
        }
        arguments->outputs.check({growingProject(arguments->out), {arguments->csv, FileKind::text}},
                                 {arguments->files.begin(), arguments->files.end()});
        keepEarlierState(arguments->out);
        const SweepTable table = mergeSweeps({arguments->files.begin(), arguments->files.end()}, arguments->out);
        SweepCriterion criterion = usualCriterion(table.plan);
        criterion.key = measureText(arguments->criterion).key;
        if (!arguments->csv.empty()) writeFileAtomically(arguments->csv, csvText(table));
        std::fputs((arguments->json ? jsonText(table, criterion) : tableText(table, criterion)).c_str(), stdout);
        const std::vector<int> missing = table.missing();
        if (exists) std::fprintf(stderr, "note: the sweep was added to %s\n", arguments->out.c_str());
        if (!missing.empty()) {
            std::fprintf(stderr, "eyrie-cli: %zu of %d points are missing: %s\n", missing.size(),
                         table.plan.pointCount(), listOf(table.plan, missing).c_str());
        }
        exit_code = missing.empty() ? exit_ok : exit_input;
    });
}

}  // namespace eyrie::cli
