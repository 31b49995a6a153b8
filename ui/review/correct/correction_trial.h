#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <set>
#include <vector>

#include "core/review/track_correction.h"
#include "correction/corrected_run.h"
#include "correction/drawn_vehicle.h"
#include "store/runs/run_store.h"

namespace eyrie::ui {

class BackgroundTask;
class CorrectedTracksMemo;

/// The run that corrections are tried on, with those it has already.
struct TriedOn {
    std::filesystem::path project;
    RunRecord run;
    std::map<int, TrackCorrection> corrections;
    std::shared_ptr<CorrectedTracksMemo> memo;  ///< never null
};

/// What would come of corrections.
struct TriedCorrections {
    std::vector<TrackCorrection> made;                  ///< those of which something comes
    std::vector<std::size_t> made_at;                   ///< which of those asked for they are
    TrackCorrection refused;                            ///< else the last of which nothing does,
    CorrectionState state = CorrectionState::no_track;  ///< and why
    TrackId last_id = 0;                                ///< the highest of the run
    TrackId covering = 0;                               ///< a track that has it so already
    DrawnVehicle vehicle;                               ///< what was followed

    /// The track that an addition or a split makes; only where one is among `made`.
    TrackId newTrack() const { return last_id + made.front().id; }
};

/// What corrections are made from: the tracks as they are shown.
struct CorrectionTrial {
    const RunStore& store;
    const RunRecord& run;
    const CorrectedTracks& corrected;
    const BackgroundTask& task;
    TriedCorrections& tried;  ///< takes what was followed

    /// Throws Error(parameter) for a track that is rejected or not part of the result.
    std::vector<TrackFrame> statesOf(TrackId track) const;
    /// With the track that is kept of those on the same vehicle; those of `but` are not kept either.
    TrackCorrection rejectionOf(TrackId track, const std::set<TrackId>& but) const;
};

/// Makes the corrections that are asked for, without numbers.
using MakeCorrections = std::function<std::vector<TrackCorrection>(const CorrectionTrial&)>;

/// Makes corrections and tells what would come of them; nothing is stored. They are given these numbers, in their
/// order; there must be enough. To be called in the background. Throws Error.
TriedCorrections tryCorrections(const TriedOn& on, const MakeCorrections& make, const std::vector<int>& numbers,
                                const BackgroundTask& task);

}  // namespace eyrie::ui
