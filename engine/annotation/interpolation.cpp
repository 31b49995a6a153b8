#include "annotation/interpolation.h"

#include <algorithm>
#include <cmath>

#include "annotation/keyframe_path.h"
#include "core/angle.h"
#include "core/upright.h"

namespace eyrie {
namespace {

using Keyframes = std::vector<Keyframe>;

/// Takes a box through a map; nothing where it lies behind the horizon or grows or shrinks beyond all measure.
std::optional<OrientedBox> mapped(const OrientedBox& box, const Homography& target_from_source) {
    const auto& m = target_from_source.matrix;
    const double depth = m(2, 0) * box.centre.x + m(2, 1) * box.centre.y + m(2, 2);
    if (!(depth > 1e-6)) return std::nullopt;
    const double scale = target_from_source.scaleAt(box.centre);
    if (!std::isfinite(scale) || scale < 1e-4 || scale > 1e4) return std::nullopt;
    OrientedBox result;
    result.centre = target_from_source.apply(box.centre);
    result.length = box.length * scale;
    result.width = box.width * scale;
    result.heading = target_from_source.turned(box.centre, box.heading);
    return result;
}

/// Boxes along the image's axes are those of somebody (or some file) who does not turn boxes.
bool drawnUpright(const Keyframe& keyframe) {
    return keyframe.heading_set && isUpright(keyframe.box);
}

/// Whether boxes between a keyframe and the next (after the last one: the one before) stay upright in the image,
/// however the camera turns. One alone may just lie so.
bool staysUpright(const std::vector<Keyframe>& keyframes, std::size_t here) {
    if (keyframes.size() < 2) return false;
    const Keyframe& a = keyframes[here];
    const Keyframe& b = keyframes[here + 1 < keyframes.size() ? here + 1 : here - 1];
    return drawnUpright(a) && drawnUpright(b) && std::abs(turnBetween(a.box.heading, b.box.heading)) < 1e-9;
}

/// Keyframes as knots in the image of a reference frame, over the ground or as they are.
class KnotMaker {
 public:
    KnotMaker(FrameIndex reference, const CameraMotion* camera) : reference_(reference), camera_(camera) {}

    std::optional<Knot> make(const Keyframe& keyframe) const {
        std::optional<OrientedBox> box = keyframe.box;
        if (camera_ != nullptr) box = carriedBox(keyframe.box, keyframe.frame, reference_, *camera_);
        if (!box) return std::nullopt;
        return Knot{static_cast<double>(keyframe.frame - reference_),
                    box->centre,
                    box->length,
                    box->width,
                    box->heading,
                    keyframe.heading_set,
                    drawnUpright(keyframe)};
    }

    bool onGround() const { return camera_ != nullptr; }

