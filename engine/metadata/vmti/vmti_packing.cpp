#include <algorithm>

#include "metadata/vmti/klv_packing.h"
#include "metadata/vmti/vmti_items.h"
#include "metadata/vmti/vmti_set.h"

namespace eyrie::vmti {
namespace {

using klv::ByteSink;

void putRange(ByteSink& sink, double value, const Range& range) {
    sink.put(klv::imapbBytes(value, range.low, range.high, range.bytes));
}

/// ST 0903: column + (row − 1) · width, both from 1.
std::uint64_t pixelNumber(cv::Point pixel, cv::Size size) {
    const int column = std::clamp(pixel.x, 0, size.width - 1);
    const int row = std::clamp(pixel.y, 0, size.height - 1);
    return static_cast<std::uint64_t>(row) * static_cast<std::uint64_t>(size.width) +
           static_cast<std::uint64_t>(column) + 1;
}

std::vector<std::uint8_t> placeOf(const Target& target) {
    ByteSink pack;
    putRange(pack, target.place->latitude_deg, kLatitude);
    putRange(pack, target.place->longitude_deg, kLongitude);
    // A truncation pack: what is not known at its end is left out.
    if (target.ellipsoid_height_m) putRange(pack, *target.ellipsoid_height_m, kHeightRange);
    return pack.bytes();
}

std::vector<std::uint8_t> trackerOf(const Target& target) {
    ByteSink set;
    if (target.track) set.putItem(tracker_item::kTrack, *target.track);
    set.putItem(tracker_item::kDetection, klv::unsignedBytes(static_cast<std::uint64_t>(target.detection), 1));
    if (target.first_utc_us)
        set.putItem(tracker_item::kFirst, klv::unsignedBytes(static_cast<std::uint64_t>(*target.first_utc_us), 8));
    if (target.last_utc_us)
        set.putItem(tracker_item::kLast, klv::unsignedBytes(static_cast<std::uint64_t>(*target.last_utc_us), 8));
    if (target.velocity) {
        ByteSink velocity;
        putRange(velocity, target.velocity->east_m_s, kSpeed);
        putRange(velocity, target.velocity->north_m_s, kSpeed);
        putRange(velocity, 0, kSpeed);
        set.putItem(tracker_item::kVelocity, velocity.bytes());
    }
    return set.bytes();
}

std::vector<std::uint8_t> packOf(const Target& target, cv::Size size) {
    ByteSink pack;
    pack.putTag(target.id);
    pack.putItem(target_item::kCentre, klv::fewestBytes(pixelNumber(target.centre, size)));
    pack.putItem(target_item::kTopLeft, klv::fewestBytes(pixelNumber(target.top_left, size)));
    pack.putItem(target_item::kBottomRight, klv::fewestBytes(pixelNumber(target.bottom_right, size)));
    if (target.confidence_percent) {
        const auto percent = static_cast<std::uint64_t>(std::clamp(*target.confidence_percent, 0, 100));
        pack.putItem(target_item::kConfidence, klv::unsignedBytes(percent, 1));
    }
    if (target.seen_before) {
        const auto before = static_cast<std::uint64_t>(std::clamp(*target.seen_before, 0, 0xFFFF));
        pack.putItem(target_item::kHistory, klv::fewestBytes(before));
    }
    if (target.place) pack.putItem(target_item::kPlace, placeOf(target));
    const auto fromOne = [](int value, int count) {
        return klv::fewestBytes(static_cast<std::uint64_t>(std::clamp(value, 0, count - 1)) + 1);
    };
    pack.putItem(target_item::kRow, fromOne(target.centre.y, size.height));
    pack.putItem(target_item::kColumn, fromOne(target.centre.x, size.width));
    pack.putItem(target_item::kTracker, trackerOf(target));
    return pack.bytes();
}

}  // namespace

std::vector<std::uint8_t> packed(const Frame& frame) {
    ByteSink items;
    items.putItem(item::kTime, klv::unsignedBytes(static_cast<std::uint64_t>(frame.utc_us), 8));
    items.putItem(item::kSystem, frame.system);
    items.putItem(item::kVersionNumber, klv::unsignedBytes(kVersion, 2));
    items.putItem(item::kDetected, klv::fewestBytes(frame.targets.size()));
    items.putItem(item::kReported, klv::fewestBytes(frame.targets.size()));
    items.putItem(item::kFrameNumber, klv::fewestBytes(frame.number));
    items.putItem(item::kWidth, klv::fewestBytes(static_cast<std::uint64_t>(frame.size.width)));
    items.putItem(item::kHeight, klv::fewestBytes(static_cast<std::uint64_t>(frame.size.height)));
    if (!frame.targets.empty()) {
        ByteSink series;
        for (const Target& target : frame.targets) series.putMember(packOf(target, frame.size));
        items.putItem(item::kTargets, series.bytes());
    }
    constexpr std::size_t kSumItem = 4;  // tag, length and two bytes
    ByteSink set;
    set.put(kKey);
    set.putLength(items.bytes().size() + kSumItem);
    set.put(items.bytes());
    set.putTag(item::kChecksum);
    set.putLength(2);
    // Over all that lies before the sum itself, its tag and length too.
    set.put(klv::unsignedBytes(klv::checksumOf(set.bytes()), 2));
    return set.bytes();
}

}  // namespace eyrie::vmti
