#include "cli/live_command.h"

#include <algorithm>
#include <condition_variable>
#include <cstdio>
#include <mutex>
#include <thread>
#include <utility>
#include <vector>

#include "chain/live/live_run.h"
#include "chain/recording/run_recorder.h"
#include "cli/arguments/earlier_state.h"
#include "cli/command.h"
#include "cli/interrupt.h"
#include "cli/reports/run_report.h"
#include "core/error.h"
#include "core/project_name.h"
#include "core/utc_time.h"
#include "io/tables/box_csv.h"
#include "io/tables/number_text.h"
#include "store/backup/database_copy.h"

namespace eyrie::cli {
namespace {

constexpr auto kTellEvery = std::chrono::seconds(5);

/// "live-20261121-080000.eyrie", after the time.
std::filesystem::path timedName() {
    std::string digits;
    for (const char c : nowUtc())
        if (c >= '0' && c <= '9') digits += c;
    return "live-" + digits.substr(0, 8) + "-" + digits.substr(8, 6) + kProjectEnding;
}

/// Beside the project, under its name; never one that is there.
std::filesystem::path recordingFor(const std::filesystem::path& project) {
    std::filesystem::path path = std::filesystem::absolute(project).replace_extension(".ts");
    const std::string stem = path.stem().string();
    std::error_code ignored;
    for (int number = 2; std::filesystem::exists(std::filesystem::symlink_status(path, ignored)); ++number)
        path.replace_filename(stem + "-" + std::to_string(number) + ".ts");
    return path;
}

/// A line now and then: how it keeps pace.
class LiveConsole : public ChainObserver {
 public:
    LiveConsole(const LiveStream& stream, bool quiet) : stream_(stream), quiet_(quiet) {}
    void onFrame(const std::shared_ptr<const FrameResult>&, const Frame&) override {}
    void onProgress(const RunProgress& progress) override {
        const auto now = std::chrono::steady_clock::now();
        if (quiet_ || now - told_ < kTellEvery) return;
        told_ = now;
        const LiveFacts facts = stream_.facts();
        std::fprintf(
            stderr, "%d frames, %s frames/s, %d waiting (%d %% of the queue), %d left out, connected again %d×\n",
            progress.frames_done, fixedText(progress.frames_per_second, 1).c_str(), facts.frames - progress.frames_done,
            static_cast<int>(100 * stream_.backlog()), facts.skipped, facts.reconnects);
    }

 private:
    const LiveStream& stream_;
    bool quiet_;
    std::chrono::steady_clock::time_point told_ = std::chrono::steady_clock::now();
};

/// Ends a stream after a while.
class LiveTimer {
 public:
    LiveTimer(double seconds, std::stop_source& ending) {
        if (seconds <= 0) return;
        thread_ = std::jthread([seconds, &ending](const std::stop_token& stop) {
            std::mutex mutex;
            std::condition_variable_any stopped;
            std::unique_lock lock(mutex);
            stopped.wait_for(lock, stop, std::chrono::duration<double>(seconds), [] { return false; });
            if (!stop.stop_requested()) ending.request_stop();
        });
    }

 private:
    std::jthread thread_;
};

/// Takes a project away again that was made for a run which then did not begin.
class ProjectOfRun {
 public:
    explicit ProjectOfRun(std::filesystem::path project)
        : project_(std::move(project)), is_new_(!std::filesystem::exists(std::filesystem::symlink_status(project_))) {}
    ~ProjectOfRun() {
        if (is_new_ && !isUsed()) removeDatabase(project_);
    }
    ProjectOfRun(const ProjectOfRun&) = delete;
    ProjectOfRun& operator=(const ProjectOfRun&) = delete;

