// The part of LabelWorkspace that says what its commands do.
#include <QDockWidget>
#include <QInputDialog>
#include <QMainWindow>
#include <numbers>

#include "annotation/edits/object_pieces.h"
#include "canvas/video_view.h"
#include "label/canvas/label_timeline.h"
#include "label/canvas/label_tool.h"
#include "label/computing/label_fitting.h"
#include "label/computing/label_tracking.h"
#include "label/files/label_files.h"
#include "label/label_actions.h"
#include "label/label_classes.h"
#include "label/label_lists.h"
#include "label/label_workspace.h"
#include "label/lists/object_inspector.h"
#include "label/lists/objects_panel.h"
#include "widgets/message_bar.h"

namespace eyrie::ui {

namespace {
constexpr double kDegree = std::numbers::pi / 180;
}

void LabelWorkspace::wireTool() {
    connect(tool_, &LabelTool::repaintNeeded, &around_.canvas, qOverload<>(&QWidget::update));
    connect(tool_, &LabelTool::drawingChanged, actions_->draw, &QAction::setChecked);
    connect(tool_, &LabelTool::boxDrawn, this,
            [this](const OrientedBox& box, FrameIndex frame) { editor_->add(box, frame); });
    connect(tool_, &LabelTool::boxRedrawn, this, [this](ObjectId id, FrameIndex frame, const OrientedBox& box) {
        editor_->setBox(id, frame, box, true, tr("Redraw box of %1"));
    });
    connect(actions_->redraw, &QAction::triggered, this, [this] {
        if (labels_->selected() && labels_->mayEdit()) tool_->startDrawing(labels_->selected());
        around_.canvas.setFocus();
    });
    connect(tool_, &LabelTool::boxChanged, this,
            [this](ObjectId id, FrameIndex frame, const OrientedBox& box, bool turned, bool resized) {
                const QString what = turned    ? tr("Turn box of %1")
                                     : resized ? tr("Resize box of %1")
                                               : tr("Move box of %1");
                editor_->setBox(id, frame, box, turned, what);
            });
    connect(tool_, &LabelTool::objectClicked, this, [this](std::optional<ObjectId> id, bool add) {
        proposals_->select(std::nullopt);
        if (id && add)
            labels_->toggle(*id);
        else
            labels_->select(id);
    });
    connect(tool_, &LabelTool::proposalClicked, this, [this](TrackId track, bool add) {
        labels_->select(std::nullopt);
        if (add)
            proposals_->toggle(track);
        else
            proposals_->select(track);
    });
    connect(actions_->draw, &QAction::triggered, this, [this](bool on) {
        if (!on)
            tool_->cancel();
        else if (labels_->mayEdit())
            tool_->startDrawing();
        else
            actions_->draw->setChecked(false);
        around_.canvas.setFocus();
    });
    connect(tool_, &LabelTool::regionDrawingChanged, actions_->region, &QAction::setChecked);
    connect(tool_, &LabelTool::regionDrawn, editor_, &LabelEditor::addRegion);
    connect(actions_->region, &QAction::triggered, this, [this](bool on) {
        if (!on)
            tool_->cancel();
        else if (labels_->mayEdit())
            tool_->startRegion();
        else
            actions_->region->setChecked(false);
        around_.canvas.setFocus();
    });
    connect(actions_->loupe, &QAction::toggled, tool_, &LabelTool::setLoupeShown);
}

void LabelWorkspace::wireEditActions() {
    const auto does = [this](QAction* action, auto work) { connect(action, &QAction::triggered, this, work); };
    does(actions_->undo, [this] { labels_->undo(); });
    does(actions_->redo, [this] { labels_->redo(); });
    does(actions_->try_to_write, [this] { labels_->tryToWrite(); });
    does(actions_->keyframe, [this] { editor_->setKeyframe(); });
    does(actions_->spread_size, [this] { editor_->spreadSize(); });
    does(actions_->spread_correction, [this] { editor_->spreadCorrection(); });
    does(actions_->fit_pictures, [this] { fitting_->start(); });
    connect(fitting_, &LabelFitting::workingChanged, this, [this] { enableActions(); });
    connect(actions_->carry_corrections, &QAction::toggled, this,
            [this](bool on) { editor_->setCarriesCorrections(on); });
    does(actions_->copy_on, [this] { editor_->copyOn(1); });
    does(actions_->copy_back, [this] { editor_->copyOn(-1); });
    does(actions_->delete_keyframe, [this] { editor_->deleteKeyframe(); });
    does(actions_->delete_object, [this] { editor_->deleteObjects(); });
    does(actions_->end_here, [this] { editor_->endHere(); });
    does(actions_->occluded, [this] { editor_->toggleOccluded(); });
    does(actions_->outside, [this] { editor_->toggleOutside(); });
    does(actions_->ignore, [this] { editor_->toggleIgnore(); });
    does(actions_->turn_left, [this] { turnBy(-kDegree); });
    does(actions_->turn_right, [this] { turnBy(kDegree); });
    const double amounts[] = {1, 0.1, 5};
    const QPointF ways[] = {{-1, 0}, {1, 0}, {0, -1}, {0, 1}};
    for (std::size_t i = 0; i < actions_->nudge.size(); ++i)
        does(actions_->nudge[i], [this, by = ways[i % 4] * amounts[i / 4]] {
            if (labels_->selected()) {
                const ViewTransform& shown = around_.canvas.transform();
                const QPointF moved = shown.imageVector(by) * shown.scale();  // as the picture lies on screen
                editor_->nudge(moved.x(), moved.y());
                tool_->showNudged();
            } else if (by.x() != 0) {  // without a box the arrows step, as in the other workspaces
                around_.session.step((by.x() > 0 ? 1 : -1) * (std::abs(by.x()) > 1 ? 10 : 1));
            }
        });
    for (std::size_t i = 0; i < actions_->object_class.size(); ++i)
        does(actions_->object_class[i], [this, name = builtInClasses()[i].name] { editor_->setClass(name); });
    does(actions_->checked, [this] { editor_->mark(ReviewState::checked); });
    does(actions_->questionable, [this] { editor_->mark(ReviewState::questionable); });
    does(actions_->unseen, [this] { editor_->mark(ReviewState::unseen); });

    connect(inspector_, &ObjectInspector::classChosen, this,
            [this](const QString& name) { editor_->setClass(name.toStdString()); });
    connect(inspector_, &ObjectInspector::colourChosen, this, [this](const QColor& colour) {
        editor_->setColour(colour.isValid() ? std::optional<std::uint32_t>(colour.rgb() & 0xffffffU) : std::nullopt);
    });
    connect(inspector_, &ObjectInspector::occlusionToggled, editor_, &LabelEditor::toggleOccluded);
    connect(inspector_, &ObjectInspector::outsideToggled, editor_, &LabelEditor::toggleOutside);
    connect(inspector_, &ObjectInspector::ignoreToggled, editor_, &LabelEditor::toggleIgnore);
    connect(inspector_, &ObjectInspector::notesEdited, editor_, &LabelEditor::setNotes);
    connect(inspector_, &ObjectInspector::checkedRequested, actions_->checked, &QAction::trigger);
    connect(inspector_, &ObjectInspector::questionableRequested, actions_->questionable, &QAction::trigger);
    connect(inspector_, &ObjectInspector::joinRequested, this,
            [this](int other) { editor_->join(other, GapFilling::interpolate); });
    connect(inspector_, &ObjectInspector::candidateChosen, this, [this](int other) {
        // Shown where it would be joined, without giving the first one up.
        const LabelledObject* candidate = labels_->object(other);
        const auto main = labels_->selected();
        if (candidate == nullptr || !main) return;
        const bool later = firstFrameOf(*candidate) > labels_->object(*main)->last_frame;
        around_.session.goToFrame(later ? firstFrameOf(*candidate) : candidate->last_frame);
        labels_->setSelection({*main, other}, main);
    });
}

void LabelWorkspace::turnBy(double radians) {
    editor_->turn(radians);
    if (labels_->selected()) tool_->showNudged();
}

void LabelWorkspace::wireGoActions() {
    const auto does = [this](QAction* action, auto work) { connect(action, &QAction::triggered, this, work); };
    does(actions_->next_frame, [this] { around_.session.step(1); });
    does(actions_->previous_frame, [this] { around_.session.step(-1); });
    does(actions_->ten_on, [this] { around_.session.step(10); });
    does(actions_->ten_back, [this] { around_.session.step(-10); });
    does(actions_->next_object, [this] { editor_->stepObject(1); });
    does(actions_->previous_object, [this] { editor_->stepObject(-1); });
    does(actions_->next_keyframe, [this] { editor_->nextKeyframe(); });
    does(actions_->previous_keyframe, [this] { editor_->previousKeyframe(); });
    does(actions_->next_attention, [this] { editor_->nextAttention(); });
    does(actions_->next_unchecked, [this] { editor_->nextUnchecked(); });
    does(actions_->deselect, [this] { escape(); });
    for (QAction* action : {actions_->follow, actions_->follow_upright})
        connect(action, &QAction::toggled, this, [this] { followObject(); });
    connect(actions_->this_frame, &QAction::toggled, objects_, &ObjectsPanel::setThisFrameOnly);
}

void LabelWorkspace::escape() {
    if (tracking_->working() || fitting_->working()) {
        tracking_->stop();
        fitting_->stop();
    } else if (std::exchange(planned_, {}).plan) {
        around_.messages.dismissTopic(kLabelTopic);
        showScene();
    } else if (!around_.canvas.hasFocus()) {
        around_.canvas.setFocus();
    } else if (!tool_->cancel()) {
        proposals_->select(std::nullopt);
        labels_->select(std::nullopt);
    }
}

// ---- proposals and tracking -----------------------------------------------------------------------------------------

void LabelWorkspace::wireProposals() {
    connect(actions_->proposals, &QAction::toggled, this, [this](bool on) {
        proposals_->setShown(on);
        if (on && !around_.session.currentRun())
            tell(tr("There is no run to propose tracks from. Start one with Run first."));
    });
    connect(actions_->next_proposal, &QAction::triggered, this, [this] {
        const auto here = proposals_->pendingIn(around_.session.currentFrame());
        const Proposal* next = nullptr;
        for (const Proposal* proposal : here)
            if (next == nullptr && proposal->track > proposals_->selected().value_or(0)) next = proposal;
        selectProposal(next != nullptr ? next : proposals_->next(around_.session.currentFrame()));
    });
    connect(actions_->accept, &QAction::triggered, this, &LabelWorkspace::acceptSelected);
    connect(actions_->reject, &QAction::triggered, this, [this] {
        if (!proposals_->selected()) return;
        proposals_->reject(proposals_->selection());
        selectProposal(proposals_->next(around_.session.currentFrame()));
    });
    connect(actions_->accept_all, &QAction::triggered, this, [this] {
        std::vector<TrackId> tracks;
        for (const Proposal* proposal : proposals_->pendingIn(around_.session.currentFrame()))
            tracks.push_back(proposal->track);
        const auto objects = proposals_->accept(tracks);
        if (!objects.empty()) tell(tr("Accepted %1 tracks.").arg(objects.size()));
    });
    connect(actions_->accept_range, &QAction::triggered, this, [this] {
        const FrameRange range = markedRange();
        const auto objects = proposals_->acceptRange(range.first, range.last);
        tell(objects.empty() ? tr("No proposal is left there.") : tr("Accepted %1 tracks.").arg(objects.size()));
    });
    connect(actions_->offer_again, &QAction::triggered, proposals_, &LabelProposals::offerAgain);
    connect(actions_->proposal_tolerance, &QAction::triggered, this, [this] {
        bool chosen = false;
        const double px =
            QInputDialog::getDouble(&around_.window, tr("Keyframes of proposals"),
                                    tr("Corners may be off the track by up to (px):\nsmaller means more keyframes"),
                                    proposals_->tolerance(), 0.1, 100, 1, &chosen);
        if (chosen) proposals_->setTolerance(px);
    });

    connect(actions_->track_on, &QAction::triggered, this, [this] { tracking_->start(1); });
    connect(actions_->track_back, &QAction::triggered, this, [this] { tracking_->start(-1); });
    connect(actions_->stop_tracking, &QAction::triggered, tracking_, &LabelTracking::stop);
    connect(actions_->stop_tracking, &QAction::triggered, fitting_, &LabelFitting::stop);
    connect(tracking_, &LabelTracking::workingChanged, this, [this] { enableActions(); });
    connect(tracking_, &LabelTracking::advanced, &around_.session, &ProjectSession::goToFrame);
    connect(tracking_, &LabelTracking::ended, this, [this](FrameIndex frame, const QString& reason) {
        around_.session.goToFrame(frame);
        if (!reason.isEmpty()) tell(tr("Tracking %1").arg(reason));
    });
}

void LabelWorkspace::selectProposal(const Proposal* proposal) {
    proposals_->select(proposal != nullptr ? std::optional(proposal->track) : std::nullopt);
    if (proposal == nullptr) {
        if (!proposals_->working()) tell(tr("No proposal is left."));
        return;
    }
    labels_->select(std::nullopt);
    const FrameIndex frame = around_.session.currentFrame();
    const FrameIndex first = firstFrameOf(proposal->object);
    if (frame < first || frame > proposal->object.last_frame) around_.session.goToFrame(first);
}

void LabelWorkspace::acceptSelected() {
    if (!proposals_->selected()) return;
    const auto objects = proposals_->accept(proposals_->selection());
    if (objects.empty()) return;
    if (objects.size() > 1) tell(tr("Accepted %1 tracks.").arg(objects.size()));
    if (const Proposal* next = proposals_->next(around_.session.currentFrame()))
        selectProposal(next);
    else
        labels_->select(objects.front());
}

// ---- files ----------------------------------------------------------------------------------------------------------

void LabelWorkspace::wireFiles() {
    connect(actions_->import_labels, &QAction::triggered, this, [this] {
        if (!labels_->mayEdit()) return;
        LabelImportDialog dialog(*labels_, &around_.window);
        if (dialog.choose() && dialog.exec() == QDialog::Accepted) tell(dialog.summary());
    });
    connect(actions_->export_labels, &QAction::triggered, this, [this] {
        if (!labels_->isOpen()) return;
        LabelExportDialog dialog(*labels_, &around_.window);
        dialog.exec();
    });
}

}  // namespace eyrie::ui
