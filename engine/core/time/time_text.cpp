#include "core/time/time_text.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>

namespace eyrie {

std::string timeText(std::int64_t time_us, int decimals) {
    constexpr std::array<std::int64_t, 4> units{1'000'000, 100'000, 10'000, 1'000};
    const int places = std::clamp(decimals, 0, 3);
    const std::int64_t unit = units[static_cast<std::size_t>(places)];
    const std::int64_t rounded = (std::llabs(time_us) + unit / 2) / unit * unit;
    const std::int64_t seconds = rounded / 1'000'000;
    std::array<char, 48> text{};
    if (seconds >= 3600)
        std::snprintf(text.data(), text.size(), "%lld:%02lld:%02lld", static_cast<long long>(seconds / 3600),
                      static_cast<long long>(seconds / 60 % 60), static_cast<long long>(seconds % 60));
    else
        std::snprintf(text.data(), text.size(), "%lld:%02lld", static_cast<long long>(seconds / 60),
                      static_cast<long long>(seconds % 60));
    std::string result = time_us < 0 && rounded > 0 ? "-" : "";
    result += text.data();
    if (places > 0) {
        const std::string digits = std::to_string(rounded % 1'000'000 / unit);
        result += '.';
        result.append(static_cast<std::size_t>(places) - digits.size(), '0');
        result += digits;
    }
    return result;
}

std::string videoClockText(double seconds) {
    return timeText(std::llround(seconds * 1e6), 1);
}

}  // namespace eyrie
