#include "store/review/review_store.h"

#include <SQLiteCpp/SQLiteCpp.h>

#include "store/journal/journalled_store_code.h"
#include "store/review/packed_review.h"
#include "store/review/review_rows.h"

namespace eyrie {

ReviewSet readReview(ProjectFile& project, int sequence_id) {
    return guarded(project.path(), "reading the verdicts", [&] {
        SQLite::Transaction moment(project.database());
        return readReviewRows(project.database(), sequence_id);
    });
}

ReviewSet ReviewContent::read(SQLite::Database& database, int sequence_id) {
    return readReviewRows(database, sequence_id);
}

void ReviewContent::write(SQLite::Database& database, int sequence_id, const ReviewEdit& edit, const ReviewSet&) {
    writeReviewRows(database, sequence_id, edit);
}

Bytes ReviewContent::pack(const ReviewEdit& edit) {
    return packReview(edit);
}

std::optional<ReviewEdit> ReviewContent::unpack(ByteView bytes, const ReviewSet& set, bool done) {
    auto edit = unpackReview(bytes);
    if (!edit) return std::nullopt;
    try {
        checkEdit(set, done ? inverseOf(*edit) : *edit);
    } catch (const Error&) {
        return std::nullopt;
    }
    return edit;
}

void ReviewContent::ground(ReviewEdit& edit, const ReviewSet& set) {
    groundChanges(edit.verdicts, set.verdicts);
    groundChanges(edit.bookmarks, set.bookmarks);
    groundChanges(edit.zones, set.zones);
    groundChanges(edit.corrections, set.corrections);
}

std::array<std::vector<int>, 4> ReviewContent::ids(const ReviewEdit& edit) {
    return {idsAfter(edit.verdicts), idsAfter(edit.bookmarks), idsAfter(edit.zones), idsAfter(edit.corrections)};
}

template class JournalledStore<ReviewContent>;

}  // namespace eyrie
