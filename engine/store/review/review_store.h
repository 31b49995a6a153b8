#pragma once

#include <array>
#include <optional>
#include <vector>

#include "core/review/review_edit.h"
#include "store/journal/journalled_store.h"

namespace eyrie {

/// What was said about a video and watched in it, read once, by anybody (command line, reports). Throws Error(project)
/// for damaged rows.
ReviewSet readReview(ProjectFile& project, int sequence_id);

/// Verdicts, bookmarks, zones and corrections of tracks as JournalledStore keeps them.
struct ReviewContent {
    using Set = ReviewSet;
    using Edit = ReviewEdit;
    static constexpr WriterLock::Work kWork = WriterLock::Work::review;
    static constexpr const char* kReading = "reading the verdicts";
    static constexpr StepTable kSteps{"review_step", "the review"};
    static constexpr std::array<NumberedTable, 4> kNumbers{
        {{"verdict", "verdict"}, {"bookmark", "bookmark"}, {"zone", "zone"}, {"correction", "correction"}}};
    static constexpr const char* kChanges = "review";
    static ReviewSet read(SQLite::Database& database, int sequence_id);
    static void write(SQLite::Database& database, int sequence_id, const ReviewEdit& edit, const ReviewSet& after);
    static Bytes pack(const ReviewEdit& edit);
    static std::optional<ReviewEdit> unpack(ByteView bytes, const ReviewSet& set, bool done);
    static void ground(ReviewEdit& edit, const ReviewSet& set);
    static std::array<std::vector<int>, 4> ids(const ReviewEdit& edit);
};

/// Verdicts, bookmarks, zones and corrections of one video, and the right to judge it.
class ReviewStore : public JournalledStore<ReviewContent> {
 public:
    using JournalledStore::JournalledStore;

    const ReviewSet& review() const { return content(); }
    int newVerdictId() { return newId(0, review().verdicts); }
    int newBookmarkId() { return newId(1, review().bookmarks); }
    int newZoneId() { return newId(2, review().zones); }
    int newCorrectionId() { return newId(3, review().corrections); }
};

extern template class JournalledStore<ReviewContent>;

}  // namespace eyrie
