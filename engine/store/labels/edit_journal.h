#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/labels/annotation_edit.h"
#include "store/project/project_file.h"

namespace eyrie {

/// Steps kept for undo per sequence; older ones are dropped.
inline constexpr int kJournalSteps = 1000;

/// The steps of work on the labels of a sequence, kept in the project for undo and redo over restarts. Every function
/// runs inside the caller's transaction. Of an object only the keyframes that differ are kept.
class EditJournal {
 public:
    /// `project` must outlive the journal.
    EditJournal(ProjectFile& project, int sequence_id) : project_(project), sequence_id_(sequence_id) {}

    /// Adds a step; those that were undone are dropped, and the oldest beyond kJournalSteps.
    void add(const AnnotationEdit& edit, const std::string& when_utc);
    /// The step that undo takes back next, and the one that redo brings back, as they were done. `set` is what is
    /// labelled now. Nothing when there is none. Throws Error(project) for a step that no journal wrote or that does
    /// not fit the labels.
    std::optional<AnnotationEdit> lastDone(const AnnotationSet& set) const;
    std::optional<AnnotationEdit> firstUndone(const AnnotationSet& set) const;
    /// Marks them as undone, or done again.
    void markUndone();
    void markDone();

    int doneCount() const;
    int undoneCount() const;
    /// Names for the menu; empty when there is none.
    std::string lastDoneName() const;
    std::string firstUndoneName() const;

 private:
    ProjectFile& project_;
    int sequence_id_;
};

}  // namespace eyrie
