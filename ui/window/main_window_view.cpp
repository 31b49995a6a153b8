// The part of MainWindow that deals with how things are shown: zoom, overlays, sheets, what is
// remembered of a view, what is dropped on the window.
#include <QApplication>
#include <QCloseEvent>
#include <QDockWidget>
#include <QDoubleSpinBox>
#include <QDragEnterEvent>
#include <QHBoxLayout>
#include <QLabel>
#include <QMenu>
#include <QMenuBar>
#include <QMessageBox>
#include <QMimeData>
#include <QPainter>
#include <QSignalBlocker>
#include <QToolButton>
#include <QWidgetAction>

#include "canvas/layers/overlay_table.h"
#include "canvas/timeline/timeline_view.h"
#include "canvas/video_view.h"
#include "chain/recording/run_recorder.h"
#include "label/label_actions.h"
#include "label/label_workspace.h"
#include "tune/compare/live_preview.h"
#include "tune/inspect/inspection.h"
#include "tune/inspect/stacks_panel.h"
#include "tune/inspect/stage_chips.h"
#include "tune/parameters/parameter_binding.h"
#include "window/bars/status_fields.h"
#include "window/docks/evaluation_docks.h"
#include "window/docks/review_docks.h"
#include "window/docks/tuning.h"
#include "window/main_window.h"
#include "window/run_guard.h"
#include "workspace/dock_registry.h"
#include "workspace/key_sheet.h"
#include "workspace/window_actions.h"
#include "workspace/workspaces.h"

