#include "tune/sweep/sweep_session.h"

#include <sys/resource.h>
#include <unistd.h>

#include <exception>
#include <functional>
#include <thread>
#include <utility>

#include "chain/recording/run_recorder.h"
#include "core/error.h"
#include "sweep/sweep_lock.h"
#include "tune/sweep/swept_runs.h"
#include "widgets/wiring.h"

namespace eyrie::ui {

namespace {
constexpr int kPulse_ms = 120;
constexpr int kNiceness = 15;
constexpr qint64 kShareOfDrawing = 20;  ///< the table is drawn again after this many times what drawing took
}  // namespace

/// What the worker needs to know; copied, so that the session may go on changing.
struct SweepSession::Job {
    std::filesystem::path project;
    int run_id = 0;
    SweepRequest request;
    std::optional<int> resumed;  ///< a stored sweep in place of the request
};

SweepSession::SweepSession(ProjectSession& session, QObject* parent)
    : QObject(parent), session_(session), pulse_(kPulse_ms, [this] { take(); }) {
    whenChanged(session_, this, {{SessionChange::project, [this] { projectChanged(); }}});
}

SweepSession::~SweepSession() = default;

void SweepSession::projectChanged() {
    stop_.request_stop();
    selected_ = 0;
    table_.reset();
    sweeps_.clear();
    emit changed(SweepChange::sweeps);
    emit changed(SweepChange::table);
    refreshList();
}

void SweepSession::refreshList() {
    const std::filesystem::path project = session_.project();
    if (project.empty()) return;
    const auto adopt = [this, project](const std::vector<SweepRecord>& found, const QString& problem) {
        if (project != session_.project()) return;
        if (!problem.isEmpty()) emit failed(problem);
        sweeps_ = found;
        emit changed(SweepChange::sweeps);
        if (selected_ == 0 && !sweeps_.empty()) select(sweeps_.back().id);
    };
    const auto work = [project, adopt](const BackgroundTask& task) {
        ProjectFile file = ProjectFile::open(project, ProjectFile::Mode::read_only);
        task.tell([adopt, found = SweepStore(file).sweeps()] { adopt(found, {}); });
    };
    reader_.post(work, [adopt](const QString& problem) { adopt({}, problem); });
}

void SweepSession::select(int sweep_id) {
    selected_ = sweep_id;
    if (running_ && growing_ && growing_->id == sweep_id) return;  // it is shown as it grows
    const std::filesystem::path project = session_.project();
    const auto work = [this, project, sweep_id](const BackgroundTask& task) {
        ProjectFile file = ProjectFile::open(project, ProjectFile::Mode::read_only);
        const auto table = std::make_shared<const SweepTable>(readSweep(file, sweep_id));
        task.tell([this, project, table] {
            if (project != session_.project() || selected_ != table->id) return;
            table_ = table;
            emit changed(SweepChange::table);
        });
    };
    reader_.ask(work, std::bind_front(&SweepSession::failed, this));
}

void SweepSession::remove(int sweep_id) {
    const std::filesystem::path project = session_.project();
    const auto work = [project, sweep_id](const BackgroundTask&) {
        ProjectFile file = ProjectFile::open(project);
        SweepStore(file).remove(sweep_id);
    };
    reader_.post(work, std::bind_front(&SweepSession::failed, this));
    if (selected_ == sweep_id) {
        selected_ = 0;
        table_.reset();
        emit changed(SweepChange::table);
    }
    refreshList();
}

void SweepSession::start(const SweepRequest& request) {
    if (running_) return;
    double points = request.axes.empty() ? 0 : 1;
    for (const std::string& axis : request.axes) points *= countValues(axis);
    if (points > kManyPoints && !request.many_points_meant) {
        emit consentNeeded(request, points);
        return;
    }
    if (!session_.currentRun()) {
        emit failed(tr("A sweep needs a run to start from. Run the video first, or choose a run."));
        return;
    }
    begin({session_.project(), *session_.currentRun(), request, {}});
}

void SweepSession::resume(int sweep_id) {
    if (!running_) begin({session_.project(), 0, {}, sweep_id});
}

void SweepSession::cancel() {
    stop_.request_stop();
}

void SweepSession::begin(Job job) {
    running_ = true;
    progress_ = {};
    progress_.doing = tr("reading the run").toStdString();
    stop_ = worker_.post([this, job = std::move(job)](const BackgroundTask& task) {
        // A thread keeps the priority that it was given, and so do those that it starts.
        std::jthread([&] {
            setpriority(PRIO_PROCESS, static_cast<id_t>(gettid()), kNiceness);
            work(job, task);
        }).join();
    });
    pulse_.start();
    emit changed(SweepChange::running);
    emit progressed(progress_);
}

/// Opens what a stored sweep was begun over, and its plan.
OpenedRuns SweepSession::openResumed(const Job& job, SweepPlan& plan, const std::stop_token& stop) {
    {
        ProjectFile file = ProjectFile::open(job.project, ProjectFile::Mode::read_only);
        plan = readSweep(file, *job.resumed).plan;
    }
    std::vector<RunToSweep> runs;
    for (const SweepClip& clip : plan.clips) {
        if (clip.run == 0) {
            throw Error(
                ErrorKind::parameter,
                "This sweep was started by eyrie-cli on files; resume it there (the same command with --resume).");
        }
        runs.push_back({clip.run, {.file = clip.ground_truth}, plan.evaluationOf(clip)});
    }
    OpenedRuns opened = openRunsForSweep(job.project, runs, stop);
    for (std::size_t i = 0; i < runs.size(); ++i) {
        if (opened.clips[i].digest == plan.clips[i].digest && opened.clips[i].upright == plan.clips[i].upright)
            continue;
        throw Error(ErrorKind::parameter, "The video or the ground truth of run " + std::to_string(runs[i].run_id) +
                                              ", or how they are compared, have changed since this sweep was started, "
                                              "so its points would not be comparable. Start a new sweep.");
    }
    return opened;
}

void SweepSession::work(const Job& job, const BackgroundTask& task) {
    const std::stop_token& stop = task.stop();
    QString problem;
    bool whole = false;
    try {
        SweepPlan plan;
        OpenedRuns opened;
        if (job.resumed) {
            opened = openResumed(job, plan, stop);
        } else {
            RunToSweep wanted{job.run_id, {.file = job.request.truth_file}, job.request.wishes};
            std::vector<RunToSweep> runs{wanted};
            for (const int run : job.request.other_runs) {
                wanted.run_id = run;
                if (run != job.run_id) runs.push_back(wanted);
            }
            opened = openRunsForSweep(job.project, runs, stop);
            plan.engine_version = engineVersion();
            for (const std::string& axis : job.request.axes) plan.axes.push_back(parseAxis(axis, opened.options));
            plan.base = parameterValues(opened.options);
            plan.clips = opened.clips;
            plan.overlaps = job.request.overlaps;
            plan.vehicles_only = job.request.wishes.vehicles_only;
            plan.one_class = job.request.wishes.one_class;
            plan.border = job.request.wishes.border;
            check(plan);
        }
        ProjectFile file = ProjectFile::open(job.project);
        const int id = beginSweep(file, plan, "", SweepFound::resumed);
        const auto held = lockSweep(file, id);
        auto growing = std::make_shared<SweepTable>(readSweep(file, id));
        std::vector<int> positions = workOrder(plan);
        std::erase_if(positions, [&](int position) { return growing->points.contains(position); });
        task.tell([this, growing, project = job.project] {
            if (project != session_.project()) return;  // it is about to stop
            growing_ = growing;
            selected_ = growing->id;
            table_ = growing_;
            emit changed(SweepChange::table);
            refreshList();
        });
        SweepRunOptions options;
        options.on_point = [&](const SweepPoint& point) {
            storePoint(file, id, point);
            const std::scoped_lock lock(mutex_);
            new_points_.push_back(point);
        };
        options.on_progress = [&](const SweepProgress& progress) {
            const std::scoped_lock lock(mutex_);
            new_progress_ = progress;
        };
        whole = runSweep(plan, opened.inputs, positions, stop, options) == static_cast<int>(positions.size());
    } catch (const std::exception& error) {
        if (!stop.stop_requested()) problem = QString::fromUtf8(error.what());
    }
    task.tell([this, whole, problem] { ended(whole, problem); });
}

void SweepSession::take() {
    std::vector<SweepPoint> points;
    std::optional<SweepProgress> progress;
    {
        const std::scoped_lock lock(mutex_);
        points.swap(new_points_);
        progress.swap(new_progress_);
    }
    if (!points.empty() && growing_) {
        for (SweepPoint& point : points) growing_->points[point.position] = std::move(point.figures);
        grown_ = true;
    }
    // A table of many points takes its time to be drawn: most of the time belongs to the user.
    if (grown_ && growing_ && table_ == growing_ &&
        (!since_shown_.isValid() || since_shown_.elapsed() >= kShareOfDrawing * showing_took_ms_)) {
        QElapsedTimer took;
        took.start();
        grown_ = false;
        emit changed(SweepChange::table);
        showing_took_ms_ = took.elapsed();
        since_shown_.start();
    }
    if (progress) {
        progress_ = *progress;
        emit progressed(progress_);
    }
}

void SweepSession::ended(bool whole, const QString& problem) {
    since_shown_.invalidate();
    take();
    pulse_.stop();
    running_ = false;
    growing_.reset();
    emit changed(SweepChange::running);
    if (problem.isEmpty())
        emit finished(whole);
    else
        emit failed(problem);
    refreshList();
}

}  // namespace eyrie::ui

#include "moc_sweep_session.cpp"
