#include "window/main_window.h"

#include <QDockWidget>
#include <QMenu>
#include <QMenuBar>
#include <QScreen>
#include <QStackedWidget>
#include <QStatusBar>
#include <QToolBar>
#include <QVBoxLayout>
#include <filesystem>
#include <utility>

#include "canvas/timeline/timeline_view.h"
#include "canvas/video_view.h"
#include "label/canvas/label_timeline.h"
#include "label/label_workspace.h"
#include "review/run_text.h"
#include "review/runs_model.h"
#include "session/project/earlier_states.h"
#include "tune/inspect/inspection.h"
#include "tune/parameters/parameter_binding.h"
#include "widgets/charts/stage_times_chart.h"
#include "widgets/message_bar.h"
#include "widgets/parameters/parameter_form.h"
#include "window/bars/run_bar.h"
#include "window/bars/status_fields.h"
#include "window/bars/transport_bar.h"
#include "window/docks/evaluation_docks.h"
#include "window/docks/review_docks.h"
#include "window/docks/tuning.h"
#include "window/run_guard.h"
#include "window/welcome_panel.h"
#include "workspace/dock_registry.h"
#include "workspace/timeline_binding.h"
#include "workspace/window_actions.h"
#include "workspace/workspaces.h"

namespace eyrie::ui {

namespace {
constexpr QSize kFirstSize(1500, 940);
/// What messages are about; a later one about the same takes the place of the former.
const QString kGsdTopic = QStringLiteral("gsd");
const QString kRunTopic = QStringLiteral("run");
const QString kVideoTopic = QStringLiteral("video");
}  // namespace

MainWindow::MainWindow(QWidget* parent) : QMainWindow(parent) {
    setObjectName(QStringLiteral("main_window"));
    setAcceptDrops(true);
    // The lists reach down to the timeline, which belongs to the canvas.
    setCorner(Qt::BottomLeftCorner, Qt::LeftDockWidgetArea);
    setCorner(Qt::BottomRightCorner, Qt::RightDockWidgetArea);
    actions_ = new WindowActions(overlays_, this);
    keys_.add({QString(), actions_->sections()});
    buildCentre();
    buildToolBar();
    resize(kFirstSize.boundedTo(screen()->availableSize()));
    guard_ = new RunGuard(session_, *this);
    earlier_ = new EarlierStates(this);
    inspection_ = new Inspection(session_, this);
    docks_ = new DockRegistry(*this);
    review_ = new ReviewDocks(session_, *inspection_, *docks_);
    ParameterForm& form = review_->parameterForm();
    parameters_ = new ParameterBinding(session_, form, this);
    tuning_ = new Tuning({session_, *canvas_, *docks_, form, *actions_, parameters_->presets(), overlays_, *this});
    buildEvaluation();
    timeline_binding_ = new TimelineBinding(session_, *timeline_, review_->stageTimes(), this);
    status_ = new StatusFields(session_, *statusBar());
    buildLabelling();
    buildMenus();
    wireFileActions();
    wireEarlierStates();
    wirePlaybackActions();
    wireViewActions();
    wireSession();
    wireInspection();
    restoreGeometry(settings_.geometry());
    buildWorkspaces();
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
    for (QAction* action : actions_->workspace) bar->addAction(action);
    connect(run_bar_, &RunBar::editingDone, this, &MainWindow::focusCanvas);
    connect(transport_, &TransportBar::editingDone, this, &MainWindow::focusCanvas);
}

void MainWindow::buildMenus() {
    for (const ActionSection& section : actions_->sections()) {
        if (section.actions.contains(actions_->next_error)) menuBar()->addMenu(labelling_->menu());
        QMenu* menu = menuBar()->addMenu(QLatin1Char('&') + section.title);
        menu->addActions(section.actions);
        if (section.actions.contains(actions_->open_project)) {
            recent_menu_ = new QMenu(tr("Open &recent"), menu);
            menu->insertMenu(actions_->save_as, recent_menu_);
            menu->insertSeparator(actions_->save_as);
            menu->insertSeparator(actions_->quit);
        }
        if (section.actions.contains(actions_->fit)) {
            menu->addSeparator();
            for (const DockId id : allDocks())
                if (docks_->dock(id) != nullptr) menu->addAction(docks_->dock(id)->toggleViewAction());
            menu->addAction(tr("Reset the layout"), this, [this] { workspaces_->reset(); });
        }
    }
}

void MainWindow::wireFileActions() {
    connect(actions_->open_video, &QAction::triggered, this, &MainWindow::openVideo);
    connect(actions_->open_folder, &QAction::triggered, this, &MainWindow::openFolder);
    connect(actions_->open_project, &QAction::triggered, this, &MainWindow::openProject);
    connect(actions_->save_as, &QAction::triggered, this, &MainWindow::saveAs);
    connect(actions_->save_copy, &QAction::triggered, this, &MainWindow::saveCopy);
    connect(actions_->restore_state, &QAction::triggered, this, &MainWindow::chooseEarlierState);
    connect(actions_->demo, &QAction::triggered, this, &MainWindow::showDemo);
    connect(actions_->quit, &QAction::triggered, this, &QWidget::close);
    connect(welcome_, &WelcomePanel::recentChosen, this, &MainWindow::openRecent);
    connect(actions_->run, &QAction::triggered, this, &MainWindow::startRun);
    connect(actions_->stop, &QAction::triggered, &session_, &ProjectSession::stopRun);
    connect(actions_->follow, &QAction::triggered, &session_, [this](bool on) {
        if (on)
            session_.follow();
        else
            session_.goToFrame(session_.currentFrame());
    });
    connect(actions_->continue_run, &QAction::triggered, &session_, [this] {
        if (session_.currentRun()) session_.continueRun(*session_.currentRun());
    });
    connect(review_, &ReviewDocks::continueRequested, &session_, &ProjectSession::continueRun);
    connect(actions_->restore_run, &QAction::triggered, &session_, [this] {
        if (!session_.removedRuns().empty()) session_.restoreRun(session_.removedRuns().back().id);
    });
    connect(review_, &ReviewDocks::minScoreChanged, &overlays_, &OverlaySettings::setMinScore);
    connect(review_, &ReviewDocks::runRequested, actions_->run, &QAction::trigger);
    connect(review_, &ReviewDocks::removeRequested, guard_, &RunGuard::remove);
    connect(review_, &ReviewDocks::parametersRequested, parameters_, &ParameterBinding::adoptRunParameters);
    connect(tuning_, &Tuning::storedParametersRequested, parameters_, &ParameterBinding::adoptRunParameters);
    connect(tuning_, &Tuning::parameterRequested, parameters_, [this](const QString& name, const QString& value) {
        parameters_->setValue(name.toStdString(), value.toStdString());
    });
    connect(tuning_, &Tuning::runRequested, actions_->run, &QAction::trigger);
    review_->wireSweeps(*parameters_);
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
    connect(&session_, &ProjectSession::ready, this, [this](bool has_results) {
        messages_->dismissTopic(kRunTopic);  // a run of the former video may have been summarised meanwhile
        becameReady(has_results);
    });
    connect(&session_, &ProjectSession::runFinished, this, &MainWindow::runEnded);
    connect(&session_, &ProjectSession::runStarted, this, &MainWindow::enableActions);
    connect(&session_, &ProjectSession::runsChanged, this, &MainWindow::enableActions);
    connect(&session_, &ProjectSession::currentRunChanged, this, &MainWindow::enableActions);
    connect(&session_, &ProjectSession::projectChanged, this, &MainWindow::enableActions);
    connect(&session_, &ProjectSession::projectChanged, this, &MainWindow::updateTitle);
    connect(&session_, &ProjectSession::projectChanged, this, [this] {
        if (shown_project_.empty() || session_.project().empty()) return;  // becameReady() follows
        shown_project_ = session_.project();
        rememberProject();
    });
    wireRunMessages();
    connect(&session_, &ProjectSession::followingChanged, this, [this](bool following) {
        actions_->follow->setChecked(following);
        enableActions();
    });
}

void MainWindow::wireRunMessages() {
    connect(&session_, &ProjectSession::runSummarised, this, [this](const RunRecord& run, const RunFacts& facts) {
        const bool doubtful = facts.counts.tracks == 0 || facts.state == RunState::failed;
        messages_->showTopic(kRunTopic, doubtful ? MessageKind::warning : MessageKind::info, runSummaryText(run, facts),
                             tr("Show the tracks"), [this] { docks_->raise(DockId::tracks); });
    });
    connect(&session_, &ProjectSession::runPreparing, this, [this] {
        // What was wrong with the former run, or kept this one from starting, is of no use any more.
        messages_->dismiss(MessageKind::error);
        messages_->dismissTopic(kRunTopic);
    });
    connect(&session_, &ProjectSession::runRemoved, this, [this](const RunRecord& run) {
        messages_->showTopic(
            kRunTopic, MessageKind::info,
            tr("Removed “%1”. It can be brought back until the project is closed.").arg(shownName(run)),
            tr("Bring it back"), [this, id = run.id] { session_.restoreRun(id); });
    });
    connect(&session_, &ProjectSession::videoNotFound, this, [this](const QString& message) {
        messages_->showTopic(kVideoTopic, MessageKind::warning,
                             tr("%1. The results can be viewed without it.").arg(message), tr("Locate…"),
                             [this] { locateVideo(); });
    });
    connect(run_bar_, &RunBar::gsdRefused, this,
            [this](const QString& message) { messages_->showTopic(kGsdTopic, MessageKind::error, message); });
    connect(run_bar_, &RunBar::gsdTouched, this, [this] { messages_->dismissTopic(kGsdTopic); });
}

void MainWindow::startRun() {
    if (run_bar_->takeEdits()) session_.startRun();
}

void MainWindow::enableActions() {
    const bool has_video = session_.video().has_value();
    const bool running = session_.running();
    for (const ActionSection& section : actions_->sections())
        for (QAction* action : section.actions)
            if (section.actions.contains(actions_->play) || section.actions.contains(actions_->fit))
                action->setEnabled(has_video);
    actions_->full_screen->setEnabled(true);
    for (QAction* action : actions_->workspace) action->setEnabled(true);
    actions_->run->setEnabled(has_video && !running);
    actions_->stop->setEnabled(running);
    actions_->continue_run->setEnabled(session_.currentRun() && session_.canContinue(*session_.currentRun()));
    actions_->follow->setEnabled(running);
    actions_->save_as->setEnabled(has_video && !running);
    actions_->restore_state->setEnabled(!session_.project().empty());
    actions_->save_copy->setEnabled(!session_.project().empty());
    actions_->restore_run->setEnabled(!session_.removedRuns().empty());
}

void MainWindow::updateTitle() {
    QStringList parts;
    if (session_.media()) parts << QString::fromStdString(session_.media()->name);
    if (!session_.project().empty()) parts << QString::fromStdString(session_.project().filename().string());
    setWindowTitle((parts << tr("Eyrie")).join(QStringLiteral(" – ")));
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

}  // namespace eyrie::ui
