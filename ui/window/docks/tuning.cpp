#include "window/docks/tuning.h"

#include <QDockWidget>
#include <QMainWindow>
#include <QMenu>
#include <array>
#include <utility>

#include "canvas/video_view.h"
#include "rerun/replay.h"
#include "tune/compare/comparison_window.h"
#include "tune/compare/preview_bar.h"
#include "tune/inspect/why_panel.h"
#include "tune/parameters/parameter_binding.h"
#include "tune/train/training_dialog.h"
#include "widgets/layout/overlay_column.h"
#include "widgets/parameters/parameter_form.h"
#include "widgets/wiring.h"
#include "workspace/dock_registry.h"
#include "workspace/window_actions.h"

namespace eyrie::ui {

namespace {

/// What the picture of a preview could be mistaken for: of the others some tell nothing of what is found, or say
/// themselves what they are about.
constexpr std::array kTellOfTheRun{DockId::tracks, DockId::events, DockId::inspector,  DockId::card,
                                   DockId::stages, DockId::stacks, DockId::statistics, DockId::why};
constexpr double kKeyMargin = 4;  ///< logical px around a box that is meant by the cursor

QColor colourOf(CornerFate fate, const OverlayColours& colours) {
    switch (fate) {
        case CornerFate::moving:
            return colours.motion_vector;
        case CornerFate::slow:
        case CornerFate::young:
            return colours.stationary_corner;
        case CornerFate::too_fast:
        case CornerFate::parallax:
        case CornerFate::shadow:
            break;
    }
    return colours.non_vehicle;
}

}  // namespace

Tuning::Tuning(const TuningParts& parts) : QObject(&parts.window), parts_(parts) {
    buildWhy();
    buildPreview();
    bindCommands(this, {
                           {parts_.actions.why, [this] { askWhyHere(); }},
                           {parts_.actions.compare, [this] { compareRuns(); }},
                           {parts_.actions.train, [this] { train(); }},
                       });
    bindSwitches(this, {{parts_.actions.live_preview, [this](bool on) { preview_->setEnabled(on); }}});
}

void Tuning::buildWhy() {
    why_ = new Why(parts_.session, this);
    why_panel_ = new WhyPanel(parts_.session, *why_);
    parts_.docks.add(DockId::why, tr("Why?"), why_panel_);
    parts_.docks.watch(DockId::why, why_panel_, [this](bool visible) {
        why_panel_->setLookedAt(visible);
        showPlaceMark();
    });
    connect(why_panel_, &WhyPanel::parameterChosen, this, &Tuning::showParameter);
    connect(why_, &Why::changed, this, &Tuning::showPlaceMark);
    connect(&parts_.canvas, &VideoView::placeMenuRequested, this, &Tuning::showPlaceMenu);
    connect(&parts_.canvas, &VideoView::cursorMoved, this, [this](std::optional<QPointF> place) { cursor_ = place; });
}

void Tuning::askWhyHere() {
    const QPointF middle(parts_.canvas.width() / 2.0, parts_.canvas.height() / 2.0);
    const ViewTransform& transform = parts_.canvas.transform();
    const QPointF place = cursor_.value_or(transform.imageFromView(middle));
    askWhy(place, kKeyMargin / transform.scaleAt(place));
}

void Tuning::buildPreview() {
    preview_ = new LivePreview(parts_.session, this);
    preview_bar_ = new PreviewBar(
        *preview_, {.run = [this] { parts_.actions.run->trigger(); }, .discard = [this] { discardPreview(); }});
    parts_.over_canvas.add(*preview_bar_);
    // Queued: the settings of the next run take the value over first.
    ParameterForm& form = parts_.form;
    connect(&form, &ParameterForm::valueChanged, this, &Tuning::parameterMoved, Qt::QueuedConnection);
    connect(&form, &ParameterForm::presetChosen, this, &Tuning::parametersEdited, Qt::QueuedConnection);
    connect(&form, &ParameterForm::pointedAt, this, [this](const QString& name) {
        if (name.startsWith(QLatin1String("motion."))) preview_->warmUp();
    });
    connect(preview_, &LivePreview::changed, this, &Tuning::showPreview);
    // Queued: after the canvas got the stored frame, before it is painted.
    whenChanged(parts_.session, this, {{SessionChange::picture, [this] { showPreview(); }}}, Qt::QueuedConnection);
}

void Tuning::discardPreview() {
    preview_->discard();
    parts_.parameters.adoptRunParameters();
}

void Tuning::parameterMoved(const QString& name, const QString& value) {
    const auto& run = parts_.session.runData();
    // The first thing that is moved while another preset stands in the form: the run is meant, with this one changed.
    if (run && preview_->enabled() && !preview_->active() && parts_.form.modifiedCount() == 1 &&
        differencesBetween(storedOptions(run->parameters), parts_.session.settings().options).size() > 1) {
        parts_.parameters.adoptRunParameters();
        parts_.parameters.setValue(name.toStdString(), value.toStdString());
    }
    parametersEdited();
}

void Tuning::parametersEdited() {
    preview_->parametersEdited();
    if (comparison_) comparison_->parametersEditedSoon();
}

void Tuning::showPreview() {
    if (!preview_->active()) {
        if (!std::exchange(preview_shown_, false)) return;
        parts_.canvas.setBadge({});
        parts_.canvas.setFrame(parts_.session.viewFrame());
        markStale(false);
        return;
    }
    const ViewFrame& stored = parts_.session.viewFrame();
    if (!stored.result) return;
    if (!std::exchange(preview_shown_, true)) markStale(true);
    ViewFrame shown = stored;
    shown.trails.clear();
    const auto view = preview_->view();
    auto result = std::make_shared<FrameResult>();
    if (view)
        *result = view->previewed.result;
    else  // nothing of the run may pass for a preview
        result->motion = stored.result->motion;
    shown.result = std::move(result);
    parts_.canvas.setFrame(std::move(shown));
    parts_.canvas.setBadge(view ? tr("Preview") : tr("Preview…"));
}

void Tuning::markStale(bool stale) {
    const QString mark = tr(" (stored)");
    for (const DockId id : kTellOfTheRun) {
        QDockWidget* dock = parts_.docks.dock(id);
        if (dock == nullptr) continue;
        QString title = dock->windowTitle();
        if (title.endsWith(mark)) title.chop(mark.size());
        dock->setWindowTitle(stale ? title + mark : title);
    }
}

void Tuning::askWhy(QPointF place, double margin) {
    if (!parts_.session.viewFrame().result) return;
    parts_.docks.raise(DockId::why);
    why_->want(true);
    why_->ask(place, margin);
}

void Tuning::askWhyAbout(const OrientedBox& box, const QString& about) {
    parts_.docks.raise(DockId::why);
    why_->want(true);
    why_->askAbout(box, about);
}

void Tuning::train() {
    auto* dialog = new TrainingDialog(parts_.session.project(), &parts_.window);
    dialog->setAttribute(Qt::WA_DeleteOnClose);
    connect(dialog, &TrainingDialog::useRequested, this, [this](const QString& file) {
        parts_.parameters.setValue("sliding_window.model", file.toStdString());
        parametersEdited();
    });
    dialog->open();
}

ComparisonWindow& Tuning::compareRuns() {
    if (!comparison_) {
        comparison_ =
            new ComparisonWindow(parts_.session, parts_.parameters.presets(), parts_.overlays, &parts_.window);
        comparison_->setAttribute(Qt::WA_DeleteOnClose);
    }
    parts_.session.playback().pause();
    comparison_->show();
    comparison_->raise();
    comparison_->activateWindow();
    return *comparison_;
}

void Tuning::showParameter(const QString& name) {
    parts_.docks.raise(DockId::parameters);
    parts_.form.reveal(name);
}

void Tuning::showPlaceMenu(QPointF place, double margin, QPoint global) {
    QMenu menu(&parts_.window);
    QAction* why = menu.addAction(tr("Why?"));
    why->setShortcut(parts_.actions.why->shortcut());
    if (menu.exec(global) == why) askWhy(place, margin);
}

void Tuning::showPlaceMark() {
    const auto& area = why_->area();
    if (!area || parts_.docks.dock(DockId::why)->isHidden()) {
        parts_.canvas.setPlaceMark(std::nullopt);
        return;
    }
    PlaceMark mark;
    mark.area = *area;
    const auto& view = why_->view();
    if (view && view->frame == parts_.session.viewFrame().index) {
        const OverlayColours& colours = parts_.overlays.style().colours;
        for (const CornerVerdict& corner : view->corners)
            mark.dots.push_back({QPointF(corner.position.x, corner.position.y), colourOf(corner.fate, colours)});
    }
    parts_.canvas.setPlaceMark(std::move(mark));
}

}  // namespace eyrie::ui

#include "moc_tuning.cpp"
