#include "window/main_window.h"

#include <QAbstractItemView>
#include <QApplication>
#include <QCloseEvent>
#include <QDockWidget>
#include <QDragEnterEvent>
#include <QMenu>
#include <QMenuBar>
#include <QMimeData>
#include <QPixmapCache>
#include <QResizeEvent>
#include <QScreen>
#include <QStackedWidget>
#include <QStatusBar>
#include <QToolBar>
#include <QVBoxLayout>
#include <algorithm>
#include <utility>

#include "canvas/timeline/timeline_view.h"
#include "canvas/video_view.h"
#include "io/live/live_address.h"
#include "label/canvas/label_timeline.h"
#include "label/label_workspace.h"
#include "review/events/event_review.h"
#include "review/events/events_dock.h"
#include "tune/compare/live_preview.h"
#include "tune/evaluate/evaluation_session.h"
#include "tune/inspect/inspection.h"
#include "widgets/layout/overlay_column.h"
#include "widgets/layout/top_overlay.h"
#include "widgets/message_bar.h"
#include "widgets/wiring.h"
#include "window/bars/overlay_button.h"
#include "window/bars/picture_button.h"
#include "window/bars/run_bar.h"
#include "window/bars/status_fields.h"
#include "window/bars/transport_bar.h"
#include "window/docks/clock_display.h"
#include "window/docks/evaluation_docks.h"
#include "window/docks/event_report.h"
#include "window/docks/inspection_on_canvas.h"
#include "window/docks/review_docks.h"
#include "window/docks/tracks_and_events.h"
#include "window/docks/tuning.h"
#include "window/docks/watching_docks.h"
#include "window/handover/run_handover.h"
#include "window/live/live_strip.h"
#include "window/live/live_watching.h"
#include "window/opened_files.h"
#include "window/run_guard.h"
#include "window/run_messages.h"
#include "window/welcome_panel.h"
#include "window/window_commands.h"
#include "workspace/dock_registry.h"
#include "workspace/focused_keys.h"
#include "workspace/timeline_binding.h"
#include "workspace/timeline_thumbnails.h"
#include "workspace/window_actions.h"
#include "workspace/workspaces.h"

