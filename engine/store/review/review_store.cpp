#include "store/review/review_store.h"

#include <SQLiteCpp/SQLiteCpp.h>

#include <algorithm>
#include <limits>

#include "core/utc_time.h"
#include "store/database/rows.h"
#include "store/labels/label_rows.h"
#include "store/review/review_rows.h"

namespace eyrie {
namespace {

// Counters of the project.
constexpr char kVerdictCounter[] = "verdict";    // the next number
constexpr char kBookmarkCounter[] = "bookmark";  // the next number
constexpr char kReviewChanges[] = "review";      // how often anything was changed

/// The edit with what is really there as its `before`, whatever its maker believed.
template <class Value>
void ground(std::vector<Change<Value>>& changes, const std::map<int, Value>& present) {
    for (auto& change : changes) {
        if (!change.before) continue;
        const auto there = present.find(change.before->id);
        if (there != present.end()) change.before = there->second;
    }
}

}  // namespace

ReviewSet readReview(ProjectFile& project, int sequence_id) {
    return guarded(project.path(), "reading the verdicts", [&] {
        SQLite::Transaction moment(project.database());
        return readReviewRows(project.database(), sequence_id);
    });
}

ReviewStore::ReviewStore(ProjectFile& project, int sequence_id)
    : project_(project), sequence_id_(sequence_id), journal_(project, sequence_id) {
    if (!tryToWrite()) load();
}

ReviewStore::~ReviewStore() = default;

bool ReviewStore::tryToWrite() {
    if (lock_) return true;
    if (project_.mode() == ProjectFile::Mode::read_only) {
        read_only_reason_ = "verdicts and bookmarks are read-only: the project is open for reading only";
        return false;
    }
    auto lock = WriterLock::tryTake(project_.path(), read_only_reason_, WriterLock::Work::review);
    if (!lock) return false;
    load();
    lock_ = std::move(lock);
    read_only_reason_.clear();
    return true;
}

void ReviewStore::load() {
    guarded(project_.path(), "reading the verdicts", [&] {
        SQLite::Database& database = project_.database();
        SQLite::Transaction moment(database);
        set_ = readReviewRows(database, sequence_id_);
        changes_ = readCounter(database, kReviewChanges);
        // Numbers are those of the whole project, and the counter may be damaged.
        const auto behind = [&](const char* table) {
            constexpr std::int64_t kLastStart = std::numeric_limits<int>::max() - 1'000;
            const std::int64_t most =
                database.execAndGet("SELECT coalesce(max(id), 0) FROM " + std::string(table)).getInt64();
            return static_cast<int>(std::clamp<std::int64_t>(most + 1, 1, kLastStart));
        };
        next_verdict_ = std::max(readNextNumber(database, kVerdictCounter), behind("verdict"));
        next_bookmark_ = std::max(readNextNumber(database, kBookmarkCounter), behind("bookmark"));
        undo_count_ = journal_.doneCount();
        redo_count_ = journal_.undoneCount();
    });
    ++version_;
}

bool ReviewStore::refresh() {
    if (lock_) return false;
    const auto changes = guarded(project_.path(), "reading the verdicts",
                                 [&] { return readCounter(project_.database(), kReviewChanges); });
    if (changes == changes_) return false;
    load();
    return true;
}

void ReviewStore::refuseReadOnly() const {
    if (!lock_) throw Error(ErrorKind::output, read_only_reason_);
}

void ReviewStore::apply(const ReviewEdit& edit) {
    refuseReadOnly();
    if (edit.empty()) return;
    ReviewEdit real = edit;
    ground(real.verdicts, set_.verdicts);
    ground(real.bookmarks, set_.bookmarks);
    commit(real, Step::edit);
    undo_count_ = std::min(undo_count_ + 1, kReviewSteps);
    redo_count_ = 0;
}

std::optional<ReviewEdit> ReviewStore::undo() {
    refuseReadOnly();
    auto edit = journal_.lastDone(set_);
    if (!edit) return std::nullopt;
    commit(inverseOf(*edit), Step::undo);
    --undo_count_;
    ++redo_count_;
    return edit;
}

std::optional<ReviewEdit> ReviewStore::redo() {
    refuseReadOnly();
    auto edit = journal_.firstUndone(set_);
    if (!edit) return std::nullopt;
    commit(*edit, Step::redo);
    ++undo_count_;
    --redo_count_;
    return edit;
}

void ReviewStore::commit(const ReviewEdit& edit, Step step) {
    project_.checkInPlace();
    applyEdit(set_, edit);
    for (const auto& change : edit.verdicts) {
        if (change.after) next_verdict_ = std::max(next_verdict_, change.after->id + 1);
    }
    for (const auto& change : edit.bookmarks) {
        if (change.after) next_bookmark_ = std::max(next_bookmark_, change.after->id + 1);
    }
    try {
        guarded(project_.path(), "storing \"" + edit.name + "\"", [&] {
            SQLite::Database& database = project_.database();
            SQLite::Transaction transaction(database, SQLite::TransactionBehavior::IMMEDIATE);
            writeReviewRows(database, sequence_id_, edit);
            if (step == Step::edit) journal_.add(edit, nowUtc());
            if (step == Step::undo) journal_.markUndone();
            if (step == Step::redo) journal_.markDone();
            raiseCounter(database, kVerdictCounter, next_verdict_);
            raiseCounter(database, kBookmarkCounter, next_bookmark_);
            raiseCounter(database, kReviewChanges, changes_ + 1);
            transaction.commit();
        });
    } catch (...) {
        applyEdit(set_, inverseOf(edit));
        throw;
    }
    ++changes_;
    ++version_;
}

std::string ReviewStore::undoName() const {
    return journal_.lastDoneName();
}

std::string ReviewStore::redoName() const {
    return journal_.firstUndoneName();
}

}  // namespace eyrie
