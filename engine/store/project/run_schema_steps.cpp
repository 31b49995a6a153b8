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

// Registration::elapsed and zoom of each frame, and metres and km/h of tracks by its mean over a track's life. Few runs
// have frames that are zoomed; the index finds whether there are any.
void addElapsedAndZoom(SQLite::Database& database) {
    database.exec(R"sql(
ALTER TABLE frame ADD COLUMN elapsed INTEGER NOT NULL DEFAULT 1;
ALTER TABLE frame ADD COLUMN zoom REAL NOT NULL DEFAULT 1;
CREATE INDEX zoomed_frame ON frame (run_id, frame, zoom) WHERE zoom <> 1;
DROP VIEW IF EXISTS v_frames;
CREATE VIEW v_frames AS
SELECT frame.run_id AS run, frame.frame, frame.time_us / 1e6 AS seconds, frame.registration_state AS registration,
    frame.reason, frame.picture, frame.corner_count AS corners, frame.motion_vector_count AS motion_vectors,
    frame.detection_count AS detections, frame.track_count AS tracks, frame.details, frame.zoom,
    CASE WHEN frame.registration_state IN ('first', 'frozen') THEN 0 ELSE frame.elapsed END AS elapsed
FROM frame JOIN v_runs ON v_runs.run = frame.run_id;
DROP VIEW IF EXISTS v_tracks;
CREATE VIEW v_tracks AS
SELECT run, track, first_frame, last_frame, frames, (last_frame - first_frame) / rate AS seconds,
    length_px, width_px, speed_px_per_frame,
    length_px * gsd / (factor * zoom) AS length_m, width_px * gsd / (factor * zoom) AS width_m,
    speed_px_per_frame * gsd / (factor * zoom) * rate * 3.6 AS speed_kmh, factor AS scale_factor, zoom
FROM (SELECT *,
        CASE WHEN growth_right = 0 AND growth_down = 0 THEN 1.0 ELSE min(4.0, max(0.2,
            1 + (growth_right * off_x + growth_down * off_y) / zoom)) END AS factor
    FROM (SELECT track.run_id AS run, track.id AS track, track.first_frame, track.last_frame, track.frames,
            track.length_sum / track.frames AS length_px, track.width_sum / track.frames AS width_px,
            track.speed_sum / track.frames AS speed_px_per_frame,
            run.frame_rate_hz AS rate, CASE WHEN run.gsd_known THEN run.gsd_m_per_px END AS gsd,
            run.scale_growth_right AS growth_right, run.scale_growth_down AS growth_down,
            track.x_sum / track.frames - (sequence.width - 1) / 2.0 AS off_x,
            track.y_sum / track.frames - (sequence.height - 1) / 2.0 AS off_y,
            1 + (SELECT total(frame.zoom - 1) FROM frame WHERE frame.run_id = track.run_id AND frame.zoom <> 1
                AND frame.frame BETWEEN track.first_frame AND track.last_frame)
                / (track.last_frame - track.first_frame + 1) AS zoom
        FROM track JOIN run ON run.id = track.run_id JOIN sequence ON sequence.id = run.sequence_id
        WHERE track.confirmed <> 0 AND run.removed_utc = ''));
)sql");
}

}  // namespace eyrie::schema
