#include "store/project/schema_steps.h"

#include <SQLiteCpp/SQLiteCpp.h>

#include "core/values/scale_slope.h"
#include "store/project/schema.h"

namespace eyrie::schema {

void addComparisonsAndCompleteBoxes(SQLite::Database& database) {
    database.exec(R"sql(
CREATE TABLE comparison (
    id INTEGER PRIMARY KEY AUTOINCREMENT,
    made_utc TEXT NOT NULL,
    sequence TEXT NOT NULL,
    report TEXT NOT NULL
);
ALTER TABLE detection ADD COLUMN complete INTEGER NOT NULL DEFAULT 0;
)sql");
}

// A plan and the figures of a point are JSON texts that engine/sweep writes and reads.
void addSweeps(SQLite::Database& database) {
    database.exec(R"sql(
CREATE TABLE sweep (
    id INTEGER PRIMARY KEY AUTOINCREMENT,
    made_utc TEXT NOT NULL,
    name TEXT NOT NULL,
    point_count INTEGER NOT NULL,
    plan TEXT NOT NULL
);
CREATE TABLE sweep_point (
    sweep_id INTEGER NOT NULL REFERENCES sweep (id) ON DELETE CASCADE,
    position INTEGER NOT NULL,
    seconds REAL,
    figures TEXT NOT NULL,
    PRIMARY KEY (sweep_id, position)
) WITHOUT ROWID;
)sql");
}

void addPresets(SQLite::Database& database) {
    database.exec(R"sql(
CREATE TABLE preset (
    name TEXT PRIMARY KEY,
    saved_utc TEXT NOT NULL
) WITHOUT ROWID;
CREATE TABLE preset_value (
    preset TEXT NOT NULL REFERENCES preset (name) ON DELETE CASCADE ON UPDATE CASCADE,
    position INTEGER NOT NULL,
    name TEXT NOT NULL,
    value TEXT NOT NULL,
    PRIMARY KEY (preset, position)
) WITHOUT ROWID;
)sql");
}

// What was left out when the tracks of a run were finished, and why.
void addDroppedStates(SQLite::Database& database) {
    database.exec(R"sql(
CREATE TABLE dropped_state (
    run_id INTEGER NOT NULL REFERENCES run (id) ON DELETE CASCADE,
    frame INTEGER NOT NULL,
    track_id INTEGER NOT NULL,
    x REAL, y REAL, length REAL, width REAL, heading_rad REAL,
    reason TEXT NOT NULL,
    beside INTEGER NOT NULL,
    PRIMARY KEY (run_id, frame, track_id)
) WITHOUT ROWID;
)sql");
}

// When a run was removed by a person who can still change her mind; empty: it was not.
void addRemovalOfRuns(SQLite::Database& database) {
    database.exec("ALTER TABLE run ADD COLUMN removed_utc TEXT NOT NULL DEFAULT ''");
}

// What a run that ended early needs to be gone on with: the state of the chain after some frame (written by
// engine/chain), and the tracks as they were before they were finished.
void addRunStates(SQLite::Database& database) {
    database.exec(R"sql(
CREATE TABLE run_state (
    run_id INTEGER PRIMARY KEY REFERENCES run (id) ON DELETE CASCADE,
    frame INTEGER NOT NULL,
    data BLOB NOT NULL
);
CREATE TABLE unfinished_track_state (
    run_id INTEGER NOT NULL REFERENCES run (id) ON DELETE CASCADE,
    frame INTEGER NOT NULL,
    track_id INTEGER NOT NULL,
    x REAL, y REAL, length REAL, width REAL, heading_rad REAL,
    vx REAL, vy REAL,
    status TEXT NOT NULL,
    origin TEXT NOT NULL,
    age INTEGER NOT NULL,
    hits INTEGER NOT NULL,
    score REAL,
    PRIMARY KEY (run_id, frame, track_id)
) WITHOUT ROWID;
)sql");
}

// Why a frame could not be registered, as a word with its figures; a sentence until then.
void addRegistrationFaults(SQLite::Database& database) {
    database.exec(R"sql(
ALTER TABLE frame ADD COLUMN picture TEXT NOT NULL DEFAULT 'clear';
ALTER TABLE frame ADD COLUMN reason_count INTEGER NOT NULL DEFAULT 0;
ALTER TABLE frame ADD COLUMN reason_of INTEGER NOT NULL DEFAULT 0;
)sql");
    schema::wordRegistrationFaults(database);
}

// For readers with other tools: units that people use, and a shape that stays when tables change.
void addViews(SQLite::Database& database) {
    database.exec(R"sql(
CREATE VIEW v_runs AS
SELECT run.id AS run, sequence.path AS video, run.name, run.started_utc, run.state, run.first_frame, run.last_frame,
    run.frame_rate_hz, CASE WHEN run.gsd_known THEN run.gsd_m_per_px END AS gsd_m_per_px
FROM run JOIN sequence ON sequence.id = run.sequence_id WHERE run.removed_utc = '';
CREATE VIEW v_tracks AS
SELECT track.run_id AS run, track.id AS track, track.first_frame, track.last_frame, track.frames,
    (track.last_frame - track.first_frame) / v_runs.frame_rate_hz AS seconds,
    track.length_sum / track.frames AS length_px, track.width_sum / track.frames AS width_px,
    track.speed_sum / track.frames AS speed_px_per_frame,
    track.length_sum / track.frames * v_runs.gsd_m_per_px AS length_m,
    track.width_sum / track.frames * v_runs.gsd_m_per_px AS width_m,
    track.speed_sum / track.frames * v_runs.gsd_m_per_px * v_runs.frame_rate_hz * 3.6 AS speed_kmh
FROM track JOIN v_runs ON v_runs.run = track.run_id WHERE track.confirmed <> 0;
CREATE VIEW v_track_states AS
SELECT track_state.run_id AS run, track_state.track_id AS track, track_state.frame, frame.time_us / 1e6 AS seconds,
    track_state.x, track_state.y, track_state.length AS length_px, track_state.width AS width_px,
    track_state.heading_rad * 57.29577951308232
        + CASE WHEN track_state.heading_rad < 0 THEN 360 ELSE 0 END AS heading_deg,
    track_state.vx AS vx_px_per_frame, track_state.vy AS vy_px_per_frame, track_state.status, track_state.origin,
    track_state.score
FROM track_state JOIN frame ON frame.run_id = track_state.run_id AND frame.frame = track_state.frame
    JOIN v_runs ON v_runs.run = track_state.run_id WHERE track_state.status <> 'tentative';
CREATE VIEW v_detections AS
SELECT detection.run_id AS run, detection.frame, detection.number, detection.x, detection.y,
    detection.length AS length_px, detection.width AS width_px,
    detection.heading_rad * 57.29577951308232
        + CASE WHEN detection.heading_rad < 0 THEN 360 ELSE 0 END AS heading_deg,
    detection.score, detection.rejection
FROM detection JOIN v_runs ON v_runs.run = detection.run_id;
CREATE VIEW v_frames AS
SELECT frame.run_id AS run, frame.frame, frame.time_us / 1e6 AS seconds, frame.registration_state AS registration,
    frame.reason, frame.picture, frame.corner_count AS corners, frame.motion_vector_count AS motion_vectors,
    frame.detection_count AS detections, frame.track_count AS tracks
FROM frame JOIN v_runs ON v_runs.run = frame.run_id;
)sql");
}

// What a person says about events: of a video, so that a new run finds it. Steps as packed bytes: packed_review.h.
void addReview(SQLite::Database& database) {
    database.exec(R"sql(
CREATE TABLE verdict (
    id INTEGER PRIMARY KEY,
    sequence_id INTEGER NOT NULL REFERENCES sequence (id) ON DELETE CASCADE,
    kind TEXT NOT NULL,
    first_frame INTEGER NOT NULL,
    last_frame INTEGER NOT NULL,
    first_s REAL NOT NULL,
    last_s REAL NOT NULL,
    frame INTEGER NOT NULL,
    x REAL NOT NULL, y REAL NOT NULL,
    ground_frame INTEGER NOT NULL,
    ground_x REAL NOT NULL, ground_y REAL NOT NULL,
    zone TEXT NOT NULL,
    sense TEXT NOT NULL,
    judgement TEXT NOT NULL,
    note TEXT NOT NULL,
    tags TEXT NOT NULL,
    starred INTEGER NOT NULL,
    person TEXT NOT NULL,
    when_utc TEXT NOT NULL
);
CREATE INDEX verdict_of_sequence ON verdict (sequence_id);
CREATE TABLE bookmark (
    id INTEGER PRIMARY KEY,
    sequence_id INTEGER NOT NULL REFERENCES sequence (id) ON DELETE CASCADE,
    frame INTEGER NOT NULL,
    seconds REAL NOT NULL,
    x REAL, y REAL,
    note TEXT NOT NULL,
    person TEXT NOT NULL,
    when_utc TEXT NOT NULL
);
CREATE INDEX bookmark_of_sequence ON bookmark (sequence_id);
CREATE TABLE review_step (
    id INTEGER PRIMARY KEY AUTOINCREMENT,
    sequence_id INTEGER NOT NULL REFERENCES sequence (id) ON DELETE CASCADE,
    name TEXT NOT NULL,
    made_utc TEXT NOT NULL,
    undone INTEGER NOT NULL,
    data BLOB NOT NULL
);
CREATE INDEX review_step_of_sequence ON review_step (sequence_id, undone, id);
CREATE TABLE seen (
    id INTEGER PRIMARY KEY,
    sequence_id INTEGER NOT NULL REFERENCES sequence (id) ON DELETE CASCADE,
    person TEXT NOT NULL,
    first_frame INTEGER NOT NULL,
    last_frame INTEGER NOT NULL
);
CREATE INDEX seen_of_sequence ON seen (sequence_id, person, first_frame);
CREATE VIEW v_verdicts AS
SELECT verdict.id AS verdict, sequence.path AS video, verdict.kind, verdict.judgement, verdict.first_frame,
    verdict.last_frame, verdict.first_s AS start_s, verdict.last_s AS end_s, verdict.frame, verdict.x, verdict.y,
    verdict.zone, verdict.sense, verdict.note, verdict.tags, verdict.starred, verdict.person, verdict.when_utc
FROM verdict JOIN sequence ON sequence.id = verdict.sequence_id;
CREATE VIEW v_bookmarks AS
SELECT bookmark.id AS bookmark, sequence.path AS video, bookmark.frame, bookmark.seconds, bookmark.x, bookmark.y,
    bookmark.note, bookmark.person, bookmark.when_utc
FROM bookmark JOIN sequence ON sequence.id = bookmark.sequence_id;
CREATE VIEW v_seen AS
SELECT sequence.path AS video, seen.person, seen.first_frame, seen.last_frame,
    seen.last_frame - seen.first_frame + 1 AS frames
FROM seen JOIN sequence ON sequence.id = seen.sequence_id;
)sql");
}

// Where the metres per pixel of a run come from, and how sure an estimate is.
void addScaleOrigins(SQLite::Database& database) {
    database.exec(R"sql(
ALTER TABLE run ADD COLUMN scale_origin TEXT NOT NULL DEFAULT 'assumed';
ALTER TABLE run ADD COLUMN scale_uncertainty REAL;
ALTER TABLE run ADD COLUMN scale_vehicles INTEGER NOT NULL DEFAULT 0;
DROP VIEW IF EXISTS v_runs;
CREATE VIEW v_runs AS
SELECT run.id AS run, sequence.path AS video, run.name, run.started_utc, run.state, run.first_frame, run.last_frame,
    run.frame_rate_hz, CASE WHEN run.gsd_known THEN run.gsd_m_per_px END AS gsd_m_per_px, run.scale_origin
FROM run JOIN sequence ON sequence.id = run.sequence_id WHERE run.removed_utc = '';
)sql");
    tellScaleOrigins(database);
}

// Zones and lines that a person watches: of a video, like verdicts, whose steps they share. Points as of regions:
// packed_labels.h.
void addZones(SQLite::Database& database) {
    database.exec(R"sql(
CREATE TABLE zone (
    id INTEGER PRIMARY KEY,
    sequence_id INTEGER NOT NULL REFERENCES sequence (id) ON DELETE CASCADE,
    name TEXT NOT NULL,
    shape TEXT NOT NULL,
    anchor TEXT NOT NULL,
    frame INTEGER NOT NULL,
    points BLOB NOT NULL,
    colour INTEGER NOT NULL,
    shown INTEGER NOT NULL,
    person TEXT NOT NULL,
    when_utc TEXT NOT NULL
);
CREATE INDEX zone_of_sequence ON zone (sequence_id);
CREATE VIEW v_zones AS
SELECT zone.id AS zone, sequence.path AS video, zone.name, zone.shape, zone.anchor, zone.frame, zone.shown, zone.person,
    zone.when_utc
FROM zone JOIN sequence ON sequence.id = zone.sequence_id;
)sql");
}

// How metres per pixel change over an oblique view: growth of pixels per metre for a pixel to the right and downwards,
// relative to those in the middle of the picture, where the GSD holds.
void addScaleSlopes(SQLite::Database& database) {
    database.exec(R"sql(
ALTER TABLE run ADD COLUMN scale_growth_right REAL NOT NULL DEFAULT 0;
ALTER TABLE run ADD COLUMN scale_growth_down REAL NOT NULL DEFAULT 0;
DROP VIEW IF EXISTS v_runs;
CREATE VIEW v_runs AS
SELECT run.id AS run, sequence.path AS video, run.name, run.started_utc, run.state, run.first_frame, run.last_frame,
    run.frame_rate_hz, CASE WHEN run.gsd_known THEN run.gsd_m_per_px END AS gsd_m_per_px, run.scale_origin,
    run.scale_growth_right, run.scale_growth_down
FROM run JOIN sequence ON sequence.id = run.sequence_id WHERE run.removed_utc = '';
)sql");
}

// Runs may keep what is behind their tracks of some frames only; until such a run is finished, what finishing needs of
// the others lies aside. Places that a person found on the earth.
void addKeptDetails(SQLite::Database& database) {
    database.exec(R"sql(
ALTER TABLE frame ADD COLUMN details INTEGER NOT NULL DEFAULT 1;
CREATE TABLE unfinished_frame (
    run_id INTEGER NOT NULL REFERENCES run (id) ON DELETE CASCADE,
    frame INTEGER NOT NULL,
    vectors BLOB NOT NULL,
    vehicles BLOB NOT NULL,
    UNIQUE (run_id, frame)
);
CREATE TABLE control_point (
    id INTEGER PRIMARY KEY,
    sequence_id INTEGER NOT NULL REFERENCES sequence (id) ON DELETE CASCADE,
    frame INTEGER NOT NULL,
    x REAL NOT NULL, y REAL NOT NULL,
    latitude_deg REAL NOT NULL, longitude_deg REAL NOT NULL
);
CREATE INDEX control_point_of_sequence ON control_point (sequence_id);
DROP VIEW IF EXISTS v_frames;
CREATE VIEW v_frames AS
SELECT frame.run_id AS run, frame.frame, frame.time_us / 1e6 AS seconds, frame.registration_state AS registration,
    frame.reason, frame.picture, frame.corner_count AS corners, frame.motion_vector_count AS motion_vectors,
    frame.detection_count AS detections, frame.track_count AS tracks, frame.details
FROM frame JOIN v_runs ON v_runs.run = frame.run_id;
)sql");
}

// What speaks for each track, those that only their score kept out of the result, and how likely a detection is a
// vehicle.
void addEvidence(SQLite::Database& database) {
    database.exec(R"sql(
CREATE TABLE track_evidence (
    run_id INTEGER NOT NULL REFERENCES run (id) ON DELETE CASCADE,
    track_id INTEGER NOT NULL,
    detected REAL NOT NULL,
    looked_alike REAL NOT NULL,
    life_s REAL NOT NULL,
    flow_px REAL NOT NULL,
    flow_ratio REAL NOT NULL,
    alignment REAL NOT NULL,
    score REAL NOT NULL,
    PRIMARY KEY (run_id, track_id)
) WITHOUT ROWID;
CREATE TABLE doubtful_state (
    run_id INTEGER NOT NULL REFERENCES run (id) ON DELETE CASCADE,
    frame INTEGER NOT NULL,
    track_id INTEGER NOT NULL,
    x REAL, y REAL, length REAL, width REAL, heading_rad REAL,
    vx REAL, vy REAL,
    status TEXT NOT NULL,
    origin TEXT NOT NULL,
    age INTEGER NOT NULL,
    hits INTEGER NOT NULL,
    score REAL,
    PRIMARY KEY (run_id, frame, track_id)
) WITHOUT ROWID;
ALTER TABLE detection ADD COLUMN probability REAL;
DROP VIEW IF EXISTS v_detections;
CREATE VIEW v_detections AS
SELECT detection.run_id AS run, detection.frame, detection.number, detection.x, detection.y,
    detection.length AS length_px, detection.width AS width_px,
    detection.heading_rad * 57.29577951308232
        + CASE WHEN detection.heading_rad < 0 THEN 360 ELSE 0 END AS heading_deg,
    detection.score, detection.rejection, detection.probability
FROM detection JOIN v_runs ON v_runs.run = detection.run_id;
CREATE VIEW v_track_evidence AS
SELECT track_evidence.run_id AS run, track_evidence.track_id AS track, track_evidence.detected,
    track_evidence.looked_alike, track_evidence.life_s, track_evidence.flow_px, track_evidence.flow_ratio,
    track_evidence.alignment, track_evidence.score
FROM track_evidence JOIN v_runs ON v_runs.run = track_evidence.run_id;
)sql");
}

// What people corrected of the tracks of a video: of the video, like verdicts, whose steps they share. Boxes as in
// packed_review.h.
void addCorrections(SQLite::Database& database) {
    database.exec(R"sql(
CREATE TABLE correction (
    id INTEGER PRIMARY KEY,
    sequence_id INTEGER NOT NULL REFERENCES sequence (id) ON DELETE CASCADE,
    kind TEXT NOT NULL,
    frame INTEGER NOT NULL,
    track BLOB NOT NULL,
    other BLOB NOT NULL,
    person TEXT NOT NULL,
    when_utc TEXT NOT NULL
);
CREATE INDEX correction_of_sequence ON correction (sequence_id);
CREATE VIEW v_corrections AS
SELECT correction.id AS correction, sequence.path AS video, correction.kind, correction.frame, correction.person,
    correction.when_utc
FROM correction JOIN sequence ON sequence.id = correction.sequence_id;
)sql");
}

// Metres and km/h of tracks by the scale at their place; by that in the middle of the picture until then. As
// SceneScale::at() has it, for the mean of a track's centres.
void addLocalScales(SQLite::Database& database) {
    static_assert(ScaleSlope::kLeast == 0.2 && ScaleSlope::kMost == 4);
    database.exec(R"sql(
DROP VIEW IF EXISTS v_tracks;
CREATE VIEW v_tracks AS
SELECT run, track, first_frame, last_frame, frames, (last_frame - first_frame) / rate AS seconds,
    length_px, width_px, speed_px_per_frame,
    length_px * gsd / factor AS length_m, width_px * gsd / factor AS width_m,
    speed_px_per_frame * gsd / factor * rate * 3.6 AS speed_kmh, factor AS scale_factor
FROM (SELECT track.run_id AS run, track.id AS track, track.first_frame, track.last_frame, track.frames,
        track.length_sum / track.frames AS length_px, track.width_sum / track.frames AS width_px,
        track.speed_sum / track.frames AS speed_px_per_frame,
        run.frame_rate_hz AS rate, CASE WHEN run.gsd_known THEN run.gsd_m_per_px END AS gsd,
        CASE WHEN run.scale_growth_right = 0 AND run.scale_growth_down = 0 THEN 1.0 ELSE min(4.0, max(0.2, (
            SELECT 1 + run.scale_growth_right * (avg(x) - (sequence.width - 1) / 2.0)
                     + run.scale_growth_down * (avg(y) - (sequence.height - 1) / 2.0)
            FROM track_state WHERE track_state.run_id = track.run_id AND track_state.track_id = track.id))) END AS factor
    FROM track JOIN run ON run.id = track.run_id JOIN sequence ON sequence.id = run.sequence_id
    WHERE track.confirmed <> 0 AND run.removed_utc = '');
)sql");
}

// Whether the frame rate of a video, and that of a run, is only assumed: folders of pictures do not tell theirs.
void addAssumedRates(SQLite::Database& database) {
    database.exec(R"sql(
ALTER TABLE sequence ADD COLUMN rate_assumed INTEGER NOT NULL DEFAULT 0;
ALTER TABLE run ADD COLUMN rate_assumed INTEGER NOT NULL DEFAULT 0;
DROP VIEW IF EXISTS v_runs;
CREATE VIEW v_runs AS
SELECT run.id AS run, sequence.path AS video, run.name, run.started_utc, run.state, run.first_frame, run.last_frame,
    run.frame_rate_hz, CASE WHEN run.gsd_known THEN run.gsd_m_per_px END AS gsd_m_per_px, run.scale_origin,
    run.scale_growth_right, run.scale_growth_down, run.rate_assumed
FROM run JOIN sequence ON sequence.id = run.sequence_id WHERE run.removed_utc = '';
)sql");
}

// States of tracks without what follows from others: words are short, and what all states of a finished
// track have in common stands in its row of `track`. States of one track are found by its frames, without an index; the
// sums of its places spare views and lists to look at them.
void addCompactStates(SQLite::Database& database) {
    database.exec(R"sql(
ALTER TABLE track ADD COLUMN score REAL;
ALTER TABLE track ADD COLUMN x_sum REAL;
ALTER TABLE track ADD COLUMN y_sum REAL;
UPDATE track SET (x_sum, y_sum) = (SELECT sum(x), sum(y) FROM track_state
    WHERE track_state.run_id = track.run_id AND track_state.track_id = track.id);
DROP INDEX track_state_of_track;
DROP VIEW IF EXISTS v_track_states;
CREATE VIEW v_track_states AS
SELECT track_state.run_id AS run, track_state.track_id AS track, track_state.frame, frame.time_us / 1e6 AS seconds,
    track_state.x, track_state.y, track_state.length AS length_px, track_state.width AS width_px,
    track_state.heading_rad * 57.29577951308232
        + CASE WHEN track_state.heading_rad < 0 THEN 360 ELSE 0 END AS heading_deg,
    track_state.vx AS vx_px_per_frame, track_state.vy AS vy_px_per_frame,
    CASE track_state.status WHEN '' THEN 'confirmed' WHEN 'c' THEN 'coasting' ELSE track_state.status END AS status,
    CASE track_state.origin WHEN '' THEN 'detected' WHEN 'r' THEN 'reconstructed' WHEN 'p' THEN 'predicted'
        WHEN 's' THEN 'standing' ELSE track_state.origin END AS origin,
    coalesce(track_state.score, (SELECT track.score FROM track WHERE track.run_id = track_state.run_id
        AND track.id = track_state.track_id)) AS score
FROM track_state JOIN frame ON frame.run_id = track_state.run_id AND frame.frame = track_state.frame
    JOIN v_runs ON v_runs.run = track_state.run_id WHERE track_state.status <> 'tentative';
DROP VIEW IF EXISTS v_tracks;
CREATE VIEW v_tracks AS
SELECT run, track, first_frame, last_frame, frames, (last_frame - first_frame) / rate AS seconds,
    length_px, width_px, speed_px_per_frame,
    length_px * gsd / factor AS length_m, width_px * gsd / factor AS width_m,
    speed_px_per_frame * gsd / factor * rate * 3.6 AS speed_kmh, factor AS scale_factor
FROM (SELECT track.run_id AS run, track.id AS track, track.first_frame, track.last_frame, track.frames,
        track.length_sum / track.frames AS length_px, track.width_sum / track.frames AS width_px,
        track.speed_sum / track.frames AS speed_px_per_frame,
        run.frame_rate_hz AS rate, CASE WHEN run.gsd_known THEN run.gsd_m_per_px END AS gsd,
        CASE WHEN run.scale_growth_right = 0 AND run.scale_growth_down = 0 THEN 1.0 ELSE min(4.0, max(0.2,
            1 + run.scale_growth_right * (track.x_sum / track.frames - (sequence.width - 1) / 2.0)
              + run.scale_growth_down * (track.y_sum / track.frames - (sequence.height - 1) / 2.0))) END AS factor
    FROM track JOIN run ON run.id = track.run_id JOIN sequence ON sequence.id = run.sequence_id
    WHERE track.confirmed <> 0 AND run.removed_utc = '');
)sql");
}

// When the first frame of a video was taken, as a person says; empty: nobody said.
void addVideoStarts(SQLite::Database& database) {
    database.exec("ALTER TABLE sequence ADD COLUMN start_utc TEXT NOT NULL DEFAULT ''");
}

// Zones may be arrows. The tables are the same; versions before do not know the word, and should say so at once.
void addArrows(SQLite::Database&) {}

// The frames in which a doubtful track has states: rows are in the order of frames, and a person who selects one track
// should not wait for those of all others to be read.
void addDoubtfulIndex(SQLite::Database& database) {
    database.exec("CREATE INDEX doubtful_state_of_track ON doubtful_state (run_id, track_id, frame)");
}

// What the classifier says of the boxes of detections and tracks.
void addDecisions(SQLite::Database& database) {
    database.exec(R"sql(
ALTER TABLE detection ADD COLUMN decision REAL;
ALTER TABLE track_evidence ADD COLUMN decision REAL;
DROP VIEW IF EXISTS v_detections;
CREATE VIEW v_detections AS
SELECT detection.run_id AS run, detection.frame, detection.number, detection.x, detection.y,
    detection.length AS length_px, detection.width AS width_px,
    detection.heading_rad * 57.29577951308232
        + CASE WHEN detection.heading_rad < 0 THEN 360 ELSE 0 END AS heading_deg,
    detection.score, detection.rejection, detection.probability, detection.decision
FROM detection JOIN v_runs ON v_runs.run = detection.run_id;
DROP VIEW IF EXISTS v_track_evidence;
CREATE VIEW v_track_evidence AS
SELECT track_evidence.run_id AS run, track_evidence.track_id AS track, track_evidence.detected,
    track_evidence.looked_alike, track_evidence.life_s, track_evidence.flow_px, track_evidence.flow_ratio,
    track_evidence.alignment, track_evidence.score, track_evidence.decision
FROM track_evidence JOIN v_runs ON v_runs.run = track_evidence.run_id;
)sql");
}

}  // namespace eyrie::schema
