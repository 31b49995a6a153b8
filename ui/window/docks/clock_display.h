#pragma once

#include <QObject>

namespace eyrie::ui {

class EventsDock;
class ProjectSession;
class ReviewDocks;
class StatusFields;
class TimelineBinding;
class TimelineView;
class WatchingDocks;

/// Where times and places are shown. All must outlive the display.
struct ClockParts {
    ProjectSession& session;
    TimelineView& timeline;
    TimelineBinding& binding;
    StatusFields& status;
    ReviewDocks& review;
    EventsDock& events;
    WatchingDocks& watching;  ///< knows when and where the video was taken
};

/// Times of the day, places on the earth and courses, wherever frames, pixels and boxes are shown.
class ClockDisplay : public QObject {
    Q_OBJECT

 public:
    explicit ClockDisplay(const ClockParts& parts, QObject* parent);

 private:
    /// Whatever shows times shows those of the day, where they are known.
    void showClock();

    ClockParts parts_;
};

}  // namespace eyrie::ui
