#include "annotation/edits/object_pieces.h"

#include <algorithm>

#include "annotation/keyframes/box_reader.h"

namespace eyrie {

std::string nameOf(const LabelledObject& object) {
    return object.object_class + " " + std::to_string(object.id);
}

Keyframe shownAt(const LabelledObject& object, FrameIndex frame, const CameraMotion& camera) {
    if (const Keyframe* there = keyframeAt(object, frame)) return *there;
    const LabelledBox box = boxAt(object, frame, camera);
    Keyframe keyframe;
    keyframe.frame = frame;
    keyframe.box = box.box;
    keyframe.heading_set = !box.heading_from_path;
    keyframe.occlusion = box.occlusion;
    keyframe.outside = box.outside;
    keyframe.ignore = box.ignore;
    if (const Keyframe* before = keyframeBefore(object, frame)) keyframe.computed = before->computed;
    return keyframe;
}

std::vector<FrameBox> shownBoxes(const LabelledObject& object, FrameIndex first, FrameIndex last,
                                 const CameraMotion& camera) {
    std::vector<FrameBox> boxes;
    BoxReader shown(object, camera);
    for (FrameIndex frame = std::max(first, firstFrameOf(object)); frame <= std::min(last, object.last_frame);
         ++frame) {
        const LabelledBox box = shown.at(frame);
        if (box.visible()) boxes.push_back({frame, box.box});
    }
    return boxes;
}

LabelledObject keptTo(LabelledObject object, const std::vector<FrameBox>& boxes, const CameraMotion& camera) {
    ReductionOptions options;
    options.tolerance_px = 0.5;
    return refined(std::move(object), boxes, camera, options);
}

LabelledObject pieceOf(const LabelledObject& object, FrameIndex first, FrameIndex last, const CameraMotion& camera) {
    first = std::max(first, firstFrameOf(object));
    last = std::min(last, object.last_frame);
    LabelledObject piece = object;
    piece.last_frame = last;
    piece.keyframes.clear();
    for (const Keyframe& keyframe : object.keyframes) {
        if (keyframe.frame >= first && keyframe.frame <= last) piece.keyframes.push_back(keyframe);
    }
    // What stands still at the end needs no keyframe there, what is cut in the middle of its way does.
    const bool moves_on = nextKeyframe(object, last) != nullptr;
    if (keyframeAt(piece, first) == nullptr) piece = withKeyframe(std::move(piece), shownAt(object, first, camera));
    if (moves_on && keyframeAt(piece, last) == nullptr) {
        piece = withKeyframe(std::move(piece), shownAt(object, last, camera));
    }
    piece.last_frame = last;
    // All of it: a keyframe that is put in near a cut may bend what lies three keyframes farther on.
    const std::vector<FrameBox> boxes = shownBoxes(object, first, last, camera);
    return keptTo(std::move(piece), boxes, camera);
}

LabelledObject joined(const LabelledObject& earlier, const LabelledObject& later, const LabelledObject& identity,
                      bool outside_between, const CameraMotion& camera) {
    LabelledObject result = identity;
    result.last_frame = later.last_frame;
    result.keyframes = earlier.keyframes;
    result.keyframes.erase(std::remove_if(result.keyframes.begin(), result.keyframes.end(),
                                          [&](const Keyframe& k) { return k.frame > earlier.last_frame; }),
                           result.keyframes.end());
    const FrameIndex end = earlier.last_frame;
    // What stood at the end must not set off early.
    if (keyframeAt(earlier, end) == nullptr) result.keyframes.push_back(shownAt(earlier, end, camera));
    if (outside_between && firstFrameOf(later) > end + 1) {
        Keyframe gone = result.keyframes.back();
        const auto carried = carriedBox(gone.box, gone.frame, end + 1, camera);
        if (carried) gone.box = *carried;
        gone.frame = end + 1;
        gone.outside = true;
        result.keyframes.push_back(gone);
    }
    result.keyframes.insert(result.keyframes.end(), later.keyframes.begin(), later.keyframes.end());
    std::vector<FrameBox> boxes = shownBoxes(earlier, firstFrameOf(earlier), end, camera);
    const std::vector<FrameBox> tail = shownBoxes(later, firstFrameOf(later), later.last_frame, camera);
    boxes.insert(boxes.end(), tail.begin(), tail.end());
    return keptTo(std::move(result), boxes, camera);
}

}  // namespace eyrie
