#include <SQLiteCpp/SQLiteCpp.h>

#include "store/project/schema_steps.h"

namespace eyrie::schema {

// How far into the second of `started_utc` a run began; not known of those of before. It stands beside it, so that what
// tells the start tells what it did.
void addStartFractions(SQLite::Database& database) {
    database.exec("ALTER TABLE run ADD COLUMN started_fraction_us INTEGER");
}

// How the files of its video lay there when a run began (io/file_digest.h); empty of those of before.
void addSourceDigests(SQLite::Database& database) {
    database.exec("ALTER TABLE run ADD COLUMN source_digest TEXT NOT NULL DEFAULT ''");
}

// How shadows fall, in each stretch of frames and in each frame, or what headlights light, and what of it was taken out
// of the boxes of which tracks. Runs of before have no rows.
void addLight(SQLite::Database& database) {
    database.exec(R"sql(
CREATE TABLE light_finding (
    run_id INTEGER NOT NULL REFERENCES run (id) ON DELETE CASCADE,
    first_frame INTEGER NOT NULL,
    last_frame INTEGER NOT NULL,
    outcome TEXT NOT NULL,
    heading_deg REAL NOT NULL,
    reach_m REAL NOT NULL,
    scatter_m REAL NOT NULL,
    vehicles INTEGER NOT NULL,
    agreement REAL NOT NULL,
    darkening REAL,
    trimmed INTEGER NOT NULL,
    dropped INTEGER NOT NULL,
    PRIMARY KEY (run_id, first_frame)
) WITHOUT ROWID;
CREATE TABLE frame_shadow (
    run_id INTEGER NOT NULL REFERENCES run (id) ON DELETE CASCADE,
    frame INTEGER NOT NULL,
    heading_deg REAL NOT NULL,
    reach_px REAL NOT NULL,
    PRIMARY KEY (run_id, frame)
) WITHOUT ROWID;
CREATE TABLE box_trim (
    run_id INTEGER NOT NULL REFERENCES run (id) ON DELETE CASCADE,
    track_id INTEGER NOT NULL,
    what TEXT NOT NULL,
    along REAL NOT NULL,
    across REAL NOT NULL,
    taken REAL NOT NULL,
    PRIMARY KEY (run_id, track_id)
) WITHOUT ROWID;
CREATE VIEW v_light AS
SELECT light_finding.run_id AS run, light_finding.first_frame, light_finding.last_frame, light_finding.outcome,
    light_finding.heading_deg, light_finding.reach_m, light_finding.vehicles, light_finding.agreement,
    light_finding.darkening, light_finding.trimmed, light_finding.dropped
FROM light_finding JOIN v_runs ON v_runs.run = light_finding.run_id;
CREATE VIEW v_frame_shadows AS
SELECT frame_shadow.run_id AS run, frame_shadow.frame, frame_shadow.heading_deg, frame_shadow.reach_px
FROM frame_shadow JOIN v_runs ON v_runs.run = frame_shadow.run_id;
CREATE VIEW v_box_trims AS
SELECT box_trim.run_id AS run, box_trim.track_id AS track, box_trim.what, box_trim.along, box_trim.across,
    box_trim.taken
FROM box_trim JOIN v_runs ON v_runs.run = box_trim.run_id;
)sql");
}

}  // namespace eyrie::schema
