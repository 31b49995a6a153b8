#include "label/label_workspace.h"

#include <QMainWindow>
#include <QMenu>
#include <QMenuBar>
#include <QTimer>
#include <QToolBar>
#include <numbers>

#include "annotation/edits/object_pieces.h"
#include "annotation/review/join_suggestions.h"
#include "canvas/timeline/timeline_view.h"
#include "canvas/video_view.h"
#include "label/canvas/label_timeline.h"
#include "label/canvas/label_tool.h"
#include "label/computing/label_chips.h"
#include "label/computing/label_fitting.h"
#include "label/computing/label_stacks.h"
#include "label/computing/label_tracking.h"
#include "label/label_actions.h"
#include "label/label_classes.h"
#include "label/label_lists.h"
#include "label/label_scene.h"
#include "label/lists/object_inspector.h"
#include "label/lists/objects_panel.h"
#include "widgets/chip_grid.h"
#include "widgets/display_text.h"
#include "widgets/empty_state.h"
#include "widgets/message_bar.h"
#include "workspace/dock_registry.h"
#include "workspace/window_actions.h"

namespace eyrie::ui {

namespace {
const QString kRightTopic = QStringLiteral("right to label");

QString asSentence(const std::string& reason) {
    const QString text = QString::fromStdString(reason);
    return text.left(1).toUpper() + text.mid(1) + QLatin1Char('.');
}
}  // namespace

LabelWorkspace::LabelWorkspace(const LabelSurroundings& around) : QObject(&around.window), around_(around) {
    labels_ = new LabelSession(around_.session, this);
    proposals_ = new LabelProposals(around_.session, *labels_, this);
    editor_ = new LabelEditor(around_.session, *labels_, this);
    fitting_ = new LabelFitting(around_.session, *labels_, this);
    tracking_ = new LabelTracking(around_.session, *labels_, this);
    tool_ = new LabelTool(this);
    actions_ = new LabelActions(around_.keys, around_.window, around_.canvas);
    buildDocks();
    buildToolBar();
    buildMenu();
    wireLabels();
    wireTool();
    wireEditActions();
    wireGoActions();
    wireProposals();
    wireIdentity();
    wireRanges();
    wireFiles();
    wireChips();
    wireStacks();
    around_.rows.hide();
}

void LabelWorkspace::buildDocks() {
    model_ = new ObjectsModel(this);
    objects_ = new ObjectsPanel(model_);
    inspector_ = new ObjectInspector;
    chips_ = new LabelChips(around_.session, *labels_, this);
    stacks_ = new LabelStacks(around_.session, *labels_, this);
    grid_ = new ChipGrid;
    around_.docks.add(DockId::objects, tr("Objects"), objects_);
    around_.docks.add(DockId::object, tr("Object"), inspector_);
    around_.docks.add(DockId::object_chips, tr("Over time"), grid_);
}

void LabelWorkspace::buildToolBar() {
    around_.window.addToolBarBreak();
    bar_ = around_.window.addToolBar(tr("Labelling"));
    bar_->setObjectName(QStringLiteral("label_bar"));
    bar_->setMovable(false);
    bar_->setToolButtonStyle(Qt::ToolButtonTextBesideIcon);
    bar_->addActions({actions_->draw, actions_->proposals});
    bar_->addSeparator();
    bar_->addActions({actions_->undo, actions_->redo});
    bar_->addSeparator();
    bar_->addActions({actions_->import_labels, actions_->export_labels});
    bar_->hide();
}

void LabelWorkspace::buildMenu() {
    menu_ = new QMenu(tr("&Label"), &around_.window);
    for (const ActionSection& section : actions_->sections())
        menu_->addMenu(section.title)->addActions(section.actions);
    menu_->menuAction()->setVisible(false);
}

// ---- switching ------------------------------------------------------------------------------------------------------

void LabelWorkspace::setActive(bool active) {
    if (active == active_) return;
    if (!active) tool_->cancel();
    active_ = active;
    bar_->setVisible(active);
    menu_->menuAction()->setVisible(active);
    around_.rows.setVisible(active);
    around_.canvas.setTool(active ? tool_ : nullptr);
    actions_->setActive(active);
    followObject();
    labels_->setWanted(active || labels_->isOpen());
    labelsChanged();
    around_.canvas.setFocus();
}

// ---- showing --------------------------------------------------------------------------------------------------------

void LabelWorkspace::wireLabels() {
    connect(labels_, &LabelSession::changed, this, &LabelWorkspace::labelsChanged);
    connect(labels_, &LabelSession::drawnClassChanged, this, &LabelWorkspace::showScene);
    connect(labels_, &LabelSession::problem, &around_.session, &ProjectSession::problem);
    connect(labels_, &LabelSession::notice, this, &LabelWorkspace::tell);
    connect(labels_, &LabelSession::opened, this, [this] {
        around_.messages.dismissTopic(kRightTopic);
        if (labels_->readOnly())
            around_.messages.showTopic(kRightTopic, MessageKind::warning,
                                       asSentence(labels_->store()->readOnlyReason()), tr("Try again"),
                                       [this] { labels_->tryToWrite(); });
        else if (active_ && !around_.session.currentRun() && labels_->annotations().objects.empty())
            tell(tr(
                "This video has no run yet: boxes are interpolated in the image. After a run they follow the ground, "
                "however the camera moves."));
        enableActions();
    });
    connect(labels_, &LabelSession::selectionChanged, this, [this] {
        showScene();
        showObject();
        objects_->selectId(labels_->selected().value_or(0));
        around_.rows.setSelection(labels_->selection(), labels_->selected());
        enableActions();
        followObject();
        if (active_) chips_due_.start();
    });
    connect(proposals_, &LabelProposals::changed, this, [this] {
        showScene();
        enableActions();
    });
    connect(&around_.session, &ProjectSession::viewFrameChanged, this, [this] {
        if (!active_) return;
        followObject();
        showScene();
        showObject();
    });
    connect(&around_.session, &ProjectSession::frameChanged, this, [this](FrameIndex frame) {
        if (active_) objects_->setFrame(frame);
    });
    connect(objects_, &ObjectsPanel::objectSelected, this, [this](int id) { labels_->select(id); });
    connect(objects_, &ObjectsPanel::objectActivated, this, [this](int id, int frame) { editor_->goTo(id, frame); });
    connect(objects_->emptyState(), &EmptyState::actionTriggered, actions_->draw, &QAction::trigger);
    connect(&around_.rows, &LabelTimeline::placeClicked, this,
            [this](ObjectId id, FrameIndex frame) { editor_->goTo(id, frame); });
    connect(&around_.rows, &LabelTimeline::frameRequested, &around_.session, &ProjectSession::goToFrame);
}

void LabelWorkspace::labelsChanged() {
    if (!active_) return;
    showScene();
    showObject();
    enableActions();
    chips_due_.start();
    // Lists of a thousand objects follow when the event loop is free, once for several edits.
    if (std::exchange(refresh_due_, true)) return;
    QTimer::singleShot(0, this, [this] {
        refresh_due_ = false;
        showList();
        showRows();
    });
}

void LabelWorkspace::showScene() {
    if (!active_) return;
    // Boxes belong to the picture that is shown, which may come later than the frame was asked for.
    const bool planned =
        planned_.plan && planned_.plan->version == labels_->version() && planned_.selection == labels_->selection();
    tool_->setScene(labelScene(*labels_, *proposals_, around_.session.viewFrame().index, around_.session.scale(),
                               planned ? &planned_.plan->edit : nullptr));
}

void LabelWorkspace::showList() {
    QStringList names;
    for (const ObjectClass& entry : classesOf(labels_->annotations())) names << QString::fromStdString(entry.name);
    objects_->setClasses(names);
    inspector_->setClasses(names);
    model_->setObjects(objectRows(*labels_), around_.session.scale());
    objects_->setCheckedShare(labels_->review().checkedShare(),
                              static_cast<int>(labels_->annotations().objects.size()));
    objects_->selectId(labels_->selected().value_or(0));
}

void LabelWorkspace::showRows() {
    around_.rows.setRows(timelineRows(*labels_));
    around_.rows.setSelection(labels_->selection(), labels_->selected());
}

void LabelWorkspace::showObject() {
    if (!active_) return;
    if (editor_->object() == nullptr)
        inspector_->showObject(std::nullopt);
    else
        inspector_->showObject(objectDetails(*labels_, *editor_, around_.session.scale()));
}

void LabelWorkspace::enableActions() {
    if (!active_) return;
    const bool any = labels_->selected().has_value();
    const bool proposal = proposals_->selected().has_value();
    actions_->undo->setEnabled(labels_->canUndo());
    actions_->redo->setEnabled(labels_->canRedo());
    setTip(*actions_->undo, labels_->canUndo() ? tr("Undo: %1").arg(labels_->undoName()) : tr("Undo"));
    setTip(*actions_->redo, labels_->canRedo() ? tr("Redo: %1").arg(labels_->redoName()) : tr("Redo"));
    for (QAction* action : {actions_->keyframe,      actions_->redraw,
                            actions_->spread_size,   actions_->spread_correction,
                            actions_->fit_pictures,  actions_->copy_on,
                            actions_->copy_back,     actions_->delete_keyframe,
                            actions_->delete_object, actions_->end_here,
                            actions_->occluded,      actions_->outside,
                            actions_->ignore,        actions_->spread_flags,
                            actions_->turn_left,     actions_->turn_right,
                            actions_->checked,       actions_->questionable,
                            actions_->unseen,        actions_->join,
                            actions_->fuse,          actions_->split,
                            actions_->swap,          actions_->renumber,
                            actions_->delete_before, actions_->delete_after,
                            actions_->track_on,      actions_->track_back,
                            actions_->next_keyframe, actions_->previous_keyframe})
        action->setEnabled(any);
    for (QAction* action : {actions_->accept, actions_->reject}) action->setEnabled(proposal);
    for (QAction* action : {actions_->accept_all, actions_->accept_range, actions_->next_proposal})
        action->setEnabled(proposals_->shown());
    actions_->offer_again->setEnabled(proposals_->rejectedCount() > 0);
    actions_->stop_tracking->setEnabled(tracking_->working() || fitting_->working());
    actions_->try_to_write->setEnabled(labels_->isOpen() && labels_->readOnly());
    for (QAction* action : {actions_->draw, actions_->region}) action->setEnabled(labels_->isOpen());
}

void LabelWorkspace::tell(const QString& text) {
    around_.messages.showTopic(kLabelTopic, MessageKind::info, text);  // the newest counts
}

void LabelWorkspace::followObject() {
    const bool following = active_ && actions_->follow->isChecked();
    const LabelledObject* object = following ? editor_->object() : nullptr;
    if (object == nullptr) {
        around_.canvas.setRotation(0);
        return;
    }
    const auto box = LabelEditor::expectedBox(*object, around_.session.viewFrame().index, labels_->camera());
    if (!box) return;
    const bool upright = actions_->follow_upright->isChecked();
    around_.canvas.setRotation(upright ? -std::numbers::pi / 2 - box->heading : 0);
    around_.canvas.centreOn({box->centre.x, box->centre.y});
}

}  // namespace eyrie::ui
