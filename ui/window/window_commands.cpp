#include "window/window_commands.h"

#include <QEvent>
#include <QInputDialog>
#include <QMainWindow>
#include <QMessageBox>

#include "canvas/timeline/timeline_view.h"
#include "canvas/video_view.h"
#include "chain/recording/run_recorder.h"
#include "label/label_workspace.h"
#include "session/project/person_name.h"
#include "session/project_session.h"
#include "tune/inspect/inspection.h"
#include "widgets/wiring.h"
#include "window/bars/run_bar.h"
#include "window/bars/transport_bar.h"
#include "workspace/key_sheet.h"
#include "workspace/window_actions.h"
#include "workspace/workspaces.h"

namespace eyrie::ui {

namespace {
constexpr double kZoomStep = 1.25;
constexpr double kLookStep = 0.1;  ///< of the canvas
}  // namespace

WindowCommands::WindowCommands(const CommandParts& parts) : QObject(&parts.window), parts_(parts) {
    bindRun();
    bindPlayback();
    bindView();
    bindHelp();
    parts_.window.installEventFilter(this);
}

// ---- runs -----------------------------------------------------------------------------------------------------------

void WindowCommands::bindRun() {
    const WindowActions& actions = parts_.actions;
    ProjectSession& session = parts_.session;
    bindCommands(this, {
                           {actions.run, [this] { startRun(); }},
                           {actions.stop, [&session] { session.stopRun(); }},
                           {actions.continue_run,
                            [&session] {
                                if (session.currentRun()) session.continueRun(*session.currentRun());
                            }},
                           {actions.restore_run,
                            [&session] {
                                if (session.lastRemovedRun()) session.restoreRun(session.lastRemovedRun()->id);
                            }},
                           {actions.follow,
                            [&session](bool on) {
                                if (on)
                                    session.follow();
                                else
                                    session.goToFrame(session.currentFrame());
                            }},
                       });
}

void WindowCommands::startRun() {
    if (parts_.run_bar.takeEdits()) parts_.session.startRun();
}

// ---- playback -------------------------------------------------------------------------------------------------------

void WindowCommands::bindPlayback() {
    const WindowActions& actions = parts_.actions;
    ProjectSession& session = parts_.session;
    const auto change_speed = [&session](double factor) {
        session.playback().setSpeed(session.playback().speed() * factor, session.currentFrame());
    };
    bindCommands(this, {
                           {actions.play, [&session] { session.togglePlay(); }},
                           {actions.step_back, [&session] { session.step(-1); }},
                           {actions.step_on, [&session] { session.step(1); }},
                           {actions.jump_back, [&session] { session.step(-10); }},
                           {actions.jump_on, [&session] { session.step(10); }},
                           {actions.first, [&session] { session.goToFrame(0); }},
                           {actions.last, [&session] { session.step(session.lastFrame()); }},
                           {actions.go_to_frame, [this] { parts_.transport.focusFrameField(); }},
                           {actions.shuttle_back, [&session] { session.shuttle(-1); }},
                           {actions.shuttle_stop, [&session] { session.shuttle(0); }},
                           {actions.shuttle_on, [&session] { session.shuttle(1); }},
                           {actions.slower, [change_speed] { change_speed(0.5); }},
                           {actions.faster, [change_speed] { change_speed(2); }},
                       });
    bindSwitches(this, {{actions.loop, [&session](bool on) { session.playback().setLooping(on); }}});
    connect(&parts_.canvas, &VideoView::playToggled, actions.play, &QAction::trigger);
    connect(&session.playback(), &Playback::playingChanged, this, [play = actions.play](bool playing) {
        play->setIcon(QIcon::fromTheme(playing ? QStringLiteral("media-playback-pause")
                                               : QStringLiteral("media-playback-start")));
        play->setText(playing ? tr("&Pause") : tr("&Play"));
    });
}

// ---- the view -------------------------------------------------------------------------------------------------------

void WindowCommands::bindView() {
    const WindowActions& actions = parts_.actions;
    VideoView& canvas = parts_.canvas;
    TimelineView& timeline = parts_.timeline;
    const auto look = [&canvas](double right, double down) {
        const QPointF middle(canvas.width() / 2.0, canvas.height() / 2.0);
        const QPointF step(right * kLookStep * canvas.width(), down * kLookStep * canvas.height());
        canvas.centreOn(canvas.transform().imageFromView(middle + step));
    };
    bindCommands(this, {
                           {actions.look_left, [look] { look(-1, 0); }},
                           {actions.look_right, [look] { look(1, 0); }},
                           {actions.look_up, [look] { look(0, -1); }},
                           {actions.look_down, [look] { look(0, 1); }},
                           {actions.timeline_in, [&timeline] { timeline.zoomBy(kZoomStep); }},
                           {actions.timeline_out, [&timeline] { timeline.zoomBy(1 / kZoomStep); }},
                       });
    bindCommands(this, {
                           {actions.fit, [&canvas] { canvas.fit(); }},
                           {actions.one_to_one, [&canvas] { canvas.showOneToOne(); }},
                           {actions.zoom_in, [&canvas] { canvas.zoomBy(kZoomStep); }},
                           {actions.zoom_out, [&canvas] { canvas.zoomBy(1 / kZoomStep); }},
                           {actions.full_screen, [this](bool on) { showFullScreen(on); }},
                           {actions.deselect, [this] { escape(); }},
                       });
}

void WindowCommands::escape() {
    if (parts_.canvas.isVisible() && !parts_.canvas.hasFocus())
        parts_.canvas.setFocus();
    else if (parts_.inspection.hasChoice())
        parts_.inspection.clear();
    else if (parts_.window.isFullScreen())
        parts_.actions.full_screen->trigger();
    else
        parts_.timeline.showAll();
}

void WindowCommands::showFullScreen(bool on) {
    const Qt::WindowStates state = parts_.window.windowState();
    // Before the window grows: its layout is to come back.
    if (on) parts_.workspaces.showPictureAlone(true);
    parts_.window.setWindowState(on ? state | Qt::WindowFullScreen : state & ~Qt::WindowFullScreen);
}

void WindowCommands::followFullScreen() {
    const bool on = parts_.window.isFullScreen();
    // While docks go and come back, whoever sees it asks the action why.
    parts_.actions.full_screen->setChecked(true);
    parts_.workspaces.showPictureAlone(on);
    parts_.actions.full_screen->setChecked(on);
}

bool WindowCommands::eventFilter(QObject* watched, QEvent* event) {
    if (watched == &parts_.window && event->type() == QEvent::WindowStateChange) followFullScreen();
    return QObject::eventFilter(watched, event);
}

// ---- help -----------------------------------------------------------------------------------------------------------

void WindowCommands::bindHelp() {
    const WindowActions& actions = parts_.actions;
    bindCommands(this, {{actions.keys, [this] { showKeys(); }},
                        {actions.about, [this] { showAbout(); }},
                        {actions.your_name, [this] { askForName(); }}});
}

void WindowCommands::showKeys() {
    auto* sheet = new KeySheet(parts_.keys, parts_.labelling.active() ? tr("Label") : QString(), &parts_.window);
    sheet->setAttribute(Qt::WA_DeleteOnClose);
    sheet->show();
}

void WindowCommands::askForName() {
    bool accepted = false;
    const QString name = QInputDialog::getText(
        &parts_.window, tr("Your name"),
        tr("Kept with what you judge, check and correct from now on.\nEmpty: the name of your account."),
        QLineEdit::Normal, personName(), &accepted);
    if (accepted) setPersonName(name);
}

void WindowCommands::showAbout() {
    QMessageBox::about(&parts_.window, tr("About Eyrie"),
                       tr("<h3>Eyrie %1</h3><p>Finds, outlines and follows small moving vehicles in aerial video, "
                          "after M. Teutsch, <i>Moving Object Detection and Segmentation for Remote Aerial Video "
                          "Surveillance</i>.</p>")
                           .arg(QString::fromStdString(engineVersion())));
}

}  // namespace eyrie::ui

#include "moc_window_commands.cpp"
