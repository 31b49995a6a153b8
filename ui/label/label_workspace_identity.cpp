// The part of LabelWorkspace that says which object is which, and what ignore regions and ranges of frames do.
#include <QMenu>

#include "annotation/edits/object_pieces.h"
#include "annotation/review/join_suggestions.h"
#include "canvas/video_view.h"
#include "label/canvas/label_tool.h"
#include "label/label_actions.h"
#include "label/label_lists.h"
#include "label/label_workspace.h"
#include "widgets/message_bar.h"

namespace eyrie::ui {

std::optional<ObjectId> LabelWorkspace::otherSelected() const {
    if (labels_->selection().size() != 2 || !labels_->selected()) return std::nullopt;
    for (const ObjectId id : labels_->selection())
        if (id != *labels_->selected()) return id;
    return std::nullopt;
}

void LabelWorkspace::offer(QAction* action, const std::function<std::optional<LabelEditor::Plan>()>& make) {
    const Planned before = std::exchange(planned_, {});
    const FrameIndex frame = around_.session.shownFrame();
    if (before.action == action && before.frame == frame && before.selection == labels_->selection() && before.plan &&
        before.plan->version == labels_->version()) {
        around_.messages.dismissTopic(kLabelTopic);
        editor_->carryOut(before.plan);
        return;
    }
    auto plan = make();
    if (!plan) return;
    const QString key = action->shortcut().toString(QKeySequence::NativeText);
    const QString text = tr("%1 → %2. Press %3 again to confirm, Esc to cancel.")
                             .arg(QString::fromStdString(plan->edit.name), plan->text, key);
    planned_ = {action, frame, labels_->selection(), std::move(plan)};
    showScene();
    around_.messages.showTopic(kLabelTopic, MessageKind::info, text, tr("Confirm"),
                               [this, action] { action->trigger(); });
}

void LabelWorkspace::identityWithOther(bool fuse) {
    if (!labels_->selected() || !labels_->mayEdit()) return;
    if (const auto other = otherSelected()) {
        offer(fuse ? actions_->fuse : actions_->join,
              [&] { return fuse ? editor_->planFuse(*other) : editor_->planJoin(*other, GapFilling::interpolate); });
        return;
    }
    // Candidates, the nearest first; pointing at one shows it.
    QMenu menu;
    if (fuse) {
        for (const FuseSuggestion& offer :
             suggestFusions(labels_->annotations(), *labels_->selected(), labels_->camera(), 0.05))
            menu.addAction(tr("%1, overlap %2 in %3 frames")
                               .arg(QString::fromStdString(nameOf(*labels_->object(offer.object))))
                               .arg(offer.mean_overlap, 0, 'f', 2)
                               .arg(offer.shared_frames))
                ->setData(offer.object);
    } else {
        for (const JoinSuggestion& offer :
             suggestJoins(labels_->annotations(), *labels_->selected(), labels_->camera()))
            menu.addAction(joinText(*labels_, offer.object, offer.later, offer.gap, offer.distance_px))
                ->setData(offer.object);
    }
    if (menu.isEmpty()) {
        tell(fuse ? tr("No other object overlaps this one. Select both (Ctrl+click) to fuse them anyway.")
                  : tr("No other object begins or ends near this one. Select both (Ctrl+click) to join them "
                       "anyway."));
        return;
    }
    const auto main = labels_->selected();
    connect(&menu, &QMenu::hovered, this, [this, main](QAction* action) {
        labels_->setSelection({*main, action->data().toInt()}, main);
    });
    const QAction* chosen = menu.exec(around_.canvas.mapToGlobal(around_.canvas.rect().center()));
    labels_->select(main);
    if (chosen == nullptr) return;
    const ObjectId other = chosen->data().toInt();  // pointed at it was shown already
    fuse ? editor_->fuse(other) : editor_->join(other, GapFilling::interpolate);
}

void LabelWorkspace::wireIdentity() {
    connect(actions_->join, &QAction::triggered, this, [this] { identityWithOther(false); });
    connect(actions_->fuse, &QAction::triggered, this, [this] { identityWithOther(true); });
    connect(actions_->split, &QAction::triggered, this,
            [this] { offer(actions_->split, [this] { return editor_->planSplit(); }); });
    connect(actions_->swap, &QAction::triggered, this, [this] {
        if (const auto other = otherSelected())
            offer(actions_->swap, [&] { return editor_->planSwap(*other); });
        else
            tell(tr("Select the two objects to swap from this frame on (Ctrl+click)."));
    });
    connect(actions_->renumber, &QAction::triggered, this,
            [this] { offer(actions_->renumber, [this] { return editor_->planRenumber(); }); });
    connect(actions_->delete_before, &QAction::triggered, editor_, &LabelEditor::deleteBefore);
    connect(actions_->delete_after, &QAction::triggered, editor_, &LabelEditor::deleteAfter);
}

// ---- ignore regions and ranges --------------------------------------------------------------------------------------

FrameRange LabelWorkspace::markedRange() const {
    FrameRange range = around_.session.settings().range;
    const FrameIndex end = around_.session.lastFrame();
    range.last = range.last < 0 ? end : std::min(range.last, end);
    return range;
}

void LabelWorkspace::wireRanges() {
    const auto under_cursor = [this](QAction* action, const QString& asked, auto work) {
        connect(action, &QAction::triggered, this, [this, asked, work] {
            const auto place = tool_->cursorInImage();
            if (!labels_->mayEdit()) return;
            if (!place || work(cv::Point2d(place->x(), place->y())) == 0) tell(asked);
        });
    };
    const QString which = tr("Point at an ignore region.");
    under_cursor(actions_->delete_region, which, [this](cv::Point2d at) { return editor_->deleteRegionsAt(at); });
    under_cursor(actions_->region_anchor, which, [this](cv::Point2d at) { return editor_->anchorRegionsAt(at); });
    under_cursor(actions_->region_begins, which, [this](cv::Point2d at) {
        return editor_->changeRegionsAt(at, tr("Begin an ignore region here"), [this](IgnoreRegion& region) {
            region.first_frame = around_.session.shownFrame();
        });
    });
    under_cursor(actions_->region_ends, which, [this](cv::Point2d at) {
        return editor_->changeRegionsAt(at, tr("End an ignore region here"), [this](IgnoreRegion& region) {
            region.last_frame = around_.session.shownFrame();
        });
    });
    connect(actions_->spread_flags, &QAction::triggered, this, [this] {
        const FrameRange range = markedRange();
        editor_->spreadFlags(range.first, range.last);
    });
}

}  // namespace eyrie::ui
