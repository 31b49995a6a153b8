#pragma once

#include <string>
#include <vector>

#include "annotation/keyframes/interpolation.h"
#include "annotation/keyframes/keyframe_reduction.h"

/// Objects cut and put together so that boxes stay where they were on screen.
namespace eyrie {

/// "car 7"
std::string nameOf(const LabelledObject& object);

/// Keyframe of a frame as the object is shown there.
Keyframe shownAt(const LabelledObject& object, FrameIndex frame, const CameraMotion& camera);

/// The boxes an object shows in [first, last].
std::vector<FrameBox> shownBoxes(const LabelledObject& object, FrameIndex first, FrameIndex last,
                                 const CameraMotion& camera);

/// Puts keyframes in where an object shows other boxes than these, by more than half a pixel.
LabelledObject keptTo(LabelledObject object, const std::vector<FrameBox>& boxes, const CameraMotion& camera);

/// The part of an object in [first, last], which must meet its life; with keyframes at both cuts, and where the path
/// between would change by more than half a pixel.
LabelledObject pieceOf(const LabelledObject& object, FrameIndex first, FrameIndex last, const CameraMotion& camera);

/// Two pieces put together; `earlier` ends before `later` begins. Everything but keyframes and the end comes from
/// `identity`. Between them the object is interpolated or outside.
LabelledObject joined(const LabelledObject& earlier, const LabelledObject& later, const LabelledObject& identity,
                      bool outside_between, const CameraMotion& camera);

}  // namespace eyrie
