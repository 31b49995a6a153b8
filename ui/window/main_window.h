#pragma once

#include <QMainWindow>
#include <functional>
#include <memory>

#include "canvas/overlay_settings.h"
#include "session/project_session.h"
#include "window/start_options.h"
#include "window/window_settings.h"
#include "workspace/key_bindings.h"

class QMenu;
class QStackedWidget;

namespace eyrie::ui {

class DockRegistry;
class EarlierStates;
class EvaluationDocks;
class Inspection;
class LabelTimeline;
class LabelWorkspace;
class MessageBar;
class ParameterBinding;
class ReviewDocks;
class RunBar;
class RunGuard;
class StatusFields;
class TimelineBinding;
class TimelineView;
class TransportBar;
class Tuning;
class VideoView;
class WelcomePanel;
class WindowActions;
class Workspaces;

/// The window: menus, docks, canvas and timeline, joined with the session. Decides nothing about videos and runs
/// itself.
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
    EvaluationDocks& evaluation() { return *evaluation_; }
    Tuning& tuning() { return *tuning_; }

 protected:
    void showEvent(QShowEvent* event) override;
    void closeEvent(QCloseEvent* event) override;
    void dragEnterEvent(QDragEnterEvent* event) override;
    void dropEvent(QDropEvent* event) override;

 private:
    void buildCentre();
    void buildMenus();
    void buildToolBar();
    QMenu* buildOverlayMenu();
    QWidget* overlayButton(QMenu* menu);
    void wireFileActions();
    void wirePlaybackActions();
    void wireViewActions();
    void wireSession();
    void wireInspection();
    void buildLabelling();
    void buildEvaluation();
    void buildWorkspaces();
    void wireRunMessages();
    void openVideo();
    void openFolder();
    void openProject();
    void locateVideo();
    void saveAs();
    void saveCopy();
    QString chosenTarget(const QString& title);
    void openPath(const QString& path);
    void openRecent(const RecentProject& project);
    void wireEarlierStates();
    void chooseEarlierState();
    void leave(std::function<void()> then);
    void rememberProject();
    void showDemo();
    void startRun();
    void showProblem(const QString& message);
    void showNotice(const QString& message);
    void becameReady(bool has_results);
    void runEnded(const RunSummary& summary);
    void enableActions();
    void updateTitle();
    void showRecent();
    void restoreView();
    void rememberView();
    void focusCanvas();

    WindowSettings settings_;
    OverlaySettings overlays_;
    KeyBindings keys_;
    ProjectSession session_;
    StartOptions start_;           ///< what is still to be done of it
    bool run_when_ready_ = false;  ///< opened from the command line, by the demo or by dropping: run if there is no run
    bool play_when_done_ = false;
    bool closing_ = false;                 ///< the user was asked and answered
    std::filesystem::path shown_project_;  ///< whose view is to be remembered

    WindowActions* actions_;
    MessageBar* messages_;
    QStackedWidget* stack_;
    WelcomePanel* welcome_;
    VideoView* canvas_;
    TransportBar* transport_;
    TimelineView* timeline_;
    LabelTimeline* label_rows_;
    RunBar* run_bar_;
    RunGuard* guard_;
    EarlierStates* earlier_;
    std::filesystem::path restoring_;  ///< the project that was closed to become what it was
    StatusFields* status_;
    Inspection* inspection_;
    DockRegistry* docks_;
    ReviewDocks* review_;
    EvaluationDocks* evaluation_;
    Tuning* tuning_;
    LabelWorkspace* labelling_;
    ParameterBinding* parameters_;
    TimelineBinding* timeline_binding_;
    QMenu* recent_menu_;
    Workspaces* workspaces_;
};

}  // namespace eyrie::ui
