#pragma once

#include <memory>
#include <optional>
#include <string>

#include "core/review/review_edit.h"
#include "store/labels/writer_lock.h"
#include "store/project/project_file.h"
#include "store/review/review_journal.h"

namespace eyrie {

/// What was said about a video, read once, by anybody (command line, reports). Throws Error(project) for damaged rows.
ReviewSet readReview(ProjectFile& project, int sequence_id);

/// Verdicts and bookmarks of one video: all in memory, every edit one committed transaction together with its step in
/// the journal, so that a killed process loses nothing that was judged and undo goes on after a restart. One window
/// judges in a project at a time; others read. Used by one thread.
class ReviewStore {
 public:
    /// Reads what is there and takes the right to judge, if nobody has it. `project` must outlive the store; opened
    /// read_only, so is the review. Throws Error(project).
    ReviewStore(ProjectFile& project, int sequence_id);
    ~ReviewStore();
    ReviewStore(const ReviewStore&) = delete;
    ReviewStore& operator=(const ReviewStore&) = delete;

    const ReviewSet& review() const { return set_; }
    int sequenceId() const { return sequence_id_; }
    /// Grows with every change of review(), for caches.
    std::uint64_t version() const { return version_; }

    bool readOnly() const { return lock_ == nullptr; }
    /// Why, for people; empty when not.
    const std::string& readOnlyReason() const { return read_only_reason_; }
    /// Tries again to take the right to judge; the review is read anew. Answers whether it may write now.
    bool tryToWrite();
    /// Reads again what another window has changed meanwhile; answers whether anything had. For readers.
    bool refresh();

    /// A new id, never used before in the project. Kept when the first edit with it is applied.
    int newVerdictId() { return next_verdict_++; }
    int newBookmarkId() { return next_bookmark_++; }

    /// Carries the edit out and commits it. An empty edit is nothing. Throws Error(output) when read-only,
    /// Error(internal | parameter) as applyEdit(), Error(project | output) when it cannot be written: then nothing is
    /// changed, neither in the file nor in memory.
    void apply(const ReviewEdit& edit);
    /// Takes back the last step, or brings back the one undone last. Answers it (as it was done), for the selection;
    /// nothing when there is none.
    std::optional<ReviewEdit> undo();
    std::optional<ReviewEdit> redo();
    bool canUndo() const { return undo_count_ > 0; }
    bool canRedo() const { return redo_count_ > 0; }
    int undoCount() const { return undo_count_; }
    int redoCount() const { return redo_count_; }
    std::string undoName() const;  ///< "Judge 12 events not relevant"; empty when there is none
    std::string redoName() const;

 private:
    enum class Step { edit, undo, redo };
    void load();
    void commit(const ReviewEdit& edit, Step step);
    void refuseReadOnly() const;

    ProjectFile& project_;
    int sequence_id_;
    std::unique_ptr<WriterLock> lock_;
    std::string read_only_reason_;
    ReviewSet set_;
    ReviewJournal journal_;
    std::uint64_t version_ = 0;
    std::int64_t changes_ = 0;  ///< counter "review" of the project when read or written last
    int undo_count_ = 0;
    int redo_count_ = 0;
    int next_verdict_ = 1;
    int next_bookmark_ = 1;
};

}  // namespace eyrie
