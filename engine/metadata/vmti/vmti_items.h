#pragma once

#include <cstdint>

/// Numbers of ST 0903 for what is written; inside of this folder and for tests only.
namespace eyrie::vmti {

inline constexpr int kVersion = 5;  ///< ST 0903.5

namespace item {
inline constexpr std::uint32_t kChecksum = 1, kTime = 2, kSystem = 3, kVersionNumber = 4, kDetected = 5, kReported = 6,
                               kFrameNumber = 7, kWidth = 8, kHeight = 9, kTargets = 101;
}  // namespace item
namespace target_item {
inline constexpr std::uint32_t kCentre = 1, kTopLeft = 2, kBottomRight = 3, kConfidence = 5, kHistory = 6, kPlace = 17,
                               kRow = 19, kColumn = 20, kTracker = 104;
}  // namespace target_item
namespace tracker_item {
inline constexpr std::uint32_t kTrack = 1, kDetection = 2, kFirst = 3, kLast = 4, kVelocity = 10;
}  // namespace tracker_item

/// Ranges of IMAPB and the bytes they take.
struct Range {
    double low, high;
    int bytes;
};
inline constexpr Range kLatitude{-90, 90, 4}, kLongitude{-180, 180, 4}, kHeightRange{-900, 19000, 2},
    kSpeed{-900, 900, 2};

}  // namespace eyrie::vmti
