#include "store/journal/step_journal.h"

#include <SQLiteCpp/SQLiteCpp.h>

#include "store/database/rows.h"

namespace eyrie {
/// The row that undo takes next is the newest that is done, that of redo the oldest that is undone.
std::string StepJournal::select(const char* columns, bool done) const {
    return std::string("SELECT ") + columns + " FROM " + table_.name + " WHERE sequence_id = ? AND " +
           (done ? "undone = 0 ORDER BY id DESC" : "undone = 1 ORDER BY id") + " LIMIT 1";
}

std::string StepJournal::doing(const char* what) const {
    return std::string(what) + " a step of " + table_.work;
}

void StepJournal::add(const StoredStep& step, const std::string& when_utc) {
    if (step.data.size() > kLargestStep) {
        throw Error(ErrorKind::output,
                    "\"" + step.name + "\" changes more than can be undone in one step; do it in parts");
    }
    guarded(project_.path(), doing("storing"), [&] {
        SQLite::Database& database = project_.database();
        const std::string table = table_.name;
        SQLite::Statement forget(database, "DELETE FROM " + table + " WHERE sequence_id = ? AND undone = 1");
        RowWriter(forget).integer(sequence_id_).run();
        SQLite::Statement add(
            database, "INSERT INTO " + table + " (sequence_id, name, made_utc, undone, data) VALUES (?, ?, ?, 0, ?)");
        RowWriter(add).integer(sequence_id_).text(step.name).text(when_utc).bytes(step.data).run();
        SQLite::Statement trim(database, "DELETE FROM " + table +
                                             " WHERE sequence_id = ?1 AND undone = 0 AND id <= (SELECT id FROM " +
                                             table +
                                             " WHERE sequence_id = ?1 AND undone = 0 ORDER BY id DESC LIMIT 1 "
                                             "OFFSET ?2)");
        RowWriter(trim).integer(sequence_id_).integer(kStepsKept).run();
    });
}

std::optional<StoredStep> StepJournal::step(bool done) const {
    return guarded(project_.path(), doing("reading"), [&]() -> std::optional<StoredStep> {
        SQLite::Statement statement(project_.database(), select("name, data", done));
        statement.bind(1, sequence_id_);
        if (!statement.executeStep()) return std::nullopt;
        RowReader row(statement);
        StoredStep step;
        step.name = row.text();
        const ByteView data = row.bytes();
        step.data.assign(data.begin(), data.end());
        return step;
    });
}

void StepJournal::mark(bool done) {
    guarded(project_.path(), doing("marking"), [&] {
        SQLite::Statement statement(
            project_.database(),
            std::string("UPDATE ") + table_.name + " SET undone = ? WHERE id = (" + select("id", !done) + ")");
        RowWriter(statement).integer(done ? 0 : 1).integer(sequence_id_).run();
    });
}

std::string StepJournal::name(bool done) const {
    return guarded(project_.path(), doing("reading"), [&] {
        SQLite::Statement statement(project_.database(), select("name", done));
        statement.bind(1, sequence_id_);
        return statement.executeStep() ? RowReader(statement).text() : std::string();
    });
}

int StepJournal::count(bool done) const {
    return guarded(project_.path(), std::string("counting the steps of ") + table_.work, [&] {
        SQLite::Statement statement(project_.database(), std::string("SELECT count(*) FROM ") + table_.name +
                                                             " WHERE sequence_id = ? AND undone = ?");
        statement.bind(1, sequence_id_);
        statement.bind(2, done ? 0 : 1);
        statement.executeStep();
        return statement.getColumn(0).getInt();
    });
}

std::optional<StoredStep> StepJournal::lastDone() const {
    return step(true);
}

std::optional<StoredStep> StepJournal::firstUndone() const {
    return step(false);
}

void StepJournal::markUndone() {
    mark(false);
}

void StepJournal::markDone() {
    mark(true);
}

int StepJournal::doneCount() const {
    return count(true);
}

int StepJournal::undoneCount() const {
    return count(false);
}

std::string StepJournal::lastDoneName() const {
    return name(true);
}

std::string StepJournal::firstUndoneName() const {
    return name(false);
}

}  // namespace eyrie
