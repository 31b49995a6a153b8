// The part of LabelEditor that says which object is which.
#include "annotation/object_pieces.h"
#include "session/label_editor.h"

namespace eyrie::ui {

IdentityChange LabelEditor::joinWith(ObjectId other, GapFilling gap) const {
    return joinInTime(*object(), labels_.annotations().objects.at(other), labels_.camera(), gap);
}

IdentityChange LabelEditor::fuseWith(ObjectId other) const {
    return fuseInParallel(*object(), labels_.annotations().objects.at(other), labels_.camera());
}

void LabelEditor::join(ObjectId other, GapFilling gap) {
    if (!ready() || labels_.object(other) == nullptr) return;
    guarded([&] {
        labels_.apply(
            editOf(named(tr("Join %1 with %2")).arg(other).toStdString(), labels_.annotations(), joinWith(other, gap)));
    });
}

void LabelEditor::fuse(ObjectId other) {
    if (!ready() || labels_.object(other) == nullptr) return;
    guarded([&] {
        labels_.apply(
            editOf(named(tr("Fuse %1 with %2")).arg(other).toStdString(), labels_.annotations(), fuseWith(other)));
    });
}

void LabelEditor::splitHere() {
    if (!ready() || !labels_.mayEdit()) return;
    guarded([&] {
        const IdentityChange change = splitAt(*object(), frame(), labels_.newObjectId(), labels_.camera());
        const ObjectId fresh = change.after.empty() ? 0 : change.after.back().id;
        if (labels_.apply(editOf(named(tr("Split %1")).toStdString(), labels_.annotations(), change)) &&
            labels_.object(fresh) != nullptr)
            labels_.select(fresh);
    });
}

void LabelEditor::swapFrom(ObjectId other) {
    if (!ready() || labels_.object(other) == nullptr) return;
    guarded([&] {
        labels_.apply(editOf(named(tr("Swap %1 and %2")).arg(other).toStdString(), labels_.annotations(),
                             eyrie::swapFrom(*object(), *labels_.object(other), frame(), labels_.camera())));
    });
}

void LabelEditor::renumberHere() {
    if (!ready() || !labels_.mayEdit()) return;
    guarded([&] {
        labels_.apply(editOf(named(tr("Renumber %1")).toStdString(), labels_.annotations(),
                             renumberFrom(*object(), frame(), labels_.newObjectId(), nullptr, labels_.camera())));
    });
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
