#include "io/clock_jumps.h"

#include <utility>

#include "core/time_text.h"

namespace eyrie {
namespace {

constexpr double kNeverAJump_s = 2;  ///< slow cameras and lost pictures
constexpr double kJumpInFrames = 10;

}  // namespace

bool isClockJump(double step_s, double usual_s) {
    return step_s > kNeverAJump_s && step_s > kJumpInFrames * usual_s;
}

ClockJumps::ClockJumps(double frame_rate_hz) : usual_s_(1 / frame_rate_hz) {}

void ClockJumps::see(FrameIndex frame, std::int64_t time_us) {
    const std::int64_t step_us = time_us - std::exchange(last_us_, time_us).value_or(time_us);
    if (!isClockJump(static_cast<double>(step_us) / 1e6, usual_s_)) return;
    if (count_++ > 0) return;
    first_ = frame;
    first_us_ = step_us;
}

std::string ClockJumps::text() const {
    if (count_ == 0) return {};
    return "the clock of the video leaps ahead by " + timeText(first_us_, 0) + " before frame " +
           std::to_string(first_) + (count_ > 1 ? " and " + std::to_string(count_ - 1) + "× later" : "") +
           ", and times of events count that; unless the recording paused there, cut the video at that frame";
}

}  // namespace eyrie
