#include "main_window/main_window.h"

#include <QDockWidget>
#include <QFileDialog>
#include <QFileInfo>
#include <QMenu>
#include <QMenuBar>
#include <QStackedWidget>
#include <QStatusBar>
#include <QToolBar>
#include <QVBoxLayout>
#include <utility>

#include "main_window/evaluation_docks.h"
#include "main_window/label_workspace.h"
#include "main_window/parameter_binding.h"
#include "main_window/review_docks.h"
#include "main_window/run_bar.h"
#include "main_window/status_fields.h"
#include "main_window/timeline_binding.h"
#include "main_window/transport_bar.h"
#include "main_window/tuning.h"
#include "main_window/welcome_panel.h"
#include "main_window/window_actions.h"
#include "panels/message_bar.h"
#include "panels/parameter_form.h"
#include "panels/stage_times_chart.h"
#include "session/inspection.h"
#include "view/label_timeline.h"
#include "view/timeline_view.h"
#include "view/video_view.h"

namespace eyrie::ui {

namespace {
constexpr QSize kFirstSize(1500, 940);

QString pathText(const std::filesystem::path& path) {
    return QString::fromStdString(path.string());
}
}  // namespace

MainWindow::MainWindow(QWidget* parent) : QMainWindow(parent) {
    setObjectName(QStringLiteral("main_window"));
    setWindowIcon(QIcon::fromTheme(QStringLiteral("camera-video")));
    setAcceptDrops(true);
    setDockNestingEnabled(true);
    setTabPosition(Qt::AllDockWidgetAreas, QTabWidget::North);
    // The lists reach down to the timeline, which belongs to the canvas.
    setCorner(Qt::BottomLeftCorner, Qt::LeftDockWidgetArea);
    setCorner(Qt::BottomRightCorner, Qt::RightDockWidgetArea);
    actions_ = new WindowActions(overlays_, this);
    buildCentre();
    buildToolBar();
    resize(kFirstSize);
    inspection_ = new Inspection(session_, this);
    docks_ = new ReviewDocks(session_, *inspection_, *this);
    parameters_ = new ParameterBinding(session_, docks_->parameterForm(), this);
    tuning_ = new Tuning({session_, *canvas_, *docks_, *actions_, parameters_->presets(), overlays_, *this});
    buildEvaluation();
    timeline_binding_ = new TimelineBinding(session_, *timeline_, docks_->stageTimes(), this);
    status_ = new StatusFields(session_, *statusBar());
    buildMenus();
    buildLabelling();
    wireFileActions();
    wirePlaybackActions();
    wireViewActions();
    wireSession();
    wireInspection();
    default_layout_ = saveState();
    restoreGeometry(settings_.geometry());
    restoreState(settings_.layout());
    showTabTitles();
    showRecent();
    enableActions();
    updateTitle();
}

MainWindow::~MainWindow() {
    // Docks that vanish tell their panels, which ask the session: it must be there still.
    hide();
}

// ---- assembly -------------------------------------------------------------------------------------------------------

void MainWindow::buildCentre() {
    messages_ = new MessageBar;
    welcome_ = new WelcomePanel(*actions_);
    canvas_ = new VideoView(overlays_);
    transport_ = new TransportBar(session_, *actions_);
    timeline_ = new TimelineView;
    label_rows_ = new LabelTimeline(*timeline_);
    label_rows_->setFixedHeight(118);
    auto* review = new QWidget;
    auto* rows = new QVBoxLayout(review);
    rows->setContentsMargins(0, 0, 0, 0);
    rows->setSpacing(0);
    rows->addWidget(canvas_, 1);
    rows->addWidget(transport_);
    rows->addWidget(timeline_);
    rows->addWidget(label_rows_);
    stack_ = new QStackedWidget;
    stack_->addWidget(welcome_);
    stack_->addWidget(review);
    auto* centre = new QWidget;
    auto* layout = new QVBoxLayout(centre);
    layout->setContentsMargins(0, 0, 0, 0);
    layout->setSpacing(0);
    layout->addWidget(messages_);
    layout->addWidget(stack_, 1);
    setCentralWidget(centre);
}

void MainWindow::buildToolBar() {
    auto* bar = addToolBar(tr("Run"));
    bar->setObjectName(QStringLiteral("run_bar"));
    bar->setMovable(false);
    bar->addAction(actions_->open_video);
    bar->addSeparator();
    run_bar_ = new RunBar(session_, *actions_);
    run_bar_->setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Preferred);
    bar->addWidget(run_bar_);
    bar->addSeparator();
    bar->addAction(actions_->fit);
    bar->addAction(actions_->one_to_one);
    bar->addWidget(overlayButton(buildOverlayMenu()));
    bar->addSeparator();
    bar->addActions({actions_->review_workspace, actions_->label_workspace});
    connect(run_bar_, &RunBar::editingDone, this, &MainWindow::focusCanvas);
    connect(transport_, &TransportBar::editingDone, this, &MainWindow::focusCanvas);
}

