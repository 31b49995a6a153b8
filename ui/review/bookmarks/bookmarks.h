#pragma once

#include <QObject>
#include <QString>
#include <functional>
#include <map>
#include <optional>
#include <vector>

#include "canvas/timeline/timeline_marks.h"
#include "core/review/verdict.h"

namespace eyrie::ui {

class BookmarksModel;
class BookmarksPanel;
struct ClockOfFrames;
class EventReview;
class ProjectSession;
class WindowActions;

/// The places of the video that a person marked, with a note each: set, changed, removed, gone through. They are kept
/// and undone as verdicts are.
class Bookmarks : public QObject {
    Q_OBJECT

 public:
    /// Asks the person for the note of a bookmark, given the one it has; nothing: leave all as it is.
    using AskForNote = std::function<std::optional<QString>(const QString& note, FrameIndex frame)>;

    /// All must outlive it. Asks with a dialog over the window until told otherwise.
    Bookmarks(ProjectSession& session, WindowActions& actions, EventReview& review, QObject* parent = nullptr);
    void setAskForNote(AskForNote ask) { ask_ = std::move(ask); }

    /// Strokes for the timeline, with ids that no event has.
    std::vector<TimelineMark> marks(bool dark) const;
    /// Whether a mark on the timeline is a bookmark's.
    static bool isBookmark(int mark_id) { return mark_id < 0; }
    /// The note, and who wrote it when.
    QString markText(int mark_id) const;
    void goTo(int mark_id);

    /// Whether keys are wanted: labelling has others. To be called again when bookmarks have changed: the list follows.
    void enableActions(bool active);
    /// What time it was when the frames were taken; to be given again when that is known otherwise.
    void setClock(const ClockOfFrames& clock);
    /// Their list, for a dock.
    BookmarksPanel& panel() { return *panel_; }

 private:
    /// Marks the frame that is shown, or changes the note of the bookmark that is there.
    void edit();
    void remove();
    void step(int direction);
    const Bookmark* at(FrameIndex frame) const;
    void showList();

    ProjectSession& session_;
    WindowActions& actions_;
    EventReview& review_;
    BookmarksModel* model_;
    BookmarksPanel* panel_;
    AskForNote ask_;
    bool active_ = true;
};

}  // namespace eyrie::ui
