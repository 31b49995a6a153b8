// The part of RunStore that reads what a run found: whole frames, tracks and boxes.
#include <SQLiteCpp/SQLiteCpp.h>

#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <unordered_map>

#include "core/labels/result_box.h"
#include "store/database/rows.h"
#include "store/details/kept_details.h"
#include "store/details/unfinished_frames.h"
#include "store/project/sequence_rows.h"
#include "store/runs/class_rule.h"
#include "store/runs/of_run.h"
#include "store/runs/run_store.h"
#include "store/runs/stored_light.h"

namespace eyrie {
namespace {

/// Adds to states what those of a finished track have in common and is stored with the track.
class CommonOfTracks {
 public:
    CommonOfTracks(SQLite::Database& database, int run_id) : database_(database), run_id_(run_id) {}

    void addTo(TrackState& state, FrameIndex frame) {
        if (!std::isnan(state.score)) return;
        const Common& common = of(state.id);
        if (std::isnan(common.score)) return;
        state.score = common.score;
        state.age = frame - common.first_frame;
    }

 private:
    struct Common {
        FrameIndex first_frame = 0;
        double score = 0;
    };
    const Common& of(TrackId track) {
        const auto [place, is_new] = known_.try_emplace(track);
        if (!is_new) return place->second;
        if (!statement_) {
            statement_.emplace(database_, "SELECT first_frame, score FROM track WHERE run_id = ? AND id = ?");
            statement_->bind(1, run_id_);
        }
        statement_->reset();
        statement_->bind(2, track);
        Common& common = place->second;
        common.score = std::numeric_limits<double>::quiet_NaN();
        if (!statement_->executeStep()) return common;
        RowReader row(*statement_);
        common.first_frame = row.integer();
        common.score = row.real();
        return common;
    }

