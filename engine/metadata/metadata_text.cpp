#include "metadata/metadata_text.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <string_view>

#include "core/time/utc_time.h"
#include "metadata/metadata_tag.h"

namespace eyrie {
namespace {

constexpr int kMostDecimals = 7;
constexpr int kUnknownDecimals = 3;  ///< of codings that do not tell how fine they are

bool isMoment(const TagInfo* info) {
    return info != nullptr && std::string_view(info->unit) == "us";
}

int decimalsOf(const TagInfo& info) {
    const bool is_signed = info.coding == Coding::signed_range;
    switch (info.coding) {
        case Coding::unsigned_integer:
        case Coding::signed_integer:
            return 0;
        case Coding::unsigned_range:
        case Coding::signed_range: {
            const double step = (info.high - (is_signed ? -info.high : info.low)) / std::pow(2.0, 8 * info.bytes);
            return std::clamp(static_cast<int>(std::ceil(-std::log10(step))), 0, kMostDecimals);
        }
        default:
            return kUnknownDecimals;
    }
}

}  // namespace

std::string valueText(int tag, double value) {
    const TagInfo* info = infoOf(tag);
    constexpr double kFarthest_us = 1e18;  // beyond any calendar, and well within 64 bits
    if (isMoment(info) && std::abs(value) < kFarthest_us) {
        std::string text = utcText(static_cast<std::int64_t>(value));
        if (!text.empty()) return text;
    }
    // Zeros at the end stay, so that a value that changes keeps its width.
    char text[400];
    const auto end = std::to_chars(text, text + sizeof text, value, std::chars_format::fixed,
                                   info != nullptr ? decimalsOf(*info) : kUnknownDecimals);
    return {text, end.ptr};
}

std::string unitText(int tag) {
    const TagInfo* info = infoOf(tag);
    if (info == nullptr || isMoment(info)) return {};
    const std::string_view unit = info->unit;
    if (unit == "deg") return "°";
    if (unit == "C") return "°C";
    return std::string(unit);
}

std::string damageText(const MetadataStream& stream) {
    std::string text;
    for (std::size_t i = 0; i < stream.faults.size(); ++i) {
        if (stream.faults[i] == 0) continue;
        text += (text.empty() ? "" : ", ") + std::string(klv::nameOf(static_cast<klv::Fault>(i))) + " " +
                std::to_string(stream.faults[i]) + "×";
    }
    return text.empty() ? text : text + firstPlaceText(stream.first_damage);
}

std::string firstPlaceText(const std::optional<MetadataPlace>& place) {
    return place ? "; the first near frame " + std::to_string(place->pictures_before) : "";
}

}  // namespace eyrie
