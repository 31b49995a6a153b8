#pragma once

#include <string>

#include "core/values/corner.h"

namespace eyrie {

/// Looks after a video of which many pictures repeat the one before, since it was made of another one of fewer pictures
/// a second. A picture that stays for longer is a stall, which says nothing of the rate; only its first few repeats
/// count.
class RepeatedPictures {
 public:
    /// The next frame.
    void see(RegistrationState state);
    /// What that means for speeds and what to do about it, for people; empty where few repeat.
    std::string text(double frame_rate_hz) const;

 private:
    int differing_ = 0;
    int repeats_ = 0;
    int in_a_row_ = 0;  ///< up to now
};

}  // namespace eyrie
