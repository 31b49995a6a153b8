// The part of interpolation.h that sets and removes keyframes.
#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "annotation/keyframes/interpolation.h"
#include "core/geometry/angle.h"
#include "core/geometry/upright.h"

namespace eyrie {
namespace {

auto placeOf(std::vector<Keyframe>& keyframes, FrameIndex frame) {
    return std::lower_bound(keyframes.begin(), keyframes.end(), frame,
                            [](const Keyframe& keyframe, FrameIndex f) { return keyframe.frame < f; });
}

/// The smallest box around one that heads along the image's axes.
OrientedBox hullAlong(const OrientedBox& box, double heading) {
    OrientedBox hull = box.upright();
    hull.heading = heading;
    if (std::abs(std::sin(heading)) > 0.5) std::swap(hull.length, hull.width);
    return hull;
}

/// What became of a box, in its own axes and relative to its size.
class Correction {
 public:
    Correction(const OrientedBox& before, const OrientedBox& after)
        : moved_(before.toBox(after.centre) * (1 / std::max(1e-9, before.length))),
          longer_(after.length / std::max(1e-9, before.length)),
          wider_(after.width / std::max(1e-9, before.width)),
          turned_(turnBetween(before.heading, after.heading)) {}

    /// Does a share of the same to another keyframe, which is shown with `heading`.
    void apply(Keyframe& keyframe, double heading, double share) const {
        OrientedBox shown = keyframe.box;
        shown.heading = heading;
        keyframe.box.centre = shown.toImage(moved_ * (share * shown.length));
        keyframe.box.length *= 1 + share * (longer_ - 1);
        keyframe.box.width *= 1 + share * (wider_ - 1);
        if (keyframe.heading_set) keyframe.box.heading = wrapPi(keyframe.box.heading + share * turned_);
    }

 private:
    cv::Point2d moved_;
    double longer_;
    double wider_;
    double turned_;
};

/// The nearest keyframes before and after a frame that a hand set.
class HandsAround {
 public:
    HandsAround(const LabelledObject& object, FrameIndex frame) : frame_(frame) {
        for (const Keyframe& keyframe : object.keyframes) {
            if (keyframe.computed || keyframe.frame == frame) continue;
            if (keyframe.frame < frame) before_ = keyframe.frame;
            if (keyframe.frame > frame && !after_) after_ = keyframe.frame;
        }
    }

    /// 1 at the frame itself and where no hand is further on, 0 at the hands and beyond.
    double shareAt(FrameIndex other) const {
        const auto& hand = other < frame_ ? before_ : after_;
        if (!hand || other == frame_) return 1;
        const double share = static_cast<double>(*hand - other) / (*hand - frame_);
        return std::max(0.0, share);
    }

 private:
    FrameIndex frame_;
    std::optional<FrameIndex> before_;
    std::optional<FrameIndex> after_;
};

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
    keyframe.computed = false;
    return withKeyframe(std::move(object), keyframe);
}

bool isCutByBorder(const OrientedBox& box, cv::Size image) {
    constexpr double kNear = 1.5;
    const OrientedBox around = box.upright();
    const auto near = [](double side, double border) { return std::abs(side - border) <= kNear; };
    return near(around.centre.x - around.length / 2, -0.5) || near(around.centre.y - around.width / 2, -0.5) ||
           near(around.centre.x + around.length / 2, image.width - 0.5) ||
           near(around.centre.y + around.width / 2, image.height - 0.5);
}

LabelledObject withBoxCarriedOn(LabelledObject object, FrameIndex frame, const OrientedBox& box, bool heading_set,
                                const CameraMotion& camera) {
    const LabelledBox before = boxAt(object, frame, camera);
    const LabelledObject known = object;
    object = withBox(std::move(object), frame, box, heading_set);
    constexpr double kSameVehicle = 0.1;
    if (!before.visible() || overlap(before.box, box) < kSameVehicle) return object;
    // Where boxes are drawn along the image's axes those that were computed become such boxes, too.
    const bool now_upright = heading_set && isUpright(box) && !isUpright(before.box);
    const Correction correction(now_upright ? hullAlong(before.box, box.heading) : before.box, box);
    const HandsAround hands(known, frame);
    for (Keyframe& keyframe : object.keyframes) {
        const double share = keyframe.computed && !keyframe.outside ? hands.shareAt(keyframe.frame) : 0;
        if (share <= 0) continue;
        OrientedBox shown = boxAt(known, keyframe.frame, camera).box;
        if (now_upright) {
            shown = hullAlong(shown, box.heading);
            keyframe.box = shown;
            keyframe.heading_set = true;
        }
        correction.apply(keyframe, shown.heading, share);
    }
    return object;
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
    const Correction correction(before.box, after);
    const bool some_computed = std::any_of(object.keyframes.begin(), object.keyframes.end(),
                                           [&](const Keyframe& k) { return k.computed && k.frame != frame; });
    for (Keyframe& keyframe : object.keyframes) {
        if (keyframe.frame == frame || keyframe.outside || (some_computed && !keyframe.computed)) continue;
        correction.apply(keyframe, boxAt(others, keyframe.frame, camera).box.heading, 1);
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
