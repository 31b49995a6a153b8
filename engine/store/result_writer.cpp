#include "store/result_writer.h"

#include <SQLiteCpp/SQLiteCpp.h>

#include "store/frame_rows.h"
#include "store/rows.h"
#include "store/run_lock.h"
#include "store/sequence_rows.h"

namespace eyrie {
namespace {

int storeRun(SQLite::Database& database, const RunRecord& run) {
    SQLite::Statement statement(
        database,
        "INSERT INTO run (sequence_id, name, started_utc, engine_version, preset, gsd_m_per_px, gsd_known, "
        "frame_rate_hz, first_frame, last_frame, state, message) VALUES (?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?)");
    RowWriter(statement)
        .integer(run.sequence.id)
        .text(run.name)
        .text(run.started_utc)
        .text(run.engine_version)
        .text(run.preset)
        .real(run.scale.gsd_m_per_px)
        .integer(run.scale.gsd_known)
        .real(run.scale.frame_rate_hz)
        .integer(run.first_frame)
        .integer(run.last_frame)
        .word(stored::kRunStates, run.state)
        .text(run.message)
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

}  // namespace

struct ResultWriter::Implementation {
    explicit Implementation(const std::filesystem::path& path)
        : project(ProjectFile::open(path)), rows(project.database()) {}

    ProjectFile project;
    FrameRows rows;
    std::unique_ptr<FileLock> lock;
    int run_id = 0;
};

ResultWriter::ResultWriter(const std::filesystem::path& project, RunRecord run,
                           const std::vector<std::pair<std::string, std::string>>& parameters)
    : implementation_(std::make_unique<Implementation>(project)) {
    SQLite::Database& database = implementation_->project.database();
    const std::filesystem::path& path = implementation_->project.path();
    for (const RunRecord& earlier : RunStore(implementation_->project).runs()) {
        if (earlier.state == RunState::running) clearRunLock(path, earlier.id);
    }
    guarded(implementation_->project.path(), "adding a run", [&] {
        SQLite::Transaction transaction(database, SQLite::TransactionBehavior::IMMEDIATE);
        run.sequence.id = storeSequence(database, run.sequence);
        if (run.started_utc.empty()) run.started_utc = nowUtc();
        implementation_->run_id = storeRun(database, run);
        // Taken before others can see the run. Where nothing can be locked the run is written all the same.
        implementation_->lock = FileLock::tryTake(runLockFile(path, implementation_->run_id)).lock;
        storeParameters(database, implementation_->run_id, parameters);
        transaction.commit();
    });
}

ResultWriter::~ResultWriter() = default;

int ResultWriter::runId() const {
    return implementation_->run_id;
}

void ResultWriter::write(const FrameResult& result) {
    const std::string doing = "storing frame " + std::to_string(result.motion.frame);
    implementation_->project.checkInPlace();
    guarded(implementation_->project.path(), doing, [&] {
        SQLite::Transaction transaction(implementation_->project.database(), SQLite::TransactionBehavior::IMMEDIATE);
        implementation_->rows.insert(implementation_->run_id, result);
        transaction.commit();
    });
}

void ResultWriter::finish(RunState state, const std::string& message) {
    implementation_->project.checkInPlace();
    guarded(implementation_->project.path(), "recording how the run ended", [&] {
        SQLite::Statement statement(implementation_->project.database(),
                                    "UPDATE run SET state = ?, message = ? WHERE id = ?");
        RowWriter(statement).word(stored::kRunStates, state).text(message).integer(implementation_->run_id).run();
    });
}

}  // namespace eyrie
