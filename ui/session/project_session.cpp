#include "session/project_session.h"

#include <algorithm>
#include <utility>

namespace eyrie::ui {

namespace fs = std::filesystem;

namespace {
constexpr int kListRefresh_ms = 1500;
constexpr int kLengthStep = 10;  ///< frames

/// Whether more of a run can be read than before.
bool hasGrown(const RunRecord& before, const RunRecord& now) {
    return before.frames_done != now.frames_done || before.state != now.state || before.live != now.live;
}
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
    connect(&reader_, &ProjectReader::copiedForMove, this, &ProjectSession::beginMove);
    connect(&reader_, &ProjectReader::moveFailed, this, &ProjectSession::moveFailed);
    connect(&reader_, &ProjectReader::movedTo, this, &ProjectSession::projectMovedTo);
    connect(&reader_, &ProjectReader::read, this, &ProjectSession::listsRead);
    connect(&reader_, &ProjectReader::runRead, this, &ProjectSession::runRead);
    connect(&reader_, &ProjectReader::factsRead, this, &ProjectSession::runSummarised);
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
        if (project_open_) reader_.readListsIfChanged();
    });
    list_refresh_.start();
}

ProjectSession::~ProjectSession() = default;

// ---- project and runs ----------------------------------------------------------------------------------------------

void ProjectSession::takeLists(const ProjectLists& lists) {
    runs_ = lists.runs;
    last_removed_run_ = lists.last_removed;
    resumable_runs_ = lists.resumable;
    sequences_ = lists.sequences;
    starts_ = lists.starts;
    control_ = lists.control;
}

std::optional<std::int64_t> ProjectSession::givenStart() const {
    if (!media_) return std::nullopt;
    for (const SequenceRecord& sequence : sequences_)
        if (sequence.path == media_->identity)
            if (const auto found = starts_.find(sequence.id); found != starts_.end()) return found->second;
    return std::nullopt;
}

std::vector<ControlPoint> ProjectSession::givenControl() const {
    if (!media_) return {};
    for (const SequenceRecord& sequence : sequences_)
        if (sequence.path == media_->identity)
            if (const auto found = control_.find(sequence.id); found != control_.end()) return found->second;
    return {};
}

void ProjectSession::listsRead(const ProjectLists& lists) {
    if (!project_open_ || lists.project != project_) return;
    std::optional<RunRecord> before;
    if (current_run_)
        if (const RunRecord* run = findRun(*current_run_)) before = *run;
    takeLists(lists);
    emit changed(SessionChange::runs);
    if (!before) return;
    const RunRecord* now = findRun(before->id);
    if (now == nullptr || !hasGrown(*before, *now)) return;
    reader_.readRun(now->id, corrected_);
    // Finishing a run changes frames that were shown while it worked.
    if (before->live && !now->live) loader_.useRun(RunReference{project_, now->id}, kTrailLength);
    if (!now->live) request();
}

void ProjectSession::projectFailed(const fs::path&, const QString& message) {
    const bool awaited = isAwaited();
    if (awaited) project_opens_video_ = false;
    emit problem(message);
    if (awaited && !project_open_) {
        project_.clear();
        emit changed(SessionChange::project);
        request();
    }
}

void ProjectSession::saveProjectCopy(const fs::path& target) {
    keepWritten();
    if (project_open_) reader_.saveCopy(target);
}

void ProjectSession::saveProjectAs(const fs::path& target) {
    if (running()) {
        emit problem(
            tr("A run is writing into the project. Stop it, or wait until it ends, before saving the project under "
               "another name."));
        return;
    }
    if (project_open_)
        reader_.copyForMove(target);
    else if (media_ && video_) {
        awaitProject(false);
        reader_.openFor(media_->name, media_->identity, *video_, target);
    }
}

/// The copy is made. What is at work in the background ends first, with what it has found by now.
void ProjectSession::beginMove() {
    if (!project_open_ || moved_from_) return;
    move_wait_.watch();
    endWork();
    move_wait_.begin([this](bool) { leaveForMove(); });
}

