#include "annotation/keyframes/interpolation.h"

#include <algorithm>
#include <cmath>

#include "annotation/keyframes/box_reader.h"
#include "core/geometry/homography_jacobian.h"

namespace eyrie {
namespace {

using Keyframes = std::vector<Keyframe>;

/// Takes a box through a map; nothing where it lies behind the horizon or grows or shrinks beyond all measure.
std::optional<OrientedBox> mapped(const OrientedBox& box, const Homography& target_from_source) {
    const auto& m = target_from_source.matrix;
    const double depth = m(2, 0) * box.centre.x + m(2, 1) * box.centre.y + m(2, 2);
    if (!(depth > 1e-6)) return std::nullopt;
    const HomographyJacobian there(m, box.centre);
    const double scale = there.scale();
    if (!std::isfinite(scale) || scale < 1e-4 || scale > 1e4) return std::nullopt;
    OrientedBox result;
    result.centre = there.point();
    result.length = box.length * scale;
    result.width = box.width * scale;
    result.heading = there.turned(box.heading);
    return result;
}

std::size_t indexBefore(const Keyframes& keyframes, FrameIndex frame) {
    const auto after = std::upper_bound(keyframes.begin(), keyframes.end(), frame,
                                        [](FrameIndex f, const Keyframe& keyframe) { return f < keyframe.frame; });
    return static_cast<std::size_t>(after - keyframes.begin());
}

}  // namespace

bool standsAtItsEnd(const LabelledObject& object) {
    // A few frames tell nothing: the end was put a little later.
    constexpr FrameIndex kLeastStand = 10;
    return !object.keyframes.back().outside && object.last_frame - object.keyframes.back().frame >= kLeastStand;
}

const char* nameOf(BoxSource source) {
    switch (source) {
        case BoxSource::none:
            return "none";
        case BoxSource::keyframe:
            return "keyframe";
        case BoxSource::ground:
            return "ground";
        case BoxSource::image:
            return "image";
    }
    return "";
}

LabelledBox boxAt(const LabelledObject& object, FrameIndex frame, const CameraMotion& camera, PathShape shape) {
    return BoxReader(object, camera, shape).at(frame);
}

std::vector<LabelledBoxOf> boxesAt(const AnnotationSet& set, FrameIndex frame, const CameraMotion& camera) {
    std::vector<LabelledBoxOf> boxes;
    for (const auto& [id, object] : set.objects) {
        const LabelledBox box = boxAt(object, frame, camera);
        if (box.exists()) boxes.push_back({id, box});
    }
    return boxes;
}

FrameIndex firstFrameOf(const LabelledObject& object) {
    return object.keyframes.empty() ? 0 : object.keyframes.front().frame;
}

const Keyframe* keyframeBefore(const LabelledObject& object, FrameIndex frame) {
    const std::size_t passed = indexBefore(object.keyframes, frame);
    return passed == 0 ? nullptr : &object.keyframes[passed - 1];
}

const Keyframe* keyframeAt(const LabelledObject& object, FrameIndex frame) {
    const Keyframe* before = keyframeBefore(object, frame);
    return before != nullptr && before->frame == frame ? before : nullptr;
}

const Keyframe* nextKeyframe(const LabelledObject& object, FrameIndex frame) {
    const std::size_t passed = indexBefore(object.keyframes, frame);
    return passed < object.keyframes.size() ? &object.keyframes[passed] : nullptr;
}

const Keyframe* previousKeyframe(const LabelledObject& object, FrameIndex frame) {
    return keyframeBefore(object, frame - 1);
}

cv::Point2d carriedPoint(cv::Point2d point, FrameIndex from, FrameIndex to, const CameraMotion& camera) {
    const auto carried = carriedBox({point, 1, 1, 0}, from, to, camera);
    return carried ? carried->centre : point;
}

std::optional<OrientedBox> carriedBox(const OrientedBox& box, FrameIndex from, FrameIndex to,
                                      const CameraMotion& camera) {
    if (from == to) return box;
    const auto target_from_source = camera.map(from, to);
    if (!target_from_source) return std::nullopt;
    return mapped(box, *target_from_source);
}

}  // namespace eyrie
