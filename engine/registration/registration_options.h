#pragma once

#include "core/parameter.h"
#include "registration/corners/corner_detector.h"
#include "registration/corners/corner_tracker.h"
#include "registration/estimation/homography_estimator.h"
#include "registration/graphics/burned_in_graphics.h"

namespace eyrie {

/// Parameters of image registration (Teutsch §4.2).
struct RegistrationOptions {
    CornerOptions corners;
    TrackingOptions tracking;
    HomographyOptions homography;
    GraphicsOptions graphics;
    int recovery_frames = 8;
    bool feature_search = true;  ///< where no prediction fits, features that look alike are tried

    /// The text leaves the parameters of registration open (§4.2), but favours no places and uses no descriptors.
    static RegistrationOptions thesis();
    void describe(ParameterVisitor& visitor);
};

}  // namespace eyrie