namespace eyrie::ui {

namespace {
constexpr double kZoomStep = 1.25;
const QString kWorkspaces = QStringLiteral("window/workspaces");

/// A square in the colour of an overlay, so that the menu is also the legend.
QIcon swatch(const QColor& colour) {
    QPixmap pixmap(16, 16);
    pixmap.fill(Qt::transparent);
    QPainter painter(&pixmap);
    painter.setRenderHint(QPainter::Antialiasing);
    painter.setPen(QColor(0, 0, 0, 150));
    painter.setBrush(colour);
    painter.drawRoundedRect(QRectF(2.5, 2.5, 11, 11), 2, 2);
    return {pixmap};
}
}  // namespace

QMenu* MainWindow::buildOverlayMenu() {
    auto* menu = new QMenu(this);
    for (const ActionSection& section : actions_->sections())
        if (section.actions.contains(actions_->labels)) menu->addActions(section.actions);
    auto* row = new QWidget(menu);
    auto* layout = new QHBoxLayout(row);
    layout->setContentsMargins(28, 2, 8, 2);
    auto* length = new QDoubleSpinBox(row);
    length->setRange(1, 100);
    length->setDecimals(1);
    length->setSuffix(tr(" frames"));
    length->setToolTip(tr("A motion vector is drawn as long as the corner moves in this many frames"));
    length->setValue(overlays_.style().vector_length_factor);
    layout->addWidget(new QLabel(tr("Vector length"), row));
    layout->addWidget(length, 1);
    connect(length, &QDoubleSpinBox::valueChanged, &overlays_, &OverlaySettings::setVectorLengthFactor);
    auto* action = new QWidgetAction(menu);
    action->setDefaultWidget(row);
    menu->addSeparator();
    menu->addAction(action);

    const auto refresh = [this, length] {
        const QSignalBlocker blocker(length);
        length->setValue(overlays_.style().vector_length_factor);
        for (const OverlayRow& overlay : overlayTable())
            actions_->overlay[static_cast<size_t>(overlay.kind)]->setIcon(swatch(overlay.colour(overlays_.style())));
        timeline_->setPalette(overlays_.palette());
    };
    connect(&overlays_, &OverlaySettings::changed, this, refresh);
    refresh();
    return menu;
}

QWidget* MainWindow::overlayButton(QMenu* menu) {
    auto* button = new QToolButton(this);
    button->setText(tr("Overlays"));
    button->setIcon(QIcon::fromTheme(QStringLiteral("layer-visible-on")));
    button->setToolButtonStyle(Qt::ToolButtonTextBesideIcon);
    button->setPopupMode(QToolButton::InstantPopup);
    button->setFocusPolicy(Qt::NoFocus);
    button->setMenu(menu);
    return button;
}

void MainWindow::buildLabelling() {
    labelling_ = new LabelWorkspace(
        {session_, *canvas_, *timeline_, *label_rows_, *messages_, *actions_, *docks_, keys_, *this});
    evaluation_->join(*labelling_);
}

void MainWindow::buildWorkspaces() {
    workspaces_ = new Workspaces(*this, *docks_, overlays_);
    for (const WorkspaceKind kind : allWorkspaces())
        connect(actions_->workspaceAction(kind), &QAction::triggered, workspaces_,
                [this, kind] { workspaces_->open(kind); });
    connect(workspaces_, &Workspaces::leaving, evaluation_, &EvaluationDocks::leaveWorkspace);
    connect(workspaces_, &Workspaces::opened, this, [this](WorkspaceKind kind) {
        actions_->workspaceAction(kind)->setChecked(true);
        const QList<QDockWidget*> offered = docks_->docksFor(kind);
        for (const DockId id : allDocks())
            docks_->dock(id)->toggleViewAction()->setVisible(offered.contains(docks_->dock(id)));
        labelling_->setActive(kind == WorkspaceKind::label);
        evaluation_->enterWorkspace(kind);
    });
    workspaces_->restore(settings_.value(kWorkspaces, {}).toMap());
}

void MainWindow::buildEvaluation() {
    evaluation_ = new EvaluationDocks(session_, *canvas_, *actions_, overlays_, *docks_, *this);
    connect(evaluation_, &EvaluationDocks::notice, this, &MainWindow::showNotice);
    connect(evaluation_, &EvaluationDocks::whyRequested, tuning_, &Tuning::askWhyAbout);
    // A preview takes the verdicts away, which are those of the stored run; they come back with it.
    connect(&tuning_->preview(), &LivePreview::changed, evaluation_, [this] {
        if (!tuning_->preview().active()) evaluation_->showMarks();
    });
    connect(evaluation_, &EvaluationDocks::problem, this, &MainWindow::showProblem);
}

void MainWindow::wireInspection() {
    connect(canvas_, &VideoView::placeClicked, inspection_, [this](QPointF place, double margin) {
        if (!session_.selectedTrack()) inspection_->choose(place, margin);
    });
    connect(inspection_, &Inspection::changed, canvas_, [this] { canvas_->setInspectedArea(inspection_->area()); });
    connect(inspection_, &Inspection::replayed, canvas_, [this](const std::shared_ptr<const ReplayView>& view) {
        canvas_->setStacks(view->wish.frame, stackMarks(*view));
    });
    connect(&overlays_, &OverlaySettings::changed, inspection_,
            [this] { inspection_->wantStackOverlay(overlays_.isVisible(OverlayKind::stacks)); });
    connect(&review_->stacks(), &StacksPanel::placeChosen, this, [this](QPointF place) {
        canvas_->centreOn(place);
        inspection_->choose(place);
    });
    connect(&review_->stacks(), &StacksPanel::stackingRunRequested, this, [this] {
        parameters_->adoptRunParameters();
        parameters_->setValue("stacking.enabled", "true");
        startRun();
    });
}

void MainWindow::wireViewActions() {
    connect(actions_->fit, &QAction::triggered, canvas_, &VideoView::fit);
    connect(actions_->one_to_one, &QAction::triggered, canvas_, &VideoView::showOneToOne);
    connect(actions_->zoom_in, &QAction::triggered, canvas_, [this] { canvas_->zoomBy(kZoomStep); });
    connect(actions_->zoom_out, &QAction::triggered, canvas_, [this] { canvas_->zoomBy(1 / kZoomStep); });
    connect(actions_->full_screen, &QAction::triggered, this, [this](bool on) {
        setWindowState(on ? windowState() | Qt::WindowFullScreen : windowState() & ~Qt::WindowFullScreen);
    });
    connect(actions_->deselect, &QAction::triggered, this, [this] {
        // Escape goes one step back: out of a field, out of the selection, out of the full screen.
        if (!canvas_->hasFocus())
            focusCanvas();
        else if (inspection_->hasChoice())
            inspection_->clear();
        else if (isFullScreen())
            actions_->full_screen->trigger();
    });
    connect(actions_->keys, &QAction::triggered, this, [this] {
        auto* sheet = new KeySheet(keys_, labelling_->active() ? tr("Label") : QString(), this);
        sheet->setAttribute(Qt::WA_DeleteOnClose);
        sheet->show();
    });
    connect(actions_->about, &QAction::triggered, this, [this] {
        QMessageBox::about(this, tr("About Eyrie"),
                           tr("<h3>Eyrie %1</h3><p>Finds, outlines and follows small moving vehicles in aerial video, "
                              "after M. Teutsch, <i>Moving Object Detection and Segmentation for Remote Aerial Video "
                              "Surveillance</i>.</p>")
                               .arg(QString::fromStdString(engineVersion())));
    });
    connect(canvas_, &VideoView::cursorMoved, status_, &StatusFields::showCursor);
    connect(canvas_, &VideoView::transformChanged, status_, [this] { status_->showZoom(canvas_->transform().zoom()); });
}

void MainWindow::restoreView() {
    const ProjectView view = settings_.projectView(session_.project());
    if (view.zoom > 0)
        canvas_->restore(view.zoom, view.centre);
    else
        canvas_->fit();
    if (view.frame > 0) session_.goToFrame(view.frame);
}

void MainWindow::rememberView() {
    if (shown_project_.empty()) return;
    const ViewTransform& transform = canvas_->transform();
    const QPointF middle(transform.viewSize().width() / 2, transform.viewSize().height() / 2);
    settings_.setProjectView(shown_project_, {transform.fitted() ? 0 : transform.zoom(),
                                              transform.imageFromView(middle), session_.currentFrame()});
    shown_project_.clear();
}

void MainWindow::showEvent(QShowEvent* event) {
    QMainWindow::showEvent(event);
    workspaces_->fit();  // only now its size is known
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
    rememberView();
    settings_.setGeometry(saveGeometry());
    settings_.setValue(kWorkspaces, workspaces_->state());
    session_.stopRun();  // it finishes storing while the program goes down
    event->accept();
}

void MainWindow::dragEnterEvent(QDragEnterEvent* event) {
    for (const QUrl& url : event->mimeData()->urls())
        if (url.isLocalFile()) {
            event->acceptProposedAction();
            return;
        }
}

void MainWindow::dropEvent(QDropEvent* event) {
    for (const QUrl& url : event->mimeData()->urls()) {
        if (!url.isLocalFile()) continue;
        event->acceptProposedAction();
        openPath(url.toLocalFile());
        return;
    }
}

}  // namespace eyrie::ui
