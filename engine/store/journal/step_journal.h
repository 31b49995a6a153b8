#pragma once

#include <cstddef>
#include <optional>
#include <string>

#include "store/project/project_file.h"
#include "store/runs/packed_arrays.h"

namespace eyrie {

/// Steps kept for undo per video and kind of work; older ones are dropped.
inline constexpr int kStepsKept = 1000;

/// Bytes of a step; a row of a project holds no more.
inline constexpr std::size_t kLargestStep = ProjectFile::kLongestRow - 1'000'000;  // what else stands in its row

/// A kind of work whose steps are kept: its table, with columns id, sequence_id, name, made_utc, undone and data.
struct StepTable {
    const char* name;  ///< "edit_journal"
    const char* work;  ///< for messages: "work on the labels"
};

/// A step as it was done.
struct StoredStep {
    std::string name;  ///< "Move box of car 12"
    Bytes data;
};

/// The steps of one kind of work on a video, kept in the project for undo and redo over restarts; what is in their
/// bytes is up to the work. Every function runs inside the caller's transaction and throws Error(project | output).
class StepJournal {
 public:
    /// `project` must outlive the journal.
    StepJournal(ProjectFile& project, int sequence_id, StepTable table)
        : project_(project), sequence_id_(sequence_id), table_(table) {}

    /// Adds a step; those that were undone are dropped, and the oldest beyond kStepsKept. Throws Error(output) for one
    /// that is larger than a project can hold.
    void add(const StoredStep& step, const std::string& when_utc);
    /// The step that undo takes back next, and the one that redo brings back; nothing when there is none.
    std::optional<StoredStep> lastDone() const;
    std::optional<StoredStep> firstUndone() const;
    /// Marks them as undone, or done again.
    void markUndone();
    void markDone();

    int doneCount() const;
    int undoneCount() const;
    /// Names for the menu; empty when there is none.
    std::string lastDoneName() const;
    std::string firstUndoneName() const;

 private:
    std::string select(const char* columns, bool done) const;
    std::optional<StoredStep> step(bool done) const;
    std::string name(bool done) const;
    void mark(bool done);
    int count(bool done) const;
    std::string doing(const char* what) const;

    ProjectFile& project_;
    int sequence_id_;
    StepTable table_;
};

}  // namespace eyrie
