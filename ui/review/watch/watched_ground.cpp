#include "review/watch/watched_ground.h"

#include <algorithm>

namespace eyrie::ui {

const EventTrack* RunGround::track(TrackId id) const {
    const auto found = std::lower_bound(run->tracks.begin(), run->tracks.end(), id,
                                        [](const EventTrack& track, TrackId wanted) { return track.id < wanted; });
    return found != run->tracks.end() && found->id == id ? &*found : nullptr;
}

void WatchedGround::setRun(const std::shared_ptr<const StoredTracks>& run) {
    if (run == run_) return;
    run_ = run;
    ground_query_.cancel();
    sheets_query_.cancel();
    ground_.reset();
    sheets_.reset();
    emit changed();
    if (!run_) return;
    ground_query_.ask([this, run](const BackgroundTask& task) {
        auto made = std::make_shared<const RunGround>(run);
        task.tell([this, made] {
            ground_ = made;
            emit changed();
        });
    });
}

void WatchedGround::lay(FrameIndex anchor) {
    if (!run_) return;
    sheets_query_.ask([this, run = run_, anchor](const BackgroundTask& task) {
        auto made = std::make_shared<const GroundSheets>(run->footage, anchor);
        task.tell([this, made] {
            sheets_ = made;
            emit changed();
        });
    });
}

void WatchedGround::forgetSheets() {
    sheets_query_.cancel();
    sheets_.reset();
    emit changed();
}

}  // namespace eyrie::ui

#include "moc_watched_ground.cpp"
