#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/labels/change.h"
#include "store/journal/number_counter.h"
#include "store/journal/step_journal.h"
#include "store/journal/writer_lock.h"
#include "store/project/project_file.h"

namespace eyrie {

/// Work of people on one video: all in memory, every edit one committed transaction together with its step in the
/// journal, so that a killed process loses nothing that was applied and undo goes on after a restart. One window works
/// on a project at a time; others read. Used by one thread.
///
/// `Content` says what the work is on, and has
///   Set, Edit               the values, with applyEdit(Set&, Edit) and inverseOf(Edit); Edit has a name and empty()
///   kWork, kReading         whose right it is; "reading the labels", for messages
///   kSteps, kNumbers        the table of steps; the tables whose numbers newId() hands out
///   kChanges                the counter that grows with every edit
///   read, write             all rows of a video; what an edit makes of them
///   pack, unpack            a step as bytes; nothing for bytes that are broken or do not fit a set in which the step
///                           is done, or not done
///   ground                  puts what is really there into an edit as its `before`
///   ids                     the ids that an edit gives rows of each table of kNumbers
/// The functions with a database throw SQLite::Exception or MalformedRow.
template <class Content>
class JournalledStore {
 public:
    using Set = typename Content::Set;
    using Edit = typename Content::Edit;

    /// Reads what is there and takes the right to change it, if nobody has it. `project` must outlive the store; opened
    /// read_only, so is the store. Throws Error(project).
    JournalledStore(ProjectFile& project, int sequence_id);
    JournalledStore(const JournalledStore&) = delete;
    JournalledStore& operator=(const JournalledStore&) = delete;

    /// Grows with every change of the content, for caches.
    std::uint64_t version() const { return version_; }

    bool readOnly() const { return lock_ == nullptr; }
    /// Why, for people; empty when not.
    const std::string& readOnlyReason() const { return read_only_reason_; }
    /// Tries again to take the right; what another window has changed since it was read is read anew. Answers whether
    /// it may write now.
    bool tryToWrite();

    /// What is stored of a video at one moment.
    struct Reading {
        Set set;
        std::vector<NumberCounter> numbers;
        std::int64_t changes = 0;  ///< counter kChanges
        int undo_count = 0;
        int redo_count = 0;
    };
    /// For readers, who follow what another window changes: what is there now, nothing where it is what changes() knows
    /// already. On any thread, with a connection of its own. Throws Error(project).
    static std::optional<Reading> readIfChanged(ProjectFile& project, int sequence_id, std::int64_t known);
    /// Counter of the changes that are known.
    std::int64_t changes() const { return changes_; }
    /// Takes over what readIfChanged() answered. False, and nothing is done, where it is known by now or this store may
    /// write.
    bool follow(Reading reading);

    /// Carries the edit out and commits it. An empty edit is nothing. Throws Error(output) when read-only, what
    /// applyEdit() throws when the edit does not fit, Error(project | output) when it cannot be written: then nothing
    /// is changed, neither in the file nor in memory.
    void apply(const Edit& edit);
    /// Takes back the last step, or brings back the one undone last. Answers it (as it was done), for the selection;
    /// nothing when there is none.
    std::optional<Edit> undo();
    std::optional<Edit> redo();
    bool canUndo() const { return undo_count_ > 0; }
    bool canRedo() const { return redo_count_ > 0; }
    int undoCount() const { return undo_count_; }
    int redoCount() const { return redo_count_; }
    std::string undoName() const { return journal_.lastDoneName(); }  ///< empty when there is none
    std::string redoName() const { return journal_.firstUndoneName(); }

 protected:
    ~JournalledStore() = default;

    const Set& content() const { return set_; }
    /// A new id for a row of kNumbers[table], never used before in the project. Kept when the first edit with it is
    /// applied.
    template <class Value>
    int newId(std::size_t table, const std::map<int, Value>& present) {
        int id = numbers_[table].take();
        while (present.contains(id)) id = numbers_[table].take();  // never where the counter is sound
        return id;
    }
    /// The first id that is free, not handed out.
    int nextId(std::size_t table) const { return numbers_[table].next(); }

 private:
    enum class Step { edit, undo, redo };
    static Reading read(ProjectFile& project, int sequence_id);
    static std::int64_t storedChanges(ProjectFile& project);
    void take(Reading reading);
    Edit unpacked(const StoredStep& step, bool done) const;
    void commit(const Edit& edit, Step step);
    void refuseReadOnly() const;

    ProjectFile& project_;
    int sequence_id_;
    std::unique_ptr<WriterLock> lock_;
    std::string read_only_reason_;
    Set set_;
    StepJournal journal_;
    std::vector<NumberCounter> numbers_;
    std::uint64_t version_ = 0;
    std::int64_t changes_ = -1;  ///< counter kChanges when read or written last; −1: nothing was
    int undo_count_ = 0;
    int redo_count_ = 0;
};

/// For Content::ground(): what is really there as the `before` of each change, whatever its maker believed.
template <class Value>
void groundChanges(std::vector<Change<Value>>& changes, const std::map<int, Value>& present) {
    for (auto& change : changes) {
        if (!change.before) continue;
        const auto there = present.find(change.before->id);
        if (there != present.end()) change.before = there->second;
    }
}

/// For Content::ids().
template <class Value>
std::vector<int> idsAfter(const std::vector<Change<Value>>& changes) {
    std::vector<int> ids;
    for (const auto& change : changes) {
        if (change.after) ids.push_back(change.after->id);
    }
    return ids;
}

}  // namespace eyrie