 private:
    FrameIndex reference_;
    const CameraMotion* camera_;
};

/// The path around a keyframe, and which of its knots that is. An object that was outside the image has no path there.
struct LocalPath {
    KeyframePath path;
    std::size_t here = 0;
};

std::optional<LocalPath> pathAround(const LabelledObject& object, std::size_t here, std::size_t reach,
                                    const KnotMaker& maker, PathShape shape) {
    const Keyframes& keyframes = object.keyframes;
    std::array<Knot, 2> before;
    std::size_t earlier = 0;
    while (earlier < reach && here > earlier) {
        const Keyframe& keyframe = keyframes[here - earlier - 1];
        const auto knot = keyframe.outside ? std::nullopt : maker.make(keyframe);
        if (!knot) break;
        before[earlier++] = *knot;
    }
    const auto own = maker.make(keyframes[here]);
    if (!own) return std::nullopt;
    LocalPath local{KeyframePath(shape, maker.onGround()), earlier};
    for (std::size_t i = earlier; i-- > 0;) local.path.add(before[i]);
    local.path.add(*own);
    for (std::size_t i = here + 1; i < keyframes.size() && i <= here + 1 + reach; ++i) {
        if (keyframes[i - 1].outside && i > here + 1) break;
        const auto knot = maker.make(keyframes[i]);
        if (!knot) break;
        local.path.add(*knot);
        if (i + 1 == keyframes.size()) local.path.setStandsAfter(maker.onGround() && standsAtItsEnd(object));
    }
    return local;
}

bool hasNext(const LocalPath& local) {
    return local.here + 1 < local.path.count();
}

struct PathBox {
    OrientedBox box;
    bool heading_from_path = false;
};

/// The box at a moment `time` after the keyframe `here`, in the reference frame.
PathBox boxOnPath(const LocalPath& local, double time) {
    const KeyframePath& path = local.path;
    const Knot& a = path.knot(local.here);
    if (time <= 0 || !hasNext(local)) {
        return {{a.point, a.length, a.width, path.headingAt(local.here)}, path.headingFollowsPath(local.here)};
    }
    const Knot& b = path.knot(local.here + 1);
    const double share = (time - a.time) / (b.time - a.time);
    PathBox result;
    result.box.centre = path.position(local.here, share);
    result.box.length = a.length + share * (b.length - a.length);
    result.box.width = a.width + share * (b.width - a.width);
    result.box.heading = path.heading(local.here, share);
    result.heading_from_path = path.moving(local.here) && !a.heading_set && !b.heading_set;
    return result;
}

/// Builds the path and evaluates it; over the ground with a camera, in the image without.
std::optional<PathBox> evaluate(const LabelledObject& object, std::size_t here, FrameIndex frame,
                                const CameraMotion* camera, PathShape shape) {
    const Keyframes& keyframes = object.keyframes;
    const FrameIndex reference = keyframes[here].frame;
    const KnotMaker maker(reference, camera);
    auto local = pathAround(object, here, 1, maker, shape);
    if (!local) return std::nullopt;
    if (here + 1 < keyframes.size() && !hasNext(*local) && frame > reference) return std::nullopt;
    // Where it stands, headings come from the movement before and after, so look one keyframe further.
    const bool stands = !hasNext(*local) || !local->path.moving(local->here);
    if (stands && keyframes.size() > 1) local = pathAround(object, here, 2, maker, shape);
    PathBox result = boxOnPath(*local, static_cast<double>(frame - reference));
    if (camera != nullptr && frame != reference) {
        const auto carried = carriedBox(result.box, reference, frame, *camera);
        if (!carried) return std::nullopt;
        result.box = *carried;
    }
    if (staysUpright(keyframes, here)) result.box.heading = keyframes[here].box.heading;
    result.box.heading = wrapPi(result.box.heading);
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
    LabelledBox result;
    const Keyframes& keyframes = object.keyframes;
    const std::size_t passed = indexBefore(keyframes, frame);
    if (passed == 0 || frame > object.last_frame) return result;
    const std::size_t here = passed - 1;
    const Keyframe& before = keyframes[here];
    result.occlusion = before.occlusion;
    result.outside = before.outside;
    result.ignore = before.ignore;

    const bool exact = before.frame == frame;
    const FrameIndex until = exact || passed == keyframes.size() ? frame : keyframes[passed].frame;
    std::optional<PathBox> box;
    if (camera.connects(before.frame, until)) box = evaluate(object, here, frame, &camera, shape);
    result.source = exact ? BoxSource::keyframe : box ? BoxSource::ground : BoxSource::image;
    // A keyframe whose neighbours are not connected with it follows the path it has in the image.
    if (!box || (exact && !box->heading_from_path && !before.heading_set && keyframes.size() > 1)) {
        const auto in_image = evaluate(object, here, frame, nullptr, shape);
        const bool next_connected = passed < keyframes.size() && camera.connects(before.frame, keyframes[passed].frame);
        const bool last_connected = here > 0 && camera.connects(before.frame, keyframes[here - 1].frame);
        if (!box || (!next_connected && !last_connected)) box = in_image;
    }
    result.box = box->box;
    result.heading_from_path = box->heading_from_path;
    if (exact) {
        // To the bit as it was set.
        const double heading = before.heading_set || !box->heading_from_path ? before.box.heading : box->box.heading;
        result.box = before.box;
        result.box.heading = heading;
    }
    return result;
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