namespace eyrie::ui {

namespace {
constexpr QSize kFirstSize(1500, 940);
constexpr QSize kFrame(12, 36);  ///< what a window manager may put around it
/// The style keeps a picture of every button that ever was, and messages bring new ones all the time.
constexpr int kStyleCache_kB = 2048;
constexpr int kLowWindow_px = 800;      ///< below, rows under the video make room for it
constexpr int kLeastLabelRows_px = 51;  ///< three objects
constexpr int kMostLabelRows_px = 118;
const QString kWorkspaces = QStringLiteral("window/workspaces");
const QString kEventRows = QStringLiteral("window/event_rows");
const QString kClosingTopic = QStringLiteral("closing");
const QString kColourBlind = QStringLiteral("window/colour_blind");  ///< of all workspaces: eyes stay the same

/// What is being written in a cell of a list goes into the list.
void leaveCell(QWidget* focused) {
    QWidget* viewport = focused != nullptr ? focused->parentWidget() : nullptr;
    auto* list = viewport != nullptr ? qobject_cast<QAbstractItemView*>(viewport->parentWidget()) : nullptr;
    if (list != nullptr && list->viewport() == viewport) list->setFocus();
}

/// Whether there is anything to compare: the run shown may have been removed though others remain.
bool hasRunOfTheVideo(const ProjectSession& session) {
    const auto& runs = session.runs();
    return session.media() && std::any_of(runs.begin(), runs.end(), [&](const RunRecord& run) {
               return run.sequence.path == session.media()->identity && run.frames_done > 0;
           });
}

}  // namespace

MainWindow::MainWindow(QWidget* parent) : QMainWindow(parent) {
    setObjectName(QStringLiteral("main_window"));
    setAcceptDrops(true);
    QPixmapCache::setCacheLimit(kStyleCache_kB);
    // The lists reach down to the timeline, which belongs to the canvas.
    setCorner(Qt::BottomLeftCorner, Qt::LeftDockWidgetArea);
    setCorner(Qt::BottomRightCorner, Qt::RightDockWidgetArea);
    actions_ = new WindowActions(overlays_, this);
    keys_.add({QString(), actions_->sections()});
    new FocusedKeys(this);
    buildCentre();
    buildToolBar();
    resize(kFirstSize.boundedTo(screen()->availableSize() - kFrame));
    guard_ = new RunGuard(session_, *this);
    inspection_ = new Inspection(session_, this);
    docks_ = new DockRegistry(*this);
    measured_ = new EvaluationSession(session_, this);
    buildReview();
    watching_ = new WatchingDocks(
        {session_, *canvas_, *timeline_, *review_, *events_, *docks_, *actions_, *messages_, overlays_, *this});
    event_report_ = new EventReport({session_, *events_, *messages_, *this});
    new RunHandover({session_, *events_, *actions_, *messages_, *this});
    tuning_ = new Tuning({session_, *canvas_, *over_canvas_, *docks_, review_->parameterForm(), *actions_,
                          review_->parameters(), overlays_, *this});
    buildEvaluation();
    new TimelineThumbnails(session_, *timeline_, this);
    buildClock();
    labelling_ = new LabelWorkspace(
        {session_, *canvas_, *timeline_, *label_rows_, *messages_, *over_canvas_, *actions_, *docks_, keys_, *this});
    evaluation_->join(*labelling_);
    buildRunMessages();
    files_ =
        new OpenedFiles({session_, settings_, *actions_, *messages_, *guard_, *run_bar_, *welcome_, *canvas_, *this});
    live_ = new LiveWatching({session_, settings_, *actions_, *guard_, [this] { files_->rememberView(); }, *this});
    workspaces_ = new Workspaces(*this, *docks_, overlays_);
    commands_ = new WindowCommands({session_, *actions_, *canvas_, *transport_, *timeline_, *run_bar_, *inspection_,
                                    keys_, *labelling_, *workspaces_, *this});
    buildMenus();
    wireCanvas();
    wireSession();
    joinInspection({session_, *inspection_, *canvas_, overlays_, *docks_, *review_, [this] { commands_->startRun(); }});
    restoreGeometry(settings_.geometry());
    setWindowState(windowState() & ~Qt::WindowFullScreen);  // a window that was closed so begins with all it has
    buildWorkspaces();
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
    // In a row of its own: it stays for hours, and may hide nothing that drives along the upper edge.
    live_strip_ = new LiveStrip(session_);
    layout->addWidget(live_strip_);
    layout->addWidget(stack_, 1);
    // Over the picture: what a person points at stays where it is when one of these comes or goes.
    over_canvas_ = new OverlayColumn(centre);
    over_canvas_->add(*messages_);
    auto* overlay = new TopOverlay(*over_canvas_, *stack_, centre);
    overlay->setCovers([this](int covered_px) { canvas_->setCovered(covered_px); });
    setCentralWidget(centre);
}

void MainWindow::buildToolBar() {
    auto* bar = addToolBar(tr("Run"));
    bar->setObjectName(QStringLiteral("run_bar"));
    bar->setMovable(false);
    bar->addAction(actions_->open_video);
    bar->addSeparator();
    run_bar_ = new RunBar(session_, *actions_, *messages_);
    run_bar_->setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Preferred);
    bar->addWidget(run_bar_);
    bar->addSeparator();
    bar->addAction(actions_->fit);
    bar->addAction(actions_->one_to_one);
    bar->addWidget(new OverlayButton(overlays_, *actions_));
    bar->addWidget(new PictureButton(session_, *actions_));
    bar->addSeparator();
    for (QAction* action : actions_->workspace) bar->addAction(action);
    connect(run_bar_, &RunBar::editingDone, this, &MainWindow::focusCanvas);
    connect(transport_, &TransportBar::editingDone, this, &MainWindow::focusCanvas);
}

