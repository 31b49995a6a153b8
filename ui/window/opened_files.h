#pragma once

#include <QObject>
#include <QPointer>
#include <filesystem>
#include <functional>

#include "session/background/written_wait.h"
#include "session/project_session.h"
#include "store/backup/project_backup.h"
#include "window/start_options.h"
#include "window/window_settings.h"

class QMainWindow;
class QMenu;

namespace eyrie::ui {

class EarlierStateDialog;
class EarlierStates;
struct EarlierStatesAnswers;
class MessageBar;
class RunBar;
class RunGuard;
class VideoView;
class WelcomePanel;
class WindowActions;

/// What opening and leaving files touches. All must outlive OpenedFiles.
struct FileParts {
    ProjectSession& session;
    WindowSettings& settings;
    WindowActions& actions;
    MessageBar& messages;
    RunGuard& guard;
    RunBar& run_bar;
    WelcomePanel& welcome;
    VideoView& canvas;
    QMainWindow& window;
};

/// Opens, saves and leaves videos and projects: what the commands about files do, what was opened lately, earlier
/// states of a project, and how each project was looked at last.
class OpenedFiles : public QObject {
    Q_OBJECT

 public:
    explicit OpenedFiles(const FileParts& parts);

    /// Does what the command line asked for: opens, and runs when there is no finished run.
    void start(const StartOptions& options);
    void open(const QString& path) { open(QStringList{path}); }
    /// Several: the parts of one video.
    void open(const QStringList& paths);
    /// Asks where the video is that the project misses.
    void locateVideo();
    /// Keeps zoom, place and frame for the next time the project is opened.
    void rememberView();
    QMenu* recentMenu() const { return recent_menu_; }

 private:
    void bindActions();
    void wireSession();
    EarlierStatesAnswers earlierStatesAnswers();
    void followProject();
    void openVideo();
    void openFolder();
    void openProject();
    void openRecent(const RecentProject& project);
    void showDemo();
    void saveAs();
    void saveCopy();
    QString chosenTarget(const QString& title);
    void chooseEarlierState();
    void restore(const std::filesystem::path& project, const ProjectBackup& backup);
    void leave(std::function<void()> then);
    /// Ends what runs, and lets what people did last go into its files before `then`.
    void endWork(const QString& doing, std::function<void()> then);
    bool mayLeave();
    void becameReady(bool has_results);
    void runEnded(const RunSummary& summary);
    void rememberProject();
    void showRecent();
    void restoreView();

    FileParts parts_;
    ProjectSession& session_;
    StartOptions start_;           ///< what is still to be done of it
    bool run_when_ready_ = false;  ///< opened from the command line, by the demo or by dropping: run if there is no run
    bool play_when_done_ = false;
    std::filesystem::path kept_;           ///< the project whose earlier states are looked after
    std::filesystem::path shown_project_;  ///< whose view is to be remembered
    std::filesystem::path restoring_;      ///< the project that was closed to become what it was
    EarlierStates* earlier_;
    QPointer<EarlierStateDialog> earlier_dialog_;  ///< while it is open
    QMenu* recent_menu_;
    WrittenWait leave_wait_;
};

}  // namespace eyrie::ui
