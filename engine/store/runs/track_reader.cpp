// The part of RunStore that reads tracks and whole results.
#include <SQLiteCpp/SQLiteCpp.h>

#include <map>

#include "store/database/rows.h"
#include "store/details/kept_details.h"
#include "store/details/unfinished_frames.h"
#include "store/project/sequence_rows.h"
#include "store/runs/box_of_state.h"
#include "store/runs/class_rule.h"
#include "store/runs/of_run.h"
#include "store/runs/run_store.h"

namespace eyrie {
namespace {

void visitStates(SQLite::Statement& statement, const RunStore::StateVisitor& visitor) {
    while (statement.executeStep()) {
        RowReader row(statement);
        const FrameIndex frame = readFrameNumber(row);
        visitor(frame, readTrackState(row));
    }
}

std::vector<TrackFrame> readStates(SQLite::Statement& statement) {
    std::vector<TrackFrame> states;
    visitStates(statement, [&](FrameIndex frame, const TrackState& state) { states.push_back({frame, state}); });
    return states;
}

/// Where each track was on the whole.
std::map<TrackId, cv::Point2d> meanPlaces(SQLite::Database& database, int run_id) {
    SQLite::Statement statement(database,
                                "SELECT track_id, avg(x), avg(y) FROM track_state WHERE run_id = ? GROUP BY track_id");
    statement.bind(1, run_id);
    std::map<TrackId, cv::Point2d> places;
    while (statement.executeStep()) {
        RowReader row(statement);
        const TrackId track = row.integer();
        cv::Point2d& place = places[track];
        place.x = row.real();
        place.y = row.real();
    }
    return places;
}

}  // namespace

std::vector<TrackSummary> RunStore::tracks(int run_id) const {
    const ClassRule rule = classRuleOf(*this, run_id);
    return guarded(project_.path(), "reading the tracks" + ofRun(run_id), [&] {
        std::map<TrackId, cv::Point2d> places;
        if (!rule.scale.slope.isFlat()) places = meanPlaces(project_.database(), run_id);
        SQLite::Statement statement(project_.database(),
                                    "SELECT id, first_frame, last_frame, frames, confirmed, speed_sum, length_sum, "
                                    "width_sum, ifnull((SELECT score FROM track_state WHERE track_state.run_id = "
                                    "track.run_id AND frame = last_frame AND track_id = track.id), 0) "
                                    "FROM track WHERE run_id = ? ORDER BY id");
        statement.bind(1, run_id);
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
            const auto place = places.find(track.id);
            if (place != places.end()) track.place = place->second;
            track.track_class = rule.of(track);
            tracks.push_back(track);
        }
        return tracks;
    });
}

std::vector<TrackFrame> RunStore::trackStates(int run_id, TrackId track) const {
    return guarded(project_.path(), "reading track " + std::to_string(track) + ofRun(run_id), [&] {
        SQLite::Statement statement(project_.database(), std::string("SELECT frame, ") + kTrackStateColumns +
                                                             " FROM track_state WHERE run_id = ? AND track_id = ? "
                                                             "ORDER BY frame");
        statement.bind(1, run_id);
        statement.bind(2, track);
        return readStates(statement);
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
        return readStates(statement);
    });
}

void RunStore::visitTrackStates(int run_id, const StateVisitor& visitor) const {
    guarded(project_.path(), "reading the tracks" + ofRun(run_id), [&] {
        SQLite::Statement statement(project_.database(), std::string("SELECT frame, ") + kTrackStateColumns +
                                                             " FROM track_state WHERE run_id = ? ORDER BY frame, "
                                                             "track_id");
        statement.bind(1, run_id);
        visitStates(statement, visitor);
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
        visitStates(statement, [&](FrameIndex frame, const TrackState& state) {
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

std::vector<OrientedBox> RunStore::vehicleBoxes(int run_id, FrameIndex frame) const {
    return guarded(project_.path(), "reading the detections" + ofRun(run_id), [&] {
        if (auto aside = UnfinishedFrames::vehicles(project_.database(), run_id, frame)) return std::move(*aside);
        SQLite::Statement statement(project_.database(),
                                    "SELECT x, y, length, width, heading_rad FROM detection WHERE run_id = ? AND "
                                    "frame = ? AND rejection = 'none' AND complete ORDER BY number");
        statement.bind(1, run_id);
        statement.bind(2, frame);
        std::vector<OrientedBox> boxes;
        while (statement.executeStep()) boxes.push_back(RowReader(statement).box());
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
            record.origin = nameOf(StateOrigin::detected);
            visitor(record.frame, record);
        }
    });
}

BoxesByFrame RunStore::detectionBoxes(int run_id) const {
    BoxesByFrame boxes;
    visitDetectionBoxes(run_id, [&](FrameIndex frame, const BoxRecord& record) { boxes[frame].push_back(record); });
    return boxes;
}

}  // namespace eyrie