void MainWindow::buildMenus() {
    for (const ActionSection& section : actions_->sections()) {
        if (section.actions.contains(actions_->next_error)) menuBar()->addMenu(labelling_->menu());
        QMenu* menu = menuBar()->addMenu(section.title);
        actions_->fill(*menu, section);
        if (section.actions.contains(actions_->open_project)) {
            menu->insertMenu(actions_->save_as, files_->recentMenu());
            menu->insertSeparator(actions_->save_as);
        }
        if (section.actions.contains(actions_->fit)) {
            menu->addSeparator();
            for (const DockId id : allDocks()) menu->addAction(docks_->dock(id)->toggleViewAction());
            menu->addAction(tr("Reset the layout"), this, [this] { workspaces_->reset(); });
        }
    }
}

void MainWindow::start(const StartOptions& options) {
    if (options.workspace) workspaces_->open(*options.workspace);
    if (isLiveAddress(options.input.string()))
        live_->ask(QString::fromStdString(options.input.string()), options.gsd_m_per_px);
    else
        files_->start(options);
}

// ---- wiring ---------------------------------------------------------------------------------------------------------

void MainWindow::buildWorkspaces() {
    for (const WorkspaceKind kind : allWorkspaces())
        bindCommands(this, {{actions_->workspaceAction(kind), [this, kind] { workspaces_->open(kind); }}});
    connect(workspaces_, &Workspaces::leaving, evaluation_, &EvaluationDocks::leaveWorkspace);
    connect(workspaces_, &Workspaces::opened, this, [this](WorkspaceKind kind) {
        actions_->workspaceAction(kind)->setChecked(true);
        const QList<QDockWidget*> offered = docks_->docksFor(kind);
        for (const DockId id : allDocks())
            docks_->dock(id)->toggleViewAction()->setVisible(offered.contains(docks_->dock(id)));
        // Whoever leaves the canvas does so before the next one takes it: tool, turn and ground are one for all.
        const bool labels = kind == WorkspaceKind::label;
        // Engineers and annotators work on what the run found.
        session_.showCorrected(kind == WorkspaceKind::review);
        if (!labels) labelling_->setActive(false);
        events_->setActive(!labels);
        watching_->setActive(!labels);
        if (labels) labelling_->setActive(true);
        fitRows();
        // Zones are drawn, tracks narrowed by what they did and the ground held still, whichever list is in front.
        if (!labels) events_->review().setWanted();
        evaluation_->enterWorkspace(kind);
        showPicture();
    });
    overlays_.setPalette(settings_.value(kColourBlind, false).toBool() ? PaletteKind::colour_blind
                                                                       : PaletteKind::thesis);
    bindSwitches(this, {{actions_->event_rows, [this](bool on) { timeline_->setKindsShown(on); }}});
    connect(timeline_, &TimelineView::kindsShownWanted, actions_->event_rows, &QAction::setChecked);
    actions_->event_rows->setChecked(settings_.value(kEventRows, true).toBool());
    workspaces_->restore(settings_.value(kWorkspaces, {}).toMap());
}

void MainWindow::buildReview() {
    review_ = new ReviewDocks({session_, *inspection_, *measured_, *docks_, *actions_, overlays_, *guard_, *messages_});
    events_ = new EventsDock({session_, *canvas_, *timeline_, *docks_, *actions_, *messages_});
    joinTracksAndEvents(*review_, *events_, *docks_, session_);
}

void MainWindow::buildClock() {
    auto* binding = new TimelineBinding(session_, *timeline_, review_->stageTimes(), this);
    status_ = new StatusFields(session_, *statusBar());
    new ClockDisplay({session_, *timeline_, *binding, *status_, *review_, *events_, *watching_}, this);
}

