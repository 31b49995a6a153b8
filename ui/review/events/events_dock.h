#pragma once

#include <QObject>
#include <QPointF>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "core/review/seen_frames.h"
#include "widgets/delayed_call.h"

namespace eyrie {
struct StoredTracks;
enum class Judgement;
}  // namespace eyrie

namespace eyrie::ui {

class Bookmarks;
struct ClockOfFrames;
class TrackCorrecting;
class DockRegistry;
class EventReview;
struct EventReviewAnswers;
class EventsModel;
class EventsPanel;
class LeftList;
class MessageBar;
class ProjectSession;
class TimelineView;
class VideoView;
class WindowActions;
class ZoneReview;

/// What the dock of events works on. All must outlive it.
struct EventsParts {
    ProjectSession& session;
    VideoView& canvas;
    TimelineView& timeline;
    DockRegistry& docks;
    WindowActions& actions;
    MessageBar& messages;
};

/// The dock of events, its commands and its marks on the timeline: how they follow the session and each other.
class EventsDock : public QObject {
    Q_OBJECT

 public:
    explicit EventsDock(const EventsParts& parts);

    EventReview& review() { return *review_; }
    EventsPanel& panel() { return *panel_; }
    EventsModel& model() { return *model_; }
    ZoneReview& zones() { return *zones_; }
    Bookmarks& bookmarks() { return *bookmarks_; }
    TrackCorrecting& correcting() { return *correcting_; }

    /// What time it was when the frames were taken; to be given again when that is known otherwise.
    void setClock(const ClockOfFrames& clock);
    /// Whether keys and marks are wanted: labelling has others.
    void setActive(bool active);
    /// The current row as a place in the queue.
    std::optional<std::size_t> currentPlace() const;
    /// Shows an event: its frame, its track, its place.
    void show(int id);
    /// Who is told which event a person chose.
    void setEventShown(std::function<void(int id)> tell) { tell_shown_ = std::move(tell); }
    void writeNote(int id, const QString& note);
    /// "gate 3, lorry".
    void writeTags(int id, const QString& tags);
    QString tagsOn(int id) const;

 signals:
    /// Other events are listed, or none.
    void eventsShown();
    /// The tracks of the run were read, or are those of none: EventReview::tracks().
    void tracksRead();

 private:
    void bindCommands();
    EventReviewAnswers reviewAnswers();
    void wireLists();
    void showEvents();
    void explainNothing();
    void showCounts();
    void showLeft();
    void showVerdicts(const std::vector<std::size_t>& positions);
    void showMarks();
    void enableActions();
    void chooseAndShow(std::optional<int> id);
    void judge(Judgement judgement);
    bool anySelected();
    void toggleStars();
    /// Selected rows as places in the queue: what is written, starred and shown belongs to the first event of each.
    std::vector<std::size_t> selectedPlaces() const;
    /// The same with all events that stand in these rows: what is judged.
    std::vector<std::size_t> placesInRows() const;
    std::optional<std::size_t> placeOf(int id) const;
    void bringIntoView(QPointF place);
    /// Of a long video the timeline shows what happened and a little around it.
    void zoomTimelineTo(FrameSpan frames);
    QString markText(int id) const;

    EventsParts parts_;
    EventReview* review_;
    EventsModel* model_;
    EventsPanel* panel_;
    ZoneReview* zones_ = nullptr;
    Bookmarks* bookmarks_ = nullptr;
    TrackCorrecting* correcting_ = nullptr;
    LeftList* left_list_ = nullptr;  ///< once it was wanted
    DelayedCall marks_due_;
    std::shared_ptr<const StoredTracks> listed_run_;  ///< whose events have their ids
    bool active_ = true;
    std::function<void(int id)> tell_shown_ = [](int) {};
};

}  // namespace eyrie::ui
