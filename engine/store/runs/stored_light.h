#pragma once

#include <map>
#include <optional>
#include <vector>

#include "core/evidence/light_finding.h"
#include "store/project/project_file.h"

namespace eyrie {

/// Reads what finishing a run's tracks found of shadows and headlights, apart from what RunRecord::light and
/// TrackSummary::trim tell. Throws Error(project) for contents that no writer wrote.
class StoredLight {
 public:
    /// `project` must outlive it.
    explicit StoredLight(ProjectFile& project) : project_(project) {}

    /// Where shadows fall to in a frame; nothing where that is not known.
    std::optional<FrameShadow> shadowIn(int run_id, FrameIndex frame) const;
    /// What was taken out of the boxes of a track; nothing where nothing was.
    std::optional<BoxTrim> trimOf(int run_id, TrackId track) const;

 private:
    ProjectFile& project_;
};

/// Part of replacing the tracks of a run: what is stored of its light gives way. Inside a transaction.
void replaceLight(SQLite::Database& database, int run_id, const RunLight& light);

/// What was found, and what was taken out of the boxes of which tracks, for who is reading the run already.
std::vector<LightFinding> readFindings(SQLite::Database& database, int run_id);
std::map<TrackId, BoxTrim> readTrims(SQLite::Database& database, int run_id);

}  // namespace eyrie