void MainWindow::buildMenus() {
    for (const ActionSection& section : actions_->sections()) {
        QMenu* menu = menuBar()->addMenu(QLatin1Char('&') + section.title);
        menu->addActions(section.actions);
        if (section.actions.contains(actions_->open_project)) {
            recent_menu_ = new QMenu(tr("Open &recent"), menu);
            menu->insertMenu(actions_->save_copy, recent_menu_);
            menu->insertSeparator(actions_->save_copy);
            menu->insertSeparator(actions_->quit);
        }
        if (section.actions.contains(actions_->fit)) {
            menu->addSeparator();
            for (QDockWidget* dock : docks_->docks() + evaluation_->docks()) menu->addAction(dock->toggleViewAction());
            menu->addAction(tr("Reset the layout"), this, [this] {
                actions_->review_workspace->trigger();
                restoreState(default_layout_);
            });
        }
    }
}

void MainWindow::wireFileActions() {
    connect(actions_->open_video, &QAction::triggered, this, &MainWindow::openVideo);
    connect(actions_->open_folder, &QAction::triggered, this, &MainWindow::openFolder);
    connect(actions_->open_project, &QAction::triggered, this, &MainWindow::openProject);
    connect(actions_->save_copy, &QAction::triggered, this, &MainWindow::saveCopy);
    connect(actions_->demo, &QAction::triggered, this, &MainWindow::showDemo);
    connect(actions_->quit, &QAction::triggered, this, &QWidget::close);
    connect(welcome_, &WelcomePanel::recentChosen, this, &MainWindow::openPath);
    connect(actions_->run, &QAction::triggered, &session_, &ProjectSession::startRun);
    connect(actions_->stop, &QAction::triggered, &session_, &ProjectSession::stopRun);
    connect(actions_->follow, &QAction::triggered, &session_, [this](bool on) {
        if (on)
            session_.follow();
        else
            session_.goToFrame(session_.currentFrame());
    });
    connect(docks_, &ReviewDocks::runRequested, actions_->run, &QAction::trigger);
    connect(docks_, &ReviewDocks::parametersRequested, parameters_, &ParameterBinding::adoptRunParameters);
    connect(tuning_, &Tuning::storedParametersRequested, parameters_, &ParameterBinding::adoptRunParameters);
    connect(tuning_, &Tuning::parameterRequested, parameters_, [this](const QString& name, const QString& value) {
        parameters_->setValue(name.toStdString(), value.toStdString());
    });
    connect(tuning_, &Tuning::runRequested, actions_->run, &QAction::trigger);
    docks_->wireSweeps(*parameters_);
    connect(parameters_, &ParameterBinding::problem, this, &MainWindow::showProblem);
    connect(parameters_, &ParameterBinding::notice, this, &MainWindow::showNotice);
}

