// The part of LabelEditor that works on more than the frame shown: which object is which, flags over ranges of frames,
// ignore regions.
#include "annotation/edits/ignore_regions.h"
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

void LabelEditor::setFlags(FrameIndex first, FrameIndex last, const FlagChange& flags) {
    std::vector<LabelledObject> changed;
    const bool fine = guarded([&] {
        for (const ObjectId id : labels_.selection())
            if (const LabelledObject* known = labels_.object(id))
                changed.push_back(withFlags(*known, first, last, flags, labels_.camera()));
    });
    if (fine && !changed.empty())
        labels_.apply(editOf(tr("Set flags over a range").toStdString(), labels_.annotations(), changed));
}

void LabelEditor::spreadFlags(FrameIndex first, FrameIndex last) {
    if (!ready()) return;
    const LabelledBox shown = boxAt(*object(), frame(), labels_.camera());
    if (!shown.exists()) {
        emit labels_.notice(tr("The object does not exist in this frame."));
        return;
    }
    setFlags(first, last, {shown.occlusion, shown.outside, shown.ignore});
}

void LabelEditor::addRegion(const std::vector<cv::Point2d>& polygon, FrameIndex frame) {
    if (!labels_.mayEdit()) return;
    IgnoreRegion region;
    region.id = labels_.store()->newRegionId();
    region.polygon = polygon;
    region.reference_frame = frame;
    region.first_frame = 0;
    region.last_frame = session_.lastFrame();
    const CameraMotion& camera = labels_.camera();
    const bool known = camera.connects(frame, frame + 1) || camera.connects(frame - 1, frame);
    region.anchor = known ? RegionAnchor::ground : RegionAnchor::image;
    guarded(
        [&] { labels_.apply(regionEdit(tr("Draw an ignore region").toStdString(), labels_.annotations(), {region})); });
}

int LabelEditor::deleteRegionsAt(cv::Point2d point) {
    std::vector<int> hit;
    for (const RegionInFrame& region : regionsAt(labels_.annotations(), frame(), labels_.camera()))
        if (contains(region.polygon, point)) hit.push_back(region.id);
    if (!hit.empty())
        labels_.apply(regionEdit(tr("Delete an ignore region").toStdString(), labels_.annotations(), {}, hit));
    return static_cast<int>(hit.size());
}

int LabelEditor::changeRegionsAt(cv::Point2d point, const QString& name,
                                 const std::function<void(IgnoreRegion&)>& change) {
    std::vector<IgnoreRegion> changed;
    for (const RegionInFrame& region : regionsAt(labels_.annotations(), frame(), labels_.camera())) {
        if (!contains(region.polygon, point)) continue;
        changed.push_back(labels_.annotations().regions.at(region.id));
        change(changed.back());
    }
    if (!changed.empty())
        guarded([&] { labels_.apply(regionEdit(name.toStdString(), labels_.annotations(), changed)); });
    return static_cast<int>(changed.size());
}

int LabelEditor::anchorRegionsAt(cv::Point2d point) {
    const auto here = regionsAt(labels_.annotations(), frame(), labels_.camera());
    return changeRegionsAt(point, tr("Change what an ignore region is fixed to"), [&](IgnoreRegion& region) {
        for (const RegionInFrame& shown : here)
            if (shown.id == region.id) region.polygon = shown.polygon;
        region.reference_frame = frame();
        const bool ground = region.anchor == RegionAnchor::ground;
        region.anchor = ground ? RegionAnchor::image : RegionAnchor::ground;
        emit labels_.notice(ground ? tr("The region stays where it is in the image.")
                                   : tr("The region stays where it is on the ground."));
    });
}

}  // namespace eyrie::ui
