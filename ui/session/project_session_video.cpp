#include <algorithm>
#include <utility>

#include "session/project/project_location.h"
#include "session/project_session.h"
#include "store/health/file_check.h"

namespace eyrie::ui {

// Opening videos and projects, finding the one that belongs to the other, and where in the video one is.

namespace fs = std::filesystem;

namespace {
Media mediaOf(const SequenceRecord& sequence) {
    return mediaOfIdentity(sequence.path, {.remembered_hz = sequence.rememberedRate()});
}
}  // namespace

void ProjectSession::open(const fs::path& path) {
    if (isProject(path))
        openProject(path);
    else
        openMedia(videoMedia(path));
}

void ProjectSession::open(const std::vector<fs::path>& files) {
    if (files.size() == 1)
        open(files.front());
    else if (!files.empty())
        openMedia(partsMedia(files));
}

void ProjectSession::openMedia(Media media, const fs::path& project) {
    endWork();  // what is at work in the background may end, and be stored, while this is opened
    beginOpening({std::move(media), Purpose::another_video, project});
}

void ProjectSession::beginOpening(Pending pending) {
    pending_ = std::move(pending);
    // Nobody asked for a recording to be read; a project that somebody did ask for still comes.
    if (pending_->purpose != Purpose::recorded && std::exchange(project_opens_video_, false)) project_overtaken_ = true;
    run_when_open_ = false;
    emit openingProgress(QString::fromStdString(pending_->media.name), 0);
    loader_.openMedia(pending_->media, ++ticket_);
}

void ProjectSession::cancelOpening() {
    if (!pending_) return;
    ++ticket_;
    pending_.reset();
    run_when_open_ = false;
    loader_.cancelOpening();
    emit openingEnded();
}

void ProjectSession::openProject(const fs::path& project) {
    endWork();
    cancelOpening();
    if (running()) stopRun();
    awaitProject(true);
    reader_.open(project);
}

void ProjectSession::mediaOpened(int ticket, const OpenedVideo& video) {
    if (ticket != ticket_ || !pending_) return;
    Pending pending = *std::exchange(pending_, std::nullopt);
    if (pending.media.becomes_list)
        pending.media = videoMedia(video.info.path, {.given_hz = pending.media.given_rate_hz});
    emit openingEnded();
    if (pending.purpose == Purpose::recorded) {
        adoptRecording(pending, video);
        return;
    }
    if (pending.purpose == Purpose::moved && !isSameVideo(*pending.sequence, video.info)) {
        showWithoutVideo(*pending.sequence, pending.run,
                         whyAnotherVideo(pending.media.identity, video.info, *pending.sequence));
        return;
    }
    if (pending.purpose == Purpose::moved && isOfAnother(pending, video.info)) {
        showWithoutVideo(*pending.sequence, pending.run,
                         tr("%1 is another video of this project, with runs and labels of its own. Move the video of "
                            "these results to another place, and locate it there")
                             .arg(QString::fromStdString(pending.media.identity)));
        return;
    }
    const bool same_video = pending.purpose == Purpose::other_rate || pending.purpose == Purpose::remembered_rate;
    if (running() && !same_video) stopRun();
    adoptVideo(pending.media, video, same_video);
    switch (pending.purpose) {
        case Purpose::other_rate:
            keepFrameRate();
            request();
            if (std::exchange(run_when_open_, false)) startRun();
            return;
        case Purpose::moved:
            adoptMovedVideo(*pending.sequence, pending.media.identity);
            showProject(pending.run);
            return;
        case Purpose::remembered_rate:
        case Purpose::of_project:
            showProject(pending.run);
            return;
        case Purpose::another_video:
        case Purpose::recorded:
            break;
    }
    project_open_ = false;
    moved_from_.reset();
    takeLists({});
    useRun(std::nullopt);
    emit changed(SessionChange::runs);
    awaitProject(false);
    reader_.openFor(pending.media.name, pending.media.identity, video.info, pending.project);
}

/// Whether the project knows another video at the place where one was found.
bool ProjectSession::isOfAnother(const Pending& pending, const VideoInfo& video) const {
    return std::any_of(sequences_.begin(), sequences_.end(), [&](const SequenceRecord& sequence) {
        return sequence.id != pending.sequence->id && sequence.path == pending.media.identity &&
               sequence.size == video.size;
    });
}

void ProjectSession::mediaFailed(int ticket, const QString& message) {
    if (ticket != ticket_ || !pending_) return;
    const Pending pending = *std::exchange(pending_, std::nullopt);
    run_when_open_ = false;
    emit openingEnded();
    if (pending.purpose == Purpose::of_project || (pending.purpose == Purpose::recorded && !live_))
        findMovedVideo(pending, message);
    else if (pending.purpose == Purpose::moved)
        showWithoutVideo(*pending.sequence, pending.run, message);
    else
        emit problem(message);
}

void ProjectSession::adoptVideo(Media media, const OpenedVideo& video, bool keep_place) {
    const FrameIndex place = keep_place ? std::min(current_frame_, std::max(0, video.info.frame_count - 1)) : 0;
    if (!keep_place) {
        keepWritten();
        // A run over the former video may still be stopping: its frames are not of this one.
        setFollowing(false);
        run_project_.clear();
        settings_.useGsd(video.gsd_m_per_px);
        missing_.reset();
    }
    settings_.range = {};
    media_ = std::move(media);
    video_ = video.info;
    times_us_ = video.times_us;
    playback_.setTimes(times_us_);
    current_frame_ = place;
    view_frame_ = {};
    view_frame_.index = place;
    if (!keep_place) selectTrack(std::nullopt);
    emit changed(SessionChange::video);
    emit changed(SessionChange::frame);
}

// ---- the project ---------------------------------------------------------------------------------------------------

/// A project is on its way from now on; what was asked for before is not wanted any more.
void ProjectSession::awaitProject(bool opens_video) {
    endMove();
    ++projects_due_;
    project_opens_video_ = opens_video;
    project_overtaken_ = false;
}

/// Whether the answer that has come is that to what was asked for last. If not, what is shown stays.
bool ProjectSession::isAwaited() {
    if (--projects_due_ > 0) return false;
    if (!std::exchange(project_overtaken_, false)) return true;
    reader_.forget();
    return false;
}

void ProjectSession::projectOpened(const ProjectLists& lists) {
    if (!isAwaited()) return;
    keepWritten();
    endMove();
    reader_.takeUp();
    moved_from_.reset();
    const bool opens_video = std::exchange(project_opens_video_, false);
    project_ = lists.project;
    project_open_ = true;
    takeLists(lists);
    if (!lists.notice.empty()) emit notice(QString::fromStdString(lists.notice));
    if (opens_video) {
        cancelOpening();  // of a recording
        openVideoOfProject();
        return;
    }
    if (live_ && project_ == run_project_) {
        adoptLiveProject();
        return;
    }
    emit changed(SessionChange::project);
    emit changed(SessionChange::runs);
    const SequenceRecord* known = sequenceOfVideo();
    if (media_->given_rate_hz > 0) {
        keepFrameRate();
    } else if (known != nullptr && (!isSameRate(known->frame_rate_hz, video_->frame_rate_hz) ||
                                    (video_->frame_rate_assumed && !known->rate_assumed))) {
        beginOpening({mediaOf(*known), Purpose::remembered_rate});
        return;
    }
    showProject(std::nullopt);
}

void ProjectSession::openVideoOfProject() {
    current_run_.reset();
    // The video is on its way before anybody hears of the project: the former one is none of its.
    if (!runs_.empty()) {
        const RunRecord& run = runs_.back();
        beginOpening({mediaOf(run.sequence), Purpose::of_project, project_, run.sequence, run.id});
    } else if (!sequences_.empty()) {
        const SequenceRecord& sequence = sequences_.back();
        beginOpening({mediaOf(sequence), Purpose::of_project, project_, sequence});
    } else {
        closeVideo();
        emit problem(tr("%1 holds neither runs nor labels. Open a video to begin.")
                         .arg(QString::fromStdString(project_.filename().string())));
    }
    emit changed(SessionChange::project);
    emit changed(SessionChange::runs);
}

void ProjectSession::closeVideo() {
    keepWritten();
    loader_.closeMedia();
    media_.reset();
    video_.reset();
    missing_.reset();
    times_us_.clear();
    playback_.setTimes({});
    current_frame_ = 0;
    view_frame_ = {};
    useRun(std::nullopt);
    emit changed(SessionChange::video);
}

void ProjectSession::closeProject() {
    endMove();
    moved_from_.reset();
    cancelOpening();
    project_opens_video_ = false;
    project_overtaken_ = projects_due_ > 0;
    closeVideo();
    reader_.close();
    project_open_ = false;
    project_.clear();
    takeLists({});
    emit changed(SessionChange::project);
    emit changed(SessionChange::runs);
}

void ProjectSession::showProject(std::optional<int> run_id) {
    bool finished = true;
    if (!run_id || findRun(*run_id) == nullptr) {
        const RunRecord* shown = newestRun(true);
        finished = shown != nullptr;
        if (!finished) shown = newestRun(false);
        run_id = shown != nullptr ? std::optional(shown->id) : std::nullopt;
    }
    useRun(run_id);
    adoptGsd();
    emit changed(SessionChange::opened);
    emit ready(finished);
}

const SequenceRecord* ProjectSession::sequenceOfVideo() const {
    const auto found = std::find_if(sequences_.begin(), sequences_.end(), [&](const SequenceRecord& sequence) {
        return media_ && video_ && sequence.path == media_->identity && sequence.size == video_->size;
    });
    return found == sequences_.end() ? nullptr : &*found;
}

QString ProjectSession::partText(FrameIndex frame) const {
    const VideoPart* part = video_ ? video_->partOf(frame) : nullptr;
    if (part == nullptr) return {};
    return tr("%1, its frame %2 of %3")
        .arg(QString::fromStdString(part->file.filename().string()))
        .arg(frame - part->first_frame)
        .arg(part->frame_count);
}

// ---- the frame rate ------------------------------------------------------------------------------------------------

void ProjectSession::setFrameRate(double frames_per_second) {
    if (!media_ || running() || missing_) return;
    endWork();
    beginOpening({mediaOfIdentity(media_->identity, {.given_hz = frames_per_second}), Purpose::other_rate});
}

SequenceRecord ProjectSession::sequenceToStore() const {
    return sequenceOf(*media_, *video_);
}

void ProjectSession::keepFrameRate() {
    if (project_open_ && media_ && video_) reader_.storeSequence(sequenceToStore());
}

// ---- videos that are not where they were ---------------------------------------------------------------------------

void ProjectSession::findMovedVideo(const Pending& pending, const QString& message) {
    const auto candidate = movedBeside(project_, *pending.sequence);
    if (!candidate) {
        showWithoutVideo(*pending.sequence, pending.run, message);
        return;
    }
    const Media media = videoMedia(*candidate, {.remembered_hz = pending.sequence->rememberedRate()});
    beginOpening({media, Purpose::moved, project_, pending.sequence, pending.run});
}

void ProjectSession::locateVideo(const std::vector<fs::path>& files) {
    if (!missing_ || files.empty()) return;
    const Media media = locatedMedia(missing_->path, files, {.remembered_hz = missing_->rememberedRate()});
    beginOpening({media, Purpose::moved, project_, missing_, current_run_});
}

void ProjectSession::adoptMovedVideo(const SequenceRecord& known, const std::string& identity) {
    for (SequenceRecord& sequence : sequences_)
        if (sequence.id == known.id) sequence.path = identity;
    for (RunRecord& run : runs_)
        if (run.sequence.id == known.id) run.sequence.path = identity;
    reader_.relocateSequence(known.id, identity);
    emit changed(SessionChange::runs);
    const QString place = QString::fromStdString(identity);
    emit notice(identity == known.path ? tr("All parts are found; %1 remembers where they are.").arg(place)
                                       : tr("The video is at %1 now; the project remembers it.").arg(place));
}

void ProjectSession::showWithoutVideo(const SequenceRecord& sequence, std::optional<int> run_id,
                                      const QString& message) {
    loader_.closeMedia();
    adoptVideo(mediaOf(sequence), videoNotThere(sequence), false);
    missing_ = sequence;
    showProject(run_id);
    emit videoNotFound(message);
}

// ---- live sources: the video that is being recorded ----------------------------------------------------------------

void ProjectSession::adoptLive(const RunRecord& record) {
    cancelOpening();
    loader_.closeMedia();
    OpenedVideo video;
    video.info.path = record.sequence.path;
    video.info.size = record.sequence.size;
    video.info.frame_rate_hz = record.sequence.frame_rate_hz;
    project_open_ = false;
    moved_from_.reset();
    takeLists({});
    useRun(std::nullopt);
    adoptVideo(mediaOf(record.sequence), video, false);
    if (record.scale.gsd_known) settings_.useGsd(record.scale.gsd_m_per_px, record.scale_basis.origin);
    told_length_ = readable_length_ = 0;
    project_ = run_project_ = live_->project;
    awaitProject(false);
    reader_.openInstead(project_);
    setFollowing(true);
}

void ProjectSession::adoptLiveProject() {
    emit changed(SessionChange::project);
    emit changed(SessionChange::runs);
    emit changed(SessionChange::opened);
    emit ready(false);
    setFollowing(true);  // however the project was looked at before
}

void ProjectSession::readRecording(const RunRecord& run) {
    Pending recording{mediaOf(run.sequence), Purpose::recorded, project_, run.sequence, run.id};
    recording.sequence->frame_count = video_->frame_count;
    beginOpening(std::move(recording));
}

void ProjectSession::adoptRecording(const Pending& pending, const OpenedVideo& video) {
    readable_length_ = video.info.frame_count;
    if (live_) {  // it still grows: only its pictures are of use
        loader_.request(current_frame_, 0);
        return;
    }
    const std::string remark = remarkOnRecording(video.info.frame_count, pending.sequence->frame_count);
    if (!remark.empty()) emit notice(tr("Note: %1.").arg(QString::fromStdString(remark)));
    adoptVideo(pending.media, video, true);
    useRun(pending.run);
    adoptGsd();
    emit changed(SessionChange::opened);
    if (pending.run) reader_.readFacts(*pending.run);
}

// ---- where in the video one is, playing, and which track is looked at ----------------------------------------------

void ProjectSession::follow() {
    if (running()) setFollowing(true);
}

void ProjectSession::setFollowing(bool following) {
    if (following == following_) return;
    following_ = following;
    if (following) playback_.pause();
    emit changed(SessionChange::following);
}

void ProjectSession::goToFrame(FrameIndex frame) {
    if (!video_) return;
    const FrameIndex limited = std::clamp(frame, 0, std::max(0, video_->frame_count - 1));
    setFollowing(false);
    playback_.jumped(limited);
    showFrame(limited);
}

void ProjectSession::expectFrames(std::vector<FrameIndex> frames) {
    if (media_) loader_.expect(*media_, std::move(frames));
}

void ProjectSession::step(int frames) {
    playback_.pause();
    goToFrame(current_frame_ + frames);
}

void ProjectSession::showFrame(FrameIndex frame) {
    if (frame == current_frame_ && view_frame_.index == frame && !view_frame_.image.isNull()) return;
    direction_ = frame < current_frame_ ? -1 : 1;
    setFollowing(false);
    current_frame_ = frame;
    emit changed(SessionChange::frame);
    request();
}

void ProjectSession::request() {
    if (!video_) return;
    const RunRecord* own = live_ && !following_ && current_frame_ >= readable_length_ ? ownRun() : nullptr;
    if (own != nullptr && !pending_) readRecording(*own);
    loader_.request(current_frame_, running() ? 0 : direction_);
}

void ProjectSession::setPictureLook(const PictureLook& look) {
    if (look == look_) return;
    look_ = look;
    loader_.setLook(look);
    request();
}

void ProjectSession::frameLoaded(const ViewFrame& frame) {
    if (following_) return;  // the live picture is newer
    view_frame_ = frame;
    emit changed(SessionChange::picture);
}

void ProjectSession::togglePlay() {
    if (playback_.playing()) {
        playback_.pause();
        return;
    }
    setFollowing(false);
    playback_.play(current_frame_);
}

void ProjectSession::shuttle(int direction) {
    if (direction == 0) {
        playback_.pause();
        return;
    }
    const bool same_way = playback_.playing() && (playback_.speed() > 0) == (direction > 0);
    playback_.setSpeed(same_way ? playback_.speed() * 2 : direction, current_frame_);
    if (playback_.playing()) return;
    setFollowing(false);
    playback_.play(current_frame_);
}

void ProjectSession::selectTrack(std::optional<TrackId> track) {
    if (track == selected_track_) return;
    selected_track_ = track;
    emit changed(SessionChange::selection);
    if (track && current_run_) {
        const auto corrected = run_data_ ? run_data_->corrected : std::make_shared<const CorrectedTracks>();
        reader_.readTrack(*current_run_, *track, corrected);
    }
}

void ProjectSession::goToTrack(TrackId track) {
    selectTrack(track);
    const TrackSummary* life = trackSummary(track);
    if (life == nullptr) return;
    if (current_frame_ < life->first_frame || current_frame_ > life->last_frame) goToFrame(life->first_frame);
}

}  // namespace eyrie::ui