 private:
    bool isUsed() const {
        try {
            ProjectFile file = ProjectFile::open(project_, ProjectFile::Mode::read_only);
            const std::vector<RunRecord> runs = RunStore(file).runs();
            return std::any_of(runs.begin(), runs.end(),
                               [](const RunRecord& run) { return run.frames_done > 0 || run.live; });
        } catch (const Error&) {
            return true;  // what cannot be read is left to whoever looks for the cause
        }
    }
    std::filesystem::path project_;
    bool is_new_;
};

/// The numbers of frames are those of the recording, if nothing was lost on the way.
void checkRecording(const std::filesystem::path& recording, int frames, const std::stop_token& stop) {
    if (stop.stop_requested()) return;
    try {
        const int recorded = openSource(recording, {}, {}, stop)->info().frame_count;
        if (recorded != frames)
            std::fprintf(stderr,
                         "note: the recording shows %d frames, the run has %d: packets were damaged or lost, and boxes "
                         "may lie some frames off\n",
                         recorded, frames);
    } catch (const Error& error) {
        if (!stop.stop_requested()) std::fprintf(stderr, "note: the recording cannot be read: %s\n", error.what());
    }
}

}  // namespace

int runLiveCommand(const LiveArguments& arguments) {
    if (!arguments.video.frames.empty())
        throw Error(ErrorKind::parameter, "--frames is of no use with a live source; --seconds ends it after a while");
    const std::filesystem::path project = arguments.project.empty() ? timedName() : arguments.project;
    LiveOptions wishes;
    wishes.recording = recordingFor(project);
    arguments.outputs.check(
        {growingProject(project), {wishes.recording, FileKind::video}, {arguments.tracks_csv, FileKind::text}},
        {arguments.preset.preset});
    const InterruptGuard interrupt;
    std::stop_source ending;
    const std::stop_callback end_by_hand(interrupt.token(), [&] { ending.request_stop(); });
    if (!keepEarlierState(project, interrupt.token())) return exit_stopped;
    wishes.frame_rate_hz = arguments.video.frame_rate_hz.value_or(0);
    wishes.connect_s = arguments.wait_s;
    wishes.give_up_s = arguments.give_up_s;
    const ChainOptions options = arguments.preset.options();
    LiveStream stream(arguments.address, wishes, ending.get_token());
    const ProjectOfRun made(project);
    const VideoInfo& video = stream.info();
    const SceneScale scale = sceneScale(video, arguments.video.gsd_m_per_px.value_or(0));
    if (!arguments.quiet) {
        std::fprintf(stderr, "%s: %d×%d px at %s Hz, recorded in %s\n", shownAddress(arguments.address).c_str(),
                     video.size.width, video.size.height, fixedText(video.frame_rate_hz, 2).c_str(),
                     wishes.recording.c_str());
        if (!scale.gsd_known)
            std::fprintf(stderr, "GSD unknown: working with %s m/px; --gsd says what it is\n",
                         fixedText(scale.gsd_m_per_px, 2).c_str());
    }
    RunRecord planned = plannedRun(video, scale, {}, arguments.preset.preset);
    planned.name = arguments.name.empty() ? shownAddress(arguments.address) : arguments.name;
    LiveConsole console(stream, arguments.quiet);
    const LiveTimer timer(arguments.seconds, ending);
    const LiveRunResult result = runLive(stream, project, planned, options, &console, arguments.preset.recording());
    ProjectFile file = ProjectFile::open(project, ProjectFile::Mode::read_only);
    const RunStore store(file);
    if (!arguments.tracks_csv.empty())
        writeResultCsv(arguments.tracks_csv,
                       [&](const BoxVisitor& visitor) { store.visitTrackBoxes(result.record.id, visitor); });
    VideoInfo recorded = video;
    recorded.frame_count = result.summary.frames_done;
    std::fputs(summaryText(recorded, result.record, result.summary, factsOf(file, result.record),
                           store.tracks(result.record.id), project)
                   .c_str(),
               stdout);
    std::printf("Recording: %s\n", wishes.recording.c_str());
    if (const std::string given_up = result.load.text(); !given_up.empty()) std::printf("Live: %s\n", given_up.c_str());
    if (result.summary.outcome != RunOutcome::failed) {
        checkRecording(wishes.recording, result.summary.frames_done, interrupt.token());
        return exit_ok;
    }
    std::fprintf(stderr, "eyrie-cli: the run failed after %d frames: %s\n", result.summary.frames_done,
                 result.summary.message.c_str());
    return exitCodeOf(result.summary.error);
}

}  // namespace eyrie::cli
