#include "store/runs/frame_rows.h"

#include <SQLiteCpp/Database.h>

#include <cmath>
#include <limits>
#include <string>

#include "store/database/rows.h"

namespace eyrie {
namespace {

/// "INSERT INTO table (a, b) VALUES (?, ?)" for the columns "a, b".
std::string insertInto(const std::string& table, const std::string& columns) {
    std::string marks = "?";
    for (const char c : columns) {
        if (c == ',') marks += ", ?";
    }
    return "INSERT INTO " + table + " (" + columns + ") VALUES (" + marks + ")";
}

/// NULL in the file.
constexpr double kNoScore = std::numeric_limits<double>::quiet_NaN();

std::string frameColumns() {
    std::string columns =
        "run_id, frame, time_us, width, height, registration_state, reason, picture, reason_count, "
        "reason_of, from_frame, to_frame, "
        "h00, h01, h02, h10, h11, h12, h20, h21, h22, inliers, rms_px, corner_count, motion_vector_count, "
        "detection_count, track_count, background_speed_sigma, details, elapsed, zoom";
    for (const char* stage : stored::kStageColumns) columns += std::string(", ") + stage;
    return columns;
}

}  // namespace

std::string insertState(const std::string& table) {
    return insertInto(table, std::string("run_id, frame, ") + kTrackStateColumns);
}

void writeState(SQLite::Statement& statement, int run_id, FrameIndex frame, const TrackState& state) {
    RowWriter(statement)
        .integer(run_id)
        .integer(frame)
        .integer(state.id)
        .box(state.box)
        .point(state.velocity)
        .word(stored::kTrackStatuses, state.status)
        .word(stored::kStateOrigins, state.origin)
        .integer(state.age)
        .integer(state.hits)
        .real(state.score)
        .run();
}

TrackRows::TrackRows(SQLite::Database& database)
    : track_(database, insertInto("track",
                                  "run_id, id, first_frame, last_frame, frames, confirmed, speed_sum, length_sum, "
                                  "width_sum, x_sum, y_sum, score") +
                           " ON CONFLICT (run_id, id) DO UPDATE SET first_frame = min(first_frame, "
                           "excluded.first_frame), last_frame = max(last_frame, excluded.last_frame), "
                           "frames = frames + 1, confirmed = max(confirmed, excluded.confirmed), "
                           "speed_sum = speed_sum + excluded.speed_sum, length_sum = length_sum + "
                           "excluded.length_sum, width_sum = width_sum + excluded.width_sum, x_sum = x_sum + "
                           "excluded.x_sum, y_sum = y_sum + excluded.y_sum"),
      state_(database, insertState("track_state")),
      forget_states_(database, "DELETE FROM track_state WHERE run_id = ? AND frame = ?"),
      forget_tracks_(database,
                     "DELETE FROM track WHERE run_id = ?1 AND frames = 1 AND id IN (SELECT track_id FROM track_state "
                     "WHERE run_id = ?1 AND frame = ?2)"),
      subtract_(database,
                "UPDATE track SET frames = frames - 1, speed_sum = speed_sum - sqrt(gone.vx * gone.vx + gone.vy * "
                "gone.vy), length_sum = length_sum - gone.length, width_sum = width_sum - gone.width, x_sum = x_sum - "
                "gone.x, y_sum = y_sum - gone.y "
                "FROM track_state AS gone WHERE track.run_id = ?1 AND gone.run_id = ?1 AND gone.frame = ?2 AND "
                "gone.track_id = track.id") {}

void TrackRows::insert(int run_id, FrameIndex frame, const TrackState& state) {
    add(run_id, frame, state, kNoScore);
}

void TrackRows::insertFinished(int run_id, FrameIndex frame, TrackState state, const CommonOfTrack& common) {
    if (!common.whole) return insert(run_id, frame, state);
    state.score = kNoScore;
    state.age = 0;
    add(run_id, frame, state, common.score);
}

void TrackRows::add(int run_id, FrameIndex frame, const TrackState& state, double score_of_track) {
    RowWriter(track_)
        .integer(run_id)
        .integer(state.id)
        .integer(frame)
        .integer(frame)
        .integer(1)
        .integer(state.status != TrackStatus::tentative)
        .real(std::hypot(state.velocity.x, state.velocity.y))
        .real(state.box.length)
        .real(state.box.width)
        .real(state.box.centre.x)
        .real(state.box.centre.y)
        .real(score_of_track)
        .run();
    writeState(state_, run_id, frame, state);
}

void TrackRows::erase(int run_id, FrameIndex frame) {
    RowWriter(forget_tracks_).integer(run_id).integer(frame).run();
    RowWriter(subtract_).integer(run_id).integer(frame).run();
    RowWriter(forget_states_).integer(run_id).integer(frame).run();
}

FrameRows::FrameRows(SQLite::Database& database)
    : frame_(database, insertInto("frame", frameColumns())),
      vectors_(database, insertInto("motion_vectors", "run_id, frame, data")),
      corners_(database, insertInto("stationary_corners", "run_id, frame, data")),
      cluster_(database, insertInto("motion_cluster",
                                    "run_id, frame, number, x, y, length, width, heading_rad, vx, vy, members")),
      roi_(database, insertInto("roi", "run_id, frame, number, x, y, length, width, heading_rad")),
      detection_(database, insertInto("detection",
                                      "run_id, frame, number, x, y, length, width, heading_rad, vx, vy, score, "
                                      "cluster, rejection, vectors, complete, probability, decision")),
      unfinished_(database),
      tracks_(database) {
    for (const char* table :
         {"frame", "motion_vectors", "stationary_corners", "roi", "motion_cluster", "detection", "unfinished_frame"}) {
        forget_.emplace_back(database, std::string("DELETE FROM ") + table + " WHERE run_id = ? AND frame = ?");
    }
}

void FrameRows::insert(int run_id, const FrameResult& result, bool details) {
    const FrameMotion& motion = result.motion;
    const FrameIndex frame = motion.frame;
    const Homography& homography = motion.registration.current_from_previous;
    const RegistrationFailure& failure = motion.registration.failure;
    const FrameSummary summary = summaryOf(result);

    RowWriter row(frame_);
    row.integer(run_id)
        .integer(frame)
        .integer(motion.time_us)
        .integer(motion.image_size.width)
        .integer(motion.image_size.height)
        .word(stored::kRegistrationStates, motion.registration.state)
        .word(stored::kRegistrationFaults, failure.fault)
        .word(stored::kPictureQualities, failure.picture)
        .integer(failure.count)
        .integer(failure.of)
        .integer(homography.from_frame)
        .integer(homography.to_frame);
    for (const double element : homography.matrix.val) row.real(element);
    row.integer(homography.inliers)
        .real(homography.rms_px)
        .integer(motion.corner_count)
        .integer(summary.motion_vectors)
        .integer(summary.detections)
        .integer(summary.tracks)
        .real(motion.background_speed_sigma)
        .integer(details ? 1 : 0)
        .integer(motion.registration.elapsed)
        .real(motion.registration.zoom);
    for (const float ms : result.stage_ms) row.real(static_cast<double>(ms));
    row.run();
    if (details) {
        insertDetails(run_id, result);
    } else {
        unfinished_.insert(run_id, result);
    }
    for (const TrackState& state : result.tracks) tracks_.insert(run_id, frame, state);
}

void FrameRows::insertDetails(int run_id, const FrameResult& result) {
    const FrameMotion& motion = result.motion;
    const FrameIndex frame = motion.frame;
    const Bytes vectors = packMotionVectors(motion.motion_vectors);
    RowWriter(vectors_).integer(run_id).integer(frame).bytes(vectors).run();
    const Bytes corners = packPoints(motion.stationary_corners);
    RowWriter(corners_).integer(run_id).integer(frame).bytes(corners).run();

    int number = 0;
    for (const MotionCluster& cluster : result.clusters) {
        const Bytes members = packIndices(cluster.members);
        RowWriter(cluster_)
            .integer(run_id)
            .integer(frame)
            .integer(number++)
            .box(cluster.box)
            .point(cluster.velocity)
            .bytes(members)
            .run();
    }
    number = 0;
    for (const OrientedBox& roi : result.rois) {
        RowWriter(roi_).integer(run_id).integer(frame).integer(number++).box(roi).run();
    }
    number = 0;
    for (const Detection& detection : result.detections) {
        const Bytes members = packIndices(detection.vectors);
        RowWriter(detection_)
            .integer(run_id)
            .integer(frame)
            .integer(number++)
            .box(detection.box)
            .point(detection.velocity)
            .real(detection.score)
            .integer(detection.cluster)
            .word(stored::kRejections, detection.rejection)
            .bytes(members)
            .integer(detection.complete ? 1 : 0)
            .real(detection.probability)
            .real(detection.decision)
            .run();
    }
}

void FrameRows::erase(int run_id, FrameIndex frame) {
    tracks_.erase(run_id, frame);
    for (SQLite::Statement& statement : forget_) RowWriter(statement).integer(run_id).integer(frame).run();
}

}  // namespace eyrie
