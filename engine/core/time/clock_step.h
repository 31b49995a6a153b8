#pragma once

#include <cmath>
#include <cstdint>

namespace eyrie {

/// Whether the time from one frame to the next is no frame's: the clock was set ahead, or the recording paused.
/// `usual_s`: how long a frame lasts, mostly.
inline bool isClockJump(double step_s, double usual_s) {
    constexpr double kNeverAJump_s = 2;  // slow cameras and lost pictures
    constexpr double kJumpInFrames = 10;
    return step_s > kNeverAJump_s && step_s > kJumpInFrames * usual_s;
}

/// How many frames a video's clock says to have passed over a time, pictures that are missing included; 1 where it does
/// not tell: within a frame, over no whole number of them, over a jump.
inline int framesByClock(std::int64_t step_us, double frame_rate_hz) {
    constexpr double kWhole = 0.25;  // frames off a whole number of them: clocks tremble
    const double step_s = static_cast<double>(step_us) / 1e6;
    const double frames = step_s * frame_rate_hz;
    if (!(frames > 1) || isClockJump(step_s, 1 / frame_rate_hz)) return 1;
    return std::abs(frames - std::round(frames)) <= kWhole ? static_cast<int>(std::lround(frames)) : 1;
}

}  // namespace eyrie
