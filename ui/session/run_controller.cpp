#include "session/run_controller.h"

#include <exception>
#include <utility>

#include "chain/scale_estimation.h"
#include "metadata/metadata_scale.h"

namespace eyrie::ui {

namespace {
constexpr int kPoll_ms = 200;
}

RunController::RunController(QObject* parent) : QObject(parent) {
    poll_.setInterval(kPoll_ms);
    connect(&poll_, &QTimer::timeout, this, &RunController::fetch);
}

RunController::~RunController() = default;

void RunController::start(RunRequest request) {
    if (running()) return;
    poll_.start();
    feed_ = std::make_shared<LiveFeed>(request.trail_length, [this] { query_.tell([this] { fetch(); }); });
    run_ = query_.post(
        [this, request = std::move(request), feed = feed_](const BackgroundTask& task) { work(request, *feed, task); });
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
        const auto source = request.media.open({}, stop);
        if (request.resume_run > 0) {
            const ResumedRun resumed = resumedRun(request.project, request.resume_run, *source);
            RunRecorder recorder(request.project, resumed, &feed);
            run_id = resumed.run.id;
            task.tell([this, record = resumed.run] { emit started(record); });
            summary = ChainRun(resumed.options, resumed.run.scale)
                          .run(*source, resumed.range(), recorder, stop, true, resumed.start);
            recorder.finish(summary);
        } else {
            std::optional<ScaleEstimate> estimated;
            const StatedScale stated = statedScale(*source, request.range.first, request.range.last,
                                                   request.gsd_m_per_px, request.gsd_origin, stop);
            const SceneScale scale = chooseScale(
                *source, request.range, request.options, stated.gsd_m_per_px, stop,
                [&feed](const RunProgress& progress) { feed.onProgress(progress); }, &estimated);
            RunRecord record = plannedRun(source->info(), scale, request.range, request.preset);
            record.scale_basis = basisOf(scale, estimated);
            if (stated.gsd_m_per_px > 0) record.scale_basis.origin = stated.origin;
            record.name = request.name;
            record.sequence.path = request.media.identity;
            RunRecorder recorder(request.project, record, request.options, &feed);
            run_id = recorder.runId();
            record.id = run_id;
            task.tell([this, record] { emit started(record); });
            summary = ChainRun(request.options, scale).run(*source, request.range, recorder, stop, true);
            recorder.finish(summary);
        }
    } catch (const std::exception& error) {
        summary.outcome = stop.stop_requested() && run_id == 0 ? RunOutcome::stopped : RunOutcome::failed;
        summary.message = error.what();
    }
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
    emit finished(summary, run_id);
}

}  // namespace eyrie::ui
