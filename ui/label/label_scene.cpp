#include "label/label_scene.h"

#include "annotation/edits/ignore_regions.h"
#include "annotation/keyframes/interpolation.h"
#include "label/editor/label_editor.h"
#include "label/label_classes.h"
#include "label/object_colours.h"

namespace eyrie::ui {

namespace {

const QColor kProposalColour(64, 235, 80);  ///< tracks are green
const QColor kPlannedColour(255, 110, 220);
constexpr double kPlannedMargin = 2;  ///< px around the box, so that the present one stays visible

void addPlanned(LabelScene& scene, const AnnotationEdit& planned, const CameraMotion& camera) {
    for (const Change<LabelledObject>& change : planned.objects) {
        if (!change.after) continue;
        const LabelledBox box = boxAt(*change.after, scene.frame, camera);
        if (!box.visible()) continue;
        LabelMark mark;
        mark.id = change.after->id;
        mark.kind = LabelKind::planned;
        mark.box = box.box;
        mark.box.length += 2 * kPlannedMargin;
        mark.box.width += 2 * kPlannedMargin;
        mark.colour = kPlannedColour;
        mark.selected = true;
        mark.text = QStringLiteral("→ %1").arg(change.after->id);
        scene.marks.push_back(std::move(mark));
    }
}

}  // namespace

LabelScene labelScene(const LabelSession& labels, const LabelProposals& proposals, FrameIndex frame,
                      const SceneScale& scale, const AnnotationEdit* planned) {
    const AnnotationSet& set = labels.annotations();
    LabelScene scene;
    scene.frame = frame;
    scene.editable = labels.canEdit();
    scene.selected = labels.selected();
    ObjectColours colours(set);
    const ObjectClass drawn = classNamed(set, labels.drawnClass());
    scene.drawn_colour = colours.ofClass(drawn.name);
    if (drawn.length_m > 0 && drawn.width_m > 0) {
        scene.width_of_length = drawn.width_m / drawn.length_m;
        if (scale.gsd_known) {
            scene.drawn_width = scale.px(drawn.width_m);
            scene.slope = scale.slope;
        }
    }
    const auto add = [&](const LabelledObject& object, const LabelledBox& box) {
        LabelMark mark;
        mark.id = object.id;
        mark.box = box.box;
        const Keyframe* keyframe = box.source == BoxSource::keyframe ? keyframeAt(object, frame) : nullptr;
        mark.kind = keyframe != nullptr && !keyframe->computed ? LabelKind::keyframe : LabelKind::interpolated;
        mark.in_image_only = box.source == BoxSource::image;
        mark.colour = colours.of(object);
        mark.occlusion = box.occlusion;
        mark.ignore = box.ignore;
        mark.review = labels.review().stateAt(object.id, frame);
        mark.selected = labels.selection().contains(object.id);
        mark.text = QString::number(object.id);
        if (mark.selected) mark.text.prepend(classText(object.object_class) + QLatin1Char(' '));
        scene.marks.push_back(std::move(mark));
    };
    bool selected_shown = false;
    for (const LabelledBoxOf& entry : boxesAt(set, frame, labels.camera())) {
        const bool is_selected = scene.selected == entry.id;
        if (!entry.box.visible() && !is_selected) continue;
        add(set.objects.at(entry.id), entry.box);
        if (!is_selected) continue;
        selected_shown = true;
        if (entry.box.outside) {
            scene.marks.back().kind = LabelKind::expected;
            scene.marks.back().text += QObject::tr(" outside");
        }
    }
    if (const LabelledObject* object = scene.selected ? labels.object(*scene.selected) : nullptr;
        object != nullptr && !selected_shown) {
        if (const auto box = LabelEditor::expectedBox(*object, frame, labels.camera())) {
            LabelledBox expected;
            expected.source = BoxSource::ground;
            expected.box = *box;
            add(*object, expected);
            LabelMark& mark = scene.marks.back();
            mark.kind = LabelKind::expected;
            mark.text += frame > object->last_frame ? QObject::tr(" ended at %1").arg(object->last_frame)
                                                    : QObject::tr(" begins at %1").arg(object->keyframes.front().frame);
        }
    }
    for (const RegionInFrame& region : regionsAt(set, frame, labels.camera()))
        scene.regions.push_back({region.id, region.polygon});
    for (const Proposal* proposal : proposals.pendingIn(frame)) {
        const LabelledBox box = boxAt(proposal->object, frame, labels.camera());
        if (!box.visible()) continue;
        LabelMark mark;
        mark.id = proposal->track;
        mark.kind = LabelKind::proposal;
        mark.box = box.box;
        mark.colour = kProposalColour;
        mark.selected = proposals.isSelected(proposal->track);
        mark.text = QStringLiteral("?%1").arg(proposal->track);
        scene.marks.push_back(std::move(mark));
    }
    if (planned != nullptr) addPlanned(scene, *planned, labels.camera());
    return scene;
}

}  // namespace eyrie::ui
