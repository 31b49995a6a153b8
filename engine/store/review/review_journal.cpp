#include "store/review/review_journal.h"

#include <SQLiteCpp/SQLiteCpp.h>

#include "store/database/rows.h"
#include "store/review/packed_review.h"

namespace eyrie {
namespace {

// SQLite holds values of up to 1,000,000,000 bytes.
constexpr std::size_t kLargestReviewStep = 900'000'000;

/// The row that undo takes next is the newest that is done, that of redo the oldest that is undone.
const char* kNewestStepDone = "WHERE sequence_id = ? AND undone = 0 ORDER BY id DESC LIMIT 1";
const char* kOldestStepUndone = "WHERE sequence_id = ? AND undone = 1 ORDER BY id LIMIT 1";

std::optional<ReviewEdit> readStep(ProjectFile& project, int sequence_id, const char* which, const ReviewSet& set,
                                   bool done) {
    return guarded(project.path(), "reading a step of the review", [&]() -> std::optional<ReviewEdit> {
        SQLite::Statement statement(project.database(), std::string("SELECT name, data FROM review_step ") + which);
        statement.bind(1, sequence_id);
        if (!statement.executeStep()) return std::nullopt;
        RowReader row(statement);
        std::string name = row.text();
        auto edit = unpackReview(row.bytes());
        if (!edit) throw MalformedRow{"the step \"" + name + "\" is broken"};
        try {
            checkEdit(set, done ? inverseOf(*edit) : *edit);
        } catch (const Error&) {
            throw MalformedRow{"the step \"" + name + "\" does not fit the review"};
        }
        edit->name = std::move(name);
        return edit;
    });
}

void markStep(ProjectFile& project, int sequence_id, const char* which, bool undone) {
    guarded(project.path(), "marking a step of the review", [&] {
        SQLite::Statement statement(project.database(), std::string("UPDATE review_step SET undone = ? WHERE id = "
                                                                    "(SELECT id FROM review_step ") +
                                                            which + ")");
        RowWriter(statement).integer(undone).integer(sequence_id).run();
    });
}

std::string nameOfReviewStep(ProjectFile& project, int sequence_id, const char* which) {
    return guarded(project.path(), "reading a step of the review", [&] {
        SQLite::Statement statement(project.database(), std::string("SELECT name FROM review_step ") + which);
        statement.bind(1, sequence_id);
        return statement.executeStep() ? RowReader(statement).text() : std::string();
    });
}

int countOfSteps(ProjectFile& project, int sequence_id, bool undone) {
    return guarded(project.path(), "counting the steps of the review", [&] {
        SQLite::Statement statement(project.database(),
                                    "SELECT count(*) FROM review_step WHERE sequence_id = ? AND undone = ?");
        statement.bind(1, sequence_id);
        statement.bind(2, undone ? 1 : 0);
        statement.executeStep();
        return statement.getColumn(0).getInt();
    });
}

}  // namespace

void ReviewJournal::add(const ReviewEdit& edit, const std::string& when_utc) {
    const Bytes data = packReview(edit);
    if (data.size() > kLargestReviewStep) {
        throw Error(ErrorKind::output,
                    "\"" + edit.name + "\" changes more than can be undone in one step; do it in parts");
    }
    guarded(project_.path(), "storing a step of the review", [&] {
        SQLite::Database& database = project_.database();
        SQLite::Statement forget(database, "DELETE FROM review_step WHERE sequence_id = ? AND undone = 1");
        RowWriter(forget).integer(sequence_id_).run();
        SQLite::Statement add(
            database, "INSERT INTO review_step (sequence_id, name, made_utc, undone, data) VALUES (?, ?, ?, 0, ?)");
        RowWriter(add).integer(sequence_id_).text(edit.name).text(when_utc).bytes(data).run();
        SQLite::Statement trim(
            database,
            "DELETE FROM review_step WHERE sequence_id = ?1 AND undone = 0 AND id <= (SELECT id FROM "
            "review_step WHERE sequence_id = ?1 AND undone = 0 ORDER BY id DESC LIMIT 1 OFFSET ?2)");
        RowWriter(trim).integer(sequence_id_).integer(kReviewSteps).run();
    });
}

std::optional<ReviewEdit> ReviewJournal::lastDone(const ReviewSet& set) const {
    return readStep(project_, sequence_id_, kNewestStepDone, set, true);
}

std::optional<ReviewEdit> ReviewJournal::firstUndone(const ReviewSet& set) const {
    return readStep(project_, sequence_id_, kOldestStepUndone, set, false);
}

void ReviewJournal::markUndone() {
    markStep(project_, sequence_id_, kNewestStepDone, true);
}

void ReviewJournal::markDone() {
    markStep(project_, sequence_id_, kOldestStepUndone, false);
}

int ReviewJournal::doneCount() const {
    return countOfSteps(project_, sequence_id_, false);
}

int ReviewJournal::undoneCount() const {
    return countOfSteps(project_, sequence_id_, true);
}

std::string ReviewJournal::lastDoneName() const {
    return nameOfReviewStep(project_, sequence_id_, kNewestStepDone);
}

std::string ReviewJournal::firstUndoneName() const {
    return nameOfReviewStep(project_, sequence_id_, kOldestStepUndone);
}

}  // namespace eyrie