/// What was done meanwhile, and what is being written, goes into the former file; then nobody writes there any more, so
/// that the rest can be copied.
void ProjectSession::leaveForMove() {
    if (running()) {
        reader_.dropMove();
        emit problem(
            tr("The project was not saved under another name: a run has begun to write into it. Save again when "
               "it has ended."));
        return;
    }
    keepWritten();
    moved_from_ = std::exchange(project_, {});
    emit changed(SessionChange::project);
    move_wait_.begin([this](bool all_written) { finishMove(all_written); });
}

/// A change that does not reach the former file would not be in the copy either: work goes on where it was.
void ProjectSession::finishMove(bool all_written) {
    if (all_written && !move_wait_.anythingFailed()) {
        reader_.move();
        return;
    }
    reader_.dropMove();
    moveFailed(all_written
                   ? tr("The project was not saved under another name, since your last change could not be stored in "
                        "the present one. Work goes on there; make the change again, then save.")
                   : tr("The project was not saved under another name, since your last change is still being stored "
                        "in the present one. Work goes on there; save again in a moment."));
}

/// Something else is asked for, which comes after.
void ProjectSession::endMove() {
    if (!move_wait_.waiting()) return;
    move_wait_.cancel();
    if (project_open_ && !moved_from_) {  // what is at work has not ended yet
        leaveForMove();
        if (!moved_from_) return;
        move_wait_.cancel();
    }
    reader_.move();
}

void ProjectSession::moveFailed(const QString& message) {
    emit problem(message);
    if (!moved_from_) return;
    project_ = *std::exchange(moved_from_, std::nullopt);
    emit changed(SessionChange::project);
    useRun(current_run_);
}

void ProjectSession::projectMovedTo(const ProjectLists& lists) {
    if (!std::exchange(moved_from_, std::nullopt)) return;  // it was closed meanwhile
    project_ = lists.project;
    takeLists(lists);
    emit changed(SessionChange::project);
    emit changed(SessionChange::runs);
    useRun(current_run_);
    emit notice(
        tr("Saved as %1. What you do from now on goes there.").arg(QString::fromStdString(lists.project.string())));
}

const RunRecord* ProjectSession::findRun(int run_id) const {
    const auto found = std::find_if(runs_.begin(), runs_.end(), [&](const RunRecord& r) { return r.id == run_id; });
    return found == runs_.end() ? nullptr : &*found;
}

const RunRecord* ProjectSession::newestRun(bool finished) const {
    const auto found = std::find_if(runs_.rbegin(), runs_.rend(), [&](const RunRecord& run) {
        const bool of_this_video = media_ && run.sequence.path == media_->identity;
        return of_this_video && run.frames_done > 0 && (!finished || run.state == RunState::finished);
    });
    return found == runs_.rend() ? nullptr : &*found;
}

void ProjectSession::showRun(int run_id) {
    const RunRecord* run = findRun(run_id);
    if (run == nullptr || current_run_ == run_id) return;
    if (running()) setFollowing(false);
    if (media_ && media_->identity != run->sequence.path) {
        endWork();
        const Media media = mediaOfIdentity(run->sequence.path, {.remembered_hz = run->sequence.rememberedRate()});
        beginOpening({media, Purpose::of_project, project_, run->sequence, run_id});
        return;
    }
    useRun(run_id);
    adoptGsd();
}

void ProjectSession::useRun(std::optional<int> run_id) {
    if (run_id && findRun(*run_id) == nullptr) run_id.reset();
    if (run_id != current_run_) keepWritten();
    current_run_ = run_id;
    run_data_.reset();
    selectTrack(std::nullopt);
    emit changed(SessionChange::current_run);
    if (run_id) {
        loader_.useRun(RunReference{fileOfProject(), *run_id}, kTrailLength);
        reader_.readRun(*run_id, corrected_);
    } else {
        loader_.useRun(std::nullopt, 0);
    }
    request();
}

void ProjectSession::showCorrected(bool corrected) {
    if (std::exchange(corrected_, corrected) == corrected) return;
    if (run_data_ && run_data_->correctable) correctionsChanged();
}

void ProjectSession::correctionsChanged() {
    if (current_run_) reader_.readRun(*current_run_, corrected_);
}

