#pragma once

#include <cstdint>
#include <string>

namespace eyrie {

/// A time of the video, or a length of time, as people read it: "1:02.48" or, from an hour on, "1:00:02.48", rounded to
/// `decimals` of the seconds, 0 … 3. Whatever tells a time tells it by this, so that no two places differ.
std::string timeText(std::int64_t time_us, int decimals = 2);

/// The same of seconds, rounded to tenths: when an event is.
std::string videoClockText(double seconds);

}  // namespace eyrie
