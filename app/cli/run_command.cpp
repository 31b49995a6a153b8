#include <CLI/CLI.hpp>
#include <cstdio>
#include <memory>
#include <optional>
#include <utility>

#include "chain/scale_estimation.h"
#include "cli/annotator.h"
#include "cli/command.h"
#include "cli/console_progress.h"
#include "cli/input.h"
#include "cli/interrupt.h"
#include "cli/preset_arguments.h"
#include "cli/run_report.h"
#include "core/error.h"
#include "io/box_csv.h"
#include "io/video_writer.h"

namespace eyrie::cli {
namespace {

struct RunArguments {
    std::string input;
    std::string project;
    std::optional<double> gsd_m_per_px;
    std::optional<double> frame_rate_hz;
    std::string frames;
    std::string name;
    PresetArguments preset;
    std::string tracks_csv;
    std::string detections_csv;
    std::string annotated;
    std::string timing;
    bool quiet = false;
};

/// Shows progress and, if wanted, writes the annotated video.
class ConsoleObserver : public ChainObserver {
 public:
    ConsoleObserver(const RunArguments& arguments, const VideoInfo& video) : quiet_(arguments.quiet) {
        if (arguments.annotated.empty()) return;
        const int zoom = annotationZoom(video.size);
        VideoWriterOptions options;
        options.frame_rate_hz = video.frame_rate_hz;
        writer_ = std::make_unique<VideoWriter>(arguments.annotated, video.size * zoom, options);
    }
    void onFrame(const std::shared_ptr<const FrameResult>& result, const Frame& frame) override {
        if (writer_) writer_->write(annotator_.draw(frame, *result));
    }
    void onProgress(const RunProgress& progress) override {
        if (quiet_) return;
        progress_.show(progress.frames_done, progress.frames_total, progress.frames_per_second, progress.seconds_left);
    }