void ProjectSession::adoptGsd() {
    const RunRecord* run = current_run_ ? findRun(*current_run_) : nullptr;
    if (run == nullptr) return;
    if (run->scale.gsd_known)
        settings_.useGsd(run->scale.gsd_m_per_px, run->scale_basis.origin);
    else
        settings_.useGsd(0);
    emit changed(SessionChange::scale);
}

void ProjectSession::removeRun(int run_id) {
    if (running() && own_run_ == run_id) {
        emit problem(tr("This run has not ended yet. Stop it before removing it."));
        return;
    }
    const RunRecord* run = findRun(run_id);
    if (run == nullptr) return;
    const RunRecord removed = *run;
    // Out of the list first, so that nobody chooses it again while it goes.
    std::erase_if(runs_, [run_id](const RunRecord& each) { return each.id == run_id; });
    emit changed(SessionChange::runs);
    if (current_run_ == run_id) useRun(std::nullopt);
    reader_.removeRun(run_id);
    emit runRemoved(removed);
}

void ProjectSession::runRead(const std::shared_ptr<const RunData>& run) {
    if (current_run_ != run->record.id) return;
    const bool other_tracks = !run->corrected->empty() || (run_data_ && !run_data_->corrected->empty());
    run_data_ = run;
    if (other_tracks) {
        loader_.useRun(RunReference{fileOfProject(), run->record.id, run->corrected}, kTrailLength);
        request();
    }
    emit changed(SessionChange::run_data);
    if (selected_track_) reader_.readTrack(run->record.id, *selected_track_, run->corrected);
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

// ---- the run that this window makes: starting it, and showing what it finds while it works -------------------------

void ProjectSession::startRun() {
    if (pending_ && pending_->purpose == Purpose::other_rate) {
        run_when_open_ = true;  // the rate was typed just before; the run is meant to have it
        return;
    }
    if (!media_ || running()) return;
    if (moved_from_) {
        emit problem(tr("The project is being saved under another name. Start the run when that is done."));
        return;
    }
    if (!project_open_) {
        emit problem(
            tr("There is no project to store the run in. Save one where you can write (File ▸ Save project as)."));
        return;
    }
    if (missing_) {
        emit problem(tr("The video is not there: %1. Locate it first; a run has to read its frames.")
                         .arg(QString::fromStdString(missing_->path)));
        return;
    }
    RunRequest request;
    request.options = settings_.options;
    request.preset = settings_.preset;
    request.gsd_m_per_px = settings_.gsd_m_per_px;
    request.gsd_origin = settings_.gsd_origin;
    request.range = settings_.range;
    request.recording = settings_.recording;
    beginRun(std::move(request));
}

bool ProjectSession::canContinue(int run_id) const {
    const RunRecord* run = findRun(run_id);
    const bool ended_early = std::find(resumable_runs_.begin(), resumable_runs_.end(), run_id) != resumable_runs_.end();
    return ended_early && run != nullptr && !running() && !moved_from_ && media_ && !missing_ &&
           run->sequence.path == media_->identity;
}

void ProjectSession::continueRun(int run_id) {
    if (!canContinue(run_id)) return;
    RunRequest request;
    request.resume_run = run_id;
    beginRun(std::move(request));
}

void ProjectSession::beginRun(RunRequest request) {
    playback_.pause();
    request.media = *media_;
    request.project = project_;
    request.trail_length = kTrailLength;
    run_project_ = project_;
    own_run_.reset();
    controller_.start(std::move(request));
    emit changed(SessionChange::run_preparing);
    setFollowing(true);
}

void ProjectSession::watchLive(LiveRequest request) {
    if (running()) return;
    cancelOpening();
    if (std::exchange(project_opens_video_, false)) project_overtaken_ = true;
    playback_.pause();
    request.options = settings_.options;
    request.preset = settings_.preset;
    request.details = settings_.recording;
    request.stream.with_colour = true;
    live_ = request;
    run_project_.clear();
    own_run_.reset();
    controller_.watch(std::move(request), kTrailLength);
    emit changed(SessionChange::run_preparing);
}

const FrameSummary* ProjectSession::frameSummary(FrameIndex frame) const {
    if (!run_data_) return nullptr;
    const auto& frames = run_data_->frames;
    const auto found = std::lower_bound(frames.begin(), frames.end(), frame,
                                        [](const FrameSummary& one, FrameIndex index) { return one.frame < index; });
    return found != frames.end() && found->frame == frame ? &*found : nullptr;
}

bool ProjectSession::detailsKept(FrameIndex frame) const {
    const FrameSummary* summary = frameSummary(frame);
    return summary == nullptr || summary->details;
}

const TrackSummary* ProjectSession::trackSummary(TrackId track) const {
    if (!run_data_) return nullptr;
    const auto& tracks = run_data_->tracks;
    const auto found = std::lower_bound(tracks.begin(), tracks.end(), track,
                                        [](const TrackSummary& one, TrackId wanted) { return one.id < wanted; });
    return found != tracks.end() && found->id == track ? &*found : nullptr;
}

const RunRecord* ProjectSession::ownRun() const {
    return own_run_ && project_ == run_project_ ? findRun(*own_run_) : nullptr;
}

void ProjectSession::growVideo(const std::vector<FrameSummary>& frames) {
    if (!live_ || !video_) return;
    for (const FrameSummary& frame : frames) times_us_.push_back(frame.time_us);
    video_->frame_count = static_cast<int>(times_us_.size());
    // Told so seldom that what hangs on it costs little, of hours, too.
    if (video_->frame_count < told_length_ + std::max(kLengthStep, told_length_ / 200)) return;
    told_length_ = video_->frame_count;
    emit changed(SessionChange::length);
}

void ProjectSession::liveRunStarted(const RunRecord& record) {
    if (live_) adoptLive(record);
    if (project_ != run_project_) return;
    own_run_ = record.id;
    if (findRun(record.id) == nullptr) runs_.push_back(record);
    emit changed(SessionChange::runs);
    useRun(record.id);
    reader_.readLists();  // its record as it was stored, with the time it began
    emit changed(SessionChange::run_started);
}

void ProjectSession::liveFrameCame() {
    const auto summaries = controller_.takeSummaries();
    auto frame = controller_.takeFrame();
    if (project_ != run_project_) return;
    if (!summaries.empty()) {
        growVideo(summaries);
        for (RunRecord& run : runs_)
            // Not counted one by one: a list that was read meanwhile may know of some of them already.
            if (own_run_ == run.id)
                run.frames_done = std::max(run.frames_done, summaries.back().frame - run.first_frame + 1);
        emit liveFrames(summaries);
    }
    if (!frame || !following_) return;
    current_frame_ = frame->index;
    emit changed(SessionChange::frame);
    view_frame_ = std::move(*frame);
    view_frame_.scale = scale().zoomed(view_frame_.result ? view_frame_.result->motion.registration.zoom : 1);
    emit changed(SessionChange::picture);
}

void ProjectSession::liveRunEnded(const RunSummary& summary, int run_id) {
    const bool shown = project_ == run_project_;
    const std::optional<LiveRequest> live = std::exchange(live_, std::nullopt);
    const bool refused = live && run_id == 0;
    if (summary.outcome == RunOutcome::failed && !refused) emit problem(QString::fromStdString(summary.message));
    const bool followed = std::exchange(following_, false);
    if (followed) emit changed(SessionChange::following);
    if (shown) {
        reader_.readLists();
        if (run_id != 0 && !live) reader_.readFacts(run_id);
        // The stored tracks may differ from those seen live: they were finished with knowledge of the whole run.
        if (current_run_ == run_id && run_id != 0) {
            loader_.useRun(RunReference{project_, run_id}, kTrailLength);
            reader_.readRun(run_id, corrected_);
        }
        if (followed && !live) request();
    }
    const RunRecord* recorded = live && !refused ? ownRun() : nullptr;
    if (recorded != nullptr && !pending_) readRecording(*recorded);
    own_run_.reset();
    emit changed(SessionChange::run_ended);
    if (refused && summary.outcome == RunOutcome::failed) emit liveRefused(QString::fromStdString(summary.message));
    emit runFinished(summary);
}

}  // namespace eyrie::ui

#include "moc_project_session.cpp"
