#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "core/review/zone.h"
#include "correction/corrected_tracks.h"
#include "events/event.h"
#include "events/ground/ground_stretches.h"
#include "store/runs/run_store.h"

namespace eyrie {

/// What events are computed from.
struct StoredTracks {
    std::vector<EventTrack> tracks;    ///< of the run's result, maybe corrected, ascending ids
    Footage footage;                   ///< no frames where the run has none
    std::vector<double> shown_s;       ///< when each of its frames is shown, s from the beginning of the video
    int unregistered = 0;              ///< frames that could not be registered onto the one before
    std::map<TrackId, double> scores;  ///< of each track, 0 … 1, the surer the higher
    CorrectedTracks corrections;       ///< what people made of the tracks; nothing where that was not wanted

    /// Seconds at which a frame is shown; by the frame rate where the run does not know it.
    double secondsOf(FrameIndex frame) const;
};

/// Reads a run's tracks, with what corrections make of them, and how its frames were registered. Throws Error(project).
StoredTracks readTracks(const RunStore& store, const RunRecord& run, CorrectedTracks corrected = {});
/// The same for who has read the frames of the run already.
StoredTracks readTracks(const RunStore& store, const RunRecord& run, const std::vector<FrameSummary>& frames,
                        CorrectedTracks corrected);

/// What people did to the tracks of an event, of several to the first such; nothing: they are the machine's.
std::optional<CorrectionKind> correctionOf(const Event& event, const StoredTracks& stored);
/// "machine", or "person: added".
std::string makerText(std::optional<CorrectionKind> corrected);

/// Throws Error(input) for a zone that is fixed to the ground of a frame that was not searched.
void checkReach(const std::vector<Zone>& zones, const Footage& footage);
/// In which frames zones that are fixed to the ground hold, where these are not all; one sentence a zone.
std::vector<std::string> remarksOn(const std::vector<Zone>& zones, const Footage& footage);

}  // namespace eyrie