void MainWindow::wirePlaybackActions() {
    const auto step = [this](QAction* action, int frames) {
        connect(action, &QAction::triggered, &session_, [this, frames] { session_.step(frames); });
    };
    step(actions_->step_back, -1);
    step(actions_->step_on, 1);
    step(actions_->jump_back, -10);
    step(actions_->jump_on, 10);
    connect(actions_->first, &QAction::triggered, &session_, [this] { session_.goToFrame(0); });
    connect(actions_->last, &QAction::triggered, &session_, [this] { session_.step(session_.lastFrame()); });
    connect(actions_->play, &QAction::triggered, &session_, &ProjectSession::togglePlay);
    connect(canvas_, &VideoView::playToggled, actions_->play, &QAction::trigger);
    connect(actions_->shuttle_back, &QAction::triggered, &session_, [this] { session_.shuttle(-1); });
    connect(actions_->shuttle_stop, &QAction::triggered, &session_, [this] { session_.shuttle(0); });
    connect(actions_->shuttle_on, &QAction::triggered, &session_, [this] { session_.shuttle(1); });
    connect(actions_->slower, &QAction::triggered, &session_,
            [this] { session_.playback().setSpeed(session_.playback().speed() / 2, session_.currentFrame()); });
    connect(actions_->faster, &QAction::triggered, &session_,
            [this] { session_.playback().setSpeed(session_.playback().speed() * 2, session_.currentFrame()); });
    connect(actions_->loop, &QAction::toggled, &session_, [this](bool on) { session_.playback().setLooping(on); });
    connect(actions_->go_to_frame, &QAction::triggered, transport_, &TransportBar::focusFrameField);
    connect(&session_.playback(), &Playback::playingChanged, this, [this](bool playing) {
        actions_->play->setIcon(QIcon::fromTheme(playing ? QStringLiteral("media-playback-pause")
                                                         : QStringLiteral("media-playback-start")));
        actions_->play->setText(playing ? tr("&Pause") : tr("&Play"));
    });
}

void MainWindow::wireSession() {
    connect(&session_, &ProjectSession::videoChanged, this, [this] {
        const auto& video = session_.video();
        canvas_->clear(video ? QSize(video->size.width, video->size.height) : QSize());
        stack_->setCurrentIndex(video ? 1 : 0);
        enableActions();
        updateTitle();
    });
    connect(&session_, &ProjectSession::viewFrameChanged, canvas_, &VideoView::setFrame);
    // An empty picture of a run may not look as if nothing was found there.
    connect(&session_, &ProjectSession::viewFrameChanged, this, [this, told = false](const ViewFrame& frame) mutable {
        const bool missing = !frame.result && session_.currentRun() && !session_.running();
        if (std::exchange(told, missing) != missing)
            canvas_->setBadge(missing ? tr("Not processed in this run") : QString());
    });
    connect(&session_, &ProjectSession::viewFrameChanged, evaluation_, &EvaluationDocks::showMarks);
    connect(&session_, &ProjectSession::selectionChanged, canvas_, &VideoView::setSelectedTrack);
    connect(canvas_, &VideoView::trackClicked, &session_, &ProjectSession::selectTrack);
    connect(&session_, &ProjectSession::problem, this, &MainWindow::showProblem);
    connect(&session_, &ProjectSession::notice, this, &MainWindow::showNotice);
    connect(&session_, &ProjectSession::ready, this, &MainWindow::becameReady);
    connect(&session_, &ProjectSession::runFinished, this, &MainWindow::runEnded);
    connect(&session_, &ProjectSession::runStarted, this, &MainWindow::enableActions);
    connect(&session_, &ProjectSession::currentRunChanged, this, &MainWindow::updateTitle);
    connect(&session_, &ProjectSession::projectChanged, this, &MainWindow::enableActions);
    connect(&session_, &ProjectSession::followingChanged, this, [this](bool following) {
        actions_->follow->setChecked(following);
        enableActions();
    });
}

void MainWindow::enableActions() {
    const bool has_video = session_.video().has_value();
    const bool running = session_.running();
    for (const ActionSection& section : actions_->sections())
        for (QAction* action : section.actions)
            if (section.actions.contains(actions_->play) || section.actions.contains(actions_->fit))
                action->setEnabled(has_video);
    actions_->full_screen->setEnabled(true);
    actions_->run->setEnabled(has_video && !running);
    actions_->stop->setEnabled(running);
    actions_->follow->setEnabled(running);
    actions_->save_copy->setEnabled(!session_.project().empty());
}

void MainWindow::updateTitle() {
    QString title = tr("Eyrie");
    if (session_.media()) title = tr("%1 – Eyrie").arg(QString::fromStdString(session_.media()->name));
    setWindowTitle(title);
}

void MainWindow::showProblem(const QString& message) {
    messages_->showMessage(MessageKind::error, message);
}

