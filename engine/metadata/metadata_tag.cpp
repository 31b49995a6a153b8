#include "metadata/metadata_tag.h"

#include <algorithm>
#include <array>

namespace eyrie {
namespace {

using enum Coding;
using enum Blend;

// MISB ST 0601.17, chapter 8. Deprecated items and those for the crew alone are opaque.
constexpr auto kTags = std::to_array<TagInfo>({
    {1, "checksum", "", unsigned_integer, 2, 0, 0, Blend::none},
    {2, "time", "us", unsigned_integer, 8, 0, 0, Blend::none},
    {3, "mission", "", text},
    {4, "platform tail number", "", text},
    {5, "platform heading", "deg", unsigned_range, 2, 0, 360, circle},
    {6, "platform pitch", "deg", signed_range, 2, 0, 20},
    {7, "platform roll", "deg", signed_range, 2, 0, 50},
    {8, "platform true airspeed", "m/s", unsigned_integer, 1},
    {9, "platform indicated airspeed", "m/s", unsigned_integer, 1},
    {10, "platform", "", text},
    {11, "image source sensor", "", text},
    {12, "image coordinate system", "", text},
    {13, "sensor latitude", "deg", signed_range, 4, 0, 90},
    {14, "sensor longitude", "deg", signed_range, 4, 0, 180, circle},
    {15, "sensor altitude", "m", unsigned_range, 2, -900, 19000},
    {16, "sensor horizontal field of view", "deg", unsigned_range, 2, 0, 180},
    {17, "sensor vertical field of view", "deg", unsigned_range, 2, 0, 180},
    {18, "sensor relative azimuth", "deg", unsigned_range, 4, 0, 360, circle},
    {19, "sensor relative elevation", "deg", signed_range, 4, 0, 180, circle},
    {20, "sensor relative roll", "deg", unsigned_range, 4, 0, 360, circle},
    {21, "slant range", "m", unsigned_range, 4, 0, 5e6},
    {22, "target width", "m", unsigned_range, 2, 0, 10000},
    {23, "frame centre latitude", "deg", signed_range, 4, 0, 90},
    {24, "frame centre longitude", "deg", signed_range, 4, 0, 180, circle},
    {25, "frame centre elevation", "m", unsigned_range, 2, -900, 19000},
    {26, "corner 1 latitude offset", "deg", signed_range, 2, 0, 0.075},
    {27, "corner 1 longitude offset", "deg", signed_range, 2, 0, 0.075},
    {28, "corner 2 latitude offset", "deg", signed_range, 2, 0, 0.075},
    {29, "corner 2 longitude offset", "deg", signed_range, 2, 0, 0.075},
    {30, "corner 3 latitude offset", "deg", signed_range, 2, 0, 0.075},
    {31, "corner 3 longitude offset", "deg", signed_range, 2, 0, 0.075},
    {32, "corner 4 latitude offset", "deg", signed_range, 2, 0, 0.075},
    {33, "corner 4 longitude offset", "deg", signed_range, 2, 0, 0.075},
    {34, "icing detected", "", unsigned_integer, 1, 0, 0, Blend::none},
    {35, "wind direction", "deg", unsigned_range, 2, 0, 360, circle},
    {36, "wind speed", "m/s", unsigned_range, 1, 0, 100},
    {37, "static pressure", "mbar", unsigned_range, 2, 0, 5000},
    {38, "density altitude", "m", unsigned_range, 2, -900, 19000},
    {39, "outside air temperature", "C", signed_integer, 1},
    {40, "target latitude", "deg", signed_range, 4, 0, 90},
    {41, "target longitude", "deg", signed_range, 4, 0, 180, circle},
    {42, "target elevation", "m", unsigned_range, 2, -900, 19000},
    {43, "target gate width", "px", unsigned_integer, 1, 0, 2},
    {44, "target gate height", "px", unsigned_integer, 1, 0, 2},
    {45, "target error CE90", "m", unsigned_range, 2, 0, 4095},
    {46, "target error LE90", "m", unsigned_range, 2, 0, 4095},
    {47, "generic flags", "", unsigned_integer, 1, 0, 0, Blend::none},
    {48, "security set", "", opaque},
    {49, "differential pressure", "mbar", unsigned_range, 2, 0, 5000},
    {50, "platform angle of attack", "deg", signed_range, 2, 0, 20},
    {51, "platform vertical speed", "m/s", signed_range, 2, 0, 180},
    {52, "platform sideslip", "deg", signed_range, 2, 0, 20},
    {53, "airfield pressure", "mbar", unsigned_range, 2, 0, 5000},
    {54, "airfield elevation", "m", unsigned_range, 2, -900, 19000},
    {55, "relative humidity", "%", unsigned_range, 1, 0, 100},
    {56, "platform ground speed", "m/s", unsigned_integer, 1},
    {57, "ground range", "m", unsigned_range, 4, 0, 5e6},
    {58, "platform fuel", "kg", unsigned_range, 2, 0, 10000},
    {59, "platform call sign", "", text},
    {63, "sensor field of view name", "", unsigned_integer, 1, 0, 0, Blend::none},
    {64, "platform magnetic heading", "deg", unsigned_range, 2, 0, 360, circle},
    {65, "local set version", "", unsigned_integer, 0, 0, 0, Blend::none},
    {67, "alternate platform latitude", "deg", signed_range, 4, 0, 90},
    {68, "alternate platform longitude", "deg", signed_range, 4, 0, 180, circle},
    {69, "alternate platform altitude", "m", unsigned_range, 2, -900, 19000},
    {70, "alternate platform", "", text},
    {71, "alternate platform heading", "deg", unsigned_range, 2, 0, 360, circle},
    {72, "event start time", "us", unsigned_integer, 8, 0, 0, Blend::none},
    {73, "remote video terminal set", "", opaque},
    {74, "moving targets set", "", opaque},
    {75, "sensor ellipsoid height", "m", unsigned_range, 2, -900, 19000},
    {76, "alternate platform ellipsoid height", "m", unsigned_range, 2, -900, 19000},
    {77, "operational mode", "", unsigned_integer, 1, 0, 0, Blend::none},
    {78, "frame centre ellipsoid height", "m", unsigned_range, 2, -900, 19000},
    {79, "sensor north velocity", "m/s", signed_range, 2, 0, 327},
    {80, "sensor east velocity", "m/s", signed_range, 2, 0, 327},
    {82, "corner 1 latitude", "deg", signed_range, 4, 0, 90},
    {83, "corner 1 longitude", "deg", signed_range, 4, 0, 180, circle},
    {84, "corner 2 latitude", "deg", signed_range, 4, 0, 90},
    {85, "corner 2 longitude", "deg", signed_range, 4, 0, 180, circle},
    {86, "corner 3 latitude", "deg", signed_range, 4, 0, 90},
    {87, "corner 3 longitude", "deg", signed_range, 4, 0, 180, circle},
    {88, "corner 4 latitude", "deg", signed_range, 4, 0, 90},
    {89, "corner 4 longitude", "deg", signed_range, 4, 0, 180, circle},
    {90, "platform pitch full", "deg", signed_range, 4, 0, 90},
    {91, "platform roll full", "deg", signed_range, 4, 0, 90},
    {92, "platform angle of attack full", "deg", signed_range, 4, 0, 90},
    {93, "platform sideslip full", "deg", signed_range, 4, 0, 180, circle},
    {94, "core identifier", "", opaque},
    {95, "radar imagery set", "", opaque},
    {96, "target width extended", "m", imapb, 0, 0, 1.5e6},
    {103, "density altitude extended", "m", imapb, 0, -900, 40000},
    {104, "sensor ellipsoid height extended", "m", imapb, 0, -900, 40000},
    {105, "alternate platform ellipsoid height extended", "m", imapb, 0, -900, 40000},
    {106, "stream designator", "", text},
    {107, "operational base", "", text},
    {108, "broadcast source", "", text},
    {109, "range to recovery", "km", imapb, 0, 0, 21000},
    {110, "time airborne", "s", unsigned_integer},
    {111, "propulsion speed", "rpm", unsigned_integer},
    {112, "platform course", "deg", imapb, 0, 0, 360, circle},
    {113, "altitude above ground", "m", imapb, 0, -900, 40000},
    {114, "radar altimeter", "m", imapb, 0, -900, 40000},
    {117, "sensor azimuth rate", "deg/s", imapb, 0, -1000, 1000},
    {118, "sensor elevation rate", "deg/s", imapb, 0, -1000, 1000},
    {119, "sensor roll rate", "deg/s", imapb, 0, -1000, 1000},
    {120, "storage used", "%", imapb, 0, 0, 100},
    {129, "target identifier", "", text},
    {135, "communications method", "", text},
    {tag::kAngleToNorth, "angle to north", "deg", opaque, 0, 0, 0, circle},
    {tag::kObliquity, "obliquity", "deg", opaque, 0, 0, 0, circle},
    {tag::kSensorRollUniversal, "sensor roll", "deg", opaque, 0, 0, 0, circle},
});

}  // namespace

const TagInfo* infoOf(int number) {
    const auto found = std::lower_bound(kTags.begin(), kTags.end(), number,
                                        [](const TagInfo& info, int wanted) { return info.tag < wanted; });
    return found != kTags.end() && found->tag == number ? &*found : nullptr;
}

std::string nameOfTag(int number) {
    const TagInfo* info = infoOf(number);
    return info != nullptr ? info->name : "tag " + std::to_string(number);
}

std::optional<double> numberOf(const TagInfo& info, klv::Bytes value) {
    const bool length_fits =
        info.bytes > 0 ? value.size() == static_cast<std::size_t>(info.bytes) : !value.empty() && value.size() <= 8;
    if (!length_fits) return std::nullopt;
    const int bits = static_cast<int>(8 * value.size());
    switch (info.coding) {
        case unsigned_integer:
            return static_cast<double>(klv::unsignedOf(value)) * (info.high > 0 ? info.high : 1);
        case signed_integer:
            return static_cast<double>(klv::signedOf(value));
        case unsigned_range: {
            const double highest = static_cast<double>((std::uint64_t{1} << bits) - 1);
            return info.low + static_cast<double>(klv::unsignedOf(value)) * (info.high - info.low) / highest;
        }
        case signed_range: {
            const std::int64_t highest = (std::int64_t{1} << (bits - 1)) - 1;
            const std::int64_t code = klv::signedOf(value);
            if (code < -highest) return std::nullopt;
            return static_cast<double>(code) * info.high / static_cast<double>(highest);
        }
        case imapb:
            return klv::imapbOf(value, info.low, info.high);
        default:
            return std::nullopt;
    }
}

std::string textOf(klv::Bytes value) {
    std::string shown(value.begin(), value.end());
    std::erase_if(shown, [](char c) { return static_cast<unsigned char>(c) < 0x20 || c == 0x7F; });
    return shown;
}

}  // namespace eyrie
