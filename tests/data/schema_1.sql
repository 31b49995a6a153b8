-- A project as the first schema wrote it, with one run of one frame. Never changed; tests that it still opens.
PRAGMA application_id = 1163481673;
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
INSERT INTO sequence VALUES (1, '/videos/old.mp4', 320, 240, 30, 25.0);
INSERT INTO run VALUES (1, 1, 'old', '2026-11-21T08:00:00Z', '0.1.0', 'default', 0.25, 0, 25.0, 7, 7, 'finished', '');
INSERT INTO run_parameter VALUES (1, 0, 'motion.min_speed', '0.5'), (1, 1, 'detection.method', 'gradient');
INSERT INTO frame VALUES (1, 7, 280000, 320, 240, 'registered', '', 6, 7, 1.0, 0.0, 1.5, 0.0, 1.0, -2.0, 0.0, 0.0, 1.0,
    2, 0.125, 3, 1, 0, 1, 0.05, 1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 0.0, 8.0, 9.0, 10.0, 11.0);
INSERT INTO motion_vectors VALUES (1, 7, x'29000000000000000000c94200004942000040400000804007000000');
INSERT INTO stationary_corners VALUES (1, 7, x'021000200030004100');
INSERT INTO motion_cluster VALUES (1, 7, 0, 100.5, 50.25, 12.0, 6.0, 0.5, 3.0, 4.0, x'00000000');
INSERT INTO roi VALUES (1, 7, 0, 100.5, 50.25, 24.0, 7.5, 0.5);
INSERT INTO detection VALUES (1, 7, 0, 100.0, 50.0, 11.0, 5.0, 0.5, 3.0, 4.0, 0.5, 0, 'outlier', x'00000000');
INSERT INTO track VALUES (1, 3, 7, 7, 1, 1, 5.0, 11.0, 5.0);
INSERT INTO track_state VALUES (1, 7, 3, 100.0, 50.0, 11.0, 5.0, 0.5, 3.0, 4.0, 'confirmed', 'reconstructed', 4, 3, 0.75);
PRAGMA user_version = 1;
