#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/values/ids.h"

namespace eyrie {

/// Looks after the clock of a video that is read frame by frame. One that goes back is mended when the video is opened.
class ClockJumps {
 public:
    explicit ClockJumps(double frame_rate_hz);  ///< above 0
    void see(FrameIndex frame, std::int64_t time_us);
    /// Where it leaps ahead and what to do about it, for people; empty where it does not.
    std::string text() const;

 private:
    double usual_s_;
    std::optional<std::int64_t> last_us_;
    int count_ = 0;
    std::int64_t first_us_ = 0;       ///< how far the first jump goes
    std::vector<FrameIndex> frames_;  ///< behind the first few jumps
};

}  // namespace eyrie
