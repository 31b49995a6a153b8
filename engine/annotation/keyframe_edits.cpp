// The part of interpolation.h that sets and removes keyframes.
#include <algorithm>

#include "annotation/interpolation.h"

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

LabelledObject withoutKeyframe(LabelledObject object, FrameIndex frame) {
    const auto place = placeOf(object.keyframes, frame);
    if (object.keyframes.size() > 1 && place != object.keyframes.end() && place->frame == frame) {
        object.keyframes.erase(place);
    }
    return object;
}

}  // namespace eyrie
