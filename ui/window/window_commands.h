#pragma once

#include <QObject>

class QMainWindow;

namespace eyrie::ui {

class Inspection;
class KeyBindings;
class LabelWorkspace;
class ProjectSession;
class RunBar;
class TimelineView;
class TransportBar;
class VideoView;
class WindowActions;
class Workspaces;

/// What the window's commands work on. All must outlive them.
struct CommandParts {
    ProjectSession& session;
    WindowActions& actions;
    VideoView& canvas;
    TransportBar& transport;
    TimelineView& timeline;
    RunBar& run_bar;
    Inspection& inspection;
    KeyBindings& keys;
    LabelWorkspace& labelling;
    Workspaces& workspaces;
    QMainWindow& window;
};

/// What the window's commands do, as lists: runs, playback, the view, help. Those about files are OpenedFiles', those
/// about errors EvaluationDocks', those that tune the chain Tuning's.
class WindowCommands : public QObject {
    Q_OBJECT

 public:
    explicit WindowCommands(const CommandParts& parts);

    /// Starts a run with what stands in the bar.
    void startRun();

 protected:
    bool eventFilter(QObject* watched, QEvent* event) override;

 private:
    void bindRun();
    void bindPlayback();
    void bindView();
    void bindHelp();
    /// One step back: out of a field, out of the selection, out of the full screen, out of a part of the timeline.
    void escape();
    void showFullScreen(bool on);
    /// The window manager may have ended or begun it.
    void followFullScreen();
    void showKeys();
    void showAbout();
    void askForName();

    CommandParts parts_;
};

}  // namespace eyrie::ui
