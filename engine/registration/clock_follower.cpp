#include "registration/clock_follower.h"

#include <algorithm>
#include <cmath>

#include "core/time/clock_step.h"

namespace eyrie {
namespace {

constexpr double kMostAhead = 10;    ///< frames by which pictures come too soon …
constexpr double kStillAhead = 0.9;  ///< … and the share that counts a frame later: rates are not exact

}  // namespace

void ClockFollower::next(std::int64_t time_us, const Registration& registration, int repeats_before) {
    if (registration.state == RegistrationState::first) {
        ahead_ = 0;
    } else {
        const int shown = std::max(1, registration.elapsed - repeats_before);
        const double by_clock = static_cast<double>(time_us - last_time_us_) / 1e6 * frame_rate_hz_;
        ahead_ = kStillAhead * std::clamp(ahead_ + shown - by_clock, 0.0, kMostAhead);
    }
    last_time_us_ = time_us;
}

int ClockFollower::mostPassed(std::int64_t from_us, std::int64_t to_us) const {
    const auto too_soon_us = std::llround(ahead_ / frame_rate_hz_ * 1e6);
    return framesByClock(to_us - from_us - too_soon_us, frame_rate_hz_);
}

}  // namespace eyrie
