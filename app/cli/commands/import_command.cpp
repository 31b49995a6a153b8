#include <CLI/CLI.hpp>
#include <cstdio>
#include <memory>
#include <optional>
#include <utility>

#include "cli/arguments/earlier_state.h"
#include "cli/arguments/input.h"
#include "cli/arguments/label_arguments.h"
#include "cli/arguments/output_arguments.h"
#include "cli/command.h"
#include "cli/common_options.h"
#include "cli/labels_of_project.h"
#include "core/error.h"
#include "exchange/label_import.h"
#include "exchange/project_labels.h"
#include "formats/frame_offset.h"
#include "store/labels/annotation_store.h"

namespace eyrie::cli {
namespace {

struct ImportArguments {
    std::string file;
    LabelArguments labels;
    std::string project;
    std::string video;
    std::optional<int> sequence;
    std::string out;
    OutputArguments outputs;
    double tolerance_px = 0.45;  // less than half: whole pixels come back as they were
    bool show = false;
    bool add_doubles = false;
    bool link = false;
};

/// What the project says against the labels, if anything: another size, a shift in time.
std::vector<std::string> doubtsAbout(const LabelFile& labels, ProjectFile& project, const SequenceRecord& sequence) {
    std::vector<std::string> doubts;
    if (labels.image_size && sequence.size.width > 0 && *labels.image_size != sequence.size) {
        doubts.push_back("the labels are for images of " + std::to_string(labels.image_size->width) + "×" +
                         std::to_string(labels.image_size->height) + ", the video has " +
                         std::to_string(sequence.size.width) + "×" + std::to_string(sequence.size.height) +
                         "; is a --scale missing?");
    }
    const RunStore store(project);
    const std::optional<RunRecord> run = lastRunOver(store, sequence.id);
    const auto guess = run ? guessFrameOffset(plainBoxes(labels.boxes), store.trackBoxes(run->id)) : std::nullopt;
    if (guess && guess->shift != 0 && guess->overlap > guess->overlap_as_is + 0.02) {
        char text[160];
        std::snprintf(text, sizeof text, "tracks of run %d fit %.2f as it is and %.2f with --shift %d more", run->id,
                      guess->overlap_as_is, guess->overlap, guess->shift);
        doubts.emplace_back(text);
    } else if (guess) {
        char text[120];
        std::snprintf(text, sizeof text, "tracks of run %d fit best as it is (mean overlap %.2f)", run->id,
                      guess->overlap);
        doubts.emplace_back(text);
    }
    return doubts;
}

bool isThere(const std::string& project) {
    std::error_code failed;
    return std::filesystem::exists(project, failed);
}

/// The video that the labels belong to, where it was named and is needed.
std::unique_ptr<FrameSource> openedVideo(const ImportArguments& arguments) {
    if (arguments.video.empty() || arguments.show) return nullptr;
    return openInput(arguments.video, 0, {}, rememberedRate(arguments.project, arguments.video));
}

/// How many frames that video has, as far as it can be told before anything is done. What keeps it from being told is
/// told where the project is used.
std::optional<int> framesOfVideo(const ImportArguments& arguments, const FrameSource* video) {
    if (video != nullptr) return video->info().frame_count;
    if (!arguments.video.empty() || !isThere(arguments.project)) return std::nullopt;
    try {
        ProjectFile project = ProjectFile::open(arguments.project, ProjectFile::Mode::read_only);
        const int frames = chosenSequence(project, arguments.sequence).frame_count;
        return frames > 0 ? std::optional(frames) : std::nullopt;
    } catch (const Error&) {
        return std::nullopt;
    }
}

SequenceRecord sequenceFor(ProjectFile& project, const ImportArguments& arguments, const FrameSource* video) {
    if (video == nullptr) return chosenSequence(project, arguments.sequence);
    const VideoInfo& info = video->info();
    SequenceRecord sequence;
    sequence.path = info.path.string();
    sequence.size = info.size;
    sequence.frame_count = info.frame_count;
    sequence.frame_rate_hz = info.frame_rate_hz;
    sequence.rate_assumed = info.frame_rate_assumed;
    sequence.id = ensureSequence(project, sequence);
    return sequence;
}

/// A project can be made here only where its video is named.
void refuseAbsent(const ImportArguments& arguments) {
    if (!arguments.video.empty() || isThere(arguments.project)) return;
    throw Error(ErrorKind::project, "there is no project " + arguments.project +
                                        "; check the name, or make it here by naming the video of the labels "
                                        "(--video CLIP)");
}

void printNotes(const std::vector<std::string>& notes) {
    for (const std::string& note : notes) std::printf("  note        %s\n", note.c_str());
}

void importLabels(const ImportArguments& arguments) {
    // Before anything is opened: what is read may turn out to be named as the project, too.
    if (!arguments.show && !arguments.project.empty())
        arguments.outputs.check({growingProject(arguments.project)}, {arguments.file, arguments.video});
    ImportOptions options = importOptionsOf(arguments.labels);
    const std::unique_ptr<FrameSource> video = openedVideo(arguments);
    options.frame_count = framesOfVideo(arguments, video.get());
    LabelFile labels = readLabels(arguments.file, arguments.labels.format, options);
    const LabelReport report = reportOn(labels);
    std::fputs(reportText(arguments.file, labels, report).c_str(), stdout);
    if (arguments.show) {
        if (arguments.project.empty() || (!arguments.video.empty() && !isThere(arguments.project))) return;
        refuseAbsent(arguments);
        ProjectFile project = ProjectFile::open(arguments.project, ProjectFile::Mode::read_only);
        if (arguments.video.empty())
            printNotes(doubtsAbout(labels, project, chosenSequence(project, arguments.sequence)));
        return;
    }
    std::vector<std::filesystem::path> inputs(labels.further_files.begin(), labels.further_files.end());
    inputs.insert(inputs.end(), {arguments.file, arguments.video});
    if (arguments.project.empty()) {
        arguments.outputs.check(outputFiles(arguments.out, "native"), inputs);
        const ExportReport written = writeLabels(std::move(labels), arguments.out, "native");
        std::fputs(reportText(written).c_str(), stdout);
        return;
    }
    refuseAbsent(arguments);
    arguments.outputs.check({growingProject(arguments.project)}, inputs);
    keepEarlierState(arguments.project);
    ProjectFile project =
        arguments.video.empty() ? ProjectFile::open(arguments.project) : ProjectFile::openOrCreate(arguments.project);
    const SequenceRecord sequence = sequenceFor(project, arguments, video.get());
    printNotes(doubtsAbout(labels, project, sequence));
    AnnotationStore store(project, sequence.id);
    if (store.readOnly()) throw Error(ErrorKind::output, store.readOnlyReason());
    const CameraMotion camera = cameraMotionOf(RunStore(project), sequence.id);
    const LabelImport done = planImport(std::move(labels), sequence, camera, store, arguments.tolerance_px,
                                        arguments.add_doubles ? Doubles::add : Doubles::skip,
                                        arguments.link ? LooseBoxes::link : LooseBoxes::single);
    if (!done.edit.empty()) store.apply(done.edit);
    std::printf("%d objects with %d keyframes for %d boxes, and %d ignore regions, added to %s\n", done.objects,
                done.keyframes, done.boxes, done.regions, arguments.project.c_str());
    printNotes(done.notes);
    if (done.loose.boxes > 0 && !arguments.link) std::printf("  note        --link links them\n");
    if (done.doubles > 0) std::printf("  note        --add-doubles adds them anyway\n");
}

}  // namespace

void addImportCommand(CLI::App& app, int& exit_code) {
    const auto arguments = std::make_shared<ImportArguments>();
    CLI::App* command = app.add_subcommand("import",
                                           "Import labels of other programs into a project, or convert them to Eyrie's "
                                           "ground truth; first shows what it found");
    command->add_option("file", arguments->file, "File or folder of labels")->required();
    addLabelOptions(*command, arguments->labels, "--format", "--columns");
    command->add_option("--sequence-name", arguments->labels.sequence, "Video to take from a KWCOCO file with several");
    CLI::Option* project = command->add_option("--project", arguments->project, "Project that gets the labels");
    addSequenceNumber(*command, arguments->sequence)->needs(project);
    command->add_option("--video", arguments->video, "Video that the labels belong to, for a project that has none yet")
        ->needs(project);
    command
        ->add_option(
            "--tolerance", arguments->tolerance_px,
            "How far interpolated boxes may be from the file's, px (below 0.5, whole pixels come back exactly); "
            "0 makes every box a keyframe")
        ->capture_default_str()
        ->check(CLI::Range(0.0, 1000.0));
    command
        ->add_flag("--add-doubles", arguments->add_doubles,
                   "Also import objects that the project already has with the same boxes")
        ->needs(project);
    command
        ->add_flag("--link", arguments->link,
                   "Link boxes without ids into objects where they overlap from frame to frame; without this, each is "
                   "an object of one frame")
        ->needs(project);
    command->add_option("--out", arguments->out, "Write Eyrie's ground truth CSV instead")->excludes(project);
    arguments->outputs.addTo(*command);
    command->add_flag("--show", arguments->show, "Only show what is in the file");
    command->callback([arguments, &exit_code] {
        if (arguments->project.empty() && arguments->out.empty() && !arguments->show) {
            throw Error(ErrorKind::parameter,
                        "import needs a destination: --project P.eyrie, --out labels.csv, or --show only to look");
        }
        importLabels(*arguments);
        exit_code = exit_ok;
    });
}

}  // namespace eyrie::cli
