#pragma once

#include <optional>
#include <string>

#include "core/review/review_edit.h"
#include "store/project/project_file.h"

namespace eyrie {

/// Steps kept for undo per video; older ones are dropped.
inline constexpr int kReviewSteps = 1000;

/// The steps of reviewing a video, kept in the project for undo and redo over restarts. Every function runs inside the
/// caller's transaction.
class ReviewJournal {
 public:
    /// `project` must outlive the journal.
    ReviewJournal(ProjectFile& project, int sequence_id) : project_(project), sequence_id_(sequence_id) {}

    /// Adds a step; those that were undone are dropped, and the oldest beyond kReviewSteps.
    void add(const ReviewEdit& edit, const std::string& when_utc);
    /// The step that undo takes back next, and the one that redo brings back, as they were done. `set` is the review as
    /// it is now. Nothing when there is none. Throws Error(project) for a step that no journal wrote or that does not
    /// fit the review.
    std::optional<ReviewEdit> lastDone(const ReviewSet& set) const;
    std::optional<ReviewEdit> firstUndone(const ReviewSet& set) const;
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
