#include "label/label_workspace.h"

#include <QMainWindow>
#include <QMenu>
#include <QMenuBar>
#include <QTimer>
#include <QToolBar>
#include <functional>
#include <numbers>

#include "annotation/edits/object_pieces.h"
#include "canvas/video_view.h"
#include "label/canvas/label_timeline.h"
#include "label/canvas/label_tool.h"
#include "label/computing/label_fitting.h"
#include "label/computing/label_tracking.h"
#include "label/computing/tracking_strip.h"
#include "label/identity_commands.h"
#include "label/label_actions.h"
#include "label/label_classes.h"
#include "label/label_commands.h"
#include "label/label_lists.h"
#include "label/label_scene.h"
#include "label/lists/object_inspector.h"
#include "label/lists/objects_panel.h"
#include "label/object_pictures.h"
#include "widgets/display_text.h"
#include "widgets/empty_state.h"
#include "widgets/layout/overlay_column.h"
#include "widgets/message_bar.h"
#include "widgets/wiring.h"
#include "workspace/dock_registry.h"

namespace eyrie::ui {

namespace {
const QString kRightTopic = QStringLiteral("right to label");
const QString kNoRunTopic = QStringLiteral("labelling without a run");

QString asSentence(const std::string& reason) {
    const QString text = QString::fromStdString(reason);
    return capitalised(text) + QLatin1Char('.');
}
}  // namespace

LabelWorkspace::LabelWorkspace(const LabelSurroundings& around) : QObject(&around.window), around_(around) {
    labels_ = new LabelSession(around_.session, this);
    proposals_ = new LabelProposals(around_.session, *labels_, this);
    editor_ = new LabelEditor(around_.session, *labels_, this);
    buildWork();
    tool_ = new LabelTool(this);
    actions_ = new LabelActions(around_.keys, around_.window, around_.canvas);
    buildDocks();
    buildToolBar();
    buildMenu();
    identity_ = new IdentityCommands(parts(), this);
    new LabelCommands(parts(), *identity_, this);
    wireLabels();
    wireTool();
    wireObjects();
    pictures_ = new ObjectPictures(parts(), this);  // follows what is shown before
    around_.rows.hide();
}

LabelParts LabelWorkspace::parts() {
    return {around_, *labels_, *proposals_, *editor_, *fitting_, *tracking_, *tool_, *actions_};
}

void LabelParts::tell(const QString& text) const {
    around.messages.showTopic(kLabelTopic, MessageKind::info, text);  // the newest counts
}

ChipGrid& LabelWorkspace::chips() {
    return pictures_->chips();
}

void LabelWorkspace::buildDocks() {
    model_ = new ObjectsModel(this);
    objects_ = new ObjectsPanel(model_);
    inspector_ = new ObjectInspector;
    inspector_->nameKeys(*actions_);
    whenAny(
        &around_.keys, inspector_, [this] { inspector_->nameKeys(*actions_); }, &KeyBindings::keysChanged);
    around_.docks.add(DockId::objects, tr("Objects"), objects_);
    around_.docks.add(DockId::object, tr("Object"), inspector_);
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
    if (!active) {
        tool_->cancel();
        around_.messages.dismissTopic(kNoRunTopic);
    }
    active_ = active;
    bar_->setVisible(active);
    menu_->menuAction()->setVisible(active);
    around_.rows.setVisible(active);
    around_.canvas.setTool(active ? tool_ : nullptr);
    actions_->setActive(active);
    followObject();
    labels_->setWanted(active || labels_->isOpen());
    tellRight();
    labelsChanged();
    around_.canvas.setFocus();
}

// ---- showing --------------------------------------------------------------------------------------------------------

void LabelWorkspace::wireLabels() {
    connect(labels_, &LabelSession::changed, this, &LabelWorkspace::labelsChanged);
    connect(labels_, &LabelSession::drawnClassChanged, this, &LabelWorkspace::showScene);
    connect(identity_, &IdentityCommands::shownEditChanged, this, &LabelWorkspace::showScene);
    connect(proposals_, &LabelProposals::changed, this, [this] {
        showScene();
        enableActions();
    });
    connect(labels_, &LabelSession::problem, &around_.session, &ProjectSession::problem);
    connect(labels_, &LabelSession::notice, this, [this](const QString& text) { parts().tell(text); });
    connect(labels_, &LabelSession::opened, this, &LabelWorkspace::labelsOpened);
    connect(labels_, &LabelSession::refused, this, &LabelWorkspace::tellRight);
    connect(labels_, &LabelSession::selectionChanged, this, &LabelWorkspace::selectionChanged);
    whenChanged(around_.session, this,
                {{SessionChange::keep_written, [this] { inspector_->keepWritten(); }},
                 {SessionChange::picture, [this] { pictureChanged(); }},
                 {SessionChange::video,
                  [this] {
                      objects_->explainNothing(around_.session.video().has_value());
                      enableActions();
                  }},
                 {{SessionChange::current_run, SessionChange::run_started, SessionChange::video},
                  [this] { around_.messages.dismissTopic(kNoRunTopic); }},
                 {SessionChange::frame, [this] {
                      if (active_) objects_->setFrame(around_.session.currentFrame());
                  }}});
    for (QAction* action : {actions_->follow, actions_->follow_upright})
        bindSwitches(this, {{action, [this] { followObject(); }}});
}

void LabelWorkspace::tellRight() {
    if (!active_ || !labels_->isOpen() || !labels_->readOnly())
        around_.messages.dismissTopic(kRightTopic);
    else
        around_.messages.showTopic(kRightTopic, MessageKind::warning, asSentence(labels_->store()->readOnlyReason()),
                                   tr("Try again"), [this] { labels_->tryToWrite(); });
}

void LabelWorkspace::labelsOpened() {
    tellRight();
    if (labels_->readOnly()) return enableActions();
    if (active_ && !around_.session.currentRun() && labels_->annotations().objects.empty())
        around_.messages.showTopic(
            kNoRunTopic, MessageKind::info,
            tr("This video has no run yet: boxes are interpolated in the image. After a run they follow the ground, "
               "however the camera moves."));
    enableActions();
}

void LabelWorkspace::selectionChanged() {
    showScene();
    showObject();
    objects_->selectId(labels_->selected().value_or(0));
    around_.rows.setSelection(labels_->selection(), labels_->selected());
    enableActions();
    followObject();
    if (active_) pictures_->showChipsSoon();
}

void LabelWorkspace::pictureChanged() {
    if (!active_) return;
    followObject();
    showScene();
    showObject();
}

/// What the hand does on the canvas.
void LabelWorkspace::wireTool() {
    connect(tool_, &LabelTool::repaintNeeded, &around_.canvas, qOverload<>(&QWidget::update));
    tool_->setCommands({
        .show_drawing = [this](bool drawing) { showDrawing(*actions_->draw, drawing); },
        .show_region_drawing = [this](bool drawing) { showDrawing(*actions_->region, drawing); },
        .add_region = std::bind_front(&LabelEditor::addRegion, editor_),
        .add_box = std::bind_front(&LabelEditor::add, editor_),
        .redraw_box = [this](ObjectId id, FrameIndex frame,
                             const OrientedBox& box) { editor_->setBox(id, frame, box, true, tr("Redraw box of %1")); },
        .change_box =
            [this](ObjectId id, FrameIndex frame, const OrientedBox& box, bool turned, bool resized) {
                const QString what = turned    ? tr("Turn box of %1")
                                     : resized ? tr("Resize box of %1")
                                               : tr("Move box of %1");
                editor_->setBox(id, frame, box, turned, what);
            },
        .choose_object = [this](std::optional<ObjectId> id, bool add) { chooseObject(id, add); },
        .choose_proposal = [this](TrackId track, bool add) { chooseProposal(track, add); },
    });
}

void LabelWorkspace::showDrawing(QAction& action, bool drawing) {
    action.setChecked(drawing);
    around_.canvas.hideKeyPointer();  // the tool stays, and the next drawing begins anew
}

void LabelWorkspace::chooseObject(std::optional<ObjectId> id, bool add) {
    proposals_->select(std::nullopt);
    if (id && add)
        labels_->toggle(*id);
    else
        labels_->select(id);
}

void LabelWorkspace::chooseProposal(TrackId track, bool add) {
    labels_->select(std::nullopt);
    if (add)
        proposals_->toggle(track);
    else
        proposals_->select(track);
}

/// What goes on by itself: boxes that are followed and refined.
void LabelWorkspace::buildWork() {
    const auto enable = [this] { enableActions(); };
    strip_ = new TrackingStrip([this] { tracking_->stop(); });
    around_.over_canvas.add(*strip_);
    fitting_ = new LabelFitting(around_.session, *labels_, enable, this);
    tracking_ = new LabelTracking(around_.session, *labels_,
                                  {.working_changed =
                                       [this, enable] {
                                           if (!tracking_->working()) strip_->hide();
                                           enable();
                                       },
                                   .show_advance =
                                       [this](const TrackingAdvance& advance) {
                                           strip_->showAdvance(advance);
                                           if (advance.done > 0) around_.session.goToFrame(advance.frame);
                                       },
                                   .show_end =
                                       [this](FrameIndex frame, const QString& told) {
                                           around_.session.goToFrame(frame);
                                           if (!told.isEmpty()) parts().tell(told);
                                       }},
                                  this);
}

/// What the lists of objects do.
void LabelWorkspace::wireObjects() {
    objects_->setCommands({.select = [this](int object) { labels_->select(object); },
                           .go_to = [this](int object, int frame) { editor_->goTo(object, frame); }});
    bindCommands(this, {{objects_->emptyState()->button(), [this] { actions_->draw->trigger(); }}});
    bindSwitches(this, {{actions_->this_frame, [this](bool only) { objects_->setThisFrameOnly(only); }}});
    connect(&around_.rows, &LabelTimeline::placeClicked, editor_, &LabelEditor::goTo);
    connect(&around_.rows, &LabelTimeline::frameRequested, &around_.session, &ProjectSession::goToFrame);
    inspector_->setEdits(inspectorEdits());
}

ObjectEdits LabelWorkspace::inspectorEdits() {
    return {
        .set_class = [this](const QString& name) { editor_->setClass(name.toStdString()); },
        .set_colour =
            [this](const QColor& colour) {
                editor_->setColour(colour.isValid() ? std::optional<std::uint32_t>(colour.rgb() & 0xffffffU)
                                                    : std::nullopt);
            },
        .toggle_occluded = [this] { editor_->toggleOccluded(); },
        .toggle_outside = [this] { editor_->toggleOutside(); },
        .toggle_ignore = [this] { editor_->toggleIgnore(); },
        .set_notes = [this](int object, const QString& notes) { editor_->setNotes(object, notes); },
        .check = [this] { actions_->checked->trigger(); },
        .question = [this] { actions_->questionable->trigger(); },
        .join = [this](int other) { editor_->join(other, GapFilling::interpolate); },
        .show_candidate = [this](int other) { showCandidate(other); },
    };
}

void LabelWorkspace::showCandidate(ObjectId other) {
    const LabelledObject* candidate = labels_->object(other);
    const auto main = labels_->selected();
    if (candidate == nullptr || !main) return;
    const bool later = firstFrameOf(*candidate) > labels_->object(*main)->last_frame;
    around_.session.goToFrame(later ? firstFrameOf(*candidate) : candidate->last_frame);
    labels_->setSelection({*main, other}, main);
}

void LabelWorkspace::labelsChanged() {
    if (!active_) return;
    showScene();
    showObject();
    enableActions();
    pictures_->showChipsSoon();
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
    tool_->setScene(labelScene(*labels_, *proposals_, around_.session.viewFrame().index,
                               around_.session.scale().in(around_.session.viewFrame().index), identity_->shownEdit()));
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
        inspector_->showObject(
            objectDetails(*labels_, *editor_, around_.session.scale().in(around_.session.viewFrame().index)));
}

void LabelWorkspace::enableActions() {
    if (!active_) return;
    const bool any = labels_->selected().has_value();
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
    for (QAction* action :
         {actions_->accept, actions_->reject, actions_->accept_all, actions_->accept_range, actions_->next_proposal})
        action->setEnabled(proposals_->shown());
    actions_->offer_again->setEnabled(proposals_->rejectedCount() > 0);
    actions_->stop_tracking->setEnabled(tracking_->working() || fitting_->working());
    actions_->try_to_write->setEnabled(labels_->isOpen() && labels_->readOnly());
    for (QAction* action :
         {actions_->draw, actions_->region, actions_->delete_region, actions_->region_begins, actions_->region_ends,
          actions_->region_anchor, actions_->import_labels, actions_->export_labels, actions_->next_attention,
          actions_->next_unchecked, actions_->proposals, actions_->proposal_tolerance})
        action->setEnabled(labels_->isOpen());
    for (QAction* action : actions_->object_class) action->setEnabled(labels_->isOpen());
    for (QAction* action : {actions_->next_object, actions_->previous_object})
        action->setEnabled(labels_->isOpen() && !labels_->annotations().objects.empty());
    for (QAction* action : {actions_->next_frame, actions_->previous_frame, actions_->ten_on, actions_->ten_back})
        action->setEnabled(around_.session.video().has_value());
    for (QAction* action : actions_->nudge) action->setEnabled(around_.session.video().has_value());
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

#include "moc_label_workspace.cpp"
