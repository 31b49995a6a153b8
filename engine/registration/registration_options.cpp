#include "registration/registration_options.h"

namespace eyrie {

void RegistrationOptions::describe(ParameterVisitor& visitor) {
    corners.describe(visitor);
    tracking.describe(visitor);
    homography.describe(visitor);
    visitor.integer(
        "registration.recovery_frames", recovery_frames, 0, 100,
        {"frames",
         "After a frame that cannot be registered, the last good frame is tried again for this long, so that a "
         "black or blurred frame does not end all corner tracks.",
         ""});
}

}  // namespace eyrie
