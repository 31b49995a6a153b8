// The part of LabelEditor that says which object is which.
#include "annotation/edits/object_pieces.h"
#include "label/editor/label_editor.h"

namespace eyrie::ui {

std::optional<LabelEditor::Plan> LabelEditor::planOf(const QString& name,
                                                     const std::function<IdentityChange()>& change) {
    if (!ready() || !labels_.mayEdit()) return std::nullopt;
    Plan plan;
    const bool fine = guarded([&] {
        const IdentityChange planned = change();
        plan.edit = editOf(name.toStdString(), labels_.annotations(), planned);
        QStringList parts;
        for (const LabelledObject& object : planned.after)
            parts << tr("%1: frames %2 to %3")
                         .arg(QString::fromStdString(nameOf(object)))
                         .arg(firstFrameOf(object))
                         .arg(object.last_frame);
        for (const ObjectId id : planned.removed)
            parts << tr("%1 is gone").arg(QString::fromStdString(nameOf(*labels_.object(id))));
        plan.text = parts.join(QStringLiteral(", "));
        for (const LabelledObject& object : planned.after)
            if (labels_.object(object.id) == nullptr) plan.select = object.id;
    });
    plan.version = labels_.version();
    return fine ? std::optional(plan) : std::nullopt;
}

std::optional<LabelEditor::Plan> LabelEditor::planJoin(ObjectId other, GapFilling gap) {
    if (labels_.object(other) == nullptr) return std::nullopt;
    return planOf(named(tr("Join %1 with %2")).arg(other),
                  [&] { return joinInTime(*object(), *labels_.object(other), labels_.camera(), gap); });
}

std::optional<LabelEditor::Plan> LabelEditor::planFuse(ObjectId other) {
    if (labels_.object(other) == nullptr) return std::nullopt;
    return planOf(named(tr("Fuse %1 with %2")).arg(other),
                  [&] { return fuseInParallel(*object(), *labels_.object(other), labels_.camera()); });
}

std::optional<LabelEditor::Plan> LabelEditor::planSplit() {
    return planOf(named(tr("Split %1")),
                  [&] { return splitAt(*object(), frame(), labels_.newObjectId(), labels_.camera()); });
}

std::optional<LabelEditor::Plan> LabelEditor::planSwap(ObjectId other) {
    if (labels_.object(other) == nullptr) return std::nullopt;
    return planOf(named(tr("Swap %1 and %2")).arg(other),
                  [&] { return eyrie::swapFrom(*object(), *labels_.object(other), frame(), labels_.camera()); });
}

std::optional<LabelEditor::Plan> LabelEditor::planRenumber() {
    auto plan = planOf(named(tr("Renumber %1")), [&] {
        return renumberFrom(*object(), frame(), labels_.newObjectId(), nullptr, labels_.camera());
    });
    if (plan) plan->select.reset();
    return plan;
}

void LabelEditor::carryOut(const std::optional<Plan>& plan) {
    if (!plan || plan->version != labels_.version()) return;
    if (labels_.apply(plan->edit) && plan->select && labels_.object(*plan->select) != nullptr)
        labels_.select(*plan->select);
}

void LabelEditor::deleteBefore() {
    if (!ready()) return;
    guarded([&] {
        labels_.apply(editOf(named(tr("Delete %1 before this frame")).toStdString(), labels_.annotations(),
                             eyrie::deleteBefore(*object(), frame(), labels_.camera())));
    });
}

void LabelEditor::deleteAfter() {
    if (!ready()) return;
    guarded([&] {
        labels_.apply(editOf(named(tr("Delete %1 after this frame")).toStdString(), labels_.annotations(),
                             eyrie::deleteAfter(*object(), frame(), labels_.camera())));
    });
}

}  // namespace eyrie::ui