void MainWindow::buildRunMessages() {
    auto* told = new RunMessages(
        session_, *messages_, *docks_, [this] { files_->locateVideo(); }, this);
    const auto tell_events = [this, told] {
        const auto& found = events_->review().found();
        // What a run that works has found so far is no news of its end.
        if (found && !events_->review().asOf() && session_.currentRun())
            told->tellEvents(*session_.currentRun(), found->events.size());
    };
    whenAny(events_, told, tell_events, &EventsDock::eventsShown);
}

void MainWindow::buildEvaluation() {
    evaluation_ = new EvaluationDocks(session_, *measured_, *canvas_, *actions_, overlays_, *docks_, *messages_, *this);
    connect(evaluation_, &EvaluationDocks::whyRequested, tuning_, &Tuning::askWhyAbout);
    connect(&tuning_->preview(), &LivePreview::changed, evaluation_,
            [this] { evaluation_->setPreviewed(tuning_->preview().active()); });
}

void MainWindow::wireCanvas() {
    connect(canvas_, &VideoView::trackClicked, &session_, &ProjectSession::selectTrack);
    connect(canvas_, &VideoView::cursorMoved, status_, &StatusFields::showCursor);
    connect(canvas_, &VideoView::transformChanged, status_, [this] {
        const ViewTransform& shown = canvas_->transform();
        status_->showZoom(shown.zoom(), shown.onGround());
    });
    connect(&overlays_, &OverlaySettings::changed, timeline_, [this] { timeline_->setPalette(overlays_.palette()); });
    timeline_->setPalette(overlays_.palette());
}

void MainWindow::wireSession() {
    whenChanged(session_, this,
                {
                    {SessionChange::keep_written, [this] { leaveCell(QApplication::focusWidget()); }},
                    {SessionChange::video, [this] { showVideo(); }},
                    {SessionChange::picture, [this] { showPicture(); }},
                    {SessionChange::selection, [this] { canvas_->setSelectedTrack(session_.selectedTrack()); }},
                    {SessionChange::following, [this] { actions_->follow->setChecked(session_.following()); }},
                    {{SessionChange::video, SessionChange::project, SessionChange::runs, SessionChange::current_run,
                      SessionChange::run_started, SessionChange::run_ended, SessionChange::following},
                     [this] { enableActions(); }},
                    {{SessionChange::video, SessionChange::project}, [this] { updateTitle(); }},
                });
}

void MainWindow::showVideo() {
    const auto& video = session_.video();
    canvas_->clear(video ? QSize(video->size.width, video->size.height) : QSize());
    stack_->setCurrentIndex(video ? 1 : 0);
}

void MainWindow::showPicture() {
    const ViewFrame& frame = session_.viewFrame();
    canvas_->setFrame(frame);
    actions_->why->setEnabled(session_.currentRun() && frame.result);
    // An empty picture of a run may not look as if nothing was found there.
    QString missing;
    if (!frame.result && session_.currentRun() && !session_.running()) missing = tr("Not processed in this run");
    if (workspaces_->current() == WorkspaceKind::tune && !session_.detailsKept(frame.index))
        missing = tr("Only the tracks of this frame were kept (recording.details)");
    if (std::exchange(told_missing_, !missing.isEmpty()) || !missing.isEmpty()) canvas_->setBadge(missing);
    evaluation_->showMarks();
}

void MainWindow::enableActions() {
    const bool has_video = session_.video().has_value();
    const bool running = session_.running();
    for (const ActionSection& section : actions_->sections())
        for (QAction* action : section.actions)
            if (section.actions.contains(actions_->play) || section.actions.contains(actions_->fit))
                action->setEnabled(has_video);
    actions_->full_screen->setEnabled(true);
    watching_->enableActions();
    for (QAction* action : actions_->workspace) action->setEnabled(true);
    const bool has_run = session_.currentRun().has_value();
    actions_->why->setEnabled(has_run && session_.viewFrame().result);
    actions_->compare->setEnabled(has_run || hasRunOfTheVideo(session_));
    actions_->run->setEnabled(has_video && !running);
    actions_->stop->setEnabled(running);
    actions_->continue_run->setEnabled(has_run && session_.canContinue(*session_.currentRun()));
    actions_->follow->setEnabled(running);
    actions_->save_as->setEnabled(has_video && !running);
    actions_->restore_state->setEnabled(!session_.project().empty());
    actions_->save_copy->setEnabled(!session_.project().empty());
    actions_->restore_run->setEnabled(session_.lastRemovedRun().has_value());
}

