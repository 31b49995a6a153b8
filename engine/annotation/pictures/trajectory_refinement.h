#pragma once

#include <stop_token>

#include "annotation/keyframes/camera_motion.h"
#include "annotation/pictures/box_tracker.h"
#include "core/labels/annotation.h"

namespace eyrie {

/// How an object is laid on the pictures.
struct PictureFitOptions {
    double reach_along = 0.4;           ///< how far a box may be off along its heading, of its length
    double reach_across = 0.5;          ///< across, of its width
    double tolerance_of_length = 0.06;  ///< that keyframes may leave, of the object's length
    double min_tolerance_px = 1;
    double min_in_image = 0.75;  ///< share of a box in the image from which on it can be compared
};

/// What became of an object laid on the pictures.
struct PictureFit {
    LabelledObject object;
    int frames = 0;  ///< compared
    int sure = 0;    ///< of these, frames that look like the boxes set by hand
};

/// Lays an object on the pictures: all its frames are compared with how it looks in the boxes that a hand set, and
/// those in which it was computed move to where they look most alike; the whole way is found at once, so that one
/// frame that looks like something else does not lead away. They turn where that looks more alike; sizes, keyframes set
/// by hand and flags stay. As it is where no keyframe was set by hand or none was computed.
PictureFit fittedToPictures(const LabelledObject& object, const CameraMotion& camera, const GrayFrames& gray,
                            const PictureFitOptions& options = {}, std::stop_token stop = {});

}  // namespace eyrie
