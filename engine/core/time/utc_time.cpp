#include "core/time/utc_time.h"

#include <algorithm>
#include <chrono>
#include <cstdio>

namespace eyrie {
namespace {

/// The calendar's end on either side, µs: beyond, years do not have four digits.
constexpr std::int64_t kSecond_us = 1'000'000;
constexpr std::int64_t kFirst_us = -62'167'219'200 * kSecond_us;  // 0000-01-01
constexpr std::int64_t kEnd_us = 253'402'300'800 * kSecond_us;    // 10000-01-01

/// With so many decimals of the seconds, 0 to 6.
std::string isoText(std::int64_t utc_us, int decimals) {
    using namespace std::chrono;
    if (utc_us < kFirst_us || utc_us >= kEnd_us) return {};
    const sys_time<microseconds> time{microseconds(utc_us)};
    const auto day = floor<days>(time);
    const year_month_day date(day);
    const hh_mm_ss clock(time - day);
    char text[64];
    const int length =
        std::snprintf(text, sizeof text, "%04d-%02u-%02uT%02d:%02d:%02d.%06d", static_cast<int>(date.year()),
                      static_cast<unsigned>(date.month()), static_cast<unsigned>(date.day()),
                      static_cast<int>(clock.hours().count()), static_cast<int>(clock.minutes().count()),
                      static_cast<int>(clock.seconds().count()), static_cast<int>(clock.subseconds().count()));
    const int cut = decimals == 0 ? 7 : 6 - decimals;
    return std::string(text, static_cast<std::size_t>(length - cut)) + "Z";
}

/// Takes so many digits, and then a mark where one is asked for, off the front; nothing where they are not there.
std::optional<int> takeDigits(std::string_view& text, std::size_t count, char mark = '\0') {
    if (text.size() < count) return std::nullopt;
    int value = 0;
    for (const char digit : text.substr(0, count)) {
        if (digit < '0' || digit > '9') return std::nullopt;
        value = 10 * value + (digit - '0');
    }
    text.remove_prefix(count);
    if (mark == '\0') return value;
    if (text.empty() || (text.front() != mark && !(mark == 'T' && text.front() == ' '))) return std::nullopt;
    text.remove_prefix(1);
    return value;
}

/// The decimals of the seconds, µs; 0 without any.
std::optional<int> takeFraction(std::string_view& text) {
    if (text.empty() || text.front() != '.') return 0;
    text.remove_prefix(1);
    const std::size_t count = std::min(text.find_first_not_of("0123456789"), text.size());
    if (count < 1 || count > 6) return std::nullopt;
    int value = *takeDigits(text, count);
    for (std::size_t i = count; i < 6; ++i) value *= 10;
    return value;
}

}  // namespace

std::string nowUtc() {
    using namespace std::chrono;
    return utcTextOfSeconds(floor<seconds>(system_clock::now()).time_since_epoch().count());
}

std::int64_t nowUtcMicroseconds() {
    using namespace std::chrono;
    return floor<microseconds>(system_clock::now()).time_since_epoch().count();
}

std::string utcTextOfSeconds(std::int64_t seconds) {
    if (seconds < kFirst_us / kSecond_us || seconds >= kEnd_us / kSecond_us) return {};
    return isoText(seconds * kSecond_us, 0);
}

std::string utcText(std::int64_t utc_us) {
    return isoText(utc_us, 6);
}

std::string utcTextToMilliseconds(std::int64_t utc_us) {
    return isoText(utc_us, 3);
}

std::string timeOfDayText(std::int64_t utc_us, int decimals) {
    constexpr std::size_t kDate = 11;  // characters, with the "T"
    const std::string text = isoText(utc_us, std::clamp(decimals, 0, 6));
    return text.empty() ? text : text.substr(kDate, text.size() - kDate - 1);
}

std::optional<std::int64_t> utcOf(std::string_view text) {
    using namespace std::chrono;
    const auto y = takeDigits(text, 4, '-');
    const auto m = y ? takeDigits(text, 2, '-') : std::nullopt;
    const auto d = m ? takeDigits(text, 2, 'T') : std::nullopt;
    const auto hour = d ? takeDigits(text, 2, ':') : std::nullopt;
    const auto minute = hour ? takeDigits(text, 2, ':') : std::nullopt;
    const auto second = minute ? takeDigits(text, 2) : std::nullopt;
    if (!second || *hour > 23 || *minute > 59 || *second > 59) return std::nullopt;
    const auto fraction = takeFraction(text);
    if (!fraction || !(text.empty() || text == "Z")) return std::nullopt;
    const year_month_day date(year(*y), month(static_cast<unsigned>(*m)), day(static_cast<unsigned>(*d)));
    if (!date.ok()) return std::nullopt;
    const sys_time<microseconds> time =
        sys_days(date) + hours(*hour) + minutes(*minute) + seconds(*second) + microseconds(*fraction);
    return time.time_since_epoch().count();
}

}  // namespace eyrie
