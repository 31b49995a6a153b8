#include <algorithm>
#include <exception>
#include <unordered_map>

#include "core/error.h"
#include "core/time/utc_time.h"
#include "review/events/event_review.h"
#include "session/project/person_name.h"

/// What people say in a review, and take back: verdicts, zones, bookmarks, corrections of tracks.
namespace eyrie::ui {

// ---- verdicts -------------------------------------------------------------------------------------------------------

int& EventReview::verdictIdAt(std::size_t position) {
    const QueueItem& item = found_->queue.at(position);
    return item.is_event ? carried_.of_event.at(item.index) : carried_.of_stretch.at(item.index);
}

int EventReview::verdictIdAt(std::size_t position) const {
    const QueueItem& item = found_->queue.at(position);
    return item.is_event ? carried_.of_event.at(item.index) : carried_.of_stretch.at(item.index);
}

const Verdict* EventReview::verdictAt(std::size_t position) const {
    if (!store_ || position >= count()) return nullptr;
    const auto verdict = store_->review().verdicts.find(verdictIdAt(position));
    return verdict == store_->review().verdicts.end() ? nullptr : &verdict->second;
}

bool EventReview::isJudged(std::size_t position) const {
    const Verdict* verdict = verdictAt(position);
    return verdict != nullptr && verdict->judgement != Judgement::open;
}

std::size_t EventReview::judgedCount() const {
    std::size_t judged = 0;
    for (std::size_t i = 0; i < count(); ++i) judged += isJudged(i) ? 1 : 0;
    return judged;
}

std::vector<std::pair<const Verdict*, CarryFault>> EventReview::left() const {
    std::vector<std::pair<const Verdict*, CarryFault>> left;
    if (!found_ || !store_) return left;
    for (const LeftVerdict& each : found_->carried.left) {
        const auto verdict = store_->review().verdicts.find(each.verdict);
        if (verdict != store_->review().verdicts.end()) left.emplace_back(&verdict->second, each.fault);
    }
    return left;
}

bool EventReview::mayWrite() {
    if (!store_) return false;
    if (store_->readOnly()) answers_.tell_notice(QString::fromStdString(store_->readOnlyReason()));
    return !store_->readOnly();
}

bool EventReview::mayJudge() {
    const bool goes_on = watched_ || so_far_;
    if (goes_on)
        answers_.tell_notice(watched_ ? tr("events can be judged when the run has ended")
                                      : tr("events can be judged when the whole run has been searched"));
    return found_ && !goes_on && mayWrite();
}

std::vector<Judged> EventReview::judgedAt(const std::vector<std::size_t>& positions) const {
    std::vector<Judged> things;
    for (const std::size_t position : positions) {
        const Verdict* before = verdictAt(position);
        things.push_back({found_->subjectAt(position), before != nullptr ? std::optional(*before) : std::nullopt});
    }
    return things;
}

Judge EventReview::whoJudges() const {
    return {personName().toStdString(), nowUtc()};
}

void EventReview::notStored(const std::exception& error) {
    TaskPool::common()->countFailedWrite();
    answers_.tell_problem(QString::fromUtf8(error.what()));
}

bool EventReview::apply(const ReviewEdit& edit, const std::vector<std::size_t>& positions) {
    if (edit.empty()) return false;
    try {
        store_->apply(edit);
    } catch (const std::exception& error) {
        notStored(error);
        return false;
    }
    // New verdicts come in the order of what was judged.
    auto change = edit.verdicts.begin();
    for (const std::size_t position : positions) {
        change = std::find_if(change, edit.verdicts.end(),
                              [](const Change<Verdict>& each) { return !each.before && each.after; });
        if (change == edit.verdicts.end()) break;
        if (change->after->subject != found_->subjectAt(position)) continue;
        verdictIdAt(position) = change->after->id;
        ++change;
    }
    answers_.show_verdicts(positions);
    return true;
}

bool EventReview::judge(const std::vector<std::size_t>& positions, Judgement judgement) {
    if (!mayJudge()) return false;
    return apply(judgeAs(judgement, judgedAt(positions), whoJudges(), [this] { return store_->newVerdictId(); }),
                 positions);
}

bool EventReview::setStarred(const std::vector<std::size_t>& positions, bool starred) {
    if (!mayJudge()) return false;
    const QString one = starred ? tr("Star an event") : tr("Unstar an event");
    const QString several = (starred ? tr("Star %1 events") : tr("Unstar %1 events")).arg(positions.size());
    const std::string name = (positions.size() == 1 ? one : several).toStdString();
    const ReviewEdit edit = changeVerdicts(
        judgedAt(positions), [starred](Verdict& verdict) { verdict.starred = starred; }, name, whoJudges(),
        [this] { return store_->newVerdictId(); });
    return apply(edit, positions);
}

bool EventReview::setNote(std::size_t position, const QString& note) {
    if (!mayJudge()) return false;
    const ReviewEdit edit = changeVerdicts(
        judgedAt({position}), [&note](Verdict& verdict) { verdict.note = note.trimmed().toStdString(); },
        tr("Change a note").toStdString(), whoJudges(), [this] { return store_->newVerdictId(); });
    return apply(edit, {position});
}

bool EventReview::setTags(std::size_t position, const QString& tags) {
    if (!mayJudge()) return false;
    const ReviewEdit edit = changeVerdicts(
        judgedAt({position}), [&tags](Verdict& verdict) { verdict.tags = tagsOf(tags.toStdString()); },
        tr("Change tags").toStdString(), whoJudges(), [this] { return store_->newVerdictId(); });
    return apply(edit, {position});
}

void EventReview::undo() {
    goBack([this] { return store_->undo(); });
}

void EventReview::redo() {
    goBack([this] { return store_->redo(); });
}

void EventReview::goBack(const std::function<std::optional<ReviewEdit>()>& step) {
    // Bookmarks and zones are made before events are found, so they can be taken back by then, too.
    if (watched_ || so_far_ ? !mayJudge() : !mayWrite()) return;
    const std::vector<Zone> zones_before = zonesOf(zones());
    std::optional<ReviewEdit> edit;
    try {
        edit = step();
    } catch (const std::exception& error) {
        answers_.tell_problem(QString::fromUtf8(error.what()));
        return;
    }
    if (!edit) return;
    std::unordered_map<int, std::size_t> places;
    for (std::size_t i = 0; i < count(); ++i)
        if (verdictIdAt(i) != 0) places[verdictIdAt(i)] = i;
    std::vector<std::size_t> positions;
    bool lost = false;  // a verdict of an earlier day came back, whose event was not looked for
    for (const Change<Verdict>& change : edit->verdicts) {
        const int id = (change.before ? change.before : change.after)->id;
        const auto place = places.find(id);
        if (place != places.end())
            positions.push_back(place->second);
        else
            lost = lost || store_->review().verdicts.contains(id);
    }
    std::sort(positions.begin(), positions.end());
    if (!edit->zones.empty() || !edit->bookmarks.empty()) answers_.show_zones();
    if (!edit->corrections.empty())
        useOtherCorrections();
    else if (lost || zonesOf(zones()) != zones_before)
        search();
    answers_.show_verdicts(positions);
    answers_.go_back_to(positions);
}

// ---- zones ----------------------------------------------------------------------------------------------------------

const std::map<int, StoredZone>& EventReview::zones() const {
    static const std::map<int, StoredZone> none;
    return store_ ? store_->review().zones : none;
}

bool EventReview::changeZones(const std::function<ReviewEdit(const ReviewSet&, const Judge&, const NewId&)>& step) {
    const std::vector<Zone> before = zonesOf(zones());
    if (!applyStep([&] { return step(store_->review(), whoJudges(), [this] { return store_->newZoneId(); }); }))
        return false;
    if (zonesOf(zones()) != before) search();
    return true;
}

// ---- bookmarks ------------------------------------------------------------------------------------------------------

const std::map<int, Bookmark>& EventReview::bookmarks() const {
    static const std::map<int, Bookmark> none;
    return store_ ? store_->review().bookmarks : none;
}

bool EventReview::setBookmark(FrameIndex frame, const QString& note) {
    return applyStep([&] {
        std::optional<Bookmark> before;
        for (const auto& [id, bookmark] : bookmarks())
            if (bookmark.frame == frame) before = bookmark;
        Bookmark after = before.value_or(Bookmark{});
        if (before && after.note == note.toStdString()) return ReviewEdit{};
        if (!before) after.id = store_->newBookmarkId();
        after.frame = frame;
        // As the run tells it; until its tracks are read, as the video does.
        const auto& times = session_.timesUs();
        if (tracks_)
            after.seconds = tracks_->secondsOf(frame);
        else if (!before && frame >= 0 && static_cast<std::size_t>(frame) < times.size())
            after.seconds = static_cast<double>(times[static_cast<std::size_t>(frame)]) / 1e6;
        after.note = note.toStdString();
        const Judge judge = whoJudges();
        after.person = judge.person;
        after.when_utc = judge.when_utc;
        return changeBookmark(before, after);
    });
}

bool EventReview::removeBookmark(int id) {
    return applyStep([&] {
        const auto found = bookmarks().find(id);
        return found == bookmarks().end() ? ReviewEdit{} : changeBookmark(found->second, std::nullopt);
    });
}

/// What is not said about one event.
bool EventReview::applyStep(const std::function<ReviewEdit()>& step) {
    if (!mayWrite()) return false;
    try {
        const ReviewEdit edit = step();
        if (edit.empty()) return false;
        store_->apply(edit);
    } catch (const Error& error) {
        const QString text = QString::fromUtf8(error.what());
        error.kind() == ErrorKind::parameter ? answers_.tell_notice(text) : notStored(error);
        return false;
    } catch (const std::exception& error) {
        notStored(error);
        return false;
    }
    answers_.show_zones();
    return true;
}

// ---- corrections of tracks ------------------------------------------------------------------------------------------

const std::map<int, TrackCorrection>& EventReview::corrections() const {
    static const std::map<int, TrackCorrection> none;
    return store_ ? store_->review().corrections : none;
}

bool EventReview::correct(std::vector<TrackCorrection> corrections, const QString& step) {
    const bool made = applyStep([&] {
        const Judge judge = whoJudges();
        ReviewEdit edit;
        edit.name = step.toStdString();
        for (TrackCorrection& correction : corrections) {
            correction.person = judge.person;
            correction.when_utc = judge.when_utc;
            edit.corrections.push_back({std::nullopt, correction});
        }
        return edit;
    });
    if (made) useOtherCorrections();
    return made;
}

bool EventReview::removeCorrections(const std::vector<int>& ids, const QString& step) {
    const bool removed = applyStep([&] {
        ReviewEdit edit;
        edit.name = step.toStdString();
        for (const int id : ids) {
            const auto found = corrections().find(id);
            if (found != corrections().end()) edit.corrections.push_back({found->second, std::nullopt});
        }
        return edit;
    });
    if (removed) useOtherCorrections();
    return removed;
}

void EventReview::useOtherCorrections() {
    ++corrections_made_;
    tracks_.reset();
    session_.correctionsChanged();
    search();
}

}  // namespace eyrie::ui
