#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "metadata/klv_bytes.h"

namespace eyrie {

/// Tags of MISB ST 0601 that Eyrie works with. Values of the older universal set bear the number of the tag that means
/// the same; what has none is numbered from 1001.
namespace tag {
inline constexpr int kChecksum = 1;
inline constexpr int kTime = 2;
inline constexpr int kPlatformHeading = 5;
inline constexpr int kPlatformPitch = 6;
inline constexpr int kPlatformRoll = 7;
inline constexpr int kSensorLatitude = 13;
inline constexpr int kSensorLongitude = 14;
inline constexpr int kSensorAltitude = 15;
inline constexpr int kHorizontalView = 16;
inline constexpr int kVerticalView = 17;
inline constexpr int kSensorAzimuth = 18;
inline constexpr int kSensorElevation = 19;
inline constexpr int kSensorRoll = 20;
inline constexpr int kSlantRange = 21;
inline constexpr int kTargetWidth = 22;
inline constexpr int kCentreLatitude = 23;
inline constexpr int kCentreLongitude = 24;
inline constexpr int kCentreElevation = 25;
inline constexpr int kCornerOffsets = 26;  ///< latitude and longitude of the corners 1 … 4 in turn: eight tags
inline constexpr int kSensorEllipsoidHeight = 75;
inline constexpr int kCentreEllipsoidHeight = 78;
inline constexpr int kCorners = 82;  ///< as kCornerOffsets
inline constexpr int kPlatformPitchFull = 90;
inline constexpr int kPlatformRollFull = 91;
inline constexpr int kTargetWidthExtended = 96;
inline constexpr int kSensorEllipsoidHeightExtended = 104;
inline constexpr int kAngleToNorth = 1001;
inline constexpr int kObliquity = 1002;
inline constexpr int kSensorRollUniversal = 1003;
}  // namespace tag

/// How a value goes over from one packet to the next.
enum class Blend {
    linear,
    circle,  ///< degrees; over the shorter way
    none     ///< flags and counts hold until the next
};

/// How the bytes of a tag are to be read.
enum class Coding {
    unsigned_integer,  ///< as it is, times `high` where that is not 0
    signed_integer,
    unsigned_range,  ///< all codes over [low, high]
    signed_range,    ///< [-high, high]; the lowest code says "out of range"
    imapb,           ///< MISB ST 1201 over [low, high]
    text,
    opaque  ///< sets and packs within, not looked into
};

/// A row of the tables of ST 0601.
struct TagInfo {
    int tag = 0;
    const char* name = "";  ///< "platform heading"
    const char* unit = "";  ///< "deg", "m" …; empty: none
    Coding coding = Coding::opaque;
    int bytes = 0;  ///< what it must have; 0: any from one to eight
    double low = 0, high = 0;
    Blend blend = Blend::linear;
};

/// What is known of a tag; nothing for the others.
const TagInfo* infoOf(int tag);
/// "platform heading", "tag 300".
std::string nameOfTag(int tag);
/// The value of a tag that holds a number; nothing where it says that there is none, or where its length is wrong.
std::optional<double> numberOf(const TagInfo& info, klv::Bytes value);
/// Text as it can be shown: without control characters.
std::string textOf(klv::Bytes value);

}  // namespace eyrie