void MainWindow::updateTitle() {
    QStringList parts;
    if (session_.media()) parts << QString::fromStdString(session_.media()->name);
    if (!session_.project().empty()) parts << QString::fromStdString(session_.project().filename().string());
    setWindowTitle((parts << tr("Eyrie")).join(QStringLiteral(" – ")));
}

void MainWindow::focusCanvas() {
    canvas_->setFocus();
}

// ---- events ---------------------------------------------------------------------------------------------------------

void MainWindow::resizeEvent(QResizeEvent* event) {
    QMainWindow::resizeEvent(event);
    fitRows();
}

void MainWindow::fitRows() {
    // Of a low window the picture takes more.
    label_rows_->setFixedHeight(
        std::clamp(kMostLabelRows_px - (kFirstSize.height() - height()) / 3, kLeastLabelRows_px, kMostLabelRows_px));
    timeline_->setBrief(labelling_ != nullptr && labelling_->active() && height() < kLowWindow_px);
}

void MainWindow::showEvent(QShowEvent* event) {
    QMainWindow::showEvent(event);
    // Only now its size is known. Shown again, from an icon say, it is as a person has arranged it.
    if (!std::exchange(shown_, true)) workspaces_->fit();
}

void MainWindow::closeEvent(QCloseEvent* event) {
    if (!closing_ && session_.running() && !session_.stopping()) {
        event->ignore();
        guard_->beforeEnding(tr("the window closes"), [this] {
            closing_ = true;
            close();
        });
        return;
    }
    write_wait_.watch();
    session_.endWork();
    settings_.setGeometry(saveGeometry());
    settings_.setValue(kColourBlind, overlays_.palette() == PaletteKind::colour_blind);
    settings_.setValue(kEventRows, timeline_->kindsShown());
    settings_.setValue(kWorkspaces, workspaces_->state());
    if (waitsForWrites()) {
        event->ignore();
        return;
    }
    files_->rememberView();
    session_.stopRun();  // the run's own thread finishes storing while the program goes down
    event->accept();
}

/// Whether what a person did last is on its way into its files still. The window closes by itself once it is there.
bool MainWindow::waitsForWrites() {
    if (std::exchange(written_, false)) return false;
    if (!write_wait_.anythingDue()) return !mayClose();
    messages_->showTopic(kClosingTopic, MessageKind::info,
                         tr("Saving your last changes. The window closes when they are stored."));
    write_wait_.begin([this](bool) {
        messages_->dismissTopic(kClosingTopic);
        closing_ = false;
        if (!mayClose()) return;
        written_ = true;
        close();
        written_ = false;
    });
    return true;
}

/// Where something could not be written the window stays once, so that its message is read.
bool MainWindow::mayClose() {
    if (!write_wait_.anythingFailed()) return true;
    closing_ = false;
    messages_->showTopic(kClosingTopic, MessageKind::warning,
                         tr("Not all of your last changes could be saved, so the window stays open. Close it again to "
                            "leave without them."));
    return false;
}

void MainWindow::dragEnterEvent(QDragEnterEvent* event) {
    for (const QUrl& url : event->mimeData()->urls())
        if (url.isLocalFile()) {
            event->acceptProposedAction();
            return;
        }
}

void MainWindow::dropEvent(QDropEvent* event) {
    QStringList paths;
    for (const QUrl& url : event->mimeData()->urls())
        if (url.isLocalFile()) paths << url.toLocalFile();
    if (paths.isEmpty()) return;
    event->acceptProposedAction();
    files_->open(paths);
}

}  // namespace eyrie::ui

#include "moc_main_window.cpp"
