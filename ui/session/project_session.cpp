#include "session/project_session.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "session/project_location.h"
#include "store/file_check.h"

namespace eyrie::ui {

namespace fs = std::filesystem;

namespace {
constexpr int kListRefresh_ms = 2000;
}  // namespace

ProjectSession::ProjectSession(QObject* parent) : QObject(parent) {
    connect(&loader_, &ResultLoader::openingProgress, this, [this](double share) {
        if (pending_) emit openingProgress(QString::fromStdString(pending_->media.name), share);
    });
    connect(&loader_, &ResultLoader::opened, this, &ProjectSession::mediaOpened);
    connect(&loader_, &ResultLoader::openFailed, this, &ProjectSession::mediaFailed);
    connect(&loader_, &ResultLoader::frameLoaded, this, &ProjectSession::frameLoaded);
    connect(&loader_, &ResultLoader::frameFailed, this,
            [this](FrameIndex, const QString& text) { emit problem(text); });
    connect(&reader_, &ProjectReader::opened, this, &ProjectSession::projectOpened);
    connect(&reader_, &ProjectReader::openFailed, this, &ProjectSession::projectFailed);
    connect(&reader_, &ProjectReader::runsRead, this, &ProjectSession::runsRead);
    connect(&reader_, &ProjectReader::runRead, this, &ProjectSession::runRead);
    connect(&reader_, &ProjectReader::trackRead, this,
            [this](int run_id, TrackId track, const std::vector<TrackFrame>& states) {
                if (current_run_ == run_id && selected_track_ == track) emit trackStatesRead(track, states);
            });
    connect(&reader_, &ProjectReader::failed, this, &ProjectSession::problem);
    connect(&reader_, &ProjectReader::copied, this, [this](const fs::path& target) {
        emit notice(tr("Saved a copy as %1.").arg(QString::fromStdString(target.string())));
    });
    connect(&controller_, &RunController::started, this, &ProjectSession::liveRunStarted);
    connect(&controller_, &RunController::progress, this, &ProjectSession::runProgress);
    connect(&controller_, &RunController::frameAvailable, this, &ProjectSession::liveFrameCame);
    connect(&controller_, &RunController::finished, this, &ProjectSession::liveRunEnded);
    connect(&playback_, &Playback::frameDue, this, &ProjectSession::showFrame);
    list_refresh_.setInterval(kListRefresh_ms);
    connect(&list_refresh_, &QTimer::timeout, this, [this] {
        if (running() && current_run_ && project_ == run_project_) reader_.readRun(*current_run_);
    });
}

ProjectSession::~ProjectSession() = default;

// ---- opening --------------------------------------------------------------------------------------------------------

void ProjectSession::open(const fs::path& path) {
    if (isProject(path))
        openProject(path);
    else
        openMedia(videoMedia(path));
}

void ProjectSession::openMedia(Media media, const fs::path& project) {
    beginOpening({std::move(media), project, std::nullopt, false});
}

void ProjectSession::beginOpening(Pending pending) {
    pending_ = std::move(pending);
    project_opens_video_ = false;
    emit openingProgress(QString::fromStdString(pending_->media.name), 0);
    loader_.openMedia(pending_->media, ++ticket_);
}

void ProjectSession::cancelOpening() {
    if (!pending_) return;
    ++ticket_;
    pending_.reset();
    loader_.cancelOpening();
    emit openingEnded();
}

void ProjectSession::openProject(const fs::path& project) {
    cancelOpening();
    if (running()) stopRun();
    project_opens_video_ = true;
    reader_.open(project, ProjectReader::Opening::must_exist);
}

void ProjectSession::mediaOpened(int ticket, const OpenedVideo& video) {
    if (ticket != ticket_ || !pending_) return;
    const Pending pending = *std::exchange(pending_, std::nullopt);
    emit openingEnded();
    if (running() && !pending.keep_place) stopRun();
    adoptVideo(pending.media, video, pending.keep_place);
    if (pending.keep_place) {
        request();
        return;
    }
    if (pending.run) {  // its project is open already
        adoptGsd(*pending.run);
        useRun(pending.run->id);
        emit ready(true);
        return;
    }
    project_open_ = false;
    runs_.clear();
    useRun(std::nullopt);
    emit runsChanged();
    const fs::path project =
        pending.project.empty() ? defaultProjectPath(pending.media.name, pending.media.identity) : pending.project;
    reader_.open(project, ProjectReader::Opening::create_if_missing);
}

void ProjectSession::mediaFailed(int ticket, const QString& message) {
    if (ticket != ticket_ || !pending_) return;
    const Pending pending = *std::exchange(pending_, std::nullopt);
    emit openingEnded();
    emit problem(message);
    if (pending.run) showWithoutVideo(*pending.run);
}

void ProjectSession::adoptVideo(Media media, const OpenedVideo& video, bool keep_place) {
    const FrameIndex place = keep_place ? std::min(current_frame_, std::max(0, video.info.frame_count - 1)) : 0;
    if (!keep_place) settings_.gsd_m_per_px = video.gsd_m_per_px;
    settings_.range = {};
    media_ = std::move(media);
    video_ = video.info;
    times_us_ = video.times_us;
    playback_.setTimes(times_us_);
    current_frame_ = place;
    view_frame_ = {};
    if (!keep_place) selectTrack(std::nullopt);
    emit videoChanged();
    emit frameChanged(current_frame_);
}

void ProjectSession::showWithoutVideo(const RunRecord& run) {
    OpenedVideo video;
    VideoInfo& info = video.info;
    info.path = run.sequence.path;
    info.size = run.sequence.size;
    info.frame_count = run.sequence.frame_count;
    info.frame_rate_hz = run.sequence.frame_rate_hz;
    video.times_us.resize(static_cast<size_t>(std::max(0, info.frame_count)));
    for (size_t i = 0; i < video.times_us.size(); ++i)
        video.times_us[i] = std::llround(static_cast<double>(i) * 1e6 / std::max(0.001, info.frame_rate_hz));
    loader_.closeMedia();
    adoptVideo(mediaOfIdentity(run.sequence.path), video, false);
    adoptGsd(run);
    useRun(run.id);
    emit ready(true);
}

void ProjectSession::adoptGsd(const RunRecord& run) {
    if (run.scale.gsd_known) settings_.gsd_m_per_px = run.scale.gsd_m_per_px;
}

void ProjectSession::setFrameRate(double frames_per_second) {
    if (!media_ || running()) return;
    beginOpening({mediaOfIdentity(media_->identity, frames_per_second), project_, std::nullopt, true});
}

// ---- project and runs -----------------------------------------------------------------------------------------------

void ProjectSession::projectOpened(const fs::path& project, const std::vector<RunRecord>& runs) {
    const bool opens_video = std::exchange(project_opens_video_, false);
    project_ = project;
    project_open_ = true;
    runs_ = runs;
    emit projectChanged();
    emit runsChanged();
    if (opens_video) {
        if (runs_.empty()) {
            useRun(std::nullopt);
            emit problem(tr("%1 holds no runs yet. Open a video to make one.")
                             .arg(QString::fromStdString(project.filename().string())));
            return;
        }
        const RunRecord& run = runs_.back();
        current_run_.reset();
        beginOpening({mediaOfIdentity(run.sequence.path), project, run, false});
        return;
    }
    const RunRecord* shown = newestRun(true);
    const bool finished = shown != nullptr;
    if (!finished) shown = newestRun(false);
    if (shown != nullptr) adoptGsd(*shown);
    useRun(shown != nullptr ? std::optional(shown->id) : std::nullopt);
    emit ready(finished);
}

const RunRecord* ProjectSession::newestRun(bool finished) const {
    const auto found = std::find_if(runs_.rbegin(), runs_.rend(), [&](const RunRecord& run) {
        const bool of_this_video = media_ && run.sequence.path == media_->identity;
        return of_this_video && run.frames_done > 0 && (!finished || run.state == RunState::finished);
    });
    return found == runs_.rend() ? nullptr : &*found;
}

void ProjectSession::projectFailed(const fs::path&, const QString& message) {
    project_opens_video_ = false;
    emit problem(message);
    if (!project_open_) {
        project_.clear();
        emit projectChanged();
        request();
    }
}

void ProjectSession::saveProjectCopy(const fs::path& target) {
    if (project_open_) reader_.saveCopy(target);
}

const RunRecord* ProjectSession::findRun(int run_id) const {
    const auto found = std::find_if(runs_.begin(), runs_.end(), [&](const RunRecord& r) { return r.id == run_id; });
    return found == runs_.end() ? nullptr : &*found;
}

void ProjectSession::showRun(int run_id) {
    const RunRecord* run = findRun(run_id);
    if (run == nullptr || current_run_ == run_id) return;
    if (running()) setFollowing(false);
    if (media_ && media_->identity != run->sequence.path) {
        beginOpening({mediaOfIdentity(run->sequence.path), project_, *run, false});
        return;
    }
    useRun(run_id);
}

void ProjectSession::useRun(std::optional<int> run_id) {
    current_run_ = run_id;
    run_data_.reset();
    selectTrack(std::nullopt);
    emit currentRunChanged();
    if (run_id) {
        loader_.useRun(RunReference{project_, *run_id}, kTrailLength);
        reader_.readRun(*run_id);
    } else {
        loader_.useRun(std::nullopt, 0);
    }
    request();
}

void ProjectSession::removeRun(int run_id) {
    if (running() && current_run_ == run_id) {
        emit problem(tr("This run is still at work. Stop it before removing it."));
        return;
    }
    if (current_run_ == run_id) useRun(std::nullopt);
    reader_.removeRun(run_id);
}

void ProjectSession::runsRead(const std::vector<RunRecord>& runs) {
    runs_ = runs;
    emit runsChanged();
}

void ProjectSession::runRead(const std::shared_ptr<const RunData>& run) {
    if (current_run_ != run->record.id) return;
    run_data_ = run;
    emit runDataChanged();
    if (selected_track_) reader_.readTrack(run->record.id, *selected_track_);
}

SceneScale ProjectSession::scale() const {
    if (current_run_) {
        if (const RunRecord* run = findRun(*current_run_)) return run->scale;
    }
    SceneScale scale;
    if (video_) scale.frame_rate_hz = video_->frame_rate_hz;
    scale.gsd_known = settings_.gsd_m_per_px > 0;
    if (scale.gsd_known) scale.gsd_m_per_px = settings_.gsd_m_per_px;
    return scale;
}

// ---- running --------------------------------------------------------------------------------------------------------

void ProjectSession::startRun() {
    if (!media_ || running()) return;
    if (!project_open_) {
        emit problem(
            tr("There is no project to store the run in. Save one where you may write (File ▸ Save project as)."));
        return;
    }
    playback_.pause();
    RunRequest request;
    request.media = *media_;
    request.project = project_;
    request.options = settings_.options;
    request.preset = settings_.preset;
    request.gsd_m_per_px = settings_.gsd_m_per_px;
    request.range = settings_.range;
    request.trail_length = kTrailLength;
    run_project_ = project_;
    controller_.start(std::move(request));
    emit runPreparing();
    setFollowing(true);
}

void ProjectSession::liveRunStarted(const RunRecord& record) {
    if (project_ != run_project_) return;
    runs_.push_back(record);
    emit runsChanged();
    useRun(record.id);
    reader_.readRuns();  // its record as it was stored, with the time it began
    list_refresh_.start();
    emit runStarted(record);
}

void ProjectSession::liveFrameCame() {
    const auto summaries = controller_.takeSummaries();
    auto frame = controller_.takeFrame();
    if (project_ != run_project_) return;
    if (!summaries.empty()) {
        if (!runs_.empty()) runs_.back().frames_done += static_cast<int>(summaries.size());
        emit liveFrames(summaries);
    }
    if (!frame || !following_) return;
    current_frame_ = frame->index;
    emit frameChanged(current_frame_);
    view_frame_ = std::move(*frame);
    emit viewFrameChanged(view_frame_);
}

void ProjectSession::liveRunEnded(const RunSummary& summary, int run_id) {
    list_refresh_.stop();
    if (summary.outcome == RunOutcome::failed) emit problem(QString::fromStdString(summary.message));
    const bool followed = following_;
    setFollowing(false);
    if (project_ == run_project_) {
        reader_.readRuns();
        // The stored tracks may differ from those seen live: they were finished with knowledge of the whole run.
        if (current_run_ == run_id && run_id != 0) reader_.readRun(run_id);
        if (followed) request();
    }
    emit runFinished(summary);
}

}  // namespace eyrie::ui
