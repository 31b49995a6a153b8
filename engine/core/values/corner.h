#pragma once

#include <opencv2/core/types.hpp>
#include <vector>

#include "core/geometry/homography.h"
#include "core/values/ids.h"
#include "core/values/picture_mask.h"
#include "core/values/registration_failure.h"

namespace eyrie {

/// A corner that was found in the current frame and, if `age` > 0, in the frame before (Teutsch §4.2).
struct Corner {
    CornerId id = 0;
    cv::Point2f previous{0, 0};  ///< px in the previous frame; equals `current` when `age` is 0
    cv::Point2f current{0, 0};   ///< px in the current frame
    int age = 0;                 ///< frames since it was first detected
    bool on_background = false;  ///< agrees with the homography of this frame
};

/// How the registration of a frame onto the one before it ended.
enum class RegistrationState {
    first,       ///< nothing before it to register onto
    registered,  ///< `current_from_previous` holds
    frozen,      ///< the same picture as before; the homography is the identity, nothing was measured
    failed       ///< blur, blank, cut or too little texture; the homography is a guess, see `failure`
};

/// What registration delivers for one frame.
struct Registration {
    RegistrationState state = RegistrationState::first;
    Homography current_from_previous;  ///< a prediction (state failed), the identity (first, frozen) or the estimate
    RegistrationFailure failure{};     ///< why not, in state failed
    int elapsed = 1;                   ///< see framesPassed(); more than 1 only in state registered
    double zoom = 1;  ///< pixels per metre as a multiple of those of the first frame, as the camera has zoomed since

    /// Frames over which everything has moved on since the picture before: none when it is the same picture, usually 1,
    /// and more where pictures were lost, be it that frozen ones stand for them or that they are missing.
    int framesPassed() const {
        return state == RegistrationState::first || state == RegistrationState::frozen ? 0 : elapsed;
    }
    bool reliable() const { return state == RegistrationState::registered || state == RegistrationState::frozen; }
};

/// All corners of one frame, sorted by ascending id, and the registration they gave.
struct RegisteredFrame {
    FrameIndex frame = 0;
    Registration registration;
    std::vector<Corner> corners;
    PictureMask graphics;  ///< where something known is drawn into the picture: text, reticles
};

}  // namespace eyrie
