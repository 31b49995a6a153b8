#include <algorithm>
#include <utility>

#include "session/project_session.h"

namespace eyrie::ui {

// The run that this window makes: starting it, and showing what it finds while it works.

void ProjectSession::startRun() {
    if (pending_ && pending_->purpose == Purpose::other_rate) {
        run_when_open_ = true;  // the rate was typed just before; the run is meant to have it
        return;
    }
    if (!media_ || running()) return;
    if (!project_open_) {
        emit problem(
            tr("There is no project to store the run in. Save one where you may write (File ▸ Save project as)."));
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
    beginRun(std::move(request));
}

bool ProjectSession::canContinue(int run_id) const {
    const RunRecord* run = findRun(run_id);
    const bool ended_early = std::find(resumable_runs_.begin(), resumable_runs_.end(), run_id) != resumable_runs_.end();
    return ended_early && run != nullptr && !running() && media_ && !missing_ && run->sequence.path == media_->identity;
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
    const auto found = std::find_if(tracks.begin(), tracks.end(), [track](const auto& one) { return one.id == track; });
    return found != tracks.end() ? &*found : nullptr;
}

const RunRecord* ProjectSession::ownRun() const {
    return own_run_ && project_ == run_project_ ? findRun(*own_run_) : nullptr;
}

void ProjectSession::liveRunStarted(const RunRecord& record) {
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
        for (RunRecord& run : runs_)
            if (own_run_ == run.id) run.frames_done += static_cast<int>(summaries.size());
        emit liveFrames(summaries);
    }
    if (!frame || !following_) return;
    current_frame_ = frame->index;
    emit changed(SessionChange::frame);
    view_frame_ = std::move(*frame);
    view_frame_.scale = scale();
    emit changed(SessionChange::picture);
}

void ProjectSession::liveRunEnded(const RunSummary& summary, int run_id) {
    const bool shown = project_ == run_project_;
    if (summary.outcome == RunOutcome::failed) emit problem(QString::fromStdString(summary.message));
    const bool followed = std::exchange(following_, false);
    if (followed) emit changed(SessionChange::following);
    if (shown) {
        reader_.readLists();
        if (run_id != 0) reader_.readFacts(run_id);
        // The stored tracks may differ from those seen live: they were finished with knowledge of the whole run.
        if (current_run_ == run_id && run_id != 0) {
            loader_.useRun(RunReference{project_, run_id}, kTrailLength);
            reader_.readRun(run_id);
        }
        if (followed) request();
    }
    own_run_.reset();
    emit changed(SessionChange::run_ended);
    emit runFinished(summary);
}

}  // namespace eyrie::ui
