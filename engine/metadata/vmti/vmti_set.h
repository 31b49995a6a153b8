#pragma once

#include <array>
#include <cstdint>
#include <opencv2/core/types.hpp>
#include <optional>
#include <string>
#include <vector>

#include "core/geometry/local_plane.h"
#include "metadata/klv_splitter.h"

/// MISB ST 0903 VMTI local sets, as packets of their own: what moves in a frame. The items that Eyrie writes are those
/// it reads; others are passed over.
namespace eyrie::vmti {

/// ST 0903, VTracker: what is known of a target just then.
enum class Detection { inactive, active, dropped, stopped };

/// A target pack. Pixels are columns and rows from 0 here; pixel numbers count from 1, row by row, in the bytes.
struct Target {
    struct Velocity {
        double east_m_s = 0, north_m_s = 0;
    };
    std::uint32_t id = 0;
    cv::Point centre, top_left, bottom_right;
    std::optional<int> confidence_percent;
    std::optional<int> seen_before;  ///< how often the target was detected before
    std::optional<GeoPoint> place;
    std::optional<double> ellipsoid_height_m;  ///< of the place
    // Of its track:
    std::optional<std::array<std::uint8_t, 16>> track;  ///< a UUID: the same for all of it
    Detection detection = Detection::active;
    std::optional<std::int64_t> first_utc_us, last_utc_us;
    std::optional<Velocity> velocity;
};

/// A local set: a frame.
struct Frame {
    std::int64_t utc_us = 0;
    std::uint32_t number = 0;
    cv::Size size;
    std::string system;  ///< what found them
    std::vector<Target> targets;
};

/// Every set begins with it.
inline constexpr std::array<std::uint8_t, 16> kKey{0x06, 0x0E, 0x2B, 0x34, 0x02, 0x0B, 0x01, 0x01,
                                                   0x0E, 0x01, 0x03, 0x03, 0x06, 0x00, 0x00, 0x00};
/// Key, length, value, with the checksum as its last item.
std::vector<std::uint8_t> packed(const Frame& frame);

}  // namespace eyrie::vmti
