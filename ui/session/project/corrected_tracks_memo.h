#pragma once

#include <filesystem>
#include <map>
#include <memory>

#include "core/memo.h"
#include "correction/corrected_tracks.h"

namespace eyrie::ui {

/// What corrections make of the tracks of a run, computed once for all who ask for it: lists and pictures, events, and
/// whoever tries a further correction. May be used on any thread.
class CorrectedTracksMemo {
 public:
    /// As correctedTracksOf(); `store` is of that project. Never null. Throws Error(project).
    std::shared_ptr<const CorrectedTracks> of(const RunStore& store, const std::filesystem::path& project,
                                              const RunRecord& run, const std::map<int, TrackCorrection>& corrections);

 private:
    struct Key {
        std::filesystem::path project;
        int run = 0;
        bool live = false;
        int frames_done = 0;
        TrackId last_id = 0;
        std::map<int, TrackCorrection> corrections;
        bool operator==(const Key&) const = default;
    };
    Memo<CorrectedTracks, Key> memo_{3};
};

}  // namespace eyrie::ui
