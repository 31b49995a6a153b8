#pragma once

#include <QObject>

class QWidget;

namespace eyrie::ui {

class EventsDock;
class MessageBar;
class ProjectSession;
class WindowActions;

/// What handing over works on. All must outlive it.
struct HandoverParts {
    ProjectSession& session;
    EventsDock& events;
    WindowActions& actions;
    MessageBar& messages;
    QWidget& window;
};

/// What other people get of the run shown besides reports: its tracks in their programs' formats, and clips of an event
/// or a track. Each opens a dialog.
class RunHandover : public QObject {
    Q_OBJECT

 public:
    explicit RunHandover(const HandoverParts& parts);

 private:
    void enableActions();
    void exportTracks();
    void clipOfEvent();
    void clipOfTrack();
    void remind(const QString& text);

    HandoverParts parts_;
};

}  // namespace eyrie::ui
