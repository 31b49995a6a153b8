#include "cli/live/live_command.h"

#include <algorithm>
#include <condition_variable>
#include <cstdio>
#include <mutex>
#include <thread>

#include "chain/live/live_run.h"
#include "cli/arguments/earlier_state.h"
#include "cli/command.h"
#include "cli/interrupt.h"
#include "cli/reports/run_report.h"
#include "core/error.h"
#include "io/live/live_address.h"
#include "io/tables/box_csv.h"
#include "io/tables/number_text.h"

namespace eyrie::cli {
namespace {

constexpr auto kTellEvery = std::chrono::seconds(5);

/// A line now and then: how it keeps pace.
class LiveConsole : public ChainObserver {
 public:
    LiveConsole(const LiveRun& run, bool quiet) : run_(run), quiet_(quiet) {}
    void onFrame(const std::shared_ptr<const FrameResult>&, const Frame&) override {}
    void onProgress(const RunProgress& progress) override {
        const auto now = std::chrono::steady_clock::now();
        if (quiet_ || now - told_ < kTellEvery) return;
        told_ = now;
        if (progress.estimating_scale) {
            std::fprintf(stderr, "Looking at the first pictures for a scale: %d %%\n",
                         100 * progress.frames_done / std::max(1, progress.frames_total));
            return;
        }
        const LiveStatus status = run_.status();
        const LiveFacts& facts = status.load.facts;
        std::fprintf(stderr, "%d frames, %s frames/s, %s s behind, %d left out, connected again %d×\n",
                     progress.frames_done, fixedText(progress.frames_per_second, 1).c_str(),
                     fixedText(status.behind_s, 1).c_str(), facts.skipped, facts.reconnects);
    }

 private:
    const LiveRun& run_;
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

/// The numbers of frames are those of the recording, if nothing was lost on the way.
void checkRecording(const std::filesystem::path& recording, int frames, const std::stop_token& stop) {
    if (stop.stop_requested()) return;
    try {
        const int recorded = openSource(recording, {}, {}, stop)->info().frame_count;
        if (const std::string remark = remarkOnRecording(recorded, frames); !remark.empty())
            std::fprintf(stderr, "note: %s\n", remark.c_str());
    } catch (const Error& error) {
        if (!stop.stop_requested()) std::fprintf(stderr, "note: the recording cannot be read: %s\n", error.what());
    }
}

}  // namespace

int runLiveCommand(const LiveArguments& arguments) {
    if (!arguments.video.frames.empty())
        throw Error(ErrorKind::parameter, "--frames is of no use with a live source; --seconds ends it after a while");
    LiveRequest request;
    request.address = arguments.address;
    request.project = arguments.project.empty() ? timedProjectName() : arguments.project;
    request.stream.recording = recordingFor(request.project);
    request.stream.frame_rate_hz = arguments.video.frame_rate_hz.value_or(0);
    request.stream.connect_s = arguments.wait_s;
    request.stream.give_up_s = arguments.give_up_s;
    request.options = arguments.preset.options();
    request.preset = arguments.preset.preset;
    request.name = arguments.name;
    request.gsd_m_per_px = arguments.video.gsd_m_per_px.value_or(0);
    request.details = arguments.preset.recording();
    const std::filesystem::path& project = request.project;
    arguments.outputs.check(
        {growingProject(project), {request.stream.recording, FileKind::video}, {arguments.tracks_csv, FileKind::text}},
        {arguments.preset.preset});
    const InterruptGuard interrupt;
    std::stop_source ending;
    const std::stop_callback end_by_hand(interrupt.token(), [&] { ending.request_stop(); });
    if (!keepEarlierState(project, interrupt.token())) return exit_stopped;
    LiveRun run(request, ending.get_token());
    const VideoInfo& video = run.video();
    if (!arguments.quiet) {
        std::fprintf(stderr, "%s: %d×%d px at %s Hz, recorded in %s\n", shownAddress(arguments.address).c_str(),
                     video.size.width, video.size.height, fixedText(video.frame_rate_hz, 2).c_str(),
                     run.recording().c_str());
    }
    const auto tell_scale = [&](const RunRecord& record) {
        if (arguments.quiet || record.scale.gsd_known) return;
        const ScaleBasis& basis = record.scale_basis;
        if (basis.origin == ScaleOrigin::estimated)
            std::fprintf(
                stderr, "%s\n",
                estimateText({record.scale.gsd_m_per_px, basis.uncertainty.value_or(1), basis.vehicles}).c_str());
        else
            std::fprintf(stderr, "GSD unknown: working with %s m/px; --gsd says what it is\n",
                         fixedText(record.scale.gsd_m_per_px, 2).c_str());
    };
    LiveConsole console(run, arguments.quiet);
    const LiveTimer timer(arguments.seconds, ending);
    const LiveRunResult result = run.run(&console, tell_scale);
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
    std::printf("Recording: %s\n", run.recording().c_str());
    if (result.summary.outcome != RunOutcome::failed) {
        checkRecording(run.recording(), result.summary.frames_done, interrupt.token());
        return exit_ok;
    }
    if (const std::string given_up = result.load.text(); !given_up.empty())
        std::fprintf(stderr, "%s\n", given_up.c_str());
    std::fprintf(stderr, "eyrie-cli: the run failed after %d frames: %s\n", result.summary.frames_done,
                 result.summary.message.c_str());
    return exitCodeOf(result.summary.error);
}

}  // namespace eyrie::cli
