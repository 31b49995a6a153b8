#pragma once

#include <QObject>

class QMainWindow;

namespace eyrie::ui {

class Inspection;
class KeyBindings;
class LabelWorkspace;
class ProjectSession;
class RunBar;
class TransportBar;
class VideoView;
class WindowActions;

/// What the window's commands work on. All must outlive them.
struct CommandParts {
    ProjectSession& session;
    WindowActions& actions;
    VideoView& canvas;
    TransportBar& transport;
    RunBar& run_bar;
    Inspection& inspection;
    KeyBindings& keys;
    LabelWorkspace& labelling;
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

 private:
    void bindRun();
    void bindPlayback();
    void bindView();
    void bindHelp();
    /// One step back: out of a field, out of the selection, out of the full screen.
    void escape();
    void showFullScreen(bool on);
    void showKeys();
    void showAbout();
    void askForName();

    CommandParts parts_;
};

}  // namespace eyrie::ui
