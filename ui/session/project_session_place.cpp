#include <algorithm>

#include "session/project_session.h"

namespace eyrie::ui {

// Where in the video one is, playing, and which track is looked at.

void ProjectSession::follow() {
    if (running()) setFollowing(true);
}

void ProjectSession::setFollowing(bool following) {
    if (following == following_) return;
    following_ = following;
    if (following) playback_.pause();
    emit changed(SessionChange::following);
}

// ---- frames ---------------------------------------------------------------------------------------------------------

void ProjectSession::goToFrame(FrameIndex frame) {
    if (!video_) return;
    const FrameIndex limited = std::clamp(frame, 0, std::max(0, video_->frame_count - 1));
    setFollowing(false);
    playback_.jumped(limited);
    showFrame(limited);
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
    if (video_) loader_.request(current_frame_, running() ? 0 : direction_);
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

// ---- selection ------------------------------------------------------------------------------------------------------

void ProjectSession::selectTrack(std::optional<TrackId> track) {
    if (track == selected_track_) return;
    selected_track_ = track;
    emit changed(SessionChange::selection);
    if (track && current_run_) reader_.readTrack(*current_run_, *track);
}

void ProjectSession::goToTrack(TrackId track) {
    selectTrack(track);
    if (!run_data_) return;
    const auto& tracks = run_data_->tracks;
    const auto found = std::find_if(tracks.begin(), tracks.end(), [&](const TrackSummary& t) { return t.id == track; });
    if (found == tracks.end()) return;
    if (current_frame_ < found->first_frame || current_frame_ > found->last_frame) goToFrame(found->first_frame);
}

}  // namespace eyrie::ui
