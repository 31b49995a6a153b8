#pragma once

#include <stop_token>

#include "annotation/keyframes/camera_motion.h"
#include "annotation/pictures/box_tracker.h"
#include "core/labels/annotation.h"
#include "stacking/image_stack.h"

namespace eyrie {

/// How an object's views are laid on one another (Teutsch §5.3).
struct ObjectStackOptions {
    StackArrangement arrangement = StackArrangement::circular_median;
    int layers = 25;               ///< frames, the nearest before and after; H_min of the thesis
    double border = 0.5;           ///< around the box, of its length
    double samples_per_px = 2;     ///< of the frame looked at
    double largest_shift_px = 3;   ///< by which a layer may be moved to lie on the frame looked at
    double min_correlation = 0.3;  ///< layers that look less like it (something drove in front) are left out
};

/// An object as it looks over many frames, noise averaged away, in the place where one frame shows it.
struct ObjectStack {
    FrameIndex frame = 0;
    OrientedBox area;  ///< what `stacked` shows, px of the frame; its heading points to the right in `stacked`
    cv::Mat stacked;   ///< CV_8UC1; empty where there are fewer than three layers
    int layers = 0;
};

/// The stack of an object for a frame in which it can be seen: its boxes in the frames around, carried by their
/// interpolation, turned upright, brought to the size they have in this frame and, as interpolation is not exact, moved
/// by a few pixels to where they look most like it. Frames that `gray` cannot deliver and those in which the object is
/// hidden are left out. Empty where the object is not to be seen in the frame.
ObjectStack stackObject(const LabelledObject& object, FrameIndex frame, const CameraMotion& camera,
                        const GrayFrames& gray, const ObjectStackOptions& options = {}, std::stop_token stop = {});

}  // namespace eyrie
