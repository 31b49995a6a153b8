#include "io/clock_jumps.h"

#include <utility>

#include "core/time/clock_step.h"
#include "core/time/time_text.h"

namespace eyrie {
namespace {

constexpr std::size_t kMostNamed = 3;  ///< frames that one can still read

}  // namespace

ClockJumps::ClockJumps(double frame_rate_hz) : usual_s_(1 / frame_rate_hz) {}

void ClockJumps::see(FrameIndex frame, std::int64_t time_us) {
    const std::int64_t step_us = time_us - std::exchange(last_us_, time_us).value_or(time_us);
    if (!isClockJump(static_cast<double>(step_us) / 1e6, usual_s_)) return;
    if (count_++ == 0) first_us_ = step_us;
    if (frames_.size() < kMostNamed) frames_.push_back(frame);
}

std::string ClockJumps::text() const {
    if (count_ == 0) return {};
    const bool once = count_ == 1;
    std::string places;
    for (std::size_t i = 0; i < frames_.size(); ++i) {
        const bool last = i + 1 == frames_.size() && count_ == static_cast<int>(frames_.size());
        places += (i == 0 ? "" : last ? " and " : ", ") + std::to_string(frames_[i]);
    }
    if (count_ > static_cast<int>(frames_.size())) places += " and others";
    const std::string by = timeText(first_us_, 0);
    const std::string jumps =
        once ? "by " + by + " before frame " + places
             : std::to_string(count_) + " times, before frames " + places + " (by " + by + " the first time)";
    return "the clock of the video leaps ahead " + jumps +
           ", and times of events count that; unless the recording paused there, cut the video at " +
           (once ? "that frame" : "those frames");
}

}  // namespace eyrie
