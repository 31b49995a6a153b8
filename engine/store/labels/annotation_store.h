#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/labels/annotation.h"
#include "core/labels/annotation_edit.h"
#include "store/labels/edit_journal.h"
#include "store/labels/writer_lock.h"
#include "store/project/project_file.h"
#include "store/runs/run_store.h"

namespace eyrie {

/// The row of a video in a project, made if it is not there; what is known of the video now, its frame rate too,
/// replaces what was known. Throws Error(project | output).
int ensureSequence(ProjectFile& project, const SequenceRecord& sequence);
/// A video of the project lies elsewhere now: its runs and labels belong to `path`. Throws Error(project | output),
/// also when the project has another video of that path and size.
void relocateSequence(ProjectFile& project, int sequence_id, const std::string& path);
/// All videos of a project, ascending ids.
std::vector<SequenceRecord> sequencesOf(ProjectFile& project);
/// The labels of a sequence, read once, by anybody (command line). Throws Error(project) for damaged labels.
AnnotationSet readAnnotations(ProjectFile& project, int sequence_id);

/// The labels of one sequence: all in memory, every edit one committed transaction together with its step in the
/// journal, so that a killed process loses nothing that was applied. One window labels a project at a time; others
/// read. Used by one thread.
class AnnotationStore {
 public:
    /// Reads the labels and takes the right to label, if nobody has it. `project` must outlive the store; opened
    /// read_only, so are the labels. Throws Error(project).
    AnnotationStore(ProjectFile& project, int sequence_id);
    ~AnnotationStore();
    AnnotationStore(const AnnotationStore&) = delete;
    AnnotationStore& operator=(const AnnotationStore&) = delete;

    const AnnotationSet& annotations() const { return set_; }
    int sequenceId() const { return sequence_id_; }
    /// Grows with every change of annotations(), for caches.
    std::uint64_t version() const { return version_; }

    bool readOnly() const { return lock_ == nullptr; }
    /// Why, for people; empty when not.
    const std::string& readOnlyReason() const { return read_only_reason_; }
    /// Tries again to take the right to label; labels are read anew. Answers whether it may write now.
    bool tryToWrite();
    /// Reads again what another window has changed meanwhile; answers whether anything had. For readers.
    bool refresh();

    /// A new id, never used before in the project. Kept when the first edit with it is applied.
    ObjectId newObjectId();
    int newRegionId();

    /// Carries the edit out and commits it. An empty edit is nothing. Throws Error(output) when read-only,
    /// Error(internal) when the edit does not fit, Error(project | output) when it cannot be written: then nothing is
    /// changed, neither in the file nor in memory.
    void apply(const AnnotationEdit& edit);
    /// Takes back the last step, or brings back the one undone last. Answers it (as done, resp. taken back), for the
    /// selection; nothing when there is none.
    std::optional<AnnotationEdit> undo();
    std::optional<AnnotationEdit> redo();
    bool canUndo() const { return undo_count_ > 0; }
    bool canRedo() const { return redo_count_ > 0; }
    int undoCount() const { return undo_count_; }
    int redoCount() const { return redo_count_; }
    std::string undoName() const;  ///< "Move box of car 12"; empty when there is none
    std::string redoName() const;

 private:
    enum class Step { edit, undo, redo };
    void load();
    void commit(const AnnotationEdit& edit, Step step);
    void refuseReadOnly() const;

    ProjectFile& project_;
    int sequence_id_;
    std::unique_ptr<WriterLock> lock_;
    std::string read_only_reason_;
    AnnotationSet set_;
    EditJournal journal_;
    std::uint64_t version_ = 0;
    std::int64_t changes_ = 0;  ///< counter "change" of the project when read or written last
    int undo_count_ = 0;
    int redo_count_ = 0;
    ObjectId next_object_ = 1;
    int next_region_ = 1;
};

}  // namespace eyrie
