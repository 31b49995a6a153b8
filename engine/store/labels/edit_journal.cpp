#include "store/labels/edit_journal.h"

#include <SQLiteCpp/SQLiteCpp.h>

#include "store/database/rows.h"
#include "store/labels/packed_labels.h"

namespace eyrie {
namespace {

// SQLite holds values of up to 1,000,000,000 bytes.
constexpr std::size_t kLargestStep = 900'000'000;

/// The row that undo takes next is the newest that is done, that of redo the oldest that is undone.
const char* kNewestDone = "WHERE sequence_id = ? AND undone = 0 ORDER BY id DESC LIMIT 1";
const char* kOldestUndone = "WHERE sequence_id = ? AND undone = 1 ORDER BY id LIMIT 1";

std::optional<AnnotationEdit> readEdit(ProjectFile& project, int sequence_id, const char* which,
                                       const AnnotationSet& set, bool done) {
    return guarded(project.path(), "reading a step of work on the labels", [&]() -> std::optional<AnnotationEdit> {
        SQLite::Statement statement(project.database(), std::string("SELECT name, data FROM edit_journal ") + which);
        statement.bind(1, sequence_id);
        if (!statement.executeStep()) return std::nullopt;
        RowReader row(statement);
        std::string name = row.text();
        auto edit = unpackEdit(row.bytes(), set, done);
        if (!edit) throw MalformedRow{"the step \"" + name + "\" is broken or does not fit the labels"};
        edit->name = std::move(name);
        return edit;
    });
}

void mark(ProjectFile& project, int sequence_id, const char* which, bool undone) {
    guarded(project.path(), "marking a step of work on the labels", [&] {
        SQLite::Statement statement(project.database(), std::string("UPDATE edit_journal SET undone = ? WHERE id = "
                                                                    "(SELECT id FROM edit_journal ") +
                                                            which + ")");
        RowWriter(statement).integer(undone).integer(sequence_id).run();
    });
}

std::string nameOfStep(ProjectFile& project, int sequence_id, const char* which) {
    return guarded(project.path(), "reading a step of work on the labels", [&] {
        SQLite::Statement statement(project.database(), std::string("SELECT name FROM edit_journal ") + which);
        statement.bind(1, sequence_id);
        return statement.executeStep() ? RowReader(statement).text() : std::string();
    });
}

int countOf(ProjectFile& project, int sequence_id, bool undone) {
    return guarded(project.path(), "counting the steps of work on the labels", [&] {
        SQLite::Statement statement(project.database(),
                                    "SELECT count(*) FROM edit_journal WHERE sequence_id = ? AND undone = ?");
        statement.bind(1, sequence_id);
        statement.bind(2, undone ? 1 : 0);
        statement.executeStep();
        return statement.getColumn(0).getInt();
    });
}

}  // namespace

void EditJournal::add(const AnnotationEdit& edit, const std::string& when_utc) {
    const Bytes data = packEdit(edit);
    if (data.size() > kLargestStep) {
        throw Error(ErrorKind::output, "\"" + edit.name +
                                           "\" changes more than can be undone in one step; do it in parts, for "
                                           "instance object by object");
    }
    guarded(project_.path(), "storing a step of work on the labels", [&] {
        SQLite::Database& database = project_.database();
        SQLite::Statement forget(database, "DELETE FROM edit_journal WHERE sequence_id = ? AND undone = 1");
        RowWriter(forget).integer(sequence_id_).run();
        SQLite::Statement add(
            database, "INSERT INTO edit_journal (sequence_id, name, made_utc, undone, data) VALUES (?, ?, ?, 0, ?)");
        RowWriter(add).integer(sequence_id_).text(edit.name).text(when_utc).bytes(data).run();
        SQLite::Statement trim(
            database,
            "DELETE FROM edit_journal WHERE sequence_id = ?1 AND undone = 0 AND id <= (SELECT id FROM "
            "edit_journal WHERE sequence_id = ?1 AND undone = 0 ORDER BY id DESC LIMIT 1 OFFSET ?2)");
        RowWriter(trim).integer(sequence_id_).integer(kJournalSteps).run();
    });
}

std::optional<AnnotationEdit> EditJournal::lastDone(const AnnotationSet& set) const {
    return readEdit(project_, sequence_id_, kNewestDone, set, true);
}

std::optional<AnnotationEdit> EditJournal::firstUndone(const AnnotationSet& set) const {
    return readEdit(project_, sequence_id_, kOldestUndone, set, false);
}

void EditJournal::markUndone() {
    mark(project_, sequence_id_, kNewestDone, true);
}

void EditJournal::markDone() {
    mark(project_, sequence_id_, kOldestUndone, false);
}

int EditJournal::doneCount() const {
    return countOf(project_, sequence_id_, false);
}

int EditJournal::undoneCount() const {
    return countOf(project_, sequence_id_, true);
}

std::string EditJournal::lastDoneName() const {
    return nameOfStep(project_, sequence_id_, kNewestDone);
}

std::string EditJournal::firstUndoneName() const {
    return nameOfStep(project_, sequence_id_, kOldestUndone);
}

}  // namespace eyrie
