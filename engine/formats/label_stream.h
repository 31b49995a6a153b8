#pragma once

#include <functional>
#include <vector>

#include "formats/label_file.h"

namespace eyrie {

/// Takes the boxes of a frame.
using FrameVisitor = std::function<void(FrameIndex, const std::vector<LabelBox>&)>;
/// Hands the frames that have boxes to a visitor, ascending; the same ones whenever it is asked.
using VisitFrames = std::function<void(const FrameVisitor&)>;

/// Labels that are read or made frame by frame, so that they need not all be held at once.
struct LabelStream {
    LabelFile about;  ///< all but the boxes
    VisitFrames frames;
};

/// `boxes` must outlive the result.
VisitFrames framesOf(const LabelBoxes& boxes);
/// One by one, without the occlusions.
VisitBoxes plainBoxes(const VisitFrames& frames);
/// All boxes at once.
LabelFile collected(const LabelStream& labels);

}  // namespace eyrie
