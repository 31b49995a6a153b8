#pragma once

#include <algorithm>
#include <optional>

#include "metadata/klv_splitter.h"
#include "metadata/metadata_tag.h"
#include "metadata/vmti/vmti_items.h"
#include "metadata/vmti/vmti_set.h"

/// Reads the sets that the engine writes, item by item.
namespace eyrie::vmti {
namespace reading {

using klv::ByteCursor;
using klv::Bytes;

/// Hands every item of a local set on; answers whether they add up to it.
template <class Take>
bool eachItem(ByteCursor cursor, Take&& take) {
    while (cursor.left() > 0) {
        const auto tag = cursor.takeTag();
        const auto length = tag ? cursor.takeLength() : std::nullopt;
        const auto value = length ? cursor.take(*length) : std::nullopt;
        if (!value) return false;
        take(*tag, *value);
    }
    return true;
}

/// A number without sign of at most `most` bytes.
inline std::optional<std::uint64_t> numberIn(Bytes value, std::size_t most) {
    if (value.empty() || value.size() > most) return std::nullopt;
    return klv::unsignedOf(value);
}

inline std::optional<std::int64_t> timeIn(Bytes value) {
    if (value.size() != 8 || value[0] >= 0x80) return std::nullopt;
    return static_cast<std::int64_t>(klv::unsignedOf(value));
}

inline std::optional<double> rangeIn(ByteCursor& cursor, const Range& range) {
    const auto bytes = cursor.take(static_cast<std::uint64_t>(range.bytes));
    return bytes ? klv::imapbOf(*bytes, range.low, range.high) : std::nullopt;
}

inline void readPlace(Bytes value, Target& target) {
    ByteCursor cursor(value);
    const auto latitude = rangeIn(cursor, kLatitude);
    const auto longitude = rangeIn(cursor, kLongitude);
    if (!latitude || !longitude) return;
    target.place = GeoPoint{*latitude, *longitude};
    if (cursor.left() > 0) target.ellipsoid_height_m = rangeIn(cursor, kHeightRange);
}

inline bool readTracker(Bytes value, Target& target) {
    return eachItem(ByteCursor(value), [&](std::uint32_t tag, Bytes bytes) {
        if (tag == tracker_item::kTrack && bytes.size() == 16) {
            target.track.emplace();
            std::copy(bytes.begin(), bytes.end(), target.track->begin());
        } else if (tag == tracker_item::kDetection && bytes.size() == 1 && bytes[0] <= 3) {
            target.detection = static_cast<Detection>(bytes[0]);
        } else if (tag == tracker_item::kFirst) {
            target.first_utc_us = timeIn(bytes);
        } else if (tag == tracker_item::kLast) {
            target.last_utc_us = timeIn(bytes);
        } else if (tag == tracker_item::kVelocity) {
            ByteCursor cursor(bytes);
            const auto east = rangeIn(cursor, kSpeed);
            const auto north = rangeIn(cursor, kSpeed);
            if (east && north) target.velocity = Target::Velocity{*east, *north};
        }
    });
}

/// The pixel of a pixel number; nothing outside the frame.
inline std::optional<cv::Point> pixelIn(Bytes value, cv::Size size) {
    const auto number = numberIn(value, 6);
    const auto count = static_cast<std::uint64_t>(size.width) * static_cast<std::uint64_t>(size.height);
    if (!number || *number < 1 || *number > count) return std::nullopt;
    const auto width = static_cast<std::uint64_t>(size.width);
    return cv::Point(static_cast<int>((*number - 1) % width), static_cast<int>((*number - 1) / width));
}

inline std::optional<Target> readTarget(Bytes pack, cv::Size size) {
    ByteCursor cursor(pack);
    const auto id = cursor.takeTag();
    if (!id) return std::nullopt;
    Target target;
    target.id = *id;
    std::optional<cv::Point> centre, top_left, bottom_right;
    bool good = true;
    const bool whole = eachItem(cursor, [&](std::uint32_t tag, Bytes value) {
        if (tag == target_item::kCentre) centre = pixelIn(value, size);
        if (tag == target_item::kTopLeft) top_left = pixelIn(value, size);
        if (tag == target_item::kBottomRight) bottom_right = pixelIn(value, size);
        if (tag == target_item::kPlace) readPlace(value, target);
        if (tag == target_item::kTracker) good = good && readTracker(value, target);
        const auto number = numberIn(value, 2);
        if (tag == target_item::kConfidence && number && *number <= 100)
            target.confidence_percent = static_cast<int>(*number);
        if (tag == target_item::kHistory && number) target.seen_before = static_cast<int>(*number);
    });
    if (!whole || !good || !centre) return std::nullopt;
    target.centre = *centre;
    target.top_left = top_left.value_or(*centre);
    target.bottom_right = bottom_right.value_or(*centre);
    return target;
}

/// Whether the checksum is the last item and agrees.
inline bool sumAgrees(const klv::Set& set) {
    constexpr std::size_t kSum = 2;
    if (set.value.size() < kSum + 2) return false;
    const Bytes end = set.value.last(kSum + 2);
    if (end[0] != item::kChecksum || end[1] != kSum) return false;
    return klv::checksumOf(set.whole.first(set.whole.size() - kSum)) == klv::unsignedOf(end.last(kSum));
}

}  // namespace reading

inline bool isKey(klv::Bytes key) {
    return std::equal(key.begin(), key.end(), kKey.begin(), kKey.end());
}

/// Answers what is wrong with the whole of a set, if anything; then nothing of it is to be used. Targets that cannot be
/// read are left out and counted.
inline std::optional<klv::Fault> read(const klv::Set& set, Frame& frame, int& unreadable) {
    using namespace reading;
    frame = {};
    if (!sumAgrees(set)) return klv::Fault::wrong_checksum;
    std::optional<Bytes> series;
    std::optional<std::int64_t> time;
    const bool whole = eachItem(ByteCursor(set.value), [&](std::uint32_t tag, Bytes value) {
        const auto number = numberIn(value, 3);
        if (tag == item::kTime) time = timeIn(value);
        if (tag == item::kSystem) frame.system = textOf(value);
        if (tag == item::kFrameNumber && number) frame.number = static_cast<std::uint32_t>(*number);
        if (tag == item::kWidth && number) frame.size.width = static_cast<int>(*number);
        if (tag == item::kHeight && number) frame.size.height = static_cast<int>(*number);
        if (tag == item::kTargets) series = value;
    });
    if (!whole || !time) return klv::Fault::broken_items;
    frame.utc_us = *time;
    if (!series) return std::nullopt;
    ByteCursor cursor(*series);
    while (cursor.left() > 0) {
        const auto length = cursor.takeLength();
        const auto pack = length ? cursor.take(*length) : std::nullopt;
        if (!pack) return klv::Fault::broken_items;
        auto target = readTarget(*pack, frame.size);
        if (target) {
            frame.targets.push_back(std::move(*target));
        } else {
            ++unreadable;
        }
    }
    return std::nullopt;
}

}  // namespace eyrie::vmti
