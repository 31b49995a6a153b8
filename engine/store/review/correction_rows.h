#pragma once

#include <map>
#include <vector>

#include "core/labels/change.h"
#include "core/review/track_correction.h"

namespace SQLite {
class Database;
}

/// Corrections of tracks in the tables of a project; as review_rows.h.
namespace eyrie {

/// Those of a video; a project of an older schema has none.
std::map<int, TrackCorrection> readCorrectionRows(SQLite::Database& database, int sequence_id);
void writeCorrectionRows(SQLite::Database& database, int sequence_id,
                         const std::vector<Change<TrackCorrection>>& changes);

}  // namespace eyrie
