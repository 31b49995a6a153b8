#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "core/review/review_edit.h"

/// Steps of reviewing, to be handed to ReviewStore::apply(). All are pure.
namespace eyrie {

/// One thing to be judged.
struct Judged {
    ReviewSubject subject;
    std::optional<Verdict> before;  ///< the verdict it has, as stored, if any
};

/// Who judges, and when.
struct Judge {
    std::string person;
    std::string when_utc;  ///< ISO 8601
};

using NewId = std::function<int()>;  ///< ReviewStore::newVerdictId

/// One step that changes the verdicts on one or many things: `change` sets what it wants in each (`judgement`, `note`,
/// `tags`, `starred`); the rest stays. Verdicts take over the subject of the run that is judged now. A verdict that
/// says nothing any more is removed. Things that would not change are left out. `what` names the step where there are
/// several: "Judge 12 events not relevant".
ReviewEdit changeVerdicts(const std::vector<Judged>& things, const std::function<void(Verdict&)>& change,
                          const std::string& name, const Judge& judge, const NewId& new_id);

/// Relevant, not relevant, unsure; `open` takes the judgement back. One step for all of them.
ReviewEdit judgeAs(Judgement judgement, const std::vector<Judged>& things, const Judge& judge, const NewId& new_id);

/// A bookmark in place of `before`, or a new one, or (after empty) its removal.
ReviewEdit changeBookmark(const std::optional<Bookmark>& before, const std::optional<Bookmark>& after);

}  // namespace eyrie
