#include "review/card/card_dock.h"

#include "review/events/event_text.h"
#include "review/events/events_dock.h"
#include "review/events/events_model.h"
#include "review/tracks/tracks_model.h"
#include "review/watch/watched_ground.h"
#include "workspace/dock_registry.h"
#include "workspace/first_step.h"
#include "workspace/session_reactions.h"

namespace eyrie::ui {

CardDock::CardDock(const CardParts& parts)
    : QObject(&parts.docks),
      parts_(parts),
      card_(new EventCard),
      read_due_(0, [this] { readStory(); }),
      loader_([this](const std::shared_ptr<const VehicleStory>& story) {
          if (asked_ == story->wish) card_->setStory(story, parts_.session.scale());
      }) {
    parts_.docks.add(DockId::card, tr("Card"), card_);
    parts_.docks.watch(DockId::card, card_, [this](bool visible) {
        looked_at_ = visible;
        askForStory();
    });
    card_->setCommands({
        .go_to =
            [this](FrameIndex frame) {
                parts_.session.playback().pause();
                parts_.session.goToFrame(frame);
            },
        .write_note = [this](int event, const QString& note) { parts_.events.writeNote(event, note); },
        .write_tags = [this](int event, const QString& tags) { parts_.events.writeTags(event, tags); },
    });
    parts_.events.setEventShown([this](int id) { showEvent(id); });
    whenAny(&parts_.events.model(), this, &CardDock::refreshEvent, &EventsModel::dataChanged, &EventsModel::modelReset);
    whenAny(&parts_.ground, this, &CardDock::askForStory, &WatchedGround::changed);
    followSession(parts_.session, this,
                  {{SessionChange::keep_written, [this] { card_->keepWritten(); }},
                   {SessionChange::selection, [this] { showSelection(); }},
                   {SessionChange::run_data, [this] { refreshTrack(); }},
                   {{SessionChange::video, SessionChange::current_run, SessionChange::run_preparing,
                     SessionChange::run_started, SessionChange::run_ended},
                    [this] { explainNothing(); }},
                   {SessionChange::picture, [this] {
                        card_->setFrame(parts_.session.shownFrame());
                        if (waits_for_picture_) readStory();
                    }}});
    explainNothing();
}

void CardDock::explainNothing() {
    card_->explainNothing(afterFirstStep(
        parts_.session,
        tr("Select an event or a track: its vehicle in a loop, its speed and its path are shown here.")));
}

std::optional<CardSubject> CardDock::subjectOf(int id) const {
    EventsModel& model = parts_.events.model();
    const EventEntry* entry = model.recordAt(model.rowOf(id));
    const auto& found = model.found();
    if (entry == nullptr || !found) return std::nullopt;
    const Event* event = found->eventAt(entry->position);
    QStringList words{eventRowText(*found, entry->position, entry->others),
                      model.index(model.rowOf(id), EventsModel::time_column).data().toString()};
    if (event != nullptr)
        words << (event->tracks.size() == 1 ? tr("track %1") : tr("tracks %1"))
                     .arg(eventTracksText(*found, entry->position));
    QString figure = countedFigureText(*found, entry->position);
    if (!figure.isEmpty()) words << figure.replace(0, 1, figure.at(0).toLower());
    CardSubject subject;
    subject.title = words.join(QStringLiteral(" · "));
    subject.event = id;
    subject.note = entry->note;
    subject.tags = parts_.events.tagsOn(id);
    subject.judged = judgedText(entry->judgement, entry->person, entry->judged_utc);
    subject.track = event != nullptr && !event->tracks.empty() ? event->tracks.front() : 0;
    subject.frame = found->frameAt(entry->position);
    return subject;
}

void CardDock::showEvent(int id) {
    show(subjectOf(id));
}

void CardDock::refreshEvent() {
    if (!card_->subject() || card_->subject()->event == 0) return;
    show(subjectOf(card_->subject()->event));
}

void CardDock::showSelection() {
    const auto track = parts_.session.selectedTrack();
    // An event that was just shown selects its track, or none.
    if (card_->subject() && card_->subject()->track == track.value_or(0)) return;
    if (track)
        showTrack(*track, parts_.session.currentFrame());
    else
        show(std::nullopt);
}

void CardDock::refreshTrack() {
    const auto& subject = card_->subject();
    if (subject && subject->event == 0 && parts_.session.trackSummary(subject->track) != nullptr)
        showTrack(subject->track, subject->frame);
}

void CardDock::showTrack(TrackId track, FrameIndex frame) {
    const TrackSummary* summary = parts_.session.trackSummary(track);
    CardSubject subject;
    subject.title = summary != nullptr && summary->doubtful
                        ? tr("Track %1 · left out of the result for its score; its path is not worked out").arg(track)
                    : summary != nullptr && isRejected(*summary)
                        ? tr("Track %1 · rejected; its path is not worked out").arg(track)
                        : tr("Track %1").arg(track);
    subject.track = track;
    subject.frame = frame;
    show(subject);
}

void CardDock::show(const std::optional<CardSubject>& subject) {
    card_->show(subject);
    card_->setFrame(parts_.session.shownFrame());
    askForStory();
}

void CardDock::askForStory() {
    const auto& subject = card_->subject();
    const auto& ground = parts_.ground.ground();
    const bool readable = looked_at_ && ground && parts_.session.media();
    if (!readable || !subject || subject->track == 0) {
        readable ? loader_.cancel() : loader_.close();
        asked_.reset();
        read_due_.stop();
        waits_for_picture_ = false;
        return;
    }
    const StoryWish wish{ground, *parts_.session.media(), subject->track, subject->frame};
    if (asked_ == wish) return;
    asked_ = wish;
    loader_.cancel();
    read_due_.start();
}

/// Both decode a long way from the last key picture; done at once, each would take twice as long.
void CardDock::readStory() {
    ProjectSession& session = parts_.session;
    waits_for_picture_ = !session.playback().playing() && session.shownFrame() != session.currentFrame();
    if (asked_ && !waits_for_picture_) loader_.ask(*asked_);
}

}  // namespace eyrie::ui

#include "moc_card_dock.cpp"