void MainWindow::showNotice(const QString& message) {
    messages_->showMessage(MessageKind::info, message);
}

void MainWindow::focusCanvas() {
    canvas_->setFocus();
}

// ---- opening and closing
// ---------------------------------------------------------------------------------------------

void MainWindow::start(const StartOptions& options) {
    start_ = options;
    if (options.demo) {
        showDemo();
        return;
    }
    if (options.input.empty()) return;
    run_when_ready_ = true;
    if (options.frame_rate_hz > 0)
        session_.openMedia(videoMedia(options.input, options.frame_rate_hz));
    else
        session_.open(options.input);
}

void MainWindow::openVideo() {
    const QString path = QFileDialog::getOpenFileName(
        this, tr("Open video"), settings_.value(QStringLiteral("folder"), QString()).toString(),
        tr("Videos (*.mp4 *.mkv *.mov *.avi *.ts *.m2ts *.mts *.mpg *.mpeg *.m4v *.webm *.wmv *.mxf);;All files (*)"));
    if (!path.isEmpty()) openPath(path);
}

void MainWindow::openFolder() {
    const QString path = QFileDialog::getExistingDirectory(
        this, tr("Open folder of images"), settings_.value(QStringLiteral("folder"), QString()).toString());
    if (!path.isEmpty()) openPath(path);
}

void MainWindow::openProject() {
    const QString path = QFileDialog::getOpenFileName(this, tr("Open project"),
                                                      settings_.value(QStringLiteral("folder"), QString()).toString(),
                                                      tr("Eyrie projects (*.eyrie);;All files (*)"));
    if (!path.isEmpty()) openPath(path);
}

void MainWindow::openPath(const QString& path) {
    rememberView();
    play_when_done_ = false;
    run_when_ready_ = false;
    settings_.setValue(QStringLiteral("folder"), QFileInfo(path).path());
    session_.open(path.toStdString());
}

void MainWindow::saveCopy() {
    const QString suggestion = QFileInfo(pathText(session_.project())).fileName();
    QString path =
        QFileDialog::getSaveFileName(this, tr("Save project as"), suggestion, tr("Eyrie projects (*.eyrie)"));
    if (path.isEmpty()) return;
    if (QFileInfo(path).suffix().isEmpty()) path += QStringLiteral(".eyrie");
    session_.saveProjectCopy(path.toStdString());
}

void MainWindow::showDemo() {
    rememberView();
    run_when_ready_ = true;
    play_when_done_ = true;
    session_.openMedia(sceneMedia("demo"));
}

void MainWindow::becameReady(bool has_results) {
    const bool run_if_needed = std::exchange(run_when_ready_, false);
    const StartOptions asked = std::exchange(start_, {});
    if (asked.gsd_m_per_px > 0) {
        session_.settings().gsd_m_per_px = asked.gsd_m_per_px;
        run_bar_->refresh();
    }
    if (session_.media() && QFileInfo::exists(QString::fromStdString(session_.media()->identity))) {
        settings_.addRecent(QString::fromStdString(session_.media()->identity));
        showRecent();
    }
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

void MainWindow::runEnded(const RunSummary& summary) {
    enableActions();
    if (summary.outcome == RunOutcome::stopped)
        showNotice(tr("Stopped after %1 of %2 frames. What was done is in the project.")
                       .arg(summary.frames_done)
                       .arg(summary.frames_total));
    if (std::exchange(play_when_done_, false) && summary.outcome == RunOutcome::finished) {
        session_.goToFrame(0);
        session_.togglePlay();
    }
}

void MainWindow::showRecent() {
    const QStringList recent = settings_.recent();
    welcome_->setRecent(recent);
    recent_menu_->clear();
    for (const QString& path : recent)
        recent_menu_->addAction(QFileInfo(path).fileName(), this, [this, path] { openPath(path); })->setToolTip(path);
    recent_menu_->setEnabled(!recent.isEmpty());
    if (recent.isEmpty()) return;
    recent_menu_->setToolTipsVisible(true);
    recent_menu_->addSeparator();
    recent_menu_->addAction(tr("Forget these"), this, [this] {
        settings_.clearRecent();
        showRecent();
    });
}

}  // namespace eyrie::ui
