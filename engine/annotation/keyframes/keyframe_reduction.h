#pragma once

#include <vector>

#include "annotation/keyframes/camera_motion.h"
#include "annotation/keyframes/interpolation.h"
#include "core/labels/annotation.h"

namespace eyrie {

/// A box in a frame, as tracks deliver them.
struct FrameBox {
    FrameIndex frame = 0;
    OrientedBox box;
};

/// What a reduction must keep.
struct ReductionOptions {
    double tolerance_px = 1.5;  ///< largest distance between corresponding corners, px; 0: do not look at corners
    double min_overlap = 0;     ///< smallest overlap with the dense box, 0 … 1; 0: do not look at it
    PathShape shape = PathShape::smooth;
    bool headings_set = false;  ///< every keyframe tells its heading, none is left to the path
    bool thorough = false;      ///< looks for better places as long as that saves keyframes; takes some 50 ms a track
};

/// Few keyframes whose interpolation stays within the tolerance of every dense box. Frames must ascend; where one or
/// more are missing the interpolation goes through. Headings are left to the path where the path is right.
/// The last keyframe may come before the last dense frame (what stands at the end). Empty for no boxes.
std::vector<Keyframe> reduceToKeyframes(const std::vector<FrameBox>& boxes, const CameraMotion& camera,
                                        const ReductionOptions& options = {});

/// How far the interpolation of an object is from dense boxes at worst.
struct ReductionError {
    double corner_px = 0;
    double min_overlap = 1;
    FrameIndex worst_frame = 0;
};
ReductionError reductionError(const LabelledObject& object, const std::vector<FrameBox>& boxes,
                              const CameraMotion& camera, PathShape shape = PathShape::smooth);

/// Adds keyframes to an object until its interpolation is within the tolerance of the given boxes; none is moved.
LabelledObject refined(LabelledObject object, const std::vector<FrameBox>& boxes, const CameraMotion& camera,
                       const ReductionOptions& options);

}  // namespace eyrie
