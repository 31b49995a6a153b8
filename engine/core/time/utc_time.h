#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

/// Moments as ISO 8601 text in UTC, "2026-11-21T08:00:00Z": the one way they are stored, exchanged and shown. Texts of
/// equal precision sort as the moments do.
namespace eyrie {

/// Now, to the second.
std::string nowUtc();
/// The same to the microsecond, since 1970-01-01.
std::int64_t nowUtcMicroseconds();

/// A moment to the second, from seconds since 1970-01-01. Empty outside the years 0 to 9999, which have no such text.
std::string utcTextOfSeconds(std::int64_t seconds);
/// The same to the microsecond, "2009-01-12T22:08:22.000000Z", from µs since 1970-01-01.
std::string utcText(std::int64_t utc_us);
/// The same to the millisecond, for people; what is finer is cut off.
std::string utcTextToMilliseconds(std::int64_t utc_us);

/// The time of the day alone, for people: "22:08:22", or with so many decimals of the seconds, 0 to 6; what is finer is
/// cut off.
std::string timeOfDayText(std::int64_t utc_us, int decimals = 0);

/// µs since 1970-01-01 of a text as above, with up to six decimals of the seconds or none, also with a blank for the
/// "T" and without the "Z"; nothing for other texts and for moments that no calendar has.
std::optional<std::int64_t> utcOf(std::string_view text);

}  // namespace eyrie
