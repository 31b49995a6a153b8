#pragma once

#include <filesystem>
#include <vector>

#include "events/stored_events.h"
#include "ground/track_likeness.h"

namespace eyrie::cli {

/// Tracks by how like they are to one, with when they are seen; `looks`: with how like they look.
void printLikeness(TrackId chosen, const std::vector<TrackLikeness>& found, const StoredTracks& stored, bool looks);
/// Columns track, first_frame, last_frame, start_s, end_s, likeness, path, speed, size, looks, the last empty where it
/// is not known. Throws Error(output).
void writeLikenessCsv(const std::filesystem::path& path, const std::vector<TrackLikeness>& found,
                      const StoredTracks& stored);

}  // namespace eyrie::cli
