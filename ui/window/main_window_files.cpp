// The part of MainWindow that opens, saves and leaves files.
#include <QFileDialog>
#include <QFileInfo>
#include <QMenu>
#include <utility>

#include "store/health/file_check.h"
#include "widgets/message_bar.h"
#include "window/bars/run_bar.h"
#include "window/earlier_state_dialog.h"
#include "window/main_window.h"
#include "window/run_guard.h"
#include "window/welcome_panel.h"
#include "workspace/window_actions.h"

namespace eyrie::ui {

namespace {
const QString kFolder = QStringLiteral("folder");

QString text(const std::filesystem::path& path) {
    return QString::fromStdString(path.string());
}
}  // namespace

void MainWindow::start(const StartOptions& options) {
    start_ = options;
    if (options.workspace) workspaces_->open(*options.workspace);
    if (options.demo) {
        showDemo();
        return;
    }
    if (options.input.empty()) return;
    run_when_ready_ = !isProject(options.input);
    if (options.frame_rate_hz > 0)
        session_.openMedia(videoMedia(options.input, {.given_hz = options.frame_rate_hz}));
    else
        session_.open(options.input);
}

void MainWindow::openVideo() {
    const QString path = QFileDialog::getOpenFileName(
        this, tr("Open video"), settings_.value(kFolder, QString()).toString(),
        tr("Videos (*.mp4 *.mkv *.mov *.avi *.ts *.m2ts *.mts *.mpg *.mpeg *.m4v *.webm *.wmv *.mxf);;All files (*)"));
    if (!path.isEmpty()) openPath(path);
}

void MainWindow::openFolder() {
    const QString path = QFileDialog::getExistingDirectory(this, tr("Open folder of images"),
                                                           settings_.value(kFolder, QString()).toString());
    if (!path.isEmpty()) openPath(path);
}

void MainWindow::openProject() {
    const QString path =
        QFileDialog::getOpenFileName(this, tr("Open project"), settings_.value(kFolder, QString()).toString(),
                                     tr("Eyrie projects (*.eyrie);;All files (*)"));
    if (!path.isEmpty()) openPath(path);
}

void MainWindow::locateVideo() {
    const QFileInfo missing(QString::fromStdString(session_.media() ? session_.media()->identity : std::string()));
    const QString folder = QFileInfo(text(session_.project())).path();
    const QString title = tr("Locate %1").arg(missing.fileName());
    // A folder of images has no ending by which it could be told from a file.
    const QString path = missing.suffix().isEmpty() ? QFileDialog::getExistingDirectory(this, title, folder)
                                                    : QFileDialog::getOpenFileName(this, title, folder);
    if (!path.isEmpty()) session_.locateVideo(path.toStdString());
}

void MainWindow::leave(std::function<void()> then) {
    guard_->beforeEnding(tr("something else is opened"), [this, then = std::move(then)] {
        rememberView();
        play_when_done_ = false;
        run_when_ready_ = false;
        messages_->dismissAll();
        then();
    });
}

void MainWindow::openPath(const QString& path) {
    leave([this, path] {
        settings_.setValue(kFolder, QFileInfo(path).path());
        session_.open(path.toStdString());
    });
}

void MainWindow::openRecent(const RecentProject& project) {
    leave([this, project] {
        if (!project.project.isEmpty() && (QFileInfo::exists(project.project) || project.video.isEmpty()))
            session_.openProject(project.project.toStdString());
        else
            session_.openMedia(mediaOfIdentity(project.video.toStdString()));
    });
}

QString MainWindow::chosenTarget(const QString& title) {
    // No file that is there is replaced, so nobody needs to be asked about that.
    QString path = QFileDialog::getSaveFileName(this, title, text(session_.project()), tr("Eyrie projects (*.eyrie)"),
                                                nullptr, QFileDialog::DontConfirmOverwrite);
    if (!path.isEmpty() && QFileInfo(path).suffix() != QStringLiteral("eyrie")) path += QStringLiteral(".eyrie");
    return path;
}

void MainWindow::saveAs() {
    const QString path = chosenTarget(tr("Save project as"));
    if (!path.isEmpty()) session_.saveProjectAs(path.toStdString());
}

void MainWindow::saveCopy() {
    const QString path = chosenTarget(tr("Save a copy of the project"));
    if (!path.isEmpty()) session_.saveProjectCopy(path.toStdString());
}

void MainWindow::wireEarlierStates() {
    connect(&session_, &ProjectSession::projectChanged, this, [this, kept = std::filesystem::path()]() mutable {
        if (session_.project().empty() || session_.project() == kept) return;
        kept = session_.project();
        earlier_->keepIfDue(kept);
    });
    connect(earlier_, &EarlierStates::notice, this, &MainWindow::showNotice);
    connect(earlier_, &EarlierStates::restored, this, [this](const std::filesystem::path& project) {
        restoring_.clear();
        leave([this, project] { session_.openProject(project); });
    });
    connect(earlier_, &EarlierStates::failed, this, [this](const QString& message) {
        showProblem(message);
        if (const auto project = std::exchange(restoring_, {}); !project.empty()) session_.openProject(project);
    });
}

void MainWindow::chooseEarlierState() {
    const std::filesystem::path project = session_.project();
    auto* dialog = new EarlierStateDialog(*earlier_, project, this);
    dialog->setAttribute(Qt::WA_DeleteOnClose);
    connect(dialog, &EarlierStateDialog::restoreChosen, this, [this, project](const ProjectBackup& backup) {
        guard_->beforeEnding(tr("an earlier state is restored"), [this, project, backup] {
            rememberView();
            restoring_ = project;
            session_.closeProject();
            earlier_->restore(project, backup);
        });
    });
    connect(dialog, &EarlierStateDialog::openChosen, earlier_, [this, project](const ProjectBackup& backup) {
        const std::string name = project.stem().string() + " " + backup.name() + project.extension().string();
        earlier_->restoreAsNew(backup, project.parent_path() / name);
    });
    dialog->open();
}

void MainWindow::showDemo() {
    leave([this] {
        run_when_ready_ = true;
        play_when_done_ = true;
        session_.openMedia(sceneMedia("demo"));
    });
}

void MainWindow::becameReady(bool has_results) {
    const bool run_if_needed = std::exchange(run_when_ready_, false);
    const StartOptions asked = std::exchange(start_, {});
    if (asked.gsd_m_per_px > 0) {
        session_.settings().gsd_m_per_px = asked.gsd_m_per_px;
        run_bar_->refresh();
    }
    rememberProject();
    shown_project_ = session_.project();
    restoreView();
    focusCanvas();
    // Another scale than that of the run shown is another result.
    const bool other_scale =
        asked.gsd_m_per_px > 0 && has_results && session_.scale().gsd_m_per_px != asked.gsd_m_per_px;
    if (asked.run || other_scale || (run_if_needed && !has_results))
        session_.startRun();
    else if (run_if_needed)
        session_.togglePlay();
    if (play_when_done_) actions_->loop->setChecked(true);
}

void MainWindow::rememberProject() {
    if (session_.project().empty() || !session_.media()) return;
    settings_.addRecent({text(session_.project()), QString::fromStdString(session_.media()->identity)});
    showRecent();
}

void MainWindow::runEnded(const RunSummary& summary) {
    enableActions();
    if (std::exchange(play_when_done_, false) && summary.outcome == RunOutcome::finished) {
        session_.goToFrame(0);
        session_.togglePlay();
    }
}

void MainWindow::showRecent() {
    const QList<RecentProject> recent = settings_.recent();
    welcome_->setRecent(recent);
    recent_menu_->clear();
    for (const RecentProject& project : recent) {
        const QString name =
            project.folder().isEmpty() ? project.name() : tr("%1  –  %2").arg(project.name(), project.folder());
        // An ampersand in a name is no key.
        QAction* action = recent_menu_->addAction(QString(name).replace(QLatin1Char('&'), QStringLiteral("&&")), this,
                                                  [this, project] { openRecent(project); });
        action->setToolTip(project.project);
    }
    recent_menu_->setEnabled(!recent.isEmpty());
    if (recent.isEmpty()) return;
    recent_menu_->setToolTipsVisible(true);
    recent_menu_->addSeparator();
    recent_menu_->addAction(tr("Clear this list"), this, [this] {
        settings_.clearRecent();
        showRecent();
    });
}

}  // namespace eyrie::ui
