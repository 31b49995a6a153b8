#pragma once

#include <QObject>
#include <optional>

#include "review/card/event_card.h"
#include "widgets/delayed_call.h"

namespace eyrie::ui {

class DockRegistry;
class EventsDock;
class ProjectSession;
class WatchedGround;

/// What the card works on. All must outlive it.
struct CardParts {
    ProjectSession& session;
    DockRegistry& docks;
    EventsDock& events;
    WatchedGround& ground;
};

/// The dock with the card: of the event that was chosen last, or of the track that is selected.
class CardDock : public QObject {
    Q_OBJECT

 public:
    explicit CardDock(const CardParts& parts);

    EventCard& card() { return *card_; }

 private:
    void explainNothing();
    void showEvent(int id);
    void showSelection();
    /// A track alone, around a frame; again when what people made of it is known otherwise.
    void showTrack(TrackId track, FrameIndex frame);
    void refreshTrack();
    void refreshEvent();
    void show(const std::optional<CardSubject>& subject);
    void askForStory();
    /// Reads the story that was asked for, unless the picture of the frame gone to is still to come.
    void readStory();
    std::optional<CardSubject> subjectOf(int event) const;

    CardParts parts_;
    EventCard* card_;
    bool looked_at_ = false;
    std::optional<StoryWish> asked_;
    bool waits_for_picture_ = false;
    DelayedCall read_due_;  ///< once whoever chose something has also gone to its frame
    StoryLoader loader_;    ///< last: stops before the rest goes
};

}  // namespace eyrie::ui
