#include "store/project/schema_steps.h"

#include <SQLiteCpp/SQLiteCpp.h>

namespace eyrie::schema {

// Headings are radians, as in the engine, so that a frame reads back to the bit. Packed arrays: packed_arrays.h.
// Words (state, status, …): stored_words.h. A real that was not a number is NULL.
void addRuns(SQLite::Database& database) {
    database.exec(R"sql(
CREATE TABLE sequence (
    id INTEGER PRIMARY KEY,
    path TEXT NOT NULL,
    width INTEGER NOT NULL,
    height INTEGER NOT NULL,
    frame_count INTEGER NOT NULL,
    frame_rate_hz REAL NOT NULL,
    UNIQUE (path, width, height)
);
CREATE TABLE run (
    id INTEGER PRIMARY KEY AUTOINCREMENT,
    sequence_id INTEGER NOT NULL REFERENCES sequence (id) ON DELETE CASCADE,
    name TEXT NOT NULL,
    started_utc TEXT NOT NULL,
    engine_version TEXT NOT NULL,
    preset TEXT NOT NULL,
    gsd_m_per_px REAL NOT NULL,
    gsd_known INTEGER NOT NULL,
    frame_rate_hz REAL NOT NULL,
    first_frame INTEGER NOT NULL,
    last_frame INTEGER NOT NULL,
    state TEXT NOT NULL,
    message TEXT NOT NULL
);
CREATE INDEX run_of_sequence ON run (sequence_id);
CREATE TABLE run_parameter (
    run_id INTEGER NOT NULL REFERENCES run (id) ON DELETE CASCADE,
    position INTEGER NOT NULL,
    name TEXT NOT NULL,
    value TEXT NOT NULL,
    PRIMARY KEY (run_id, position)
) WITHOUT ROWID;
CREATE TABLE frame (
    run_id INTEGER NOT NULL REFERENCES run (id) ON DELETE CASCADE,
    frame INTEGER NOT NULL,
    time_us INTEGER NOT NULL,
    width INTEGER NOT NULL,
    height INTEGER NOT NULL,
    registration_state TEXT NOT NULL,
    reason TEXT NOT NULL,
    from_frame INTEGER NOT NULL,
    to_frame INTEGER NOT NULL,
    h00 REAL, h01 REAL, h02 REAL, h10 REAL, h11 REAL, h12 REAL, h20 REAL, h21 REAL, h22 REAL,
    inliers INTEGER NOT NULL,
    rms_px REAL,
    corner_count INTEGER NOT NULL,
    motion_vector_count INTEGER NOT NULL,
    detection_count INTEGER NOT NULL,
    track_count INTEGER NOT NULL,
    background_speed_sigma REAL,
    read_ms REAL, corners_ms REAL, corner_tracking_ms REAL, homography_ms REAL, motion_ms REAL, clustering_ms REAL,
    stacking_ms REAL, detection_ms REAL, removal_ms REAL, tracking_ms REAL, store_ms REAL,
    PRIMARY KEY (run_id, frame)
) WITHOUT ROWID;
CREATE TABLE motion_vectors (
    run_id INTEGER NOT NULL REFERENCES run (id) ON DELETE CASCADE,
    frame INTEGER NOT NULL,
    data BLOB,
    UNIQUE (run_id, frame)
);
CREATE TABLE stationary_corners (
    run_id INTEGER NOT NULL REFERENCES run (id) ON DELETE CASCADE,
    frame INTEGER NOT NULL,
    data BLOB,
    UNIQUE (run_id, frame)
);
CREATE TABLE motion_cluster (
    run_id INTEGER NOT NULL REFERENCES run (id) ON DELETE CASCADE,
    frame INTEGER NOT NULL,
    number INTEGER NOT NULL,
    x REAL, y REAL, length REAL, width REAL, heading_rad REAL,
    vx REAL, vy REAL,
    members BLOB,
    PRIMARY KEY (run_id, frame, number)
) WITHOUT ROWID;
CREATE TABLE roi (
    run_id INTEGER NOT NULL REFERENCES run (id) ON DELETE CASCADE,
    frame INTEGER NOT NULL,
    number INTEGER NOT NULL,
    x REAL, y REAL, length REAL, width REAL, heading_rad REAL,
    PRIMARY KEY (run_id, frame, number)
) WITHOUT ROWID;
CREATE TABLE detection (
    run_id INTEGER NOT NULL REFERENCES run (id) ON DELETE CASCADE,
    frame INTEGER NOT NULL,
    number INTEGER NOT NULL,
    x REAL, y REAL, length REAL, width REAL, heading_rad REAL,
    vx REAL, vy REAL,
    score REAL,
    cluster INTEGER NOT NULL,
    rejection TEXT NOT NULL,
    vectors BLOB,
    PRIMARY KEY (run_id, frame, number)
) WITHOUT ROWID;
CREATE TABLE track (
    run_id INTEGER NOT NULL REFERENCES run (id) ON DELETE CASCADE,
    id INTEGER NOT NULL,
    first_frame INTEGER NOT NULL,
    last_frame INTEGER NOT NULL,
    frames INTEGER NOT NULL,
    confirmed INTEGER NOT NULL,
    speed_sum REAL, length_sum REAL, width_sum REAL,
    PRIMARY KEY (run_id, id)
) WITHOUT ROWID;
CREATE TABLE track_state (
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
CREATE INDEX track_state_of_track ON track_state (run_id, track_id, frame);
)sql");
}

// Keyframes, polygons and steps of work as packed bytes: packed_labels.h. Counters: the next number of each kind, never
// used again ("object", "region"), and how often labels were changed ("change").
void addLabels(SQLite::Database& database) {
    database.exec(R"sql(
CREATE TABLE label_counter (
    kind TEXT PRIMARY KEY,
    value INTEGER NOT NULL
) WITHOUT ROWID;
CREATE TABLE labelled_object (
    id INTEGER PRIMARY KEY,
    sequence_id INTEGER NOT NULL REFERENCES sequence (id) ON DELETE CASCADE,
    class TEXT NOT NULL,
    colour INTEGER NOT NULL,
    notes TEXT NOT NULL,
    origin TEXT NOT NULL,
    last_frame INTEGER NOT NULL,
    keyframes BLOB NOT NULL
);
CREATE INDEX labelled_object_of_sequence ON labelled_object (sequence_id);
CREATE TABLE ignore_region (
    id INTEGER PRIMARY KEY,
    sequence_id INTEGER NOT NULL REFERENCES sequence (id) ON DELETE CASCADE,
    polygon BLOB NOT NULL,
    anchor TEXT NOT NULL,
    reference_frame INTEGER NOT NULL,
    first_frame INTEGER NOT NULL,
    last_frame INTEGER NOT NULL,
    notes TEXT NOT NULL
);
CREATE INDEX ignore_region_of_sequence ON ignore_region (sequence_id);
CREATE TABLE review_mark (
    sequence_id INTEGER NOT NULL REFERENCES sequence (id) ON DELETE CASCADE,
    position INTEGER NOT NULL,
    object_id INTEGER NOT NULL,
    first_frame INTEGER NOT NULL,
    last_frame INTEGER NOT NULL,
    state TEXT NOT NULL,
    person TEXT NOT NULL,
    when_utc TEXT NOT NULL,
    PRIMARY KEY (sequence_id, position)
) WITHOUT ROWID;
CREATE TABLE object_class (
    sequence_id INTEGER NOT NULL REFERENCES sequence (id) ON DELETE CASCADE,
    position INTEGER NOT NULL,
    name TEXT NOT NULL,
    vehicle INTEGER NOT NULL,
    colour INTEGER NOT NULL,
    length_m REAL,
    width_m REAL,
    PRIMARY KEY (sequence_id, position)
) WITHOUT ROWID;
CREATE TABLE edit_journal (
    id INTEGER PRIMARY KEY AUTOINCREMENT,
    sequence_id INTEGER NOT NULL REFERENCES sequence (id) ON DELETE CASCADE,
    name TEXT NOT NULL,
    made_utc TEXT NOT NULL,
    undone INTEGER NOT NULL,
    data BLOB NOT NULL
);
CREATE INDEX edit_journal_of_sequence ON edit_journal (sequence_id, undone, id);
)sql");
}

}  // namespace eyrie::schema
