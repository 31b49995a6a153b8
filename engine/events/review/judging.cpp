#include "events/review/judging.h"

#include <algorithm>

namespace eyrie {
namespace {

bool saysNothing(const Verdict& verdict) {
    return verdict.judgement == Judgement::open && verdict.note.empty() && verdict.tags.empty() && !verdict.starred;
}

std::string subjectText(const ReviewSubject& subject) {
    return subject.kind ? "\"" + std::string(nameOf(*subject.kind)) + "\"" : "a stretch that could not be searched";
}

std::string subjectsText(const std::vector<Judged>& things) {
    if (things.size() == 1) return subjectText(things.front().subject);
    const bool all_events =
        std::all_of(things.begin(), things.end(), [](const Judged& thing) { return thing.subject.kind.has_value(); });
    return std::to_string(things.size()) + (all_events ? " events" : " entries");
}

}  // namespace

ReviewEdit changeVerdicts(const std::vector<Judged>& things, const std::function<void(Verdict&)>& change,
                          const std::string& name, const Judge& judge, const NewId& new_id) {
    ReviewEdit edit;
    edit.name = name;
    for (const Judged& thing : things) {
        Verdict after = thing.before.value_or(Verdict{});
        after.subject = thing.subject;
        change(after);
        const bool nothing = saysNothing(after);
        if (nothing ? !thing.before : thing.before == after) continue;
        if (nothing) {
            edit.verdicts.push_back({thing.before, std::nullopt});
            continue;
        }
        if (!thing.before) after.id = new_id();
        after.person = judge.person;
        after.when_utc = judge.when_utc;
        edit.verdicts.push_back({thing.before, std::move(after)});
    }
    return edit;
}

ReviewEdit judgeAs(Judgement judgement, const std::vector<Judged>& things, const Judge& judge, const NewId& new_id) {
    const std::string name = judgement == Judgement::open ? "Take back the verdict on " + subjectsText(things)
                                                          : "Judge " + subjectsText(things) + " " + nameOf(judgement);
    return changeVerdicts(
        things, [judgement](Verdict& verdict) { verdict.judgement = judgement; }, name, judge, new_id);
}

ReviewEdit changeBookmark(const std::optional<Bookmark>& before, const std::optional<Bookmark>& after) {
    ReviewEdit edit;
    if (before == after) return edit;
    edit.name = !before ? "Add bookmark" : !after ? "Remove bookmark" : "Change bookmark";
    edit.bookmarks.push_back({before, after});
    return edit;
}

}  // namespace eyrie
