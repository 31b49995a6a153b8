#pragma once

#include <SQLiteCpp/SQLiteCpp.h>

#include <algorithm>
#include <utility>

#include "core/time/utc_time.h"
#include "store/database/rows.h"
#include "store/journal/journalled_store.h"

/// The bodies of JournalledStore; only who instantiates it includes this.
namespace eyrie {

template <class Content>
JournalledStore<Content>::JournalledStore(ProjectFile& project, int sequence_id)
    : project_(project), sequence_id_(sequence_id), journal_(project, sequence_id, Content::kSteps) {
    if (!tryToWrite()) take(read(project_, sequence_id_));
}

template <class Content>
bool JournalledStore<Content>::tryToWrite() {
    if (lock_) return true;
    if (project_.mode() == ProjectFile::Mode::read_only) {
        read_only_reason_ =
            std::string(WriterLock::readOnlyWords(Content::kWork)) + ": the project is open for reading only";
        return false;
    }
    auto lock = WriterLock::tryTake(project_.path(), read_only_reason_, Content::kWork);
    if (!lock) return false;
    if (storedChanges(project_) != changes_) take(read(project_, sequence_id_));
    lock_ = std::move(lock);
    read_only_reason_.clear();
    return true;
}

template <class Content>
auto JournalledStore<Content>::read(ProjectFile& project, int sequence_id) -> Reading {
    Reading reading;
    reading.numbers = std::vector<NumberCounter>(Content::kNumbers.begin(), Content::kNumbers.end());
    const StepJournal journal(project, sequence_id, Content::kSteps);
    guarded(project.path(), Content::kReading, [&] {
        SQLite::Database& database = project.database();
        SQLite::Transaction moment(database);
        reading.set = Content::read(database, sequence_id);
        reading.changes = readCounter(database, Content::kChanges);
        for (NumberCounter& number : reading.numbers) number.read(database);
        reading.undo_count = journal.doneCount();
        reading.redo_count = journal.undoneCount();
    });
    return reading;
}

template <class Content>
std::int64_t JournalledStore<Content>::storedChanges(ProjectFile& project) {
    return guarded(project.path(), Content::kReading,
                   [&] { return readCounter(project.database(), Content::kChanges); });
}

template <class Content>
auto JournalledStore<Content>::readIfChanged(ProjectFile& project, int sequence_id, std::int64_t known)
    -> std::optional<Reading> {
    if (storedChanges(project) == known) return std::nullopt;
    return read(project, sequence_id);
}

template <class Content>
void JournalledStore<Content>::take(Reading reading) {
    set_ = std::move(reading.set);
    numbers_ = std::move(reading.numbers);
    changes_ = reading.changes;
    undo_count_ = reading.undo_count;
    redo_count_ = reading.redo_count;
    ++version_;
}

template <class Content>
bool JournalledStore<Content>::follow(Reading reading) {
    if (lock_ || reading.changes == changes_) return false;
    take(std::move(reading));
    return true;
}

template <class Content>
void JournalledStore<Content>::refuseReadOnly() const {
    if (!lock_) throw Error(ErrorKind::output, read_only_reason_);
}

template <class Content>
void JournalledStore<Content>::apply(const Edit& edit) {
    refuseReadOnly();
    if (edit.empty()) return;
    Edit real = edit;
    Content::ground(real, set_);
    commit(real, Step::edit);
    undo_count_ = std::min(undo_count_ + 1, kStepsKept);
    redo_count_ = 0;
}

template <class Content>
auto JournalledStore<Content>::unpacked(const StoredStep& step, bool done) const -> Edit {
    auto edit = guarded(project_.path(), std::string("reading a step of ") + Content::kSteps.work,
                        [&] { return Content::unpack(step.data, set_, done); });
    if (!edit) {
        throw damagedProject(project_.path(), std::string("the step \"") + step.name + "\" of " + Content::kSteps.work +
                                                  " is broken or does not fit what is there");
    }
    edit->name = step.name;
    return std::move(*edit);
}

template <class Content>
auto JournalledStore<Content>::undo() -> std::optional<Edit> {
    refuseReadOnly();
    const auto step = journal_.lastDone();
    if (!step) return std::nullopt;
    Edit edit = unpacked(*step, true);
    commit(inverseOf(edit), Step::undo);
    --undo_count_;
    ++redo_count_;
    return edit;
}

template <class Content>
auto JournalledStore<Content>::redo() -> std::optional<Edit> {
    refuseReadOnly();
    const auto step = journal_.firstUndone();
    if (!step) return std::nullopt;
    Edit edit = unpacked(*step, false);
    commit(edit, Step::redo);
    ++undo_count_;
    --redo_count_;
    return edit;
}

template <class Content>
void JournalledStore<Content>::commit(const Edit& edit, Step step) {
    project_.checkInPlace();
    applyEdit(set_, edit);
    const auto ids = Content::ids(edit);
    for (std::size_t table = 0; table < ids.size(); ++table) {
        for (const int id : ids[table]) numbers_[table].follow(id);
    }
    try {
        guarded(project_.path(), "storing \"" + edit.name + "\"", [&] {
            SQLite::Database& database = project_.database();
            SQLite::Transaction transaction(database, SQLite::TransactionBehavior::IMMEDIATE);
            Content::write(database, sequence_id_, edit, set_);
            if (step == Step::edit) journal_.add({edit.name, Content::pack(edit)}, nowUtc());
            if (step == Step::undo) journal_.markUndone();
            if (step == Step::redo) journal_.markDone();
            for (const NumberCounter& number : numbers_) number.store(database);
            raiseCounter(database, Content::kChanges, changes_ + 1);
            transaction.commit();
        });
    } catch (...) {
        applyEdit(set_, inverseOf(edit));
        throw;
    }
    ++changes_;
    ++version_;
}

}  // namespace eyrie
