#include "store/runs/run_store.h"

#include <SQLiteCpp/SQLiteCpp.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <unordered_map>
#include <unordered_set>

#include "core/time/utc_time.h"
#include "store/database/freed_space.h"
#include "store/database/rows.h"
#include "store/project/sequence_rows.h"
#include "store/runs/doubtful_tracks.h"
#include "store/runs/frame_rows.h"
#include "store/runs/of_run.h"
#include "store/runs/run_lock.h"
#include "store/runs/stored_light.h"

namespace eyrie {
namespace {

constexpr std::chrono::seconds kPatienceOfClosing{2};

/// What the rest of Eyrie divides by and counts up to.
void check(const RunRecord& run) {
    const auto refuse = [&](const char* what) { throw MalformedRow{"run " + std::to_string(run.id) + " has " + what}; };
    if (!(run.scale.gsd_m_per_px >= kFinestGsd && run.scale.gsd_m_per_px <= kCoarsestGsd))
        refuse("an impossible scale");
    if (!(run.scale.frame_rate_hz > 0 && std::isfinite(run.scale.frame_rate_hz)))
        refuse("a frame rate that is not above 0");
    const auto& uncertainty = run.scale_basis.uncertainty;
    if (uncertainty && !(*uncertainty >= 1 && *uncertainty <= kMostUncertain))
        refuse("an impossible uncertainty of its scale");
    const ScaleSlope& slope = run.scale.slope;
    if (!(std::abs(slope.right_per_px) <= ScaleSlope::kSteepest &&
          std::abs(slope.down_per_px) <= ScaleSlope::kSteepest))
        refuse("an impossible slope of its scale");
    if (run.scale_basis.vehicles < 0) refuse("an impossible number of vehicles that its scale rests on");
    if (run.first_frame < 0 || run.last_frame > kLastFrame) refuse("frames outside every video");
    checkSequence(run.sequence);
}

ScaleBasis readBasis(RowReader& row) {
    ScaleBasis basis;
    basis.origin = row.word(stored::kScaleOrigins);
    const double uncertainty = row.real();
    if (!std::isnan(uncertainty)) basis.uncertainty = uncertainty;
    basis.vehicles = row.integer();
    return basis;
}

/// When a run began, in its second by `fraction_us`, as result_writer.cpp stores it.
std::optional<std::int64_t> startOf(const RunRecord& run, double fraction_us) {
    if (std::isnan(fraction_us)) return std::nullopt;
    if (!(fraction_us >= 0 && fraction_us < 1e6))
        throw MalformedRow{"run " + std::to_string(run.id) + " has an impossible start"};
    const auto second_us = utcOf(run.started_utc);
    return second_us ? std::optional(*second_us + static_cast<std::int64_t>(fraction_us)) : std::nullopt;
}

RunRecord readRun(SQLite::Statement& statement, const std::filesystem::path& project) {
    RowReader row(statement);
    RunRecord run;
    run.id = row.integer();
    run.name = row.text();
    run.started_utc = row.text();
    run.started_us = startOf(run, row.real());
    run.engine_version = row.text();
    run.preset = row.text();
    run.scale.gsd_m_per_px = row.real();
    run.scale.gsd_known = row.integer() != 0;
    run.scale.frame_rate_hz = row.real();
    run.scale_basis = agreeing(readBasis(row), run.scale);
    const double growth_right = row.real();
    const double growth_down = row.real();
    run.first_frame = row.integer();
    run.last_frame = row.integer();
    run.state = row.word(stored::kRunStates);
    run.message = row.text();
    run.sequence.id = row.integer();
    run.sequence.path = row.text();
    run.sequence.size.width = row.integer();
    run.sequence.size.height = row.integer();
    if (growth_right != 0 || growth_down != 0)
        run.scale.slope = ScaleSlope::ofPicture(run.sequence.size, growth_right, growth_down);
    run.sequence.frame_count = row.integer();
    run.sequence.frame_rate_hz = row.real();
    run.sequence.rate_assumed = row.integer() != 0;
    run.rate_assumed = row.integer() != 0;
    run.frames_done = row.integer();
    check(run);
    if (run.state == RunState::running) {
        const auto writer = FileLock::holderOf(runLockFile(project, run.id));
        run.live = writer.has_value();
        run.writer = writer.value_or("");
    }
    return run;
}

ZoomCourse readZoomCourse(SQLite::Database& database, int run_id) {
    SQLite::Statement statement(database,
                                "SELECT frame, zoom FROM frame WHERE run_id = ? AND zoom <> 1 ORDER BY frame");
    statement.bind(1, run_id);
    std::vector<ZoomCourse::Change> changes;
    FrameIndex next = 0;
    while (statement.executeStep()) {
        RowReader row(statement);
        const FrameIndex frame = readFrameNumber(row);
        const double zoom = readZoom(row);
        // In between it is 1.
        if (!changes.empty() && frame != next) changes.emplace_back(next, 1);
        if (changes.empty() || changes.back().second != zoom) changes.emplace_back(frame, zoom);
        next = frame + 1;
    }
    if (!changes.empty()) changes.emplace_back(next, 1);
    return ZoomCourse(std::move(changes));
}

/// Reads the runs that `where`, with ?1 = `run_id`, asks for.
std::vector<RunRecord> readRuns(ProjectFile& project, const std::string& where, int run_id = 0) {
    SQLite::Statement statement(
        project.database(),
        "SELECT run.id, name, started_utc, started_fraction_us, engine_version, preset, gsd_m_per_px, gsd_known, "
        "run.frame_rate_hz, scale_origin, scale_uncertainty, scale_vehicles, scale_growth_right, scale_growth_down, "
        "first_frame, last_frame, state, message, sequence.id, path, width, height, frame_count, "
        "sequence.frame_rate_hz, sequence.rate_assumed, run.rate_assumed, (SELECT count(*) FROM frame WHERE "
        "frame.run_id = run.id) "
        "FROM run JOIN sequence ON sequence.id = run.sequence_id WHERE " +
            where + " ORDER BY run.id");
    if (run_id > 0) statement.bind(1, run_id);
    std::vector<RunRecord> runs;
    while (statement.executeStep()) runs.push_back(readRun(statement, project.path()));
    for (RunRecord& run : runs) {
        run.light = readFindings(project.database(), run.id);
        run.scale.zoom = readZoomCourse(project.database(), run.id);
    }
    return runs;
}

constexpr const char* kRegistrationRows =
    "SELECT from_frame, to_frame, h00, h01, h02, h10, h11, h12, h20, h21, h22, inliers, rms_px, registration_state, "
    "reason, picture, reason_count, reason_of, elapsed, zoom FROM frame WHERE run_id = ? AND frame >= ? ORDER BY frame";

Homography homographyOf(RowReader& row) {
    Homography homography;
    homography.from_frame = row.integer();
    homography.to_frame = row.integer();
    for (double& element : homography.matrix.val) element = row.real();
    homography.inliers = row.integer();
    homography.rms_px = row.real();
    return homography;
}

std::unordered_set<FrameIndex> framesWithoutDetails(SQLite::Database& database, int run_id) {
    SQLite::Statement statement(database, "SELECT frame FROM frame WHERE run_id = ? AND details = 0");
    statement.bind(1, run_id);
    std::unordered_set<FrameIndex> frames;
    while (statement.executeStep()) {
        RowReader row(statement);
        frames.insert(readFrameNumber(row));
    }
    return frames;
}

/// In which frame each track was left out first.
std::unordered_map<TrackId, FrameIndex> firstFramesOf(const TracksOfRun& tracks) {
    std::unordered_map<TrackId, FrameIndex> firsts;
    tracks.dropped([&](FrameIndex frame, const DroppedState& state) {
        const auto [known, added] = firsts.emplace(state.id, frame);
        if (!added) known->second = std::min(known->second, frame);
    });
    return firsts;
}

/// Asks for the states once more than whoever stores them.
std::map<TrackId, CommonOfTrack> commonOf(const TracksOfRun& tracks) {
    std::map<TrackId, CommonOfTrack> known;
    tracks.states([&](FrameIndex frame, const TrackState& state) {
        CommonOfTrack& common = known.try_emplace(state.id, CommonOfTrack{frame, state.score, true}).first->second;
        common.whole = common.whole && state.score == common.score && state.age == frame - common.first_frame;
    });
    return known;
}

}  // namespace

const char* nameOf(RunState state) {
    switch (state) {
        case RunState::running:
            return "running";
        case RunState::finished:
            return "finished";
        case RunState::stopped:
            return "stopped";
        case RunState::failed:
            return "failed";
    }
    return "";
}

FrameSummary summaryOf(const FrameResult& result) {
    FrameSummary summary;
    summary.frame = result.motion.frame;
    summary.time_us = result.motion.time_us;
    summary.state = result.motion.registration.state;
    summary.inliers = result.motion.registration.current_from_previous.inliers;
    summary.rms_px = result.motion.registration.current_from_previous.rms_px;
    summary.corners = result.motion.corner_count;
    summary.motion_vectors = static_cast<int>(result.motion.motion_vectors.size());
    summary.detections = static_cast<int>(
        std::count_if(result.detections.begin(), result.detections.end(),
                      [](const Detection& detection) { return detection.rejection == Rejection::none; }));
    summary.tracks =
        static_cast<int>(std::count_if(result.tracks.begin(), result.tracks.end(),
                                       [](const TrackState& state) { return state.status != TrackStatus::tentative; }));
    summary.stage_ms = result.stage_ms;
    return summary;
}

std::vector<RunRecord> RunStore::runs() const {
    return guarded(project_.path(), "listing the runs", [&] { return readRuns(project_, "removed_utc = ''"); });
}

std::optional<RunRecord> RunStore::run(int run_id) const {
    if (run_id <= 0) return std::nullopt;
    return guarded(project_.path(), "reading run " + std::to_string(run_id), [&]() -> std::optional<RunRecord> {
        auto found = readRuns(project_, "removed_utc = '' AND run.id = ?1", run_id);
        if (found.empty()) return std::nullopt;
        return std::move(found.front());
    });
}

std::vector<std::pair<std::string, std::string>> RunStore::parameters(int run_id) const {
    return guarded(project_.path(), "reading the parameters" + ofRun(run_id), [&] {
        SQLite::Statement statement(project_.database(),
                                    "SELECT name, value FROM run_parameter WHERE run_id = ? ORDER BY position");
        statement.bind(1, run_id);
        std::vector<std::pair<std::string, std::string>> parameters;
        while (statement.executeStep()) {
            RowReader row(statement);
            std::string name = row.text();
            parameters.emplace_back(std::move(name), row.text());
        }
        return parameters;
    });
}

std::vector<FrameSummary> RunStore::frameSummaries(int run_id) const {
    return guarded(project_.path(), "reading the frames" + ofRun(run_id), [&] {
        std::string query =
            "SELECT frame, time_us, registration_state, inliers, rms_px, corner_count, motion_vector_count, "
            "detection_count, track_count, details";
        for (const char* stage : stored::kStageColumns) query += std::string(", ") + stage;
        SQLite::Statement statement(project_.database(), query + " FROM frame WHERE run_id = ? ORDER BY frame");
        statement.bind(1, run_id);
        std::vector<FrameSummary> summaries;
        while (statement.executeStep()) {
            RowReader row(statement);
            FrameSummary summary;
            summary.frame = readFrameNumber(row);
            summary.time_us = row.wide();
            summary.state = row.word(stored::kRegistrationStates);
            summary.inliers = row.integer();
            summary.rms_px = row.real();
            summary.corners = row.integer();
            summary.motion_vectors = row.integer();
            summary.detections = row.integer();
            summary.tracks = row.integer();
            summary.details = row.integer() != 0;
            for (float& ms : summary.stage_ms) ms = static_cast<float>(row.real());
            summaries.push_back(summary);
        }
        return summaries;
    });
}

std::vector<Homography> RunStore::homographies(int run_id, FrameIndex from, FrameIndex last) const {
    return guarded(project_.path(), "reading the registration of run " + std::to_string(run_id), [&] {
        SQLite::Statement statement(project_.database(), kRegistrationRows);
        statement.bind(1, run_id);
        statement.bind(2, from);
        std::vector<Homography> homographies;
        while (statement.executeStep()) {
            RowReader row(statement);
            const Homography homography = homographyOf(row);
            if (homography.to_frame > last) break;  // rows ascend
            homographies.push_back(homography);
        }
        return homographies;
    });
}

void RunStore::visitRegistrations(int run_id, const std::function<void(const Registration&)>& visitor) const {
    guarded(project_.path(), "reading the registration of run " + std::to_string(run_id), [&] {
        SQLite::Statement statement(project_.database(), kRegistrationRows);
        statement.bind(1, run_id);
        statement.bind(2, 0);
        while (statement.executeStep()) {
            RowReader row(statement);
            Registration registration;
            registration.current_from_previous = homographyOf(row);
            registration.state = row.word(stored::kRegistrationStates);
            registration.failure = row.failure();
            registration.elapsed = readElapsed(row);
            registration.zoom = readZoom(row);
            visitor(registration);
        }
    });
}

std::vector<Registration> RunStore::registrations(int run_id) const {
    std::vector<Registration> registrations;
    visitRegistrations(run_id, [&](const Registration& each) { registrations.push_back(each); });
    return registrations;
}

void RunStore::replaceTracks(int run_id, const TracksOfRun& tracks) {
    guarded(project_.path(), "replacing the tracks" + ofRun(run_id), [&] {
        SQLite::Database& database = project_.database();
        SQLite::Transaction transaction(database, SQLite::TransactionBehavior::IMMEDIATE);
        const auto removeFrom = [&](const std::string& table) {
            SQLite::Statement statement(database, "DELETE FROM " + table + " WHERE run_id = ?");
            RowWriter(statement).integer(run_id).run();
        };
        removeFrom("dropped_state");
        SQLite::Statement left_out(database,
                                   "INSERT OR REPLACE INTO dropped_state (run_id, frame, track_id, x, y, length, "
                                   "width, heading_rad, reason, beside) VALUES (?, ?, ?, ?, ?, ?, ?, ?, ?, ?)");
        // Of frames without details nobody can ask why; what was left out at all is still to be counted.
        const std::unordered_set<FrameIndex> bare = framesWithoutDetails(database, run_id);
        const std::unordered_map<TrackId, FrameIndex> firsts =
            bare.empty() ? std::unordered_map<TrackId, FrameIndex>{} : firstFramesOf(tracks);
        tracks.dropped([&](FrameIndex frame, const DroppedState& state) {
            if (bare.contains(frame) && firsts.at(state.id) != frame) return;
            RowWriter(left_out)
                .integer(run_id)
                .integer(frame)
                .integer(state.id)
                .box(state.box)
                .word(stored::kTrackDrops, state.why)
                .integer(state.beside)
                .run();
        });
        for (const char* table : {"doubtful_state", "track_evidence", "track_state"}) removeFrom(table);
        removeFrom("track");
        const std::map<TrackId, CommonOfTrack> common = commonOf(tracks);
        TrackRows rows(database);
        tracks.states([&](FrameIndex frame, const TrackState& state) {
            rows.insertFinished(run_id, frame, state, common.at(state.id));
        });
        insertDoubtful(database, run_id, tracks);
        replaceLight(database, run_id, tracks.light);
        SQLite::Statement counts(database,
                                 "UPDATE frame SET track_count = (SELECT count(*) FROM track_state WHERE "
                                 "track_state.run_id = frame.run_id AND track_state.frame = frame.frame AND "
                                 "status <> 'tentative') WHERE run_id = ?");
        RowWriter(counts).integer(run_id).run();
        transaction.commit();
    });
}

void RunStore::rename(int run_id, const std::string& name) {
    guarded(project_.path(), "renaming run " + std::to_string(run_id), [&] {
        SQLite::Statement statement(project_.database(), "UPDATE run SET name = ? WHERE id = ?");
        RowWriter(statement).text(name).integer(run_id).run();
        refuseUnchanged(run_id);
    });
}

void RunStore::remove(int run_id) {
    const auto present = run(run_id);
    if (present && present->live) {
        throw Error(ErrorKind::project, "run " + std::to_string(run_id) + " of " + project_.path().string() +
                                            " is being written by " + present->writer + "; stop it there first");
    }
    markRemoved(run_id, nowUtc());
}

void RunStore::restore(int run_id) {
    markRemoved(run_id, "");
}

void RunStore::markRemoved(int run_id, const std::string& when_utc) {
    guarded(project_.path(), "removing run " + std::to_string(run_id), [&] {
        SQLite::Statement statement(project_.database(), "UPDATE run SET removed_utc = ? WHERE id = ?");
        RowWriter(statement).text(when_utc).integer(run_id).run();
        refuseUnchanged(run_id);
    });
}

std::optional<RunRecord> RunStore::lastRemoved() const {
    return guarded(project_.path(), "looking for removed runs", [&]() -> std::optional<RunRecord> {
        auto found = readRuns(project_,
                              "run.id = (SELECT id FROM run WHERE removed_utc <> '' "
                              "ORDER BY removed_utc DESC, id DESC LIMIT 1)");
        if (found.empty()) return std::nullopt;
        return std::move(found.front());
    });
}

void RunStore::purgeRemoved() {
    guarded(project_.path(), "deleting removed runs", [&] {
        if (project_.database().exec("DELETE FROM run WHERE removed_utc <> ''") > 0)
            giveBackSpace(project_.database(), kPatienceOfClosing);
    });
}

void RunStore::refuseUnchanged(int run_id) const {
    if (project_.database().getChanges() > 0) return;
    throw Error(ErrorKind::project, "the project " + project_.path().string() + " has no run " +
                                        std::to_string(run_id) + "; eyrie-cli info lists its runs");
}

DoubtfulTracks RunStore::doubtful() const {
    return DoubtfulTracks(project_);
}

}  // namespace eyrie