 private:
    bool quiet_;
    ConsoleProgress progress_{"frames"};
    Annotator annotator_;
    std::unique_ptr<VideoWriter> writer_;
};

SceneScale scaleOf(FrameSource& source, FrameRange range, const ChainOptions& options, const RunArguments& arguments,
                   const std::stop_token& stop) {
    ConsoleProgress console("looks");
    return chooseScale(source, range, options, arguments.gsd_m_per_px.value_or(0), stop,
                       [&](const RunProgress& progress) {
                           if (!arguments.quiet)
                               console.show(progress.frames_done, progress.frames_total, progress.frames_per_second,
                                            progress.seconds_left);
                       });
}

/// Said before the work and not after it.
void checkRange(FrameRange range, const VideoInfo& video) {
    const FrameIndex end = video.frame_count - 1;
    if (range.first <= end && range.last <= end) return;
    throw Error(ErrorKind::parameter, "--frames: " + video.path.string() + " has frames 0 to " + std::to_string(end));
}

void checkFolderOf(const std::filesystem::path& file) {
    std::error_code failed;
    const std::filesystem::path folder = std::filesystem::absolute(file, failed).parent_path();
    if (file.empty() || std::filesystem::is_directory(folder, failed)) return;
    throw Error(ErrorKind::output,
                "the folder " + folder.string() + " for " + file.string() + " does not exist; make it first");
}

std::filesystem::path projectPath(const RunArguments& arguments) {
    if (!arguments.project.empty()) return arguments.project;
    const std::string input = arguments.input.substr(arguments.input.rfind("scene:", 0) == 0 ? 6 : 0);
    const auto stem = std::filesystem::path(input).lexically_normal().stem().string();
    return (stem.empty() || stem == "." || stem == ".." ? "video" : stem) + ".eyrie";
}

int run(const RunArguments& arguments) {
    if (arguments.gsd_m_per_px) checkGsd(*arguments.gsd_m_per_px);
    if (arguments.frame_rate_hz) checkFrameRate(*arguments.frame_rate_hz);
    const ParsedRange frames = arguments.frames.empty() ? ParsedRange{} : parseFrames(arguments.frames);
    const FrameRange range{frames.first, frames.last};
    const ChainOptions options = arguments.preset.options();
    const InterruptGuard interrupt;
    const auto source = openInput(arguments.input, arguments.frame_rate_hz.value_or(0), interrupt.token());
    const VideoInfo& video = source->info();
    const std::filesystem::path project = projectPath(arguments);

    checkRange(range, video);
    for (const std::filesystem::path& file :
         {project, std::filesystem::path(arguments.tracks_csv), std::filesystem::path(arguments.detections_csv),
          std::filesystem::path(arguments.timing), std::filesystem::path(arguments.annotated)})
        checkFolderOf(file);
    if (!arguments.gsd_m_per_px && video.gsd_m_per_px <= 0 && !arguments.quiet) {
        std::fputs("GSD unknown: looking at the traffic for the scale\n", stderr);
    }
    const SceneScale scale = scaleOf(*source, range, options, arguments, interrupt.token());
    RunRecord planned = plannedRun(video, scale, range, arguments.preset.preset);
    planned.name = arguments.name;
    RunSummary summary;
    RunRecord record;
    {
        ConsoleObserver console(arguments, video);
        RunRecorder recorder(project, planned, options, &console);
        summary =
            ChainRun(options, scale).run(*source, range, recorder, interrupt.token(), !arguments.annotated.empty());
        record = recorder.finish(summary);
    }
    ProjectFile file = ProjectFile::open(project, ProjectFile::Mode::read_only);
    const RunStore store(file);
    if (!arguments.tracks_csv.empty()) writeResultCsv(arguments.tracks_csv, store.trackBoxes(record.id));
    if (!arguments.detections_csv.empty()) writeResultCsv(arguments.detections_csv, store.detectionBoxes(record.id));
    if (!arguments.timing.empty()) writeTiming(arguments.timing, summary);
    std::fputs(summaryText(video, record, summary, store.tracks(record.id), project).c_str(), stdout);
    if (!arguments.annotated.empty()) std::printf("Annotated video: %s\n", arguments.annotated.c_str());
    if (summary.outcome == RunOutcome::failed) {
        std::fprintf(stderr, "eyrie-cli: the run failed after %d frames: %s\n", summary.frames_done,
                     summary.message.c_str());
        return exit_input;
    }
    return summary.outcome == RunOutcome::stopped ? exit_stopped : exit_ok;
}

}  // namespace

void addRunCommand(CLI::App& app, int& exit_code) {
    const auto arguments = std::make_shared<RunArguments>();
    CLI::App* command =
        app.add_subcommand("run", "Find and follow the moving vehicles of a video and store them in a project");
    command
        ->add_option("input", arguments->input, "A video file, a folder of images, or scene:NAME for a built-in scene")
        ->required();
    command->add_option(
        "--project", arguments->project,
        "Project file; made when it does not exist, else a run is added (default: INPUT's name in this folder)");
    command->add_option("--gsd", arguments->gsd_m_per_px, "Ground sampling distance in metres per pixel");
    command->add_option("--fps", arguments->frame_rate_hz,
                        "Frames per second, when the video does not tell or is wrong");
    command->add_option("--frames", arguments->frames, "First and last frame, both included, from 0: A:B, A: or :B");
    command->add_option("--name", arguments->name, "A name for the run");
    arguments->preset.addTo(*command);
    command->add_option("--tracks", arguments->tracks_csv, "Write the tracks as CSV");
    command->add_option("--detections", arguments->detections_csv, "Write the detections as CSV");
    command->add_option("--annotated", arguments->annotated, "Write the video with everything drawn in (mp4)");
    command->add_option("--timing", arguments->timing, "Write median times per stage as JSON");
    command->add_flag("--quiet", arguments->quiet, "No progress");
    command->callback([arguments, &exit_code] { exit_code = run(*arguments); });
}

}  // namespace eyrie::cli
