#include "registration/registration_options.h"

namespace eyrie {

RegistrationOptions RegistrationOptions::thesis() {
    RegistrationOptions options;
    options.corners.favour_movers = false;
    options.corners.max_corners = 50'000;  // the text knows no limit: about 22,000 vectors an image (table 7.11)
    options.feature_search = false;
    options.graphics.leave_out_graphics = false;
    options.recovery_frames = 0;  // homographies between subsequent images only
    return options;
}

void RegistrationOptions::describe(ParameterVisitor& visitor) {
    const ParameterDeclarer declare(visitor, ChainStage::registration);
    corners.describe(visitor);
    tracking.describe(visitor);
    homography.describe(visitor);
    graphics.describe(visitor);
    declare.integer(
        "registration.recovery_frames", recovery_frames, 0, 100,
        {"frames",
         "After a frame that cannot be registered, the last good frame is tried again for this long, so that a "
         "black or blurred frame does not end all corner tracks.",
         ""});
    declare.flag(
        "registration.feature_search", feature_search,
        {"", "Where no prediction fits, as after a jump, pictures are registered by features that look alike.", ""});
}

}  // namespace eyrie
