#include "label/label_commands.h"

#include <QInputDialog>
#include <QMainWindow>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "annotation/edits/object_pieces.h"
#include "canvas/video_view.h"
#include "label/canvas/label_layer.h"
#include "label/canvas/label_tool.h"
#include "label/computing/label_fitting.h"
#include "label/computing/label_proposals.h"
#include "label/computing/label_tracking.h"
#include "label/editor/label_editor.h"
#include "label/files/label_files.h"
#include "label/files/label_files_export.h"
#include "label/identity_commands.h"
#include "label/label_actions.h"
#include "label/label_classes.h"
#include "widgets/wiring.h"
#include "workspace/window_actions.h"

namespace eyrie::ui {

namespace {
constexpr double kDegree = std::numbers::pi / 180;

QString acceptedText(std::size_t tracks) {
    return tracks == 1 ? LabelCommands::tr("Accepted 1 track.") : LabelCommands::tr("Accepted %1 tracks.").arg(tracks);
}
}  // namespace

LabelCommands::LabelCommands(const LabelParts& parts, IdentityCommands& identity, QObject* parent)
    : QObject(parent), parts_(parts), identity_(identity) {
    bindDrawing();
    bindRegions();
    bindEdits();
    bindNudges();
    bindGoing();
    bindProposals();
    bindTracking();
    bindFiles();
}

// ---- drawing --------------------------------------------------------------------------------------------------------

void LabelCommands::bindDrawing() {
    const LabelActions& actions = parts_.actions;
    LabelTool& tool = parts_.tool;
    bindCommands(this,
                 {
                     {actions.draw, [&](bool on) { drawWith(actions.draw, on, [&] { tool.startDrawing(); }); }},
                     {actions.region, [&](bool on) { drawWith(actions.region, on, [&] { tool.startRegion(); }); }},
                     {actions.redraw,
                      [this] {
                          LabelSession& labels = parts_.labels;
                          if (labels.selected() && labels.mayEdit()) parts_.tool.startDrawing(labels.selected());
                          parts_.around.canvas.setFocus();
                      }},
                 });
}

void LabelCommands::drawWith(QAction* action, bool on, const std::function<void()>& start) {
    if (!on)
        parts_.tool.cancel();
    else if (parts_.labels.mayEdit())
        start();
    else
        action->setChecked(false);
    parts_.around.canvas.setFocus();
}

void LabelCommands::bindRegions() {
    const LabelActions& actions = parts_.actions;
    LabelEditor& editor = parts_.editor;
    const ProjectSession& session = parts_.around.session;
    const auto begin = [&session](IgnoreRegion& region) { region.first_frame = session.shownFrame(); };
    const auto end = [&session](IgnoreRegion& region) { region.last_frame = session.shownFrame(); };
    const auto under_cursor = [this](const std::function<int(cv::Point2d)>& change) {
        return [this, change] { changeRegions(change); };
    };
    bindCommands(
        this,
        {
            {actions.delete_region, under_cursor([&editor](cv::Point2d at) { return editor.deleteRegionsAt(at); })},
            {actions.region_anchor, under_cursor([&editor](cv::Point2d at) { return editor.anchorRegionsAt(at); })},
            {actions.region_begins, under_cursor([&editor, begin](cv::Point2d at) {
                 return editor.changeRegionsAt(at, tr("Begin an ignore region here"), begin);
             })},
            {actions.region_ends, under_cursor([&editor, end](cv::Point2d at) {
                 return editor.changeRegionsAt(at, tr("End an ignore region here"), end);
             })},
        });
}

void LabelCommands::changeRegions(const std::function<int(cv::Point2d)>& change) {
    const auto place = parts_.tool.cursorInImage();
    if (!parts_.labels.mayEdit()) return;
    if (!place || change(cv::Point2d(place->x(), place->y())) == 0) parts_.tell(tr("Point at an ignore region."));
}

// ---- edits ----------------------------------------------------------------------------------------------------------

void LabelCommands::bindEdits() {
    const LabelActions& actions = parts_.actions;
    LabelSession& labels = parts_.labels;
    LabelEditor& editor = parts_.editor;
    LabelFitting& fitting = parts_.fitting;
    bindCommands(this, {
                           {actions.undo,
                            [&] {
                                // What is at work is not in the labels yet: it ends, and what it did can be undone.
                                if (parts_.tracking.working() || parts_.fitting.working())
                                    escape();
                                else
                                    labels.undo();
                            }},
                           {actions.redo, [&] { labels.redo(); }},
                           {actions.try_to_write, [&] { labels.tryToWrite(); }},
                           {actions.keyframe, [&] { editor.setKeyframe(); }},
                           {actions.spread_size, [&] { editor.spreadSize(); }},
                           {actions.spread_correction, [&] { editor.spreadCorrection(); }},
                           {actions.fit_pictures, [&] { fitting.start(); }},
                           {actions.copy_on, [&] { editor.copyOn(1); }},
                           {actions.copy_back, [&] { editor.copyOn(-1); }},
                           {actions.delete_keyframe, [&] { editor.deleteKeyframe(); }},
                           {actions.delete_object, [&] { editor.deleteObjects(); }},
                           {actions.end_here, [&] { editor.endHere(); }},
                           {actions.occluded, [&] { editor.toggleOccluded(); }},
                           {actions.outside, [&] { editor.toggleOutside(); }},
                           {actions.ignore, [&] { editor.toggleIgnore(); }},
                           {actions.spread_flags,
                            [&] {
                                const FrameRange range = markedRange();
                                editor.spreadFlags(range.first, range.last);
                            }},
                           {actions.turn_left, [this] { turnBy(-kDegree); }},
                           {actions.turn_right, [this] { turnBy(kDegree); }},
                           {actions.checked, [&] { editor.mark(ReviewState::checked); }},
                           {actions.questionable, [&] { editor.mark(ReviewState::questionable); }},
                           {actions.unseen, [&] { editor.mark(ReviewState::unseen); }},
                       });
    for (std::size_t i = 0; i < actions.object_class.size(); ++i)
        bindCommands(
            this, {{actions.object_class[i], [&editor, name = builtInClasses()[i].name] { editor.setClass(name); }}});
    bindSwitches(this, {{actions.carry_corrections, [&](bool on) { editor.setCarriesCorrections(on); }}});
}

void LabelCommands::bindNudges() {
    const double amounts[] = {1, 0.1, 5};
    const QPointF ways[] = {{-1, 0}, {1, 0}, {0, -1}, {0, 1}};
    const auto& nudges = parts_.actions.nudge;
    for (std::size_t i = 0; i < nudges.size(); ++i)
        bindCommands(this, {{nudges[i], [this, by = ways[i % 4] * amounts[i / 4]] {
                                 if (parts_.labels.selected()) {
                                     const ViewTransform& shown = parts_.around.canvas.transform();
                                     // As the picture lies on screen.
                                     const QPointF moved = shown.imageVector(by, {}) * shown.scale();
                                     parts_.editor.nudge(moved.x(), moved.y());
                                     parts_.tool.showNudged();
                                 } else if (by.x() != 0) {
                                     // Without a box the arrows step, as in the other workspaces.
                                     const int frames = std::abs(by.x()) > 1 ? 10 : 1;
                                     parts_.around.session.step(by.x() > 0 ? frames : -frames);
                                 }
                             }}});
}

void LabelCommands::turnBy(double radians) {
    parts_.editor.turn(radians);
    if (parts_.labels.selected()) parts_.tool.showNudged();
}

// ---- going places ---------------------------------------------------------------------------------------------------

void LabelCommands::bindGoing() {
    const LabelActions& actions = parts_.actions;
    LabelEditor& editor = parts_.editor;
    ProjectSession& session = parts_.around.session;
    bindCommands(this, {
                           {actions.next_frame, [&] { session.step(1); }},
                           {actions.previous_frame, [&] { session.step(-1); }},
                           {actions.ten_on, [&] { session.step(10); }},
                           {actions.ten_back, [&] { session.step(-10); }},
                           {actions.next_object, [&] { editor.stepObject(1); }},
                           {actions.previous_object, [&] { editor.stepObject(-1); }},
                           {actions.next_keyframe, [&] { editor.nextKeyframe(); }},
                           {actions.previous_keyframe, [&] { editor.previousKeyframe(); }},
                           {actions.next_attention, [&] { editor.nextAttention(); }},
                           {actions.next_unchecked, [&] { editor.nextUnchecked(); }},
                           {actions.deselect, [this] { escape(); }},
                       });
}

void LabelCommands::escape() {
    if (parts_.tracking.working() || parts_.fitting.working()) {
        parts_.tracking.stop();
        parts_.fitting.stop();
    } else if (identity_.takeBack()) {
        return;
    } else if (!parts_.around.canvas.hasFocus()) {
        parts_.around.canvas.setFocus();
    } else if (!parts_.tool.cancel()) {
        QAction* full_screen = parts_.around.actions.full_screen;
        const bool chosen = !parts_.labels.selection().empty() || !parts_.proposals.selection().empty();
        if (!chosen && full_screen->isChecked()) full_screen->trigger();
        parts_.proposals.select(std::nullopt);
        parts_.labels.select(std::nullopt);
    }
}

// ---- proposals and tracking -----------------------------------------------------------------------------------------

void LabelCommands::bindProposals() {
    const LabelActions& actions = parts_.actions;
    bindSwitches(this, {{actions.proposals, [this](bool on) {
                             parts_.proposals.setShown(on);
                             if (on && !parts_.around.session.currentRun())
                                 parts_.tell(tr("There is no run to propose tracks from. Start one with Run first."));
                         }}});
    bindCommands(this, {
                           {actions.next_proposal, [this] { selectNextProposal(); }},
                           {actions.accept, [this] { acceptMeant(); }},
                           {actions.accept_all, [this] { acceptHere(); }},
                           {actions.accept_range, [this] { acceptMarkedRange(); }},
                           {actions.reject, [this] { rejectMeant(); }},
                           {actions.offer_again, [this] { parts_.proposals.offerAgain(); }},
                           {actions.proposal_tolerance, [this] { chooseTolerance(); }},
                       });
}

void LabelCommands::selectProposal(const Proposal* proposal) {
    LabelProposals& proposals = parts_.proposals;
    proposals.select(proposal != nullptr ? std::optional(proposal->track) : std::nullopt);
    if (proposal == nullptr) {
        if (!proposals.working()) parts_.tell(tr("No proposal is left."));
        return;
    }
    parts_.labels.select(std::nullopt);
    const FrameIndex frame = parts_.around.session.currentFrame();
    const FrameIndex first = firstFrameOf(proposal->object);
    if (frame < first || frame > proposal->object.last_frame) parts_.around.session.goToFrame(first);
}

void LabelCommands::selectNextProposal() {
    const FrameIndex frame = parts_.around.session.currentFrame();
    const Proposal* next = nullptr;
    for (const Proposal* proposal : parts_.proposals.pendingIn(frame))
        if (next == nullptr && proposal->track > parts_.proposals.selected().value_or(0)) next = proposal;
    selectProposal(next != nullptr ? next : parts_.proposals.next(frame));
}

std::vector<TrackId> LabelCommands::meantProposals() {
    if (parts_.proposals.selected()) return parts_.proposals.selection();
    const auto place = parts_.tool.cursorInImage();
    const LabelMark* hit = place ? proposalAt(parts_.tool.scene(), *place, 0) : nullptr;
    if (hit != nullptr) return {hit->id};
    parts_.tell(tr("Point at a proposal, or go to one with “Next proposal”."));
    return {};
}

void LabelCommands::acceptMeant() {
    LabelProposals& proposals = parts_.proposals;
    const bool chosen = proposals.selected().has_value();
    const auto objects = proposals.accept(meantProposals());
    if (objects.empty()) return;
    if (objects.size() > 1) parts_.tell(acceptedText(objects.size()));
    // Who points goes on pointing; nothing is chosen for them.
    const Proposal* next = chosen ? proposals.next(parts_.around.session.currentFrame()) : nullptr;
    if (next != nullptr)
        selectProposal(next);
    else
        parts_.labels.select(objects.front());
}

void LabelCommands::acceptHere() {
    std::vector<TrackId> tracks;
    for (const Proposal* proposal : parts_.proposals.pendingIn(parts_.around.session.currentFrame()))
        tracks.push_back(proposal->track);
    const auto objects = parts_.proposals.accept(tracks);
    if (tracks.empty()) parts_.tell(tr("No proposal is left in this frame."));
    if (!objects.empty()) parts_.tell(acceptedText(objects.size()));
}

void LabelCommands::acceptMarkedRange() {
    if (!parts_.labels.mayEdit()) return;  // which says why
    const FrameRange range = markedRange();
    const auto objects = parts_.proposals.acceptRange(range.first, range.last);
    parts_.tell(objects.empty() ? tr("No proposal is left there.") : acceptedText(objects.size()));
}

void LabelCommands::rejectMeant() {
    const bool chosen = parts_.proposals.selected().has_value();
    parts_.proposals.reject(meantProposals());
    if (chosen) selectProposal(parts_.proposals.next(parts_.around.session.currentFrame()));
}

void LabelCommands::chooseTolerance() {
    bool chosen = false;
    const double px =
        QInputDialog::getDouble(&parts_.around.window, tr("Keyframes of proposals"),
                                tr("Corners may be off the track by up to (px):\nsmaller means more keyframes"),
                                parts_.proposals.tolerance(), 0.1, 100, 1, &chosen);
    if (chosen) parts_.proposals.setTolerance(px);
}

FrameRange LabelCommands::markedRange() const {
    FrameRange range = parts_.around.session.settings().range;
    const FrameIndex end = parts_.around.session.lastFrame();
    range.last = range.last < 0 ? end : std::min(range.last, end);
    return range;
}

void LabelCommands::bindTracking() {
    const LabelActions& actions = parts_.actions;
    bindCommands(this, {
                           {actions.track_on, [this] { parts_.tracking.start(1); }},
                           {actions.track_back, [this] { parts_.tracking.start(-1); }},
                           {actions.stop_tracking,
                            [this] {
                                parts_.tracking.stop();
                                parts_.fitting.stop();
                            }},
                       });
}

// ---- files ----------------------------------------------------------------------------------------------------------

void LabelCommands::bindFiles() {
    const LabelActions& actions = parts_.actions;
    bindCommands(this, {
                           {actions.import_labels,
                            [this] {
                                if (!parts_.labels.mayEdit()) return;
                                LabelImportDialog dialog(parts_.labels, &parts_.around.window);
                                if (dialog.choose() && dialog.exec() == QDialog::Accepted)
                                    parts_.tell(dialog.summary());
                            }},
                           {actions.export_labels,
                            [this] {
                                if (!parts_.labels.isOpen()) return;
                                ExportDialog dialog(labelExport(parts_.labels), &parts_.around.window);
                                dialog.exec();
                            }},
                       });
}

}  // namespace eyrie::ui

#include "moc_label_commands.cpp"
