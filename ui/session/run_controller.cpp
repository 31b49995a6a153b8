#include "session/run_controller.h"

#include <exception>
#include <mutex>
#include <utility>

#include "chain/scale/scale_estimation.h"
#include "core/time/utc_time.h"
#include "metadata/metadata_scale.h"

namespace eyrie::ui {

namespace {
constexpr int kPoll_ms = 200;

/// A run may be stopped while its tracks are finished, too.
void takeOutcome(const RunRecord& run, RunSummary& summary) {
    if (run.state == RunState::stopped) summary.outcome = RunOutcome::stopped;
}
}  // namespace

RunController::RunController(QObject* parent) : QObject(parent) {
    poll_.setInterval(kPoll_ms);
    connect(&poll_, &QTimer::timeout, this, &RunController::fetch);
}

RunController::~RunController() = default;

/// The run over a live source while there is one, for both threads.
struct RunController::Watched {
    std::mutex mutex;
    const LiveRun* run = nullptr;

    /// While it lives, the run can be asked how it stands.
    class Shown {
     public:
        Shown(Watched& watched, const LiveRun& run) : watched_(watched) { set(&run); }
        ~Shown() { set(nullptr); }
        Shown(const Shown&) = delete;
        Shown& operator=(const Shown&) = delete;

     private:
        void set(const LiveRun* run) {
            const std::scoped_lock lock(watched_.mutex);
            watched_.run = run;
        }
        Watched& watched_;
    };
};

void RunController::begin(int trail_length) {
    poll_.start();
    feed_ = std::make_shared<LiveFeed>(trail_length, [this] { query_.tell([this] { fetch(); }); });
}

void RunController::start(RunRequest request) {
    if (running()) return;
    begin(request.trail_length);
    run_ = query_.post(
        [this, request = std::move(request), feed = feed_](const BackgroundTask& task) { work(request, *feed, task); });
}

void RunController::watch(LiveRequest request, int trail_length) {
    if (running()) return;
    begin(trail_length);
    watched_ = std::make_shared<Watched>();
    run_ = query_.post([this, request = std::move(request), feed = feed_,
                        watched = watched_](const BackgroundTask& task) { workLive(request, *feed, *watched, task); });
}

std::optional<LiveStatus> RunController::liveStatus() const {
    if (!watched_) return std::nullopt;
    const std::scoped_lock lock(watched_->mutex);
    return watched_->run != nullptr ? std::optional(watched_->run->status()) : std::nullopt;
}

std::optional<ViewFrame> RunController::takeFrame() {
    return feed_ ? feed_->takeFrame() : std::nullopt;
}

std::vector<FrameSummary> RunController::takeSummaries() {
    return feed_ ? feed_->takeSummaries() : std::vector<FrameSummary>();
}

void RunController::work(const RunRequest& request, LiveFeed& feed, const BackgroundTask& task) {
    const std::stop_token& stop = task.stop();
    RunSummary summary;
    int run_id = 0;
    try {
        const std::int64_t began_us = nowUtcMicroseconds();
        const auto source = request.media.open({}, stop);
        if (request.resume_run > 0) {
            const ResumedRun resumed = resumedRun(request.project, request.resume_run, *source);
            RunRecorder recorder(request.project, resumed, &feed);
            recorder.holdPictures();
            run_id = resumed.run.id;
            task.tell([this, record = resumed.run] { emit started(record); });
            summary = ChainRun(resumed.options, resumed.run.scale)
                          .run(*source, resumed.range(), recorder, stop, true, resumed.start);
            takeOutcome(recorder.finish(summary, source.get(), stop), summary);
        } else {
            const StatedScale stated = statedScale(*source, request.range.first, request.range.last,
                                                   request.gsd_m_per_px, request.gsd_origin, stop);
            const ChosenScale chosen = chooseScale(*source, request.range, request.options, stated, stop,
                                                   [&feed](const RunProgress& progress) { feed.onProgress(progress); });
            RunRecord record = plannedRun(source->info(), chosen.scale, request.range, request.preset);
            record.scale_basis = chosen.basis;
            record.name = request.name;
            record.started_us = began_us;
            record.sequence.path = request.media.identity;
            RunRecorder recorder(request.project, record, request.options, &feed, request.recording);
            recorder.holdPictures();
            run_id = recorder.runId();
            record.id = run_id;
            task.tell([this, record] { emit started(record); });
            summary = ChainRun(request.options, chosen.scale).run(*source, request.range, recorder, stop, true);
            takeOutcome(recorder.finish(summary, source.get(), stop), summary);
        }
    } catch (const std::exception& error) {
        summary.outcome = stop.stop_requested() && run_id == 0 ? RunOutcome::stopped : RunOutcome::failed;
        summary.message = error.what();
    }
    close(summary, run_id, feed, task);
}

void RunController::workLive(const LiveRequest& request, LiveFeed& feed, Watched& watched, const BackgroundTask& task) {
    RunSummary summary;
    int run_id = 0;
    try {
        LiveRun run(request, task.stop());
        const auto begun = [&](const RunRecord& record) {
            run_id = record.id;
            task.tell([this, record] { emit started(record); });
        };
        const Watched::Shown shown(watched, run);
        summary = run.run(&feed, begun).summary;
    } catch (const std::exception& error) {
        summary.outcome = task.stop().stop_requested() && run_id == 0 ? RunOutcome::stopped : RunOutcome::failed;
        summary.message = error.what();
    }
    close(summary, run_id, feed, task);
}

void RunController::close(const RunSummary& summary, int run_id, LiveFeed& feed, const BackgroundTask& task) {
    feed.flush();
    task.tell([this, summary, run_id] { end(summary, run_id); });
}

void RunController::fetch() {
    if (!feed_) return;
    feed_->fetching();
    if (const auto news = feed_->takeProgress()) emit progress(*news);
    emit frameAvailable();
}

void RunController::end(const RunSummary& summary, int run_id) {
    fetch();
    poll_.stop();
    feed_.reset();
    watched_.reset();
    emit finished(summary, run_id);
}

}  // namespace eyrie::ui

#include "moc_run_controller.cpp"
