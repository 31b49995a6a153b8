#include "annotation/edits/identity_edits.h"

#include <algorithm>

#include "annotation/edits/object_pieces.h"
#include "core/error.h"
#include "core/geometry/angle.h"

namespace eyrie {
namespace {

constexpr FrameIndex kEver = 1 << 30;

[[noreturn]] void refuse(const std::string& message) {
    throw Error(ErrorKind::parameter, message);
}

bool existsBefore(const LabelledObject& object, FrameIndex frame) {
    return firstFrameOf(object) < frame;
}

bool existsFrom(const LabelledObject& object, FrameIndex frame) {
    return object.last_frame >= frame;
}

void refuseOtherFrames(const LabelledObject& object, FrameIndex frame) {
    if (frame < firstFrameOf(object) || frame > object.last_frame) {
        refuse(nameOf(object) + " does not exist in frame " + std::to_string(frame) + "; it lives from frame " +
               std::to_string(firstFrameOf(object)) + " to " + std::to_string(object.last_frame));
    }
}

LabelledObject withIdentity(LabelledObject piece, const LabelledObject& identity) {
    LabelledObject result = identity;
    result.keyframes = std::move(piece.keyframes);
    result.last_frame = piece.last_frame;
    return result;
}

OrientedBox meanOf(const OrientedBox& a, const OrientedBox& b) {
    OrientedBox mean;
    mean.centre = (a.centre + b.centre) * 0.5;
    mean.length = (a.length + b.length) / 2;
    mean.width = (a.width + b.width) / 2;
    mean.heading = wrapPi(a.heading + turnBetween(a.heading, b.heading) / 2);
    return mean;
}

/// What one identity becomes when its part from a frame on is another object's.
std::optional<LabelledObject> crossed(const LabelledObject& identity, const LabelledObject& other, FrameIndex frame,
                                      const CameraMotion& camera) {
    std::optional<LabelledObject> left;
    std::optional<LabelledObject> right;
    if (existsBefore(identity, frame)) left = pieceOf(identity, 0, frame - 1, camera);
    if (existsFrom(other, frame)) right = pieceOf(other, frame, kEver, camera);
    if (left && right) return joined(*left, *right, identity, firstFrameOf(*right) > left->last_frame + 1, camera);
    if (left) return left;
    if (right) return withIdentity(std::move(*right), identity);
    return std::nullopt;
}

}  // namespace

IdentityChange joinInTime(const LabelledObject& kept, const LabelledObject& other, const CameraMotion& camera,
                          GapFilling gap) {
    const bool kept_first = firstFrameOf(kept) <= firstFrameOf(other);
    const LabelledObject& earlier = kept_first ? kept : other;
    const LabelledObject& later = kept_first ? other : kept;
    if (kept.id == other.id) refuse(nameOf(kept) + " cannot be joined with itself");
    if (firstFrameOf(later) <= earlier.last_frame) {
        refuse(nameOf(later) + " begins in frame " + std::to_string(firstFrameOf(later)) + ", before " +
               nameOf(earlier) + " ends (frame " + std::to_string(earlier.last_frame) + "); fuse them instead");
    }
    IdentityChange change;
    change.after.push_back(joined(earlier, later, kept, gap == GapFilling::outside, camera));
    change.removed.push_back(other.id);
    change.review_moves.push_back({other.id, kept.id, 0, kEver});
    return change;
}

IdentityChange fuseInParallel(const LabelledObject& kept, const LabelledObject& other, const CameraMotion& camera,
                              FuseRule rule) {
    if (kept.id == other.id) refuse(nameOf(kept) + " cannot be fused with itself");
    const FrameIndex first = std::max(firstFrameOf(kept), firstFrameOf(other));
    const FrameIndex last = std::min(kept.last_frame, other.last_frame);
    if (first > last) {
        refuse(nameOf(kept) + " and " + nameOf(other) + " share no frame; join them instead");
    }
    IdentityChange change;
    LabelledObject middle = pieceOf(kept, first, last, camera);
    if (rule == FuseRule::mean) {
        for (const Keyframe& keyframe : pieceOf(other, first, last, camera).keyframes) {
            if (keyframeAt(middle, keyframe.frame) == nullptr) {
                middle = withKeyframe(std::move(middle), shownAt(kept, keyframe.frame, camera));
            }
        }
        for (Keyframe& keyframe : middle.keyframes) {
            const LabelledBox there = boxAt(other, keyframe.frame, camera);
            if (there.visible() && !keyframe.outside) {
                const LabelledBox here = boxAt(kept, keyframe.frame, camera);
                keyframe.box = meanOf(here.box, there.box);
            }
        }
    }
    LabelledObject result = middle;
    const LabelledObject& begins = firstFrameOf(kept) < firstFrameOf(other) ? kept : other;
    if (firstFrameOf(begins) < first)
        result = joined(pieceOf(begins, 0, first - 1, camera), result, kept, false, camera);
    const LabelledObject& ends = kept.last_frame > other.last_frame ? kept : other;
    if (ends.last_frame > last) result = joined(result, pieceOf(ends, last + 1, kEver, camera), kept, false, camera);
    // Every seam may have moved it by half a pixel.
    std::vector<FrameBox> boxes = shownBoxes(begins, 0, first - 1, camera);
    for (const auto& part : {shownBoxes(rule == FuseRule::mean ? middle : kept, first, last, camera),
                             shownBoxes(ends, last + 1, kEver, camera)})
        boxes.insert(boxes.end(), part.begin(), part.end());
    result = keptTo(std::move(result), boxes, camera);
    change.after.push_back(withIdentity(std::move(result), kept));
    change.removed.push_back(other.id);
    change.review_moves.push_back({other.id, kept.id, 0, first - 1});
    change.review_moves.push_back({other.id, kept.id, last + 1, kEver});
    return change;
}

IdentityChange splitAt(const LabelledObject& object, FrameIndex frame, ObjectId new_id, const CameraMotion& camera) {
    refuseOtherFrames(object, frame);
    if (frame == firstFrameOf(object)) {
        refuse(nameOf(object) + " begins in frame " + std::to_string(frame) + "; there is nothing to split off");
    }
    IdentityChange change;
    change.after.push_back(pieceOf(object, 0, frame - 1, camera));
    change.after.push_back(pieceOf(object, frame, kEver, camera));
    change.after.back().id = new_id;
    change.review_moves.push_back({object.id, new_id, frame, kEver});
    return change;
}

IdentityChange swapFrom(const LabelledObject& a, const LabelledObject& b, FrameIndex frame,
                        const CameraMotion& camera) {
    if (a.id == b.id) refuse(nameOf(a) + " cannot be swapped with itself");
    if (!existsFrom(a, frame) && !existsFrom(b, frame)) {
        refuse("neither " + nameOf(a) + " nor " + nameOf(b) + " exists from frame " + std::to_string(frame) + " on");
    }
    IdentityChange change;
    for (const auto& [identity, other] : {std::pair(&a, &b), std::pair(&b, &a)}) {
        if (auto after = crossed(*identity, *other, frame, camera)) {
            change.after.push_back(std::move(*after));
        } else {
            change.removed.push_back(identity->id);
        }
        change.review_moves.push_back({identity->id, other->id, frame, kEver});
    }
    return change;
}

IdentityChange renumberFrom(const LabelledObject& object, FrameIndex frame, ObjectId new_id,
                            const LabelledObject* target, const CameraMotion& camera) {
    if (target == nullptr) {
        if (frame > firstFrameOf(object)) return splitAt(object, frame, new_id, camera);
        IdentityChange change;
        change.after.push_back(object);
        change.after.back().id = new_id;
        change.removed.push_back(object.id);
        change.review_moves.push_back({object.id, new_id, 0, kEver});
        return change;
    }
    frame = std::max(frame, firstFrameOf(object));
    refuseOtherFrames(object, frame);
    if (target->id == object.id) refuse(nameOf(object) + " has that number already");
    if (target->last_frame >= frame && firstFrameOf(*target) <= object.last_frame) {
        refuse(nameOf(*target) + " exists between frame " + std::to_string(frame) + " and " +
               std::to_string(object.last_frame) + ", too; swap the two from here, or fuse them");
    }
    IdentityChange change;
    const LabelledObject tail = pieceOf(object, frame, kEver, camera);
    const bool target_first = target->last_frame < frame;
    const LabelledObject& earlier = target_first ? *target : tail;
    const LabelledObject& later = target_first ? tail : *target;
    const bool gap = firstFrameOf(later) > earlier.last_frame + 1;
    change.after.push_back(joined(earlier, later, *target, gap, camera));
    if (existsBefore(object, frame)) {
        change.after.push_back(pieceOf(object, 0, frame - 1, camera));
    } else {
        change.removed.push_back(object.id);
    }
    change.review_moves.push_back({object.id, target->id, frame, kEver});
    return change;
}

IdentityChange deleteBefore(const LabelledObject& object, FrameIndex frame, const CameraMotion& camera) {
    IdentityChange change;
    if (existsFrom(object, frame)) {
        change.after.push_back(pieceOf(object, frame, kEver, camera));
    } else {
        change.removed.push_back(object.id);
    }
    return change;
}

IdentityChange deleteAfter(const LabelledObject& object, FrameIndex frame, const CameraMotion& camera) {
    IdentityChange change;
    if (existsBefore(object, frame + 1)) {
        change.after.push_back(pieceOf(object, 0, frame, camera));
    } else {
        change.removed.push_back(object.id);
    }
    return change;
}

LabelledObject withFlags(const LabelledObject& object, FrameIndex first, FrameIndex last, const FlagChange& flags,
                         const CameraMotion& camera) {
    first = std::max(first, firstFrameOf(object));
    last = std::min(last, object.last_frame);
    if (first > last) return object;
    LabelledObject result = withKeyframe(object, shownAt(object, first, camera));
    if (last < object.last_frame) result = withKeyframe(std::move(result), shownAt(object, last + 1, camera));
    for (Keyframe& keyframe : result.keyframes) {
        if (keyframe.frame < first || keyframe.frame > last) continue;
        keyframe.occlusion = flags.occlusion.value_or(keyframe.occlusion);
        keyframe.outside = flags.outside.value_or(keyframe.outside);
        keyframe.ignore = flags.ignore.value_or(keyframe.ignore);
    }
    // The keyframes that carry the flags must not move the boxes.
    std::vector<FrameBox> boxes = shownBoxes(object, firstFrameOf(object), object.last_frame, camera);
    boxes.erase(std::remove_if(boxes.begin(), boxes.end(),
                               [&](const FrameBox& box) { return !boxAt(result, box.frame, camera).visible(); }),
                boxes.end());
    return keptTo(std::move(result), boxes, camera);
}

std::vector<LabelledObject> withClass(std::vector<LabelledObject> objects, const std::string& object_class,
                                      std::uint32_t colour) {
    for (LabelledObject& object : objects) {
        object.object_class = object_class;
        if (colour != 0) object.colour = colour;
    }
    return objects;
}

}  // namespace eyrie
