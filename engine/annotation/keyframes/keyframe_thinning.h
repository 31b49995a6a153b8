#pragma once

#include <vector>

#include "annotation/keyframes/keyframe_reduction.h"

namespace eyrie {

/// Takes keyframes out of an object that keeps the tolerance, one at a time, while those beside the one taken out can
/// be moved (and their headings set or left to the path) so that the rest does it without it. The first keyframe
/// stays where it is.
LabelledObject thinned(LabelledObject object, const std::vector<FrameBox>& boxes, const CameraMotion& camera,
                       const ReductionOptions& options);

}  // namespace eyrie
