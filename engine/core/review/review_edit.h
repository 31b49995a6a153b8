#pragma once

#include <string>
#include <vector>

#include "core/labels/change.h"
#include "core/review/verdict.h"

namespace eyrie {

/// One step of reviewing, as undone and redone: one verdict, or hundreds at once.
struct ReviewEdit {
    std::string name;  ///< for the menu: "Judge 12 events not relevant"
    std::vector<Change<Verdict>> verdicts;
    std::vector<Change<Bookmark>> bookmarks;
    std::vector<Change<StoredZone>> zones = {};
    std::vector<Change<TrackCorrection>> corrections = {};

    bool empty() const { return verdicts.empty() && bookmarks.empty() && zones.empty() && corrections.empty(); }
};

/// The edit that takes the edit back.
ReviewEdit inverseOf(ReviewEdit edit);

/// Carries an edit out. Throws, changing nothing, Error(internal) when `set` is not what the edit starts from: what is
/// to be changed is not there or is another by now, what is to be added is there already; Error(parameter) when two
/// zones would have one name; or as checkVerdict().
void applyEdit(ReviewSet& set, const ReviewEdit& edit);
/// Throws what applyEdit() would, and changes nothing.
void checkEdit(const ReviewSet& set, const ReviewEdit& edit);

/// Throws Error(parameter) for a text that is too long to be kept or a tag that is none, Error(internal) for numbers
/// and frames that cannot be.
void checkVerdict(const Verdict& verdict);
void checkBookmark(const Bookmark& bookmark);
/// Throws Error(parameter), too, for a zone without a name or with a fault (faultOf()).
void checkZone(const StoredZone& zone);

/// Characters (bytes) that a note, all tags, a name of a zone or of a person may have.
inline constexpr std::size_t kLongestReviewText = 60'000;

}  // namespace eyrie
