#pragma once

#include <QMainWindow>

#include "canvas/overlay_settings.h"
#include "session/project_session.h"
#include "window/start_options.h"
#include "window/window_settings.h"
#include "workspace/key_bindings.h"

class QStackedWidget;

namespace eyrie::ui {

class DockRegistry;
class EvaluationDocks;
class EvaluationSession;
class EventReport;
class EventsDock;
class Inspection;
class LabelTimeline;
class LabelWorkspace;
class LiveStrip;
class LiveWatching;
class MessageBar;
class OpenedFiles;
class OverlayColumn;
class ReviewDocks;
class RunBar;
class RunGuard;
class StatusFields;
class TimelineView;
class TransportBar;
class Tuning;
class VideoView;
class WatchingDocks;
class WelcomePanel;
class WindowActions;
class WindowCommands;
class Workspaces;

/// The window: menus, docks, canvas and timeline, joined with the session. Decides nothing about videos and runs
/// itself. What commands do is told by WindowCommands, files are opened and left by OpenedFiles.
class MainWindow : public QMainWindow {
    Q_OBJECT

 public:
    explicit MainWindow(QWidget* parent = nullptr);
    ~MainWindow() override;

    /// Does what the command line asked for: opens, and runs when there is no finished run.
    void start(const StartOptions& options);

    ProjectSession& session() { return session_; }
    VideoView& canvas() { return *canvas_; }
    TimelineView& timeline() { return *timeline_; }
    MessageBar& messages() { return *messages_; }
    WindowActions& actions() { return *actions_; }
    OverlaySettings& overlays() { return overlays_; }
    KeyBindings& keys() { return keys_; }
    Inspection& inspection() { return *inspection_; }
    DockRegistry& docks() { return *docks_; }
    ReviewDocks& review() { return *review_; }
    Workspaces& workspaces() { return *workspaces_; }
    LabelWorkspace& labelling() { return *labelling_; }
    EventsDock& events() { return *events_; }
    WatchingDocks& watching() { return *watching_; }
    EventReport& eventReport() { return *event_report_; }
    EvaluationDocks& evaluation() { return *evaluation_; }
    Tuning& tuning() { return *tuning_; }
    LiveStrip& liveStrip() { return *live_strip_; }
    LiveWatching& live() { return *live_; }

 protected:
    void resizeEvent(QResizeEvent* event) override;
    void showEvent(QShowEvent* event) override;
    void closeEvent(QCloseEvent* event) override;
    void dragEnterEvent(QDragEnterEvent* event) override;
    void dropEvent(QDropEvent* event) override;

 private:
    void buildCentre();
    void buildMenus();
    void buildToolBar();
    void buildReview();
    /// Times of the day and places on the earth in the timeline, the status bar and the inspector.
    void buildClock();
    void buildEvaluation();
    void buildRunMessages();
    void buildWorkspaces();
    void wireCanvas();
    void wireSession();
    void showVideo();
    void showPicture();
    void enableActions();
    void updateTitle();
    void focusCanvas();
    bool waitsForWrites();
    bool mayClose();
    /// How high the rows below the video are, by how high the window is.
    void fitRows();

    WindowSettings settings_;
    OverlaySettings overlays_;
    KeyBindings keys_;
    ProjectSession session_;
    bool shown_ = false;    ///< once
    bool closing_ = false;  ///< the user was asked and answered
    bool written_ = false;  ///< what people did is in its files
    WrittenWait write_wait_;

    WindowActions* actions_;
    OverlayColumn* over_canvas_;
    MessageBar* messages_;
    QStackedWidget* stack_;
    WelcomePanel* welcome_;
    VideoView* canvas_;
    TransportBar* transport_;
    TimelineView* timeline_;
    LabelTimeline* label_rows_;
    RunBar* run_bar_;
    bool told_missing_ = false;  ///< that the run has no result of the frame shown
    RunGuard* guard_;
    LiveStrip* live_strip_;
    LiveWatching* live_;
    StatusFields* status_;
    Inspection* inspection_;
    DockRegistry* docks_;
    ReviewDocks* review_;
    EventsDock* events_;
    WatchingDocks* watching_;
    EventReport* event_report_;
    EvaluationSession* measured_;
    EvaluationDocks* evaluation_;
    Tuning* tuning_;
    LabelWorkspace* labelling_ = nullptr;
    OpenedFiles* files_;
    WindowCommands* commands_;
    Workspaces* workspaces_;
};

}  // namespace eyrie::ui
