#include "store/runs/doubtful_tracks.h"

#include <SQLiteCpp/SQLiteCpp.h>

#include <algorithm>
#include <charconv>
#include <cmath>

#include "core/labels/result_box.h"
#include "store/database/rows.h"
#include "store/project/sequence_rows.h"
#include "store/runs/class_rule.h"
#include "store/runs/frame_rows.h"
#include "store/runs/of_run.h"

namespace eyrie {
namespace {

constexpr char kThreshold[] = "finishing.min_score";

std::vector<TrackFrame> readDoubtful(ProjectFile& project, int run_id, const std::string& condition,
                                     std::initializer_list<std::int64_t> values) {
    return guarded(project.path(), "reading the doubtful tracks" + ofRun(run_id), [&] {
        SQLite::Statement statement(project.database(), std::string("SELECT frame, ") + kTrackStateColumns +
                                                            " FROM doubtful_state WHERE run_id = ? AND " + condition +
                                                            " ORDER BY frame, track_id");
        int next = 1;
        statement.bind(next++, run_id);
        for (const std::int64_t value : values) statement.bind(next++, value);
        std::vector<TrackFrame> states;
        while (statement.executeStep()) {
            RowReader row(statement);
            const FrameIndex frame = readFrameNumber(row);
            states.push_back({frame, readTrackState(row)});
        }
        return states;
    });
}

}  // namespace

void insertDoubtful(SQLite::Database& database, int run_id, const TracksOfRun& tracks) {
    SQLite::Statement state_of(database, insertState("doubtful_state"));
    tracks.doubtful([&](FrameIndex frame, const TrackState& state) { writeState(state_of, run_id, frame, state); });
    SQLite::Statement evidence_of(
        database,
        "INSERT INTO track_evidence (run_id, track_id, detected, looked_alike, life_s, "
        "flow_px, flow_ratio, alignment, score, decision) VALUES (?, ?, ?, ?, ?, ?, ?, ?, ?, ?)");
    for (const auto& [track, evidence] : tracks.evidence) {
        RowWriter(evidence_of)
            .integer(run_id)
            .integer(track)
            .real(evidence.detected)
            .real(evidence.looked_alike)
            .real(evidence.life_s)
            .real(evidence.flow_px)
            .real(evidence.flow_ratio)
            .real(evidence.alignment)
            .real(evidence.score)
            .real(evidence.decision)
            .run();
    }
}

std::vector<TrackSummary> DoubtfulTracks::summaries(int run_id) const {
    const ClassRule rule = classRuleOf(RunStore(project_), run_id);
    return guarded(project_.path(), "reading the doubtful tracks" + ofRun(run_id), [&] {
        SQLite::Statement statement(
            project_.database(),
            "SELECT track_id, min(frame), max(frame), count(*), avg(sqrt(vx * vx + vy * vy)), "
            "avg(length), avg(width), min(score), avg(x), avg(y) FROM doubtful_state WHERE run_id = ? GROUP BY "
            "track_id ORDER BY track_id");
        statement.bind(1, run_id);
        std::vector<TrackSummary> tracks;
        while (statement.executeStep()) {
            RowReader row(statement);
            TrackSummary track;
            track.id = row.integer();
            track.first_frame = row.integer();
            track.last_frame = row.integer();
            track.frames = row.integer();
            track.confirmed = true;
            track.doubtful = true;
            track.mean_speed_px = row.real();
            track.mean_length_px = row.real();
            track.mean_width_px = row.real();
            track.score = row.real();
            track.place = row.point();
            track.track_class = rule.of(track);
            tracks.push_back(track);
        }
        return tracks;
    });
}

std::vector<TrackState> DoubtfulTracks::statesIn(int run_id, FrameIndex frame) const {
    std::vector<TrackState> states;
    for (const TrackFrame& state : readDoubtful(project_, run_id, "frame = ?", {frame})) states.push_back(state.state);
    return states;
}

std::vector<TrackFrame> DoubtfulTracks::statesOf(int run_id, TrackId track) const {
    // Its frames first, from the index alone: without figures of how many rows there are SQLite would rather read all
    // of the run.
    return readDoubtful(project_, run_id,
                        "track_id = ?2 AND frame IN (SELECT frame FROM doubtful_state WHERE run_id = ?1 AND track_id "
                        "= ?2)",
                        {track});
}

BoxesByFrame DoubtfulTracks::boxes(int run_id) const {
    BoxesByFrame boxes;
    for (const TrackFrame& state : readDoubtful(project_, run_id, "TRUE", {}))
        boxes[state.frame].push_back(boxOf(state.frame, state.state));
    return boxes;
}

std::vector<TrackFrame> DoubtfulTracks::statesUpTo(int run_id, FrameIndex frame, int trail) const {
    return readDoubtful(project_, run_id, "frame > ? AND frame <= ?",
                        {static_cast<std::int64_t>(frame) - trail, frame});
}

std::optional<TrackEvidence> DoubtfulTracks::evidence(int run_id, TrackId track) const {
    return guarded(
        project_.path(), "reading what speaks for track " + std::to_string(track) + ofRun(run_id),
        [&]() -> std::optional<TrackEvidence> {
            SQLite::Statement statement(project_.database(),
                                        "SELECT detected, looked_alike, life_s, flow_px, flow_ratio, "
                                        "alignment, score, decision FROM track_evidence WHERE run_id = ? AND "
                                        "track_id = ?");
            statement.bind(1, run_id);
            statement.bind(2, track);
            if (!statement.executeStep()) return std::nullopt;
            RowReader row(statement);
            TrackEvidence evidence;
            for (double* value : {&evidence.detected, &evidence.looked_alike, &evidence.life_s, &evidence.flow_px,
                                  &evidence.flow_ratio, &evidence.alignment, &evidence.score}) {
                *value = row.real();
                if (!std::isfinite(*value)) throw MalformedRow{"evidence that is no number"};
            }
            evidence.decision = row.real();
            return evidence;
        });
}

double DoubtfulTracks::scoreThreshold(int run_id) const {
    const bool scored = guarded(project_.path(), "reading what speaks for the tracks" + ofRun(run_id), [&] {
        SQLite::Statement any(project_.database(), "SELECT EXISTS (SELECT 1 FROM track_evidence WHERE run_id = ?)");
        any.bind(1, run_id);
        any.executeStep();
        return any.getColumn(0).getInt() != 0;
    });
    if (!scored) return 0;
    for (const auto& [name, value] : RunStore(project_).parameters(run_id)) {
        if (name != kThreshold) continue;
        double threshold = 0;
        std::from_chars(value.data(), value.data() + value.size(), threshold);
        return std::clamp(threshold, 0.0, 1.0);
    }
    return 0;
}

}  // namespace eyrie
