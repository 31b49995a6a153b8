#include "label/identity_commands.h"

#include <QMenu>
#include <utility>

#include "annotation/edits/object_pieces.h"
#include "annotation/review/join_suggestions.h"
#include "canvas/video_view.h"
#include "label/label_actions.h"
#include "label/label_lists.h"
#include "label/label_session.h"
#include "widgets/message_bar.h"
#include "widgets/wiring.h"

namespace eyrie::ui {

IdentityCommands::IdentityCommands(const LabelParts& parts, QObject* parent) : QObject(parent), parts_(parts) {
    const LabelActions& actions = parts_.actions;
    LabelEditor& editor = parts_.editor;
    bindCommands(
        this,
        {
            {actions.join, [this] { join(); }},
            {actions.fuse, [this] { fuse(); }},
            {actions.split, [this] { offer(parts_.actions.split, [this] { return parts_.editor.planSplit(); }); }},
            {actions.swap, [this] { swap(); }},
            {actions.renumber,
             [this] { offer(parts_.actions.renumber, [this] { return parts_.editor.planRenumber(); }); }},
            {actions.delete_before, [&editor] { editor.deleteBefore(); }},
            {actions.delete_after, [&editor] { editor.deleteAfter(); }},
        });
}

const AnnotationEdit* IdentityCommands::shownEdit() const {
    const bool fits = planned_.plan && planned_.plan->version == parts_.labels.version() &&
                      planned_.selection == parts_.labels.selection();
    return fits ? &planned_.plan->edit : nullptr;
}

bool IdentityCommands::takeBack() {
    if (!std::exchange(planned_, {}).plan) return false;
    parts_.around.messages.dismissTopic(kLabelTopic);
    emit shownEditChanged();
    return true;
}

std::optional<ObjectId> IdentityCommands::otherSelected() const {
    const LabelSession& labels = parts_.labels;
    if (labels.selection().size() != 2 || !labels.selected()) return std::nullopt;
    for (const ObjectId id : labels.selection())
        if (id != *labels.selected()) return id;
    return std::nullopt;
}

void IdentityCommands::offer(QAction* action, const std::function<std::optional<LabelEditor::Plan>()>& make) {
    const LabelSession& labels = parts_.labels;
    const Planned before = std::exchange(planned_, {});
    // Whatever frame is shown by now: one looks through them before one confirms.
    if (before.action == action && before.selection == labels.selection() && before.plan &&
        before.plan->version == labels.version()) {
        parts_.around.messages.dismissTopic(kLabelTopic);
        parts_.editor.carryOut(before.plan);
        return;
    }
    auto plan = make();
    if (!plan) return;
    const QString key = action->shortcut().toString(QKeySequence::NativeText);
    const QString text = (key.isEmpty() ? tr("%1 → %2. Confirm it, or clear the selection to cancel.")
                                        : tr("%1 → %2. Press %3 again to confirm, or clear the selection to cancel."))
                             .arg(QString::fromStdString(plan->edit.name), plan->text, key);
    planned_ = {action, labels.selection(), std::move(plan)};
    emit shownEditChanged();
    parts_.around.messages.showTopic(kLabelTopic, MessageKind::info, text, tr("Confirm"),
                                     [action] { action->trigger(); });
}

void IdentityCommands::join() {
    LabelSession& labels = parts_.labels;
    LabelEditor& editor = parts_.editor;
    if (!labels.selected() || !labels.mayEdit()) return;
    if (const auto other = otherSelected()) {
        offer(parts_.actions.join, [&] { return editor.planJoin(*other, GapFilling::interpolate); });
        return;
    }
    std::vector<std::pair<ObjectId, QString>> candidates;
    for (const JoinSuggestion& one : suggestJoins(labels.annotations(), *labels.selected(), labels.camera()))
        candidates.emplace_back(one.object, joinText(labels, one.object, one.later, one.gap, one.distance_px));
    if (candidates.empty())
        parts_.tell(
            tr("No other object begins or ends near this one. Select both (Ctrl+click) to join them "
               "anyway."));
    else if (const auto other = chosenOf(candidates))  // pointed at it was shown already
        editor.join(*other, GapFilling::interpolate);
}

void IdentityCommands::fuse() {
    LabelSession& labels = parts_.labels;
    LabelEditor& editor = parts_.editor;
    if (!labels.selected() || !labels.mayEdit()) return;
    if (const auto other = otherSelected()) {
        offer(parts_.actions.fuse, [&] { return editor.planFuse(*other); });
        return;
    }
    std::vector<std::pair<ObjectId, QString>> candidates;
    for (const FuseSuggestion& one : suggestFusions(labels.annotations(), *labels.selected(), labels.camera(), 0.05))
        candidates.emplace_back(one.object, tr("%1, overlap %2 in %3 frames")
                                                .arg(QString::fromStdString(nameOf(*labels.object(one.object))))
                                                .arg(one.mean_overlap, 0, 'f', 2)
                                                .arg(one.shared_frames));
    if (candidates.empty())
        parts_.tell(tr("No other object overlaps this one. Select both (Ctrl+click) to fuse them anyway."));
    else if (const auto other = chosenOf(candidates))
        editor.fuse(*other);
}

void IdentityCommands::swap() {
    if (const auto other = otherSelected())
        offer(parts_.actions.swap, [&] { return parts_.editor.planSwap(*other); });
    else
        parts_.tell(tr("Select the two objects to swap from this frame on (Ctrl+click)."));
}

std::optional<ObjectId> IdentityCommands::chosenOf(const std::vector<std::pair<ObjectId, QString>>& candidates) {
    QMenu menu;
    for (const auto& [object, text] : candidates) menu.addAction(text)->setData(object);
    const auto main = parts_.labels.selected();
    connect(&menu, &QMenu::hovered, this, [this, main](QAction* action) {
        parts_.labels.setSelection({*main, action->data().toInt()}, main);
    });
    const VideoView& canvas = parts_.around.canvas;
    const QAction* chosen = menu.exec(canvas.mapToGlobal(canvas.rect().center()));
    parts_.labels.select(main);
    return chosen != nullptr ? std::optional<ObjectId>(chosen->data().toInt()) : std::nullopt;
}

}  // namespace eyrie::ui

#include "moc_identity_commands.cpp"