    SQLite::Database& database_;
    int run_id_;
    std::optional<SQLite::Statement> statement_;  ///< once it is needed
    std::unordered_map<TrackId, Common> known_;
};

void visitStates(SQLite::Database& database, int run_id, SQLite::Statement& statement,
                 const RunStore::StateVisitor& visitor) {
    CommonOfTracks common(database, run_id);
    while (statement.executeStep()) {
        RowReader row(statement);
        const FrameIndex frame = readFrameNumber(row);
        TrackState state = readTrackState(row);
        common.addTo(state, frame);
        visitor(frame, state);
    }
}

std::vector<TrackFrame> readStates(SQLite::Database& database, int run_id, SQLite::Statement& statement) {
    std::vector<TrackFrame> states;
    visitStates(database, run_id, statement, [&](FrameIndex frame, const TrackState& state) {
        states.push_back({frame, state});
    });
    return states;
}

/// Reads every row of `query`, whose first two parameters are the run and the frame.
template <class Item, class ReadRow>
std::vector<Item> readItems(SQLite::Database& database, const std::string& query, int run_id, FrameIndex frame,
                            ReadRow&& read_row) {
    SQLite::Statement statement(database, query);
    statement.bind(1, run_id);
    statement.bind(2, frame);
    std::vector<Item> items;
    while (statement.executeStep()) {
        RowReader row(statement);
        items.push_back(read_row(row));
    }
    return items;
}

/// `details`: whether the run kept what is behind the tracks of the frame.
std::optional<FrameResult> readFrameRow(SQLite::Database& database, int run_id, FrameIndex frame, bool& details) {
    std::string query =
        "SELECT time_us, width, height, registration_state, reason, picture, reason_count, reason_of, from_frame, "
        "to_frame, "
        "h00, h01, h02, h10, h11, h12, h20, h21, h22, inliers, rms_px, corner_count, background_speed_sigma, details, "
        "elapsed, zoom";
    for (const char* stage : stored::kStageColumns) query += std::string(", ") + stage;
    SQLite::Statement statement(database, query + " FROM frame WHERE run_id = ? AND frame = ?");
    statement.bind(1, run_id);
    statement.bind(2, frame);
    if (!statement.executeStep()) return std::nullopt;

    RowReader row(statement);
    FrameResult result;
    FrameMotion& motion = result.motion;
    Homography& homography = motion.registration.current_from_previous;
    motion.frame = frame;
    motion.time_us = row.wide();
    motion.image_size.width = row.integer();
    motion.image_size.height = row.integer();
    motion.registration.state = row.word(stored::kRegistrationStates);
    motion.registration.failure = row.failure();
    homography.from_frame = row.integer();
    homography.to_frame = row.integer();
    for (double& element : homography.matrix.val) element = row.real();
    homography.inliers = row.integer();
    homography.rms_px = row.real();
    motion.corner_count = row.integer();
    motion.background_speed_sigma = row.real();
    details = row.integer() != 0;
    motion.registration.elapsed = readElapsed(row);
    motion.registration.zoom = readZoom(row);
    for (float& ms : result.stage_ms) ms = static_cast<float>(row.real());
    return result;
}

/// The packed array of a frame in one of the tables that hold them; exactly one row.
template <class Unpack>
auto readPacked(SQLite::Database& database, const std::string& table, int run_id, FrameIndex frame, Unpack&& unpack) {
    SQLite::Statement statement(database, "SELECT data FROM " + table + " WHERE run_id = ? AND frame = ?");
    statement.bind(1, run_id);
    statement.bind(2, frame);
    if (!statement.executeStep()) throw MalformedRow{"no " + table};
    return RowReader::unpacked(unpack(RowReader(statement).bytes()), table.c_str());
}

/// Indices into the frame's motion vectors must stay inside: who draws them trusts them.
std::vector<int> readIndices(RowReader& row, std::size_t vectors) {
    std::vector<int> indices = RowReader::unpacked(unpackIndices(row.bytes()), "indices of motion vectors");
    for (const int index : indices) {
        if (index < 0 || static_cast<std::size_t>(index) >= vectors) {
            throw MalformedRow{"index " + std::to_string(index) + " of " + std::to_string(vectors) + " motion vectors"};
        }
    }
    return indices;
}

std::vector<MotionCluster> readClusters(SQLite::Database& database, int run_id, FrameIndex frame, std::size_t vectors) {
    return readItems<MotionCluster>(database,
                                    "SELECT x, y, length, width, heading_rad, vx, vy, members FROM motion_cluster "
                                    "WHERE run_id = ? AND frame = ? ORDER BY number",
                                    run_id, frame, [&](RowReader& row) {
                                        MotionCluster cluster;
                                        cluster.box = row.box();
                                        cluster.velocity = row.point();
                                        cluster.members = readIndices(row, vectors);
                                        return cluster;
                                    });
}

std::vector<Detection> readDetections(SQLite::Database& database, int run_id, FrameIndex frame, std::size_t vectors) {
    return readItems<Detection>(
        database,
        "SELECT x, y, length, width, heading_rad, vx, vy, score, cluster, rejection, vectors, complete, "
        "probability, decision FROM detection WHERE run_id = ? AND frame = ? ORDER BY number",
        run_id, frame, [&](RowReader& row) {
            Detection detection;
            detection.box = row.box();
            detection.velocity = row.point();
            detection.score = row.real();
            detection.cluster = row.integer();
            detection.rejection = row.word(stored::kRejections);
            detection.vectors = readIndices(row, vectors);
            detection.complete = row.integer() != 0;
            detection.probability = row.real();
            detection.decision = row.real();
            return detection;
        });
}

std::vector<DroppedState> readDropped(SQLite::Database& database, int run_id, FrameIndex frame) {
    return readItems<DroppedState>(database,
                                   "SELECT track_id, x, y, length, width, heading_rad, reason, beside FROM "
                                   "dropped_state WHERE run_id = ? AND frame = ? ORDER BY track_id",
                                   run_id, frame, [](RowReader& row) {
                                       DroppedState dropped;
                                       dropped.id = row.integer();
                                       dropped.box = row.box();
                                       dropped.why = row.word(stored::kTrackDrops);
                                       dropped.beside = row.integer();
                                       return dropped;
                                   });
}

}  // namespace

std::vector<TrackSummary> RunStore::tracks(int run_id) const {
    const ClassRule rule = classRuleOf(*this, run_id);
    return guarded(project_.path(), "reading the tracks" + ofRun(run_id), [&] {
        SQLite::Statement statement(
            project_.database(),
            "SELECT id, first_frame, last_frame, frames, confirmed, speed_sum, length_sum, "
            "width_sum, coalesce(score, (SELECT score FROM track_state WHERE track_state.run_id = "
            "track.run_id AND frame = last_frame AND track_id = track.id), 0), "
            "x_sum, y_sum "
            "FROM track WHERE run_id = ? ORDER BY id");
        statement.bind(1, run_id);
        const std::map<TrackId, BoxTrim> trims = readTrims(project_.database(), run_id);
        std::vector<TrackSummary> tracks;
        while (statement.executeStep()) {
            RowReader row(statement);
            TrackSummary track;
            track.id = row.integer();
            track.first_frame = row.integer();
            track.last_frame = row.integer();
            track.frames = row.integer();
            if (track.frames < 1) throw MalformedRow{"track " + std::to_string(track.id) + " without frames"};
            track.confirmed = row.integer() != 0;
            track.mean_speed_px = row.real() / track.frames;
            track.mean_length_px = row.real() / track.frames;
            track.mean_width_px = row.real() / track.frames;
            track.score = row.real();
            const cv::Point2d place = row.point() / track.frames;
            if (!rule.scale.slope.isFlat() && std::isfinite(place.x + place.y)) track.place = place;
            track.track_class = rule.of(track);
            if (const auto trim = trims.find(track.id); trim != trims.end()) track.trim = trim->second;
            tracks.push_back(track);
        }
        return tracks;
    });
}

TrackId RunStore::lastTrackId(int run_id) const {
    return guarded(project_.path(), "reading the tracks" + ofRun(run_id), [&] {
        SQLite::Statement statement(
            project_.database(),
            "SELECT max(ifnull((SELECT max(id) FROM track WHERE run_id = ?1), 0), ifnull((SELECT "
            "max(track_id) FROM doubtful_state WHERE run_id = ?1), 0))");
        statement.bind(1, run_id);
        statement.executeStep();
        return static_cast<TrackId>(RowReader(statement).integer());
    });
}

std::vector<TrackFrame> RunStore::trackStates(int run_id, TrackId track) const {
    return guarded(project_.path(), "reading track " + std::to_string(track) + ofRun(run_id), [&] {
        // States are in the order of frames: one is looked for in each frame of the track's life.
        SQLite::Statement statement(
            project_.database(),
            std::string("SELECT frame, ") + kTrackStateColumns +
                " FROM track_state WHERE run_id = ?1 AND track_id = ?2 AND frame IN (SELECT frame FROM frame WHERE "
                "run_id = ?1 AND frame BETWEEN (SELECT first_frame FROM track WHERE run_id = ?1 AND id = ?2) AND "
                "(SELECT last_frame FROM track WHERE run_id = ?1 AND id = ?2)) ORDER BY frame");
        statement.bind(1, run_id);
        statement.bind(2, track);
        return readStates(project_.database(), run_id, statement);
    });
}

std::vector<TrackFrame> RunStore::trackStatesUpTo(int run_id, FrameIndex frame, int trail) const {
    return guarded(project_.path(), "reading the trails" + ofRun(run_id), [&] {
        SQLite::Statement statement(project_.database(), std::string("SELECT frame, ") + kTrackStateColumns +
                                                             " FROM track_state WHERE run_id = ? AND frame > ? AND "
                                                             "frame <= ? ORDER BY frame, track_id");
        statement.bind(1, run_id);
        statement.bind(2, static_cast<std::int64_t>(frame) - trail);
        statement.bind(3, frame);
        return readStates(project_.database(), run_id, statement);
    });
}

void RunStore::visitTrackStates(int run_id, const StateVisitor& visitor) const {
    guarded(project_.path(), "reading the tracks" + ofRun(run_id), [&] {
        SQLite::Statement statement(project_.database(), std::string("SELECT frame, ") + kTrackStateColumns +
                                                             " FROM track_state WHERE run_id = ? ORDER BY frame, "
                                                             "track_id");
        statement.bind(1, run_id);
        visitStates(project_.database(), run_id, statement, visitor);
    });
}

void RunStore::visitTrackPlaces(int run_id, const PlaceVisitor& visitor) const {
    guarded(project_.path(), "reading the tracks" + ofRun(run_id), [&] {
        SQLite::Statement statement(
            project_.database(),
            "SELECT frame, track_id, x, y, length, width, heading_rad, origin FROM track_state WHERE "
            "run_id = ? ORDER BY frame, track_id");
        statement.bind(1, run_id);
        while (statement.executeStep()) {
            RowReader row(statement);
            const FrameIndex frame = readFrameNumber(row);
            const TrackId track = row.integer();
            const OrientedBox box = row.box();
            visitor(frame, track, box, row.word(stored::kStateOrigins) != StateOrigin::predicted);
        }
    });
}

void RunStore::visitTrackBoxes(int run_id, const BoxVisitor& visitor) const {
    std::map<TrackId, const char*> classes;
    for (const TrackSummary& track : tracks(run_id)) classes[track.id] = wordOf(track.track_class);
    guarded(project_.path(), "reading the tracks" + ofRun(run_id), [&] {
        SQLite::Statement statement(project_.database(), std::string("SELECT frame, ") + kTrackStateColumns +
                                                             " FROM track_state WHERE run_id = ?1 AND track_id IN "
                                                             "(SELECT id FROM track WHERE run_id = ?1 AND confirmed) "
                                                             "ORDER BY frame, track_id");
        statement.bind(1, run_id);
        visitStates(project_.database(), run_id, statement, [&](FrameIndex frame, const TrackState& state) {
            BoxRecord record = boxOf(frame, state);
            if (const auto known = classes.find(state.id); known != classes.end()) record.object_class = known->second;
            visitor(frame, record);
        });
    });
}

BoxesByFrame RunStore::trackBoxes(int run_id) const {
    BoxesByFrame boxes;
    visitTrackBoxes(run_id, [&](FrameIndex frame, const BoxRecord& record) { boxes[frame].push_back(record); });
    return boxes;
}

std::vector<ClassifiedBox> RunStore::classifiedBoxes(int run_id, FrameIndex frame) const {
    return guarded(project_.path(), "reading the detections" + ofRun(run_id), [&] {
        if (auto aside = UnfinishedFrames::classified(project_.database(), run_id, frame)) return std::move(*aside);
        SQLite::Statement statement(project_.database(),
                                    "SELECT x, y, length, width, heading_rad, complete, decision FROM detection WHERE "
                                    "run_id = ? AND frame = ? AND rejection = 'none' AND "
                                    "(complete OR decision IS NOT NULL) ORDER BY number");
        statement.bind(1, run_id);
        statement.bind(2, frame);
        std::vector<ClassifiedBox> boxes;
        while (statement.executeStep()) {
            RowReader row(statement);
            ClassifiedBox& read = boxes.emplace_back();
            read.box = row.box();
            read.whole = row.integer() != 0;
            read.decision = row.real();
        }
        return boxes;
    });
}

void RunStore::visitDetectionBoxes(int run_id, const BoxVisitor& visitor) const {
    if (const std::optional<RunRecord> whole = run(run_id)) needDetails(project_, *whole);
    guarded(project_.path(), "reading the detections" + ofRun(run_id), [&] {
        SQLite::Statement statement(project_.database(),
                                    "SELECT frame, x, y, length, width, heading_rad, vx, vy, "
                                    "coalesce(probability, score) FROM detection "
                                    "WHERE run_id = ? AND rejection = 'none' ORDER BY frame, number");
        statement.bind(1, run_id);
        while (statement.executeStep()) {
            RowReader row(statement);
            BoxRecord record;
            record.frame = row.integer();
            record.box = row.box();
            record.velocity = row.point();
            record.score = row.real();
            record.origin = StateOrigin::detected;
            visitor(record.frame, record);
        }
    });
}

BoxesByFrame RunStore::detectionBoxes(int run_id) const {
    BoxesByFrame boxes;
    visitDetectionBoxes(run_id, [&](FrameIndex frame, const BoxRecord& record) { boxes[frame].push_back(record); });
    return boxes;
}

std::optional<FrameResult> RunStore::frameResult(int run_id, FrameIndex frame) const {
    const std::string doing = "reading frame " + std::to_string(frame) + " of run " + std::to_string(run_id);
    return guarded(project_.path(), doing, [&]() -> std::optional<FrameResult> {
        SQLite::Database& database = project_.database();
        // One view of the file for all tables, whatever a writer does meanwhile.
        SQLite::Transaction view(database, SQLite::TransactionBehavior::DEFERRED);
        bool details = true;
        std::optional<FrameResult> result = readFrameRow(database, run_id, frame, details);
        if (!result) return std::nullopt;
        FrameMotion& motion = result->motion;
        if (details) {
            motion.motion_vectors = readPacked(database, "motion_vectors", run_id, frame, unpackMotionVectors);
            motion.stationary_corners = readPacked(database, "stationary_corners", run_id, frame, unpackPoints);
        }
        result->clusters = readClusters(database, run_id, frame, motion.motion_vectors.size());
        result->rois = readItems<OrientedBox>(database,
                                              "SELECT x, y, length, width, heading_rad FROM roi WHERE run_id = ? AND "
                                              "frame = ? ORDER BY number",
                                              run_id, frame, [](RowReader& row) { return row.box(); });
        result->detections = readDetections(database, run_id, frame, motion.motion_vectors.size());
        CommonOfTracks common(database, run_id);
        result->tracks = readItems<TrackState>(database,
                                               std::string("SELECT ") + kTrackStateColumns +
                                                   " FROM track_state WHERE run_id = ? AND frame = ? ORDER BY track_id",
                                               run_id, frame, [&](RowReader& row) {
                                                   TrackState state = readTrackState(row);
                                                   common.addTo(state, frame);
                                                   return state;
                                               });
        result->dropped = readDropped(database, run_id, frame);
        return result;
    });
}

std::vector<MotionVector> RunStore::motionVectors(int run_id, FrameIndex frame) const {
    const std::string doing =
        "reading the motion vectors of frame " + std::to_string(frame) + " of run " + std::to_string(run_id);
    return guarded(project_.path(), doing, [&] {
        if (auto aside = UnfinishedFrames::vectors(project_.database(), run_id, frame)) return std::move(*aside);
        return readPacked(project_.database(), "motion_vectors", run_id, frame, unpackMotionVectors);
    });
}

}  // namespace eyrie
