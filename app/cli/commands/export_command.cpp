#include <CLI/CLI.hpp>
#include <cstdio>
#include <memory>
#include <utility>

#include "cli/arguments/described_sequence.h"
#include "cli/arguments/earlier_state.h"
#include "cli/arguments/event_arguments.h"
#include "cli/arguments/input.h"
#include "cli/arguments/label_arguments.h"
#include "cli/arguments/output_arguments.h"
#include "cli/arguments/video_arguments.h"
#include "cli/command.h"
#include "cli/common_options.h"
#include "cli/interrupt.h"
#include "cli/labels_of_project.h"
#include "cli/project_runs.h"
#include "core/error.h"
#include "correction/corrected_run.h"
#include "exchange/project_labels.h"
#include "exchange/run_export.h"
#include "exchange/vmti_export.h"
#include "formats/track_world.h"
#include "store/database/snapshot.h"
#include "store/labels/annotation_store.h"

namespace eyrie::cli {
namespace {

struct ExportArguments {
    std::string project;
    std::optional<int> run;
    bool labels = false;
    bool detections = false;
    bool uncorrected = false;
    std::optional<int> sequence;
    std::string from;
    LabelArguments from_labels;
    std::string format;
    std::string out;
    std::string start;
    ExportOptions options;
    OutputArguments outputs;
    bool clip = false;
    bool keep = false;
};

/// How to write what is `about`, of which `source` names the sequence where nobody did. The names of some files follow
/// from it, so that they are checked only now; nothing was written before.
ExportOptions checkedOptions(const ExportArguments& arguments, const LabelFile& about, const std::string& source) {
    ExportOptions options = arguments.options;
    if (arguments.clip) options.clip = true;
    if (arguments.keep) options.clip = false;
    if (options.sequence.empty()) options.sequence = std::filesystem::path(source).stem().string();
    if (options.sequence.empty()) options.sequence = "sequence";
    std::vector<std::filesystem::path> inputs(about.further_files.begin(), about.further_files.end());
    inputs.insert(inputs.end(), {arguments.project, arguments.from});
    arguments.outputs.check(outputFiles(arguments.out, arguments.format, options), inputs);
    return options;
}

void tellExport(const ExportReport& report, const std::vector<std::string>& notes) {
    std::fputs(reportText(report).c_str(), stdout);
    for (const std::string& note : notes) std::printf("  note        %s\n", note.c_str());
}

void exportFile(const ExportArguments& arguments) {
    LabelFile labels = readLabels(arguments.from, arguments.from_labels.format, importOptionsOf(arguments.from_labels));
    const MotSequence described = describedBeside(arguments.from);
    if (!labels.image_size && !arguments.from_labels.size.empty())
        labels.image_size = parseSize(arguments.from_labels.size);
    if (!labels.image_size) labels.image_size = described.image_size;
    if (!labels.frame_count) labels.frame_count = described.frame_count;
    if (!labels.frame_rate_hz) labels.frame_rate_hz = described.frame_rate_hz;
    const ExportOptions options = checkedOptions(arguments, labels, arguments.from);
    const std::vector<std::string> notes = labels.notes;
    tellExport(writeLabels(std::move(labels), arguments.out, arguments.format, options), notes);
}

/// Answers the exit code.
int exportAnnotations(const ExportArguments& arguments, ProjectFile& project) {
    const SequenceRecord sequence = chosenSequence(project, arguments.sequence);
    const AnnotationSet annotations = readAnnotations(project, sequence.id);
    if (annotations.objects.empty())
        throw Error(ErrorKind::project, arguments.project + ": nobody has labelled " + sequence.path +
                                            " yet; without --labels the tracks of a run are exported");
    const CameraMotion camera = cameraMotionOf(RunStore(project), sequence.id);
    const LabelStream labels = labelStreamOf(annotations, sequence, camera);
    const ExportOptions options = checkedOptions(arguments, labels.about, sequence.path);
    return untilStopped([&](const std::stop_token& stop) {
        tellExport(writeLabels(labels, arguments.out, arguments.format, options, stop), labels.about.notes);
        return exit_ok;  // of what is stopped too late all is written
    });
}

/// Tracks of a run in a copy of its video.
void exportVmti(const ExportArguments& arguments, const RunRecord& run, const LabelStream& labels,
                const FrameSource& video, const std::stop_token& stop) {
    const VmtiReport report = writeVmti(labels, video, arguments.out, {}, stop);
    if (stop.stop_requested()) throw Error(ErrorKind::output, arguments.out + ": stopped before it was written");
    std::printf("%s: a copy of %s with %d VMTI sets of %d targets\n", arguments.out.c_str(), run.sequence.path.c_str(),
                report.frames, report.targets);
    for (const std::string& remark : remarksOn(report, labels.about.world->no_place))
        std::printf("  note        %s\n", remark.c_str());
    for (const std::string& note : labels.about.notes) std::printf("  note        %s\n", note.c_str());
}

/// Answers the exit code.
int exportRun(const ExportArguments& arguments, ProjectFile& project) {
    const RunStore store(project);
    const RunRecord run = chosenRun(store, arguments.project, arguments.run);
    const bool own = arguments.detections || arguments.uncorrected;
    const CorrectedTracks corrected = own ? CorrectedTracks() : readCorrectedTracks(project, run);
    const Snapshot unchanging(project);
    const bool as_video = arguments.format == kVmtiFormat;
    if (as_video) arguments.outputs.check({{arguments.out, FileKind::video}}, {run.sequence.path, arguments.project});
    LabelStream labels = arguments.detections ? labelStreamOf(store, run, true) : labelStreamOf(store, run, corrected);
    const ExportOptions options =
        as_video ? arguments.options : checkedOptions(arguments, labels.about, run.sequence.path);
    return untilStopped([&](const std::stop_token& stop) {
        const auto open = [&] { return openInput(run.sequence.path, 0, stop, run.sequence.frame_rate_hz); };
        const auto start = startOf(arguments.start);
        const auto video = openVideoFor(arguments.format, run, open, stop);
        addWorld(labels, arguments.format, project, run, video.get(), start, stop);
        if (as_video)
            exportVmti(arguments, run, labels, *video, stop);
        else
            tellExport(writeLabels(labels, arguments.out, arguments.format, options, stop), labels.about.notes);
        return exit_ok;
    });
}

/// Answers the exit code.
int exportLabels(const ExportArguments& arguments) {
    if (arguments.format == kVmtiFormat && (!arguments.from.empty() || arguments.labels))
        throw Error(ErrorKind::parameter, "vmti is written from runs: give --project and, if need be, --run");
    if (arguments.format == kVmtiFormat && arguments.detections)
        throw Error(ErrorKind::parameter,
                    "vmti holds targets that are followed, which detections are not: leave --detections out, or choose "
                    "another format");
    if (!arguments.from.empty()) {
        exportFile(arguments);
        return exit_ok;
    }
    ProjectFile project = openForReading(arguments.project);
    return arguments.labels ? exportAnnotations(arguments, project) : exportRun(arguments, project);
}

}  // namespace

void addExportCommand(CLI::App& app, int& exit_code) {
    const auto arguments = std::make_shared<ExportArguments>();
    arguments->options.sequence.clear();
    CLI::App* command =
        app.add_subcommand("export", "Write labels or tracks for other programs; says what their format cannot hold");
    CLI::Option* project = command->add_option("--project", arguments->project, "Project with the labels or runs");
    CLI::Option* run =
        command->add_option("--run", arguments->run, "Tracks of this run (default: the last)")->needs(project);
    CLI::Option* labels =
        command->add_flag("--labels", arguments->labels, "Labels instead of a run")->needs(project)->excludes(run);
    CLI::Option* detections =
        command->add_flag("--detections", arguments->detections, "The run's detections instead of its tracks")
            ->needs(project);
    addUncorrected(*command, arguments->uncorrected);
    command->get_option("--uncorrected")->needs(project)->excludes(labels)->excludes(detections);
    addSequenceNumber(*command, arguments->sequence)->needs(project);
    addStart(*command, arguments->start)->needs(project);
    command->add_option("--from", arguments->from, "File or folder of labels to convert")->excludes(project);
    addLabelOptions(*command, arguments->from_labels, "--from-format", "--from-columns");
    command->add_option("--format", arguments->format, "One of " + formatNames(true) + ", " + kVmtiFormat)->required();
    command->add_option("--out", arguments->out, "File, or folder for formats with a text file per image")->required();
    command->add_option("--columns", arguments->options.columns, "Columns of your own table, for format columns");
    command->add_option("--out-first-frame", arguments->options.first_frame_number,
                        "Number of a video's first frame in such a table (default 0)");
    command->add_option(
        "--out-pixel-origin", arguments->options.first_pixel_edge,
        "Where the first pixel begins in such a table (default 0) and in MOTChallenge text (default 1)");
    CLI::Option* clip = command->add_flag("--clip", arguments->clip, "Clip boxes to the image");
    command->add_flag("--keep-outside", arguments->keep, "Do not clip, not even for YOLO-OBB")->excludes(clip);
    command->add_flag("--unrotated-bounds", arguments->options.unrotated_bounds,
                      "COCO and KWCOCO: bbox is the unrotated box, as DIVE reads it");
    command->add_option("--name", arguments->options.sequence, "Name of the sequence (default: the video's)");
    command->add_option("--benchmark", arguments->options.benchmark, "TrackEval: name of the benchmark")
        ->capture_default_str();
    command->add_option("--split", arguments->options.split, "TrackEval: name of the split")->capture_default_str();
    command->add_option("--tracker", arguments->options.tracker,
                        "TrackEval: write the result of a tracker of this name");
    arguments->outputs.addTo(*command);
    command->callback([arguments, &exit_code] {
        if (arguments->from.empty() == arguments->project.empty()) {
            throw Error(ErrorKind::parameter, "export needs something to write: --project P.eyrie or --from FILE");
        }
        exit_code = exportLabels(*arguments);
    });
}

}  // namespace eyrie::cli
