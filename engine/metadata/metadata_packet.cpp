#include "metadata/metadata_packet.h"

#include <algorithm>
#include <array>
#include <utility>

namespace eyrie {
namespace {

using Key = std::array<std::uint8_t, 16>;

constexpr Key kLocalSet{0x06, 0x0E, 0x2B, 0x34, 0x02, 0x0B, 0x01, 0x01, 0x0E, 0x01, 0x03, 0x01, 0x01, 0x00, 0x00, 0x00};
constexpr Key kUniversalSet{0x06, 0x0E, 0x2B, 0x34, 0x02, 0x01, 0x01, 0x01,
                            0x0E, 0x01, 0x01, 0x02, 0x01, 0x01, 0x00, 0x00};

/// Bytes 8 … 15 of an item's key in the universal set, and the tag that means the same (ST 0601.12, chapter 8). The
/// bytes before hold versions that differ between writers.
struct UniversalItem {
    std::uint64_t key;
    int tag;
};
constexpr auto kUniversalItems = std::to_array<UniversalItem>({
    {0x0702010101050000, tag::kTime},
    {0x0105050000000000, 3},
    {0x0701100106000000, tag::kPlatformHeading},
    {0x0701100105000000, tag::kPlatformPitch},
    {0x0701100104000000, tag::kPlatformRoll},
    {0x0101200100000000, 10},
    {0x0420010201010000, 11},
    {0x0701010100000000, 12},
    {0x0701020102040200, tag::kSensorLatitude},
    {0x0701020102060200, tag::kSensorLongitude},
    {0x0701020102020000, tag::kSensorAltitude},
    {0x0420020101080000, tag::kHorizontalView},
    {0x04200201010A0100, tag::kVerticalView},
    {0x0701080101000000, tag::kSlantRange},
    {0x0701090201000000, tag::kTargetWidth},
    {0x0701020103020000, tag::kCentreLatitude},
    {0x0701020103040000, tag::kCentreLongitude},
    {0x0701020103160000, tag::kCentreElevation},
    {0x0701020103070100, tag::kCorners},
    {0x07010201030B0100, tag::kCorners + 1},
    {0x0701020103080100, tag::kCorners + 2},
    {0x07010201030C0100, tag::kCorners + 3},
    {0x0701020103090100, tag::kCorners + 4},
    {0x07010201030D0100, tag::kCorners + 5},
    {0x07010201030A0100, tag::kCorners + 6},
    {0x07010201030E0100, tag::kCorners + 7},
    {0x0E01030302000000, 48},
    {0x0701100101000000, tag::kSensorRollUniversal},
    {0x0701100102000000, tag::kAngleToNorth},
    {0x0701100103000000, tag::kObliquity},
});

bool is(klv::Bytes key, const Key& wanted) {
    return std::equal(key.begin(), key.end(), wanted.begin(), wanted.end());
}

/// Takes an item over; of a tag that comes twice the last counts.
void take(int number, klv::Bytes value, std::optional<double> read, MetadataPacket& packet, SetRemarks& remarks) {
    const TagInfo* info = infoOf(number);
    remarks.tags.push_back(number);
    if (info != nullptr && info->coding == Coding::text) {
        if (!value.empty()) packet.texts.push_back({number, textOf(value)});
        return;
    }
    const bool is_number = info != nullptr && (read || info->coding != Coding::opaque);
    if (!is_number) return;
    if (!read) {
        remarks.unreadable.push_back(number);
        return;
    }
    if (number == tag::kTime) {
        packet.utc_us = static_cast<std::int64_t>(*read);
        return;
    }
    const auto at = std::lower_bound(packet.numbers.begin(), packet.numbers.end(), number,
                                     [](const MetadataPacket::Number& one, int wanted) { return one.tag < wanted; });
    if (at != packet.numbers.end() && at->tag == number) {
        at->value = *read;
    } else {
        packet.numbers.insert(at, {number, *read});
    }
}

constexpr double kLatestTime = 9e15;  ///< µs, in the year 2255; a double holds all whole numbers up to there

/// The number of an item, or nothing.
std::optional<double> readable(const TagInfo* info, klv::Bytes value) {
    if (info == nullptr) return std::nullopt;
    const auto number = numberOf(*info, value);
    if (number && info->tag == tag::kTime && *number > kLatestTime) return std::nullopt;
    return number;
}

std::optional<klv::Fault> readLocalSet(const klv::Set& set, MetadataPacket& packet, SetRemarks& remarks) {
    klv::ByteCursor cursor(set.value);
    const std::size_t head = set.whole.size() - set.value.size();
    while (cursor.left() > 0) {
        const auto number = cursor.takeTag();
        const auto length = number ? cursor.takeLength() : std::nullopt;
        const std::size_t begin = cursor.position();
        const auto value = length ? cursor.take(*length) : std::nullopt;
        if (!value) return klv::Fault::broken_items;
        if (*number == tag::kChecksum) {
            // The sum runs over everything before its own two bytes, which must be the last.
            if (value->size() != 2 || cursor.left() > 0) return klv::Fault::wrong_checksum;
            if (klv::checksumOf(set.whole.first(head + begin)) != klv::unsignedOf(*value))
                return klv::Fault::wrong_checksum;
            packet.has_checksum = true;
            continue;
        }
        if (*number > 1000) {  // the standard has none; a damaged set may have any, which are counted together
            remarks.tags.push_back(0);
            continue;
        }
        const int tag_number = static_cast<int>(*number);
        take(tag_number, *value, readable(infoOf(tag_number), *value), packet, remarks);
    }
    return std::nullopt;
}

std::optional<klv::Fault> readUniversalSet(const klv::Set& set, MetadataPacket& packet, SetRemarks& remarks) {
    klv::ByteCursor cursor(set.value);
    while (cursor.left() > 0) {
        const auto key = cursor.take(16);
        const auto length = key ? cursor.takeLength() : std::nullopt;
        const auto value = length ? cursor.take(*length) : std::nullopt;
        if (!value || klv::unsignedOf(key->first(4)) != 0x060E2B34) return klv::Fault::broken_items;
        const std::uint64_t name = klv::unsignedOf(key->last(8));
        const auto item = std::find_if(kUniversalItems.begin(), kUniversalItems.end(),
                                       [&](const UniversalItem& one) { return one.key == name; });
        if (item == kUniversalItems.end()) {
            remarks.tags.push_back(0);
            continue;
        }
        const TagInfo* info = infoOf(item->tag);
        const bool is_time = item->tag == tag::kTime;
        take(item->tag, *value, is_time ? readable(info, *value) : klv::floatOf(*value), packet, remarks);
    }
    return std::nullopt;
}

}  // namespace

SetKind kindOf(klv::Bytes key) {
    if (is(key, kLocalSet)) return SetKind::local;
    return is(key, kUniversalSet) ? SetKind::universal : SetKind::other;
}

std::optional<double> MetadataPacket::number(int wanted) const {
    const auto at = std::lower_bound(numbers.begin(), numbers.end(), wanted,
                                     [](const Number& one, int number) { return one.tag < number; });
    return at != numbers.end() && at->tag == wanted ? std::optional(at->value) : std::nullopt;
}

std::optional<klv::Fault> readSet(const klv::Set& set, MetadataPacket& packet, SetRemarks& remarks) {
    packet.kind = kindOf(set.key);
    switch (packet.kind) {
        case SetKind::local:
            return readLocalSet(set, packet, remarks);
        case SetKind::universal:
            return readUniversalSet(set, packet, remarks);
        case SetKind::other:
            break;
    }
    return std::nullopt;
}

}  // namespace eyrie
