// The part of interpolation.h that sets and removes keyframes.
#include <algorithm>

#include "annotation/interpolation.h"
#include "core/angle.h"

namespace eyrie {
namespace {

auto placeOf(std::vector<Keyframe>& keyframes, FrameIndex frame) {
    return std::lower_bound(keyframes.begin(), keyframes.end(), frame,
                            [](const Keyframe& keyframe, FrameIndex f) { return keyframe.frame < f; });
}

}  // namespace

LabelledObject withKeyframe(LabelledObject object, const Keyframe& keyframe) {
    const bool fresh = object.keyframes.empty();
    const auto place = placeOf(object.keyframes, keyframe.frame);
    if (place != object.keyframes.end() && place->frame == keyframe.frame) {
        *place = keyframe;
    } else {
        object.keyframes.insert(place, keyframe);
    }
    object.last_frame = fresh ? keyframe.frame : std::max(object.last_frame, keyframe.frame);
    return object;
}

LabelledObject withBox(LabelledObject object, FrameIndex frame, const OrientedBox& box, bool heading_set) {
    Keyframe keyframe;
    if (const Keyframe* before = keyframeBefore(object, frame)) {
        keyframe = *before;
    } else if (!object.keyframes.empty()) {
        keyframe = object.keyframes.front();
    }
    keyframe.frame = frame;
    keyframe.box = box;
    keyframe.heading_set = heading_set;
    return withKeyframe(std::move(object), keyframe);
}

LabelledObject withSize(LabelledObject object, FrameIndex frame, const OrientedBox& box, const CameraMotion& camera) {
    for (Keyframe& keyframe : object.keyframes) {
        const OrientedBox there = carriedBox(box, frame, keyframe.frame, camera).value_or(box);
        keyframe.box.length = there.length;
        keyframe.box.width = there.width;
    }
    return object;
}

LabelledObject withCorrectionSpread(LabelledObject object, FrameIndex frame, const CameraMotion& camera) {
    if (keyframeAt(object, frame) == nullptr || object.keyframes.size() < 2) return object;
    const FrameIndex first = firstFrameOf(object);
    LabelledObject others = withoutKeyframe(object, frame);
    others.last_frame = std::max(others.last_frame, frame);
    LabelledBox before = boxAt(others, frame, camera);
    if (frame == first) {
        // Nothing is known before the first keyframe, so the next one is taken back over the ground.
        const OrientedBox& next = others.keyframes.front().box;
        before.box = boxAt(object, frame, camera).box;
        if (const auto carried = carriedBox(next, others.keyframes.front().frame, frame, camera)) {
            before.box.length = carried->length;
            before.box.width = carried->width;
        }
    }
    const OrientedBox after = boxAt(object, frame, camera).box;
    if (before.box.length <= 0 || before.box.width <= 0) return object;
    const cv::Point2d moved = before.box.toBox(after.centre);
    const double turned = turnBetween(before.box.heading, after.heading);
    for (Keyframe& keyframe : object.keyframes) {
        if (keyframe.frame == frame || keyframe.outside) continue;
        OrientedBox shown = keyframe.box;
        shown.heading = boxAt(others, keyframe.frame, camera).box.heading;
        const double scale = keyframe.box.length / before.box.length;
        keyframe.box.centre = shown.toImage(moved * scale);
        keyframe.box.length *= after.length / before.box.length;
        keyframe.box.width *= after.width / before.box.width;
        if (keyframe.heading_set) keyframe.box.heading = wrapPi(keyframe.box.heading + turned);
    }
    return object;
}

LabelledObject withoutKeyframe(LabelledObject object, FrameIndex frame) {
    const auto place = placeOf(object.keyframes, frame);
    if (object.keyframes.size() > 1 && place != object.keyframes.end() && place->frame == frame) {
        object.keyframes.erase(place);
    }
    return object;
}

}  // namespace eyrie
