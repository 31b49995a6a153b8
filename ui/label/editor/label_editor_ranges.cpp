// The part of LabelEditor that works on ranges of frames: flags and ignore regions.
#include "annotation/edits/ignore_regions.h"
#include "label/editor/label_editor.h"

namespace eyrie::ui {

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
