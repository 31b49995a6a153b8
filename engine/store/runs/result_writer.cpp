#include "store/runs/result_writer.h"

#include <SQLiteCpp/SQLiteCpp.h>

#include <chrono>
#include <limits>
#include <optional>

#include "core/time/utc_time.h"
#include "core/values/last_frame.h"
#include "store/database/freed_space.h"
#include "store/database/rows.h"
#include "store/details/recording_options.h"
#include "store/project/sequence_rows.h"
#include "store/runs/frame_rows.h"
#include "store/runs/run_lock.h"
#include "store/runs/run_state_store.h"

namespace eyrie {
namespace {

/// How far into the second of `started_utc` a run began; not a number where only the second is known.
double startFraction(const RunRecord& run) {
    if (!run.started_us) return std::numeric_limits<double>::quiet_NaN();
    const std::chrono::microseconds start(*run.started_us);
    return static_cast<double>((start - floor<std::chrono::seconds>(start)).count());
}

/// Fills in when a run begins, as far as nobody said it.
void tellStart(RunRecord& run) {
    if (!run.started_us && run.started_utc.empty()) run.started_us = nowUtcMicroseconds();
    if (!run.started_us) return;
    const std::chrono::microseconds start(*run.started_us);
    run.started_utc = utcTextOfSeconds(floor<std::chrono::seconds>(start).count());
}

int storeRun(SQLite::Database& database, const RunRecord& run) {
    SQLite::Statement statement(
        database,
        "INSERT INTO run (sequence_id, name, started_utc, started_fraction_us, engine_version, preset, "
        "gsd_m_per_px, gsd_known, frame_rate_hz, scale_origin, scale_uncertainty, scale_vehicles, scale_growth_right, "
        "scale_growth_down, first_frame, last_frame, state, message, rate_assumed) "
        "VALUES (?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?)");
    const ScaleBasis basis = agreeing(run.scale_basis, run.scale);
    RowWriter(statement)
        .integer(run.sequence.id)
        .text(run.name)
        .text(run.started_utc)
        .real(startFraction(run))
        .text(run.engine_version)
        .text(run.preset)
        .real(run.scale.gsd_m_per_px)
        .integer(run.scale.gsd_known)
        .real(run.scale.frame_rate_hz)
        .word(stored::kScaleOrigins, basis.origin)
        .real(basis.uncertainty.value_or(std::numeric_limits<double>::quiet_NaN()))
        .integer(basis.vehicles)
        .real(run.scale.slope.right_per_px)
        .real(run.scale.slope.down_per_px)
        .integer(run.first_frame)
        .integer(run.last_frame)
        .word(stored::kRunStates, run.state)
        .text(run.message)
        .integer(run.rate_assumed)
        .run();
    return static_cast<int>(database.getLastInsertRowid());
}

void storeParameters(SQLite::Database& database, int run_id,
                     const std::vector<std::pair<std::string, std::string>>& parameters) {
    SQLite::Statement statement(database,
                                "INSERT INTO run_parameter (run_id, position, name, value) VALUES (?, ?, ?, ?)");
    int position = 0;
    for (const auto& [name, value] : parameters) {
        RowWriter(statement).integer(run_id).integer(position++).text(name).text(value).run();
    }
}

/// That a run and its video reach to a frame, where their end was not known before.
void storeEnd(SQLite::Database& database, int run_id, FrameIndex last) {
    SQLite::Statement run(database, "UPDATE run SET last_frame = ? WHERE id = ?");
    RowWriter(run).integer(last).integer(run_id).run();
    SQLite::Statement video(
        database, "UPDATE sequence SET frame_count = ? WHERE id = (SELECT sequence_id FROM run WHERE id = ?)");
    RowWriter(video).integer(last + 1).integer(run_id).run();
}

}  // namespace

struct ResultWriter::Implementation {
    explicit Implementation(const std::filesystem::path& path)
        : project(ProjectFile::open(path)),
          rows(project.database()),
          store_time(project.database(), "UPDATE frame SET store_ms = ? WHERE run_id = ? AND frame = ?") {}

    /// Stores how long storing took last, which is only known once that is over.
    void storeTime() {
        if (!taken) return;
        RowWriter(store_time).real(static_cast<double>(taken->ms)).integer(run_id).integer(taken->frame).run();
    }

