#include "window/opened_files.h"

#include <QFileDialog>
#include <QFileInfo>
#include <QMainWindow>
#include <QMenu>
#include <utility>

#include "canvas/video_view.h"
#include "core/project_name.h"
#include "io/file_kind.h"
#include "io/video/parts/part_list.h"
#include "session/project/earlier_states.h"
#include "store/health/file_check.h"
#include "widgets/display_text.h"
#include "widgets/message_bar.h"
#include "widgets/wiring.h"
#include "window/bars/run_bar.h"
#include "window/earlier_state_dialog.h"
#include "window/run_guard.h"
#include "window/welcome_panel.h"
#include "workspace/window_actions.h"

namespace eyrie::ui {

namespace {
const QString kFolder = QStringLiteral("folder");
const QString kLeavingTopic = QStringLiteral("leaving");

QString text(const std::filesystem::path& path) {
    return QString::fromStdString(path.string());
}

std::vector<std::filesystem::path> filesOf(const QStringList& paths) {
    std::vector<std::filesystem::path> files;
    for (const QString& path : paths)
        if (!path.isEmpty()) files.emplace_back(path.toStdString());
    return files;
}
}  // namespace

OpenedFiles::OpenedFiles(const FileParts& parts) : QObject(&parts.window), parts_(parts), session_(parts.session) {
    earlier_ = new EarlierStates(earlierStatesAnswers(), this);
    recent_menu_ = new QMenu(tr("Open &recent"), &parts_.window);
    bindActions();
    wireSession();
    showRecent();
}

void OpenedFiles::bindActions() {
    const WindowActions& actions = parts_.actions;
    bindCommands(this, {
                           {actions.open_video, [this] { openVideo(); }},
                           {actions.open_folder, [this] { openFolder(); }},
                           {actions.open_project, [this] { openProject(); }},
                           {actions.save_as, [this] { saveAs(); }},
                           {actions.save_copy, [this] { saveCopy(); }},
                           {actions.restore_state, [this] { chooseEarlierState(); }},
                           {actions.demo, [this] { showDemo(); }},
                           {actions.quit, [this] { parts_.window.close(); }},
                       });
    connect(&parts_.welcome, &WelcomePanel::recentChosen, this, &OpenedFiles::openRecent);
}

void OpenedFiles::wireSession() {
    connect(&session_, &ProjectSession::ready, this, &OpenedFiles::becameReady);
    connect(&session_, &ProjectSession::runFinished, this, &OpenedFiles::runEnded);
    whenChanged(session_, this, {{SessionChange::project, [this] { followProject(); }}});
}

void OpenedFiles::followProject() {
    const std::filesystem::path& project = session_.project();
    if (project.empty()) return;
    if (std::exchange(kept_, project) != project) earlier_->keepIfDue(project);
    if (shown_project_.empty()) return;  // becameReady() follows
    shown_project_ = project;
    rememberProject();
}

void OpenedFiles::start(const StartOptions& options) {
    start_ = options;
    if (options.demo) {
        showDemo();
        return;
    }
    if (options.input.empty()) return;
    run_when_ready_ = !isProject(options.input);
    std::vector<std::filesystem::path> files{options.input};
    files.insert(files.end(), options.further_parts.begin(), options.further_parts.end());
    if (options.frame_rate_hz > 0)
        session_.openMedia(partsMedia(files, {.given_hz = options.frame_rate_hz}));
    else
        session_.open(files);
}

void OpenedFiles::openVideo() {
    const QStringList paths = QFileDialog::getOpenFileNames(
        &parts_.window, tr("Open video, or several files that are one"),
        parts_.settings.value(kFolder, QString()).toString(),
        tr("Videos (%1 *%2);;All files (*)")
            .arg(QString::fromStdString(videoFilePatterns()), QString::fromLatin1(kPartListEnding)),
        nullptr, QFileDialog::HideNameFilterDetails);  // more endings than a dialog is wide
    if (!paths.isEmpty()) open(paths);
}

void OpenedFiles::openFolder() {
    const QString path = QFileDialog::getExistingDirectory(&parts_.window, tr("Open folder of images"),
                                                           parts_.settings.value(kFolder, QString()).toString());
    if (!path.isEmpty()) open(path);
}

void OpenedFiles::openProject() {
    const QString path = QFileDialog::getOpenFileName(
        &parts_.window, tr("Open project"), parts_.settings.value(kFolder, QString()).toString(), projectOrAnyFilter());
    if (!path.isEmpty()) open(path);
}

void OpenedFiles::locateVideo() {
    const QFileInfo missing(QString::fromStdString(session_.media() ? session_.media()->identity : std::string()));
    const QString folder = QFileInfo(text(session_.project())).path();
    const QString title = tr("Locate %1").arg(missing.fileName());
    // A folder of images has no ending by which it could be told from a file.
    const QStringList paths = missing.suffix().isEmpty()
                                  ? QStringList{QFileDialog::getExistingDirectory(&parts_.window, title, folder)}
                                  : QFileDialog::getOpenFileNames(&parts_.window, title, folder);
    session_.locateVideo(filesOf(paths));
}

void OpenedFiles::endWork(const QString& doing, std::function<void()> then) {
    parts_.guard.beforeEnding(doing, [this, doing, then = std::move(then)] {
        parts_.messages.dismissTopic(kLeavingTopic);
        leave_wait_.watch();
        session_.endWork();
        if (!leave_wait_.anythingDue()) {
            if (mayLeave()) then();
            return;
        }
        parts_.messages.showTopic(kLeavingTopic, MessageKind::info, tr("Saving your last changes first."));
        leave_wait_.begin([this, doing, then](bool) {
            parts_.messages.dismissTopic(kLeavingTopic);
            if (!mayLeave()) return;
            // A run may have been begun meanwhile, and by its end there may be more to save.
            if (session_.running())
                endWork(doing, then);
            else
                then();
        });
    });
}

/// What could not be written is told by its owner, and is to be read; asked for again, it is left.
bool OpenedFiles::mayLeave() {
    if (!leave_wait_.anythingFailed()) return true;
    parts_.messages.showTopic(kLeavingTopic, MessageKind::warning,
                              tr("Not all of your last changes could be saved, so nothing else was opened. Ask for it "
                                 "again to go on without them."));
    return false;
}

void OpenedFiles::leave(std::function<void()> then) {
    endWork(tr("something else is opened"), [this, then = std::move(then)] {
        rememberView();
        play_when_done_ = false;
        run_when_ready_ = false;
        parts_.messages.dismissAll();
        then();
    });
}

void OpenedFiles::open(const QStringList& paths) {
    leave([this, paths] {
        parts_.settings.setValue(kFolder, QFileInfo(paths.front()).path());
        session_.open(filesOf(paths));
    });
}

void OpenedFiles::openRecent(const RecentProject& project) {
    leave([this, project] {
        if (!project.project.isEmpty() && (QFileInfo::exists(project.project) || project.video.isEmpty()))
            session_.openProject(project.project.toStdString());
        else
            session_.openMedia(mediaOfIdentity(project.video.toStdString()));
    });
}

QString OpenedFiles::chosenTarget(const QString& title) {
    // No file that is there is replaced, so nobody needs to be asked about that.
    const QString path = QFileDialog::getSaveFileName(&parts_.window, title, text(session_.project()), projectFilter(),
                                                      nullptr, QFileDialog::DontConfirmOverwrite);
    return withEnding(path, kProjectEnding);
}

void OpenedFiles::saveAs() {
    const QString path = chosenTarget(tr("Save project as"));
    if (!path.isEmpty()) session_.saveProjectAs(path.toStdString());
}

void OpenedFiles::saveCopy() {
    const QString path = chosenTarget(tr("Save a copy of the project"));
    if (!path.isEmpty()) session_.saveProjectCopy(path.toStdString());
}

EarlierStatesAnswers OpenedFiles::earlierStatesAnswers() {
    return {
        .show =
            [this](const std::vector<EarlierState>& states) {
                if (earlier_dialog_) earlier_dialog_->show(states);
            },
        .open =
            [this](const std::filesystem::path& project) {
                restoring_.clear();
                leave([this, project] { session_.openProject(project); });
            },
        .fail =
            [this](const QString& text) {
                if (earlier_dialog_) earlier_dialog_->showProblem(text);
                parts_.messages.showMessage(MessageKind::error, text);
                if (const auto project = std::exchange(restoring_, {}); !project.empty()) session_.openProject(project);
            },
        .tell = [this](const QString& text) { parts_.messages.showMessage(MessageKind::info, text); },
    };
}

void OpenedFiles::chooseEarlierState() {
    const std::filesystem::path project = session_.project();
    const EarlierStateCommands commands{
        .restore = [this, project](const ProjectBackup& backup) { restore(project, backup); },
        .open_as_new =
            [this, project](const ProjectBackup& backup) {
                const std::string name = project.stem().string() + " " + backup.name() + project.extension().string();
                earlier_->restoreAsNew(backup, project.parent_path() / name);
            },
    };
    earlier_dialog_ = new EarlierStateDialog(project, commands, &parts_.window);
    earlier_dialog_->setAttribute(Qt::WA_DeleteOnClose);
    earlier_dialog_->open();
    earlier_->list(project);
}

void OpenedFiles::restore(const std::filesystem::path& project, const ProjectBackup& backup) {
    endWork(tr("an earlier state is restored"), [this, project, backup] {
        rememberView();
        restoring_ = project;
        session_.closeProject();
        earlier_->restore(project, backup);
    });
}

void OpenedFiles::showDemo() {
    leave([this] {
        run_when_ready_ = true;
        play_when_done_ = true;
        session_.openMedia(sceneMedia("demo"));
    });
}

void OpenedFiles::becameReady(bool has_results) {
    const bool run_if_needed = std::exchange(run_when_ready_, false);
    const StartOptions asked = std::exchange(start_, {});
    if (asked.gsd_m_per_px > 0) {
        session_.settings().useGsd(asked.gsd_m_per_px);
        parts_.run_bar.refresh();
    }
    rememberProject();
    shown_project_ = session_.project();
    restoreView();
    parts_.canvas.setFocus();
    // Another scale than that of the run shown is another result.
    const bool other_scale =
        asked.gsd_m_per_px > 0 && has_results && session_.scale().gsd_m_per_px != asked.gsd_m_per_px;
    if (asked.run || other_scale || (run_if_needed && !has_results))
        session_.startRun();
    else if (run_if_needed)
        session_.togglePlay();
    if (play_when_done_) parts_.actions.loop->setChecked(true);
}

void OpenedFiles::rememberProject() {
    if (session_.project().empty() || !session_.media()) return;
    parts_.settings.addRecent({text(session_.project()), QString::fromStdString(session_.media()->identity)});
    showRecent();
}

void OpenedFiles::runEnded(const RunSummary& summary) {
    if (std::exchange(play_when_done_, false) && summary.outcome == RunOutcome::finished) {
        session_.goToFrame(0);
        session_.togglePlay();
    }
}

void OpenedFiles::showRecent() {
    const QList<RecentProject> recent = parts_.settings.recent();
    parts_.welcome.setRecent(recent);
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
        parts_.settings.clearRecent();
        showRecent();
    });
}

void OpenedFiles::restoreView() {
    const ProjectView view = parts_.settings.projectView(session_.project());
    if (view.zoom > 0)
        parts_.canvas.restore(view.zoom, view.centre);
    else
        parts_.canvas.fit();
    if (view.frame > 0) session_.goToFrame(view.frame);
}

void OpenedFiles::rememberView() {
    if (shown_project_.empty()) return;
    const ViewTransform& transform = parts_.canvas.transform();
    const QPointF middle(transform.viewSize().width() / 2, transform.viewSize().height() / 2);
    parts_.settings.setProjectView(shown_project_, {transform.fitted() ? 0 : transform.zoom(),
                                                    transform.imageFromView(middle), session_.currentFrame()});
    shown_project_.clear();
}

}  // namespace eyrie::ui

#include "moc_opened_files.cpp"
