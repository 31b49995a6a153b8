#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "chain/recording/run_resume.h"
#include "chain/scale/scale_estimation.h"
#include "cli/arguments/earlier_state.h"
#include "cli/arguments/input.h"
#include "cli/arguments/output_arguments.h"
#include "cli/arguments/preset_arguments.h"
#include "cli/arguments/run_choice.h"
#include "cli/arguments/video_arguments.h"
#include "cli/command.h"
#include "cli/common_options.h"
#include "cli/interrupt.h"
#include "cli/live/live_command.h"
#include "cli/reports/console_progress.h"
#include "cli/reports/run_report.h"
#include "core/error.h"
#include "core/project_name.h"
#include "core/time/utc_time.h"
#include "io/folder.h"
#include "io/live/live_address.h"
#include "io/tables/box_csv.h"
#include "io/tables/number_text.h"
#include "io/video/parts/part_list.h"
#include "io/video/video_writer.h"
#include "metadata/metadata_scale.h"
#include "report/clip/annotator.h"

namespace eyrie::cli {
namespace {

struct RunArguments {
    std::vector<std::string> inputs;  ///< several: the parts of one video
    std::string project;
    VideoArguments video;
    std::string name;
    PresetArguments preset;
    std::string tracks_csv;
    std::string detections_csv;
    std::string annotated;
    std::string timing;
    LiveArguments live;
    bool resume = false;
    std::optional<int> run_id;
    bool preset_given = false;
    bool live_given = false;  ///< something that is of use with a live source only
    OutputArguments outputs;
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
    /// Draws frames that the project holds, as if they were done now.
    void drawStored(const RunStore& store, int run_id, FrameSource& source, FrameRange frames,
                    const std::stop_token& stop) {
        for (FrameIndex frame = frames.first; writer_ && frame <= frames.last && !stop.stop_requested(); ++frame) {
            const auto result = store.frameResult(run_id, frame);
            if (result) writer_->write(annotator_.draw(source.read(frame, true), *result));
        }
    }
    /// Completes the annotated video, of a failed run as far as it came; answers whether there is one.
    bool finishVideo(bool failed) {
        try {
            if (writer_) writer_->finish();
            return writer_ != nullptr;
        } catch (const Error&) {
            if (!failed) throw;
            return false;  // what made the run fail is told
        }
    }
    void onProgress(const RunProgress& progress) override {
        if (quiet_) return;
        if (progress.finishing && !finishing_) finishing_.emplace("frames, finishing the tracks");
        (finishing_ ? *finishing_ : progress_)
            .show(progress.frames_done, progress.frames_total, progress.frames_per_second, progress.seconds_left);
    }