    struct Taken {
        FrameIndex frame = 0;
        float ms = 0;
    };
    ProjectFile project;
    FrameRows rows;
    SQLite::Statement store_time;
    std::optional<Taken> taken;  ///< by the last frame
    std::unique_ptr<FileLock> lock;
    int run_id = 0;
    RecordingOptions recording;
    FrameIndex first = 0, last = 0;  ///< planned
    bool has_end = true;             ///< it is known before
    FrameIndex replaced_up_to = -1;  ///< frames up to here may be stored already
};

ResultWriter::ResultWriter(const std::filesystem::path& project, RunRecord run,
                           const std::vector<std::pair<std::string, std::string>>& parameters, const MayAddRun& may_add)
    : implementation_(std::make_unique<Implementation>(project)) {
    SQLite::Database& database = implementation_->project.database();
    const std::filesystem::path& path = implementation_->project.path();
    implementation_->recording = RecordingOptions::among(parameters);
    implementation_->first = run.first_frame;
    implementation_->last = run.last_frame;
    implementation_->has_end = run.last_frame < kLastFrame;
    if (!implementation_->has_end) {  // as storeEnd() says it of no frame
        run.last_frame = run.first_frame - 1;
        run.sequence.frame_count = run.first_frame;
    }
    for (const RunRecord& earlier : RunStore(implementation_->project).runs()) {
        if (earlier.state == RunState::running) clearRunLock(path, earlier.id);
    }
    guarded(implementation_->project.path(), "adding a run", [&] {
        SQLite::Transaction transaction(database, SQLite::TransactionBehavior::IMMEDIATE);
        if (may_add) may_add(RunStore(implementation_->project));
        run.sequence.id = storeSequence(database, run.sequence);
        tellStart(run);
        implementation_->run_id = storeRun(database, run);
        // Taken before others can see the run. Where nothing can be locked the run is written all the same.
        implementation_->lock = FileLock::tryTake(runLockFile(path, implementation_->run_id)).lock;
        storeParameters(database, implementation_->run_id, parameters);
        transaction.commit();
    });
}

ResultWriter::ResultWriter(const std::filesystem::path& project, int run_id, FrameIndex last)
    : implementation_(std::make_unique<Implementation>(project)) {
    const std::filesystem::path& path = implementation_->project.path();
    FileLock::Attempt attempt = FileLock::tryTake(runLockFile(path, run_id));
    if (attempt.outcome == FileLock::Outcome::held) {
        throw Error(ErrorKind::project, "run " + std::to_string(run_id) + " of " + path.string() +
                                            " is being written by " + attempt.words + "; let it end there first");
    }
    implementation_->lock = std::move(attempt.lock);
    implementation_->run_id = run_id;
    const RunStore store(implementation_->project);
    implementation_->recording = RecordingOptions::among(store.parameters(run_id));
    if (const auto run = store.run(run_id)) {
        implementation_->first = run->first_frame;
        implementation_->last = run->last_frame;
    }
    implementation_->replaced_up_to = RunStateStore(implementation_->project).takeUp(run_id, last);
}

ResultWriter::~ResultWriter() = default;

int ResultWriter::runId() const {
    return implementation_->run_id;
}

float ResultWriter::write(const FrameResult& result) {
    const auto start = std::chrono::steady_clock::now();
    const std::string doing = "storing frame " + std::to_string(result.motion.frame);
    implementation_->project.checkInPlace();
    guarded(implementation_->project.path(), doing, [&] {
        SQLite::Transaction transaction(implementation_->project.database(), SQLite::TransactionBehavior::IMMEDIATE);
        if (result.motion.frame <= implementation_->replaced_up_to) {
            implementation_->rows.erase(implementation_->run_id, result.motion.frame);
        }
        implementation_->rows.insert(implementation_->run_id, result,
                                     implementation_->recording.keepsDetailsOf(
                                         result.motion.frame, implementation_->first, implementation_->last));
        if (!implementation_->has_end)
            storeEnd(implementation_->project.database(), implementation_->run_id, result.motion.frame);
        implementation_->storeTime();
        transaction.commit();
    });
    const std::chrono::duration<float, std::milli> passed = std::chrono::steady_clock::now() - start;
    implementation_->taken = {result.motion.frame, passed.count()};
    return passed.count();
}

void ResultWriter::keepState(FrameIndex frame, const std::string& bytes) {
    implementation_->project.checkInPlace();
    RunStateStore(implementation_->project).keep(implementation_->run_id, frame, bytes);
}

void ResultWriter::finish(RunState state, const std::string& message) {
    implementation_->project.checkInPlace();
    guarded(implementation_->project.path(), "recording how the run ended", [&] {
        SQLite::Database& database = implementation_->project.database();
        SQLite::Transaction transaction(database, SQLite::TransactionBehavior::IMMEDIATE);
        SQLite::Statement statement(database, "UPDATE run SET state = ?, message = ? WHERE id = ?");
        RowWriter(statement).word(stored::kRunStates, state).text(message).integer(implementation_->run_id).run();
        implementation_->storeTime();
        if (state == RunState::finished) {
            for (const char* table : {"run_state", "unfinished_track_state", "unfinished_frame"}) {
                SQLite::Statement rest(database, std::string("DELETE FROM ") + table + " WHERE run_id = ?");
                RowWriter(rest).integer(implementation_->run_id).run();
            }
        }
        transaction.commit();
        if (state == RunState::finished) giveBackSpace(database);
    });
}

}  // namespace eyrie
