#pragma once

#include <filesystem>
#include <vector>

#include "events/stored_events.h"
#include "ground/track_likeness.h"

namespace eyrie::cli {

/// Tracks by how like they are to one, with when they are seen.
void printLikeness(TrackId chosen, const std::vector<TrackLikeness>& found, const StoredTracks& stored);
/// Columns track, first_frame, last_frame, start_s, end_s, likeness, path, speed, size. Throws Error(output).
void writeLikenessCsv(const std::filesystem::path& path, const std::vector<TrackLikeness>& found,
                      const StoredTracks& stored);

}  // namespace eyrie::cli
