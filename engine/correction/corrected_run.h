#pragma once

#include <filesystem>
#include <map>
#include <set>
#include <vector>

#include "correction/corrected_tracks.h"

/// Corrections read of a project and applied to its stored runs. Whoever shows or hands out an operator's tracks reads
/// them here; RunStore tells the run's own. All throw Error(project).
namespace eyrie {

/// What corrections make of a run's tracks; nothing is changed in a run that is being written.
CorrectedTracks correctedTracksOf(const RunStore& store, const RunRecord& run,
                                  const std::map<int, TrackCorrection>& corrections);
/// The same with all that the project keeps of the video.
CorrectedTracks readCorrectedTracks(ProjectFile& project, const RunRecord& run);

/// As RunStore::tracks(), ascending ids.
std::vector<TrackSummary> trackSummaries(const RunStore& store, int run_id, const CorrectedTracks& corrected);
/// Those that a person rejected, for lists that say so; confirmed ones no more, and part of nothing else here.
std::vector<TrackSummary> rejectedSummaries(const RunStore& store, int run_id, const CorrectedTracks& corrected);
/// As RunStore::trackStates().
std::vector<TrackFrame> trackStates(const RunStore& store, int run_id, TrackId track, const CorrectedTracks& corrected);
/// The track of the result that lies best on at least half of the boxes by which a rejected one is found again: both
/// are on one vehicle. Those of `but` do not count. Empty: there is none.
std::vector<TrackFrame> trackBeside(const RunStore& store, int run_id, const TrackCorrection& rejection,
                                    const std::set<TrackId>& but, const CorrectedTracks& corrected);
/// As RunStore::trackStatesUpTo().
std::vector<TrackFrame> trackStatesUpTo(const RunStore& store, int run_id, FrameIndex frame, int trail,
                                        const CorrectedTracks& corrected);
/// As RunStore::visitTrackStates().
void visitTrackStates(const RunStore& store, int run_id, const CorrectedTracks& corrected,
                      const RunStore::StateVisitor& visitor);
/// As RunStore::visitTrackBoxes().
void visitTrackBoxes(const RunStore& store, int run_id, const CorrectedTracks& corrected, const BoxVisitor& visitor);

}  // namespace eyrie
