#pragma once

#include <vector>

#include "annotation/keyframes/camera_motion.h"
#include "core/labels/annotation.h"

namespace eyrie {

/// How the box of an object in a frame came about.
enum class BoxSource {
    none,      ///< the object does not exist in the frame
    keyframe,  ///< a keyframe says so
    ground,    ///< interpolated (or held) on the ground, the camera's motion taken into account
    image      ///< interpolated (or held) in the image, because the frames are not connected by registration
};
/// "none", "keyframe", "ground", "image"
const char* nameOf(BoxSource source);

/// An object in one frame.
struct LabelledBox {
    BoxSource source = BoxSource::none;
    OrientedBox box;
    Occlusion occlusion = Occlusion::none;
    bool outside = false;
    bool ignore = false;
    bool heading_from_path = false;  ///< the heading is the direction of motion

    bool exists() const { return source != BoxSource::none; }
    bool visible() const { return exists() && !outside; }
};

/// How the path between keyframes is drawn.
enum class PathShape {
    straight,  ///< constant speed from keyframe to keyframe
    smooth     ///< cubic through the keyframes: exact for constant speed and constant acceleration, never overshoots a
               ///< stop
};

/// The box of an object in a frame.
///
/// The path runs in ground coordinates, that is, in the image of the keyframe before, into which the neighbouring
/// keyframes are taken through the camera's motion. Sizes grow and shrink with the map's local scale. Where the
/// keyframes stand at least half a box length apart the heading is the direction of the path, unless a keyframe sets
/// it: then the turn against the path is interpolated by the shorter arc; elsewhere headings are, by the shorter arc.
/// After the last keyframe the box stands still on the ground until `last_frame` (what does so for ten frames or more
/// brakes until there); before the first there is none.
/// Flags come from the keyframe before. Takes O(log n) for n frames and keyframes.
LabelledBox boxAt(const LabelledObject& object, FrameIndex frame, const CameraMotion& camera,
                  PathShape shape = PathShape::smooth);

/// An object's box with its id.
struct LabelledBoxOf {
    ObjectId id = 0;
    LabelledBox box;
};

/// All objects that exist in a frame (those outside the image included), ascending ids.
std::vector<LabelledBoxOf> boxesAt(const AnnotationSet& set, FrameIndex frame, const CameraMotion& camera);

/// Whether an object stands still after its last keyframe for so long that it must have braked before.
bool standsAtItsEnd(const LabelledObject& object);
/// First frame of an object (that of its first keyframe).
FrameIndex firstFrameOf(const LabelledObject& object);
/// The last keyframe at or before a frame; nothing before the first.
const Keyframe* keyframeBefore(const LabelledObject& object, FrameIndex frame);
/// The keyframe of exactly this frame.
const Keyframe* keyframeAt(const LabelledObject& object, FrameIndex frame);
/// Next or previous keyframe after or before a frame.
const Keyframe* nextKeyframe(const LabelledObject& object, FrameIndex frame);
const Keyframe* previousKeyframe(const LabelledObject& object, FrameIndex frame);

/// The object with a keyframe set (added, or replacing the one of that frame). Before the first keyframe the object
/// begins earlier, after its end it lasts longer.
LabelledObject withKeyframe(LabelledObject object, const Keyframe& keyframe);
/// The object with the box of a frame changed and everything else of that frame kept: a keyframe that is made by it
/// takes over the flags that hold there.
LabelledObject withBox(LabelledObject object, FrameIndex frame, const OrientedBox& box, bool heading_set);
/// The same, and what is corrected goes on to the keyframes that were computed: those up to the next ones that a hand
/// set change alike in place (along the vehicle's own axes), size and heading, less the nearer they are to these.
/// Nothing goes on where the box lies elsewhere altogether, or beyond the object's life.
LabelledObject withBoxCarriedOn(LabelledObject object, FrameIndex frame, const OrientedBox& box, bool heading_set,
                                const CameraMotion& camera);
/// Whether a box ends at the border of the image: it shows a part of the object only. One that goes on beyond shows
/// all.
bool isCutByBorder(const OrientedBox& box, cv::Size image);
/// The object with the length and width that `box` has in a frame, in all its keyframes; sizes follow the local scale
/// of the camera's motion where the frames are connected. Centres, headings and flags stay.
LabelledObject withSize(LabelledObject object, FrameIndex frame, const OrientedBox& box, const CameraMotion& camera);
/// What a keyframe corrects, carried over to all other keyframes: the box it shows is compared with the one that the
/// others would show there, and place (in the vehicle's own axes), size and heading of theirs change in the same way.
/// Where some of them were computed only these change.
/// As it is where the frame has no keyframe or no other is left.
LabelledObject withCorrectionSpread(LabelledObject object, FrameIndex frame, const CameraMotion& camera);
/// The object without its keyframe of that frame. Its last keyframe is never removed (the object is to be deleted
/// then); `last_frame` stays.
LabelledObject withoutKeyframe(LabelledObject object, FrameIndex frame);

/// The same point on the ground, or the same pixel where the frames are not connected.
cv::Point2d carriedPoint(cv::Point2d point, FrameIndex from, FrameIndex to, const CameraMotion& camera);
/// A box carried on the ground to another frame: centre, local scale, local turn; nothing where not connected.
std::optional<OrientedBox> carriedBox(const OrientedBox& box, FrameIndex from, FrameIndex to,
                                      const CameraMotion& camera);

}  // namespace eyrie
