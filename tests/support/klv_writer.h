#pragma once

#include <bit>
#include <cstdint>
#include <string>
#include <vector>

/// Sets of metadata as recorders write them, for tests; written from the standard and not from our reader.
namespace eyrie::test {

using KlvBytes = std::vector<std::uint8_t>;

inline KlvBytes bytesOfHex(const std::string& hex) {
    KlvBytes bytes;
    for (std::size_t i = 0; i + 1 < hex.size(); i += 2)
        bytes.push_back(static_cast<std::uint8_t>(std::stoi(hex.substr(i, 2), nullptr, 16)));
    return bytes;
}

inline KlvBytes bigEndian(std::uint64_t value, int count) {
    KlvBytes bytes;
    for (int i = count - 1; i >= 0; --i) bytes.push_back(static_cast<std::uint8_t>(value >> (8 * i)));
    return bytes;
}

inline void append(KlvBytes& to, const KlvBytes& bytes) {
    to.insert(to.end(), bytes.begin(), bytes.end());
}

inline const KlvBytes& localSetKey() {
    static const KlvBytes key = bytesOfHex("060e2b34020b01010e01030101000000");
    return key;
}

/// An ST 0601 local set that is filled item by item.
class LocalSetWriter {
 public:
    LocalSetWriter& item(int tag, const KlvBytes& value) {
        if (tag >= 128) value_.push_back(static_cast<std::uint8_t>(0x80 | (tag >> 7)));
        value_.push_back(static_cast<std::uint8_t>(tag & 0x7F));
        if (value.size() >= 128) value_.push_back(0x81);
        value_.push_back(static_cast<std::uint8_t>(value.size()));
        append(value_, value);
        return *this;
    }
    LocalSetWriter& time(std::uint64_t utc_us) { return item(2, bigEndian(utc_us, 8)); }
    /// Degrees in [-limit, limit] as four bytes.
    LocalSetWriter& angle(int tag, double degrees, double limit) {
        const double code = degrees / limit * 2147483647.0;
        return item(
            tag,
            bigEndian(static_cast<std::uint32_t>(static_cast<std::int32_t>(code < 0 ? code - 0.5 : code + 0.5)), 4));
    }
    /// Of [low, high] as two bytes.
    LocalSetWriter& range(int tag, double value, double low, double high) {
        return item(tag, bigEndian(static_cast<std::uint64_t>((value - low) / (high - low) * 65535.0 + 0.5), 2));
    }
    /// The whole set, with its checksum.
    KlvBytes bytes() const {
        KlvBytes set = localSetKey();
        const std::size_t length = value_.size() + 4;
        if (length < 128) {
            set.push_back(static_cast<std::uint8_t>(length));
        } else {
            set.push_back(0x82);
            append(set, bigEndian(length, 2));
        }
        append(set, value_);
        set.push_back(1);
        set.push_back(2);
        std::uint32_t sum = 0;
        for (std::size_t i = 0; i < set.size(); ++i) sum += static_cast<std::uint32_t>(set[i]) << (i % 2 == 0 ? 8 : 0);
        append(set, bigEndian(sum & 0xFFFF, 2));
        return set;
    }
    /// The same without a checksum.
    KlvBytes bytesWithoutChecksum() const {
        KlvBytes set = localSetKey();
        set.push_back(0x82);
        append(set, bigEndian(value_.size(), 2));
        append(set, value_);
        return set;
    }

 private:
    KlvBytes value_;
};

/// A universal set of one 16-byte key and value after the other.
class UniversalSetWriter {
 public:
    UniversalSetWriter& item(const std::string& key_end, const KlvBytes& value) {
        append(value_, bytesOfHex("060e2b3401010101" + key_end));
        value_.push_back(static_cast<std::uint8_t>(value.size()));
        append(value_, value);
        return *this;
    }
    UniversalSetWriter& real(const std::string& key_end, double value) {
        return item(key_end, bigEndian(std::bit_cast<std::uint64_t>(value), 8));
    }
    UniversalSetWriter& single(const std::string& key_end, float value) {
        return item(key_end, bigEndian(std::bit_cast<std::uint32_t>(value), 4));
    }
    KlvBytes bytes() const {
        KlvBytes set = bytesOfHex("060e2b34020101010e0101020101000082");
        append(set, bigEndian(value_.size(), 2));
        append(set, value_);
        return set;
    }

 private:
    KlvBytes value_;
};

}  // namespace eyrie::test
