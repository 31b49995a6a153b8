#pragma once

#include "explain/explanation.h"

namespace eyrie::test {

/// 1 px is 25 cm, 1 px/frame is 6.25 m/s; a car is 18 × 7.2 px.
inline const SceneScale kPlaceScale{0.25, 25, true};

/// Options in which counts alone decide, however dense corners are, so that they can be worked out by hand.
inline ChainOptions withoutDensity() {
    ChainOptions options;
    options.clustering.min_density_share = 0;
    options.outliers.min_density_share = 0;
    return options;
}

/// A registered frame without corners; the place is a car's length around (100, 100).
inline PlaceEvidence emptyPlace() {
    PlaceEvidence evidence;
    evidence.area = placeAt({100, 100}, kPlaceScale);
    FrameMotion& motion = evidence.result.motion;
    motion.frame = 30;
    motion.image_size = {1000, 500};
    motion.corner_count = 1000;
    motion.registration.state = RegistrationState::registered;
    motion.registration.current_from_previous.inliers = 800;
    motion.registration.current_from_previous.rms_px = 0.2;
    evidence.corners = CornerVerdicts{};
    evidence.tracking = TrackingTrace{};
    return evidence;
}

}  // namespace eyrie::test
