#pragma once

#include <optional>
#include <string>
#include <vector>

#include "annotation/keyframes/camera_motion.h"
#include "core/labels/annotation.h"
#include "core/labels/annotation_edit.h"

/// Who is who, put right. Every verb is a pure function: it takes objects and returns what they become; nothing is
/// changed until the edit made of it is applied, so that it can be shown first. Boxes on screen stay where they were
/// (within half a pixel): keyframes are added where an object is cut.
/// Errors are Error(parameter) with a message for people ("car 4 begins before car 7 ends; fuse them instead").
namespace eyrie {

/// Review marks that go over to another object.
struct ReviewMove {
    ObjectId from = 0;
    ObjectId to = 0;
    FrameIndex first_frame = 0;
    FrameIndex last_frame = 0;  ///< included
};

/// What a verb does.
struct IdentityChange {
    std::vector<LabelledObject> after;  ///< changed and new objects
    std::vector<ObjectId> removed;
    std::vector<ReviewMove> review_moves;
};

/// The change as an edit of a set. Marks of removed objects that did not move are removed.
AnnotationEdit editOf(const std::string& name, const AnnotationSet& set, const IdentityChange& change);
/// Objects added or changed, nothing else.
AnnotationEdit editOf(const std::string& name, const AnnotationSet& set, const std::vector<LabelledObject>& after);
/// Objects deleted, with their review marks.
AnnotationEdit deletionOf(const std::string& name, const AnnotationSet& set, const std::vector<ObjectId>& ids);
/// Regions added or changed (`after`), and removed.
AnnotationEdit regionEdit(const std::string& name, const AnnotationSet& set, const std::vector<IgnoreRegion>& after,
                          const std::vector<int>& removed = {});
/// Marks added at the end of the list.
AnnotationEdit reviewEdit(const std::string& name, const AnnotationSet& set, const std::vector<ReviewMark>& marks);

/// What an object is between two pieces that are joined.
enum class GapFilling {
    interpolate,  ///< it goes on, as interpolated
    outside       ///< it is outside the image
};

/// One object from two that follow each other in time, in either order; it keeps the id, class and notes of `kept`.
IdentityChange joinInTime(const LabelledObject& kept, const LabelledObject& other, const CameraMotion& camera,
                          GapFilling gap = GapFilling::interpolate);

/// Which box counts in frames that both of two fused objects have.
enum class FuseRule {
    prefer_kept,  ///< where both exist the box of `kept` counts
    mean          ///< where both exist the mean of both
};
/// One object from two that are the same vehicle at the same time. Frames only `other` has are taken from it.
IdentityChange fuseInParallel(const LabelledObject& kept, const LabelledObject& other, const CameraMotion& camera,
                              FuseRule rule = FuseRule::prefer_kept);

/// The object ends before `frame`, a new one with `new_id` goes on from it.
IdentityChange splitAt(const LabelledObject& object, FrameIndex frame, ObjectId new_id, const CameraMotion& camera);

/// From `frame` on a is b and b is a. One of them may not exist before or after: then the other's part changes hands.
IdentityChange swapFrom(const LabelledObject& a, const LabelledObject& b, FrameIndex frame, const CameraMotion& camera);

/// From `frame` on the object has another identity: a new one, or that of `target`, which must not exist from `frame`
/// to this object's end.
IdentityChange renumberFrom(const LabelledObject& object, FrameIndex frame, ObjectId new_id,
                            const LabelledObject* target, const CameraMotion& camera);

/// The object without all frames before `frame`, or after `frame`. `frame` itself stays. Nothing to keep: removed.
IdentityChange deleteBefore(const LabelledObject& object, FrameIndex frame, const CameraMotion& camera);
IdentityChange deleteAfter(const LabelledObject& object, FrameIndex frame, const CameraMotion& camera);

/// Flags to set; empty: as they are.
struct FlagChange {
    std::optional<Occlusion> occlusion;
    std::optional<bool> outside;
    std::optional<bool> ignore;
};
/// Flags of the frames [first, last], both included; those outside the range keep theirs.
LabelledObject withFlags(const LabelledObject& object, FrameIndex first, FrameIndex last, const FlagChange& flags,
                         const CameraMotion& camera);
/// Objects with another class; `colour` 0 keeps theirs.
std::vector<LabelledObject> withClass(std::vector<LabelledObject> objects, const std::string& object_class,
                                      std::uint32_t colour = 0);

}  // namespace eyrie
