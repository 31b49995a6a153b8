#include "session/project/corrected_tracks_memo.h"

#include "correction/corrected_run.h"

namespace eyrie::ui {

std::shared_ptr<const CorrectedTracks> CorrectedTracksMemo::of(const RunStore& store,
                                                               const std::filesystem::path& project,
                                                               const RunRecord& run,
                                                               const std::map<int, TrackCorrection>& corrections) {
    Key key{project, run.id, run.live, run.frames_done, store.lastTrackId(run.id), corrections};
    for (auto& [id, correction] : key.corrections) {  // whoever made it, it does the same
        correction.person.clear();
        correction.when_utc.clear();
    }
    return memo_.get(
        key, [&] { return std::make_shared<const CorrectedTracks>(correctedTracksOf(store, run, corrections)); });
}

}  // namespace eyrie::ui
