#include <exception>

#include "core/error.h"
#include "review/events/event_review.h"

/// What of a review is not said about events: zones, bookmarks, corrections of tracks.
namespace eyrie::ui {

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
        after.seconds = tracks_ ? tracks_->secondsOf(frame) : after.seconds;
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
        error.kind() == ErrorKind::parameter ? answers_.tell_notice(text) : answers_.tell_problem(text);
        return false;
    } catch (const std::exception& error) {
        answers_.tell_problem(QString::fromUtf8(error.what()));
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