 private:
    bool quiet_;
    ConsoleProgress progress_{"frames"};
    std::optional<ConsoleProgress> finishing_;
    Annotator annotator_;
    std::unique_ptr<VideoWriter> writer_;
};

void tell(const std::vector<std::string>& remarks) {
    for (const std::string& remark : remarks) std::fprintf(stderr, "%s\n", remark.c_str());
}

/// The scale to work with; what is said of it before the run is said here.
ChosenScale scaleOf(FrameSource& source, FrameRange range, const ChainOptions& options, const RunArguments& arguments,
                    const std::stop_token& stop) {
    const StatedScale stated = statedScale(source, range.first, range.last, arguments.video.gsd_m_per_px.value_or(0),
                                           ScaleOrigin::given, stop);
    if (arguments.quiet) return chooseScale(source, range, options, stated, stop);
    tell(remarksOn(stated));
    if (stated.gsd_m_per_px <= 0 && source.info().gsd_m_per_px <= 0)
        std::fputs("GSD unknown: estimating the scale from the traffic\n", stderr);
    ChosenScale chosen;
    {
        ConsoleProgress console("looks");  // ends its line
        chosen = chooseScale(source, range, options, stated, stop, [&](const RunProgress& progress) {
            console.show(progress.frames_done, progress.frames_total, progress.frames_per_second,
                         progress.seconds_left);
        });
    }
    tell(remarksOn(chosen));
    return chosen;
}

/// Said before the work and not after it.
void checkRange(FrameRange range, const VideoInfo& video) {
    const FrameIndex end = video.frame_count - 1;
    if (range.first <= end && range.last <= end) return;
    throw Error(ErrorKind::parameter, "--frames: " + video.path.string() + " has frames 0 to " + std::to_string(end));
}

std::filesystem::path projectPath(const RunArguments& arguments) {
    if (!arguments.project.empty()) return arguments.project;
    std::string input = arguments.inputs.empty() ? "" : arguments.inputs.front();
    if (arguments.inputs.size() > 1) input = partListName({arguments.inputs.begin(), arguments.inputs.end()});
    const auto stem = std::filesystem::path(sceneOf(input)).lexically_normal().stem().string();
    return (stem.empty() || stem == "." || stem == ".." ? "video" : stem) + kProjectEnding;
}

/// A run that has ended, and what is to be told of it.
struct EndedRun {
    RunRecord record;
    RunSummary summary;
    bool has_video = false;  ///< the annotated video was written
};

/// Finishes the run and takes what only its recorder knows.
void takeRecord(EndedRun& ended, RunRecorder& recorder, FrameSource& source, const std::stop_token& stop) {
    ended.summary.median_ms[static_cast<std::size_t>(Stage::store)] = recorder.medianStoreMs();
    const auto before = std::chrono::steady_clock::now();
    ended.record = recorder.finish(ended.summary, &source, stop);
    ended.summary.seconds += std::chrono::duration<double>(std::chrono::steady_clock::now() - before).count();
    if (ended.record.state == RunState::stopped) ended.summary.outcome = RunOutcome::stopped;
}

/// What stands on the command line of a run to be resumed; `source` is the input, if one was given.
ResumeWishes wishesOf(const RunArguments& arguments, const FrameSource* source) {
    ResumeWishes wishes;
    if (source != nullptr) wishes.video = source->info().path.string();
    wishes.run = arguments.run_id;
    wishes.gsd_m_per_px = arguments.video.gsd_m_per_px;
    wishes.frame_rate_hz = arguments.video.frame_rate_hz;
    if (!arguments.video.frames.empty()) wishes.frames = arguments.video.range();
    if (arguments.preset_given) wishes.options = arguments.preset.options();
    wishes.recording = arguments.preset.recording().changed();
    return wishes;
}

/// With --resume: two commands that found nothing to resume would each begin a run. The first to add one has it.
MayAddRun unlessBegunMeanwhile(const RunArguments& arguments, const FrameSource& source,
                               const std::filesystem::path& project) {
    if (!arguments.resume) return {};
    return [wishes = wishesOf(arguments, &source), project](const RunStore& store) {
        checkNotBegun(store, project.string(), wishes);
    };
}

EndedRun runAnew(const RunArguments& arguments, std::int64_t began_us, FrameSource& source,
                 const std::filesystem::path& project, const std::stop_token& stop) {
    const FrameRange range = arguments.video.range();
    const ChainOptions options = arguments.preset.options();
    const VideoInfo& video = source.info();
    checkRange(range, video);
    const ChosenScale chosen = scaleOf(source, range, options, arguments, stop);
    RunRecord planned = plannedRun(video, chosen.scale, range, arguments.preset.preset);
    planned.scale_basis = chosen.basis;
    planned.name = arguments.name;
    planned.started_us = began_us;
    const RecordingOptions recording =
        arguments.detections_csv.empty()
            ? arguments.preset.recording()
            : arguments.preset.recordingAll("--detections", planned.first_frame, planned.last_frame);
    ConsoleObserver console(arguments, video);
    RunRecorder recorder(project, planned, options, &console, recording,
                         unlessBegunMeanwhile(arguments, source, project));
    recorder.holdPictures();
    EndedRun ended;
    ended.summary = ChainRun(options, chosen.scale).run(source, range, recorder, stop, !arguments.annotated.empty());
    takeRecord(ended, recorder, source, stop);
    ended.has_video = console.finishVideo(ended.summary.outcome == RunOutcome::failed);
    return ended;
}

void tellWhereItGoesOn(const ResumedRun& resumed) {
    const int done = resumed.last_done - resumed.run.first_frame + 1;
    const int total = resumed.run.last_frame - resumed.run.first_frame + 1;
    const std::string which = "run " + std::to_string(resumed.run.id);
    switch (resumed.restart) {
        case RestartReason::none:
            std::fprintf(stderr, "resuming %s: %d of %d frames are done\n", which.c_str(), done, total);
            break;
        case RestartReason::nothing_kept:
            std::fprintf(stderr, "%s starts again from its first frame: no state was kept to resume from\n",
                         which.c_str());
            break;
        case RestartReason::damaged_state:
            std::fprintf(stderr, "%s starts again from its first frame: the state kept to resume from is damaged\n",
                         which.c_str());
            break;
    }
}

/// A finished run: there is nothing to do but the outputs.
EndedRun asItIs(const RunArguments& arguments, const RunRecord& run, FrameSource& source,
                const std::filesystem::path& project, const std::stop_token& stop) {
    if (!arguments.quiet) std::fprintf(stderr, "run %d is finished: nothing is left to do\n", run.id);
    EndedRun ended;
    ended.record = run;
    ended.summary.outcome = RunOutcome::finished;
    ended.summary.message.clear();
    ended.summary.frames_done = ended.summary.frames_total = run.frames_done;
    ProjectFile file = ProjectFile::open(project, ProjectFile::Mode::read_only);
    const RunStore store(file);
    for (const FrameSummary& frame : store.frameSummaries(run.id)) {
        if (frame.state == RegistrationState::failed) ++ended.summary.unregistered_frames;
    }
    ConsoleObserver console(arguments, source.info());
    console.drawStored(store, run.id, source, {run.first_frame, run.last_frame}, stop);
    ended.has_video = console.finishVideo(false);
    return ended;
}

/// A new run, unless another program did it meanwhile. `began_us`: before `source` was opened.
EndedRun begin(const RunArguments& arguments, std::int64_t began_us, FrameSource& source,
               const std::filesystem::path& project, const std::stop_token& stop) {
    try {
        return runAnew(arguments, began_us, source, project, stop);
    } catch (const FinishedMeanwhile& other) {
        if (!arguments.detections_csv.empty()) {
            ProjectFile file = ProjectFile::open(project, ProjectFile::Mode::read_only);
            needDetections(file, other.run);
        }
        return asItIs(arguments, other.run, source, project, stop);
    }
}

EndedRun goOn(const RunArguments& arguments, const RunRecord& run, FrameSource& source,
              const std::filesystem::path& project, const std::stop_token& stop) {
    const ResumedRun resumed = resumedRun(project, run.id, source);
    if (!arguments.quiet) tellWhereItGoesOn(resumed);
    ConsoleObserver console(arguments, source.info());
    RunRecorder recorder(project, resumed, &console);
    recorder.holdPictures();
    if (!arguments.annotated.empty()) {
        ProjectFile file = ProjectFile::open(project, ProjectFile::Mode::read_only);
        console.drawStored(RunStore(file), run.id, source, {run.first_frame, resumed.last_done}, stop);
    }
    EndedRun ended;
    ended.summary = ChainRun(resumed.options, run.scale)
                        .run(source, resumed.range(), recorder, stop, !arguments.annotated.empty(), resumed.start);
    takeRecord(ended, recorder, source, stop);
    ended.has_video = console.finishVideo(ended.summary.outcome == RunOutcome::failed);
    return ended;
}

/// Which run --resume is about; `source` is the input, if one was given.
ResumeChoice choiceOf(const RunArguments& arguments, const FrameSource* source, const std::filesystem::path& project) {
    if (source != nullptr && !arguments.run_id && !isFile(project)) return {};
    ProjectFile file = ProjectFile::open(project, ProjectFile::Mode::read_only);
    ResumeChoice choice = chooseRun(RunStore(file), project.string(), wishesOf(arguments, source));
    if (choice.run && !arguments.detections_csv.empty()) needDetections(file, *choice.run);
    return choice;
}

/// Before a long video is indexed, not after a long run.
void checkOutputs(const RunArguments& arguments, const std::filesystem::path& project,
                  const std::vector<std::string>& videos) {
    std::vector<std::filesystem::path> read(videos.begin(), videos.end());
    read.emplace_back(arguments.preset.preset);
    OutputArguments outputs = arguments.outputs;
    outputs.force = outputs.force || arguments.resume;  // the same command again replaces what it wrote
    outputs.check({growingProject(project),
                   {arguments.tracks_csv, FileKind::text},
                   {arguments.detections_csv, FileKind::text},
                   {arguments.annotated, FileKind::video},
                   {arguments.timing, FileKind::json}},
                  read);
}

int runLive(const RunArguments& arguments) {
    if (arguments.resume || !arguments.annotated.empty() || !arguments.detections_csv.empty() ||
        !arguments.timing.empty())
        throw Error(ErrorKind::parameter,
                    "--resume, --annotated, --detections and --timing are of no use with a live source; run over its "
                    "recording afterwards");
    LiveArguments live = arguments.live;
    live.address = arguments.inputs.front();
    live.project = arguments.project;
    live.video = arguments.video;
    live.preset = arguments.preset;
    live.name = arguments.name;
    live.tracks_csv = arguments.tracks_csv;
    live.outputs = arguments.outputs;
    live.quiet = arguments.quiet;
    return runLiveCommand(live);
}

/// Answers the exit code.
int runVideo(const RunArguments& arguments, const std::stop_token& stop) {
    const std::int64_t began_us = nowUtcMicroseconds();
    const std::filesystem::path project = projectPath(arguments);
    std::unique_ptr<FrameSource> source;
    if (!arguments.inputs.empty()) {
        checkOutputs(arguments, project, arguments.inputs);
        source = openInputs(arguments.inputs, arguments.video.frame_rate_hz.value_or(0), stop, project);
    }
    ResumeChoice choice;
    if (arguments.resume) {
        choice = choiceOf(arguments, source.get(), project);
        if (!choice.run && !choice.why_new.empty() && !arguments.quiet) {
            std::fprintf(stderr, "starting a new run: %s\n", choice.why_new.c_str());
        }
    }
    if (!source) {
        checkOutputs(arguments, project, {choice.run->sequence.path});
        source = openInput(choice.run->sequence.path, 0, stop, choice.run->scale.frame_rate_hz);
    }
    if (!keepEarlierState(project, stop)) return exit_stopped;
    const auto [record, summary, has_video] = !choice.run ? begin(arguments, began_us, *source, project, stop)
                                              : choice.run->state == RunState::finished
                                                  ? asItIs(arguments, *choice.run, *source, project, stop)
                                                  : goOn(arguments, *choice.run, *source, project, stop);
    ProjectFile file = ProjectFile::open(project, ProjectFile::Mode::read_only);
    const RunStore store(file);
    if (!arguments.tracks_csv.empty())
        writeResultCsv(arguments.tracks_csv,
                       [&, run = record.id](const BoxVisitor& visitor) { store.visitTrackBoxes(run, visitor); });
    if (!arguments.detections_csv.empty())
        writeResultCsv(arguments.detections_csv,
                       [&, run = record.id](const BoxVisitor& visitor) { store.visitDetectionBoxes(run, visitor); });
    if (!arguments.timing.empty()) writeTiming(arguments.timing, summary);
    std::fputs(
        summaryText(source->info(), record, summary, factsOf(file, record), store.tracks(record.id), project).c_str(),
        stdout);
    if (has_video) std::printf("Annotated video: %s\n", arguments.annotated.c_str());
    if (summary.outcome == RunOutcome::failed) {
        std::fprintf(stderr, "eyrie-cli: the run failed after %d frames: %s\n", summary.frames_done,
                     summary.message.c_str());
        return exitCodeOf(summary.error);
    }
    if (summary.outcome == RunOutcome::stopped && !arguments.quiet) {
        std::fprintf(stderr, "stopped; eyrie-cli run --resume --project %s resumes it\n", project.c_str());
    }
    return summary.outcome == RunOutcome::stopped ? exit_stopped : exit_ok;
}

int run(const RunArguments& arguments) {
    arguments.video.check();
    arguments.preset.options();
    if (!arguments.detections_csv.empty()) arguments.preset.recordingAll("--detections", 0, 0);
    if (arguments.inputs.size() == 1 && isLiveAddress(arguments.inputs.front())) return runLive(arguments);
    if (arguments.live_given)
        throw Error(ErrorKind::parameter,
                    "--seconds, --wait and --give-up are for live sources, and INPUT is not one; --frames says how "
                    "much of a video is processed");
    if (arguments.inputs.empty() && !(arguments.resume && !arguments.project.empty())) {
        throw Error(
            ErrorKind::parameter,
            "INPUT is missing: name a video, a folder of images or a scene; with --resume, --project is enough");
    }
    if (arguments.run_id && !arguments.resume) {
        throw Error(ErrorKind::parameter, "--run names the run to resume; add --resume, or leave it out");
    }
    return untilStopped([&](const std::stop_token& stop) { return runVideo(arguments, stop); });
}

}  // namespace

void addRunCommand(CLI::App& app, int& exit_code) {
    const auto arguments = std::make_shared<RunArguments>();
    CLI::App* command =
        app.add_subcommand("run", "Find and follow the moving vehicles of a video and store them in a project");
    command->add_option("input", arguments->inputs,
                        "A video file, or several that count as one video, in their order; a list of such (*.parts), a "
                        "folder of images, scene:NAME for a built-in scene, the address of a live source (udp://, "
                        "rtsp://, srt:// and others) or a camera (/dev/video0, camera:0); with --resume and --project "
                        "it may be left out");
    command->add_option(
        "--project", arguments->project,
        "Project file; made when it does not exist, else a run is added (default: INPUT's name in this folder)");
    arguments->video.addTo(*command);
    command->add_flag("--resume", arguments->resume,
                      "Resume a run that ended early; the result is the same as without the break. With INPUT: the "
                      "newest of that video started with the same options, or a new one");
    command->add_option("--run", arguments->run_id, "Number of the run to resume (default: the newest)");
    command->add_option("--name", arguments->name, "A name for the run");
    arguments->preset.addTo(*command);
    command->add_option("--tracks", arguments->tracks_csv, "Write the tracks as CSV");
    command->add_option("--detections", arguments->detections_csv, "Write the detections as CSV");
    command->add_option("--annotated", arguments->annotated, "Write the video with all results drawn in (mp4)");
    command->add_option("--timing", arguments->timing, "Write median times per stage as JSON");
    command->add_option("--seconds", arguments->live.seconds,
                        "Live source: seconds after which to end (default: Ctrl-C ends it)");
    command->add_option("--wait", arguments->live.wait_s, "Live source: seconds to wait for its first picture")
        ->check(CLI::Range(0.5, 3600.0))
        ->capture_default_str();
    command
        ->add_option("--give-up", arguments->live.give_up_s,
                     "Live source: seconds without a picture after which it counts as ended; until then Eyrie tries to "
                     "connect again")
        ->check(CLI::Range(0.5, 1e6))
        ->capture_default_str();
    arguments->outputs.addTo(*command);
    addQuiet(*command, arguments->quiet);
    command->callback([arguments, command, &exit_code] {
        arguments->preset_given = command->count("--preset") + command->count("--set") > 0;
        arguments->live_given =
            command->count("--seconds") + command->count("--wait") + command->count("--give-up") > 0;
        exit_code = run(*arguments);
    });
}

}  // namespace eyrie::cli
