#include "metadata/vmti/klv_packing.h"

#include <algorithm>
#include <cmath>

namespace eyrie::klv {

std::vector<std::uint8_t> unsignedBytes(std::uint64_t value, int count) {
    std::vector<std::uint8_t> bytes(static_cast<std::size_t>(count));
    for (auto byte = bytes.rbegin(); byte != bytes.rend(); ++byte, value >>= 8U)
        *byte = static_cast<std::uint8_t>(value & 0xFFU);
    return bytes;
}

std::vector<std::uint8_t> fewestBytes(std::uint64_t value) {
    int count = 1;
    while (count < 8 && value >> (8 * count) != 0) ++count;
    return unsignedBytes(value, count);
}

std::vector<std::uint8_t> imapbBytes(double value, double low, double high, int count) {
    const double inside = std::clamp(value, low, high);
    const double forward = std::ldexp(1.0, 8 * count - 1 - static_cast<int>(std::ceil(std::log2(high - low))));
    const double offset = low < 0 && high > 0 ? forward * low - std::floor(forward * low) : 0;
    return unsignedBytes(static_cast<std::uint64_t>(std::floor(forward * (inside - low) + offset)), count);
}

void ByteSink::putLength(std::uint64_t length) {
    const std::vector<std::uint8_t> number = fewestBytes(length);
    if (length >= 0x80) bytes_.push_back(static_cast<std::uint8_t>(0x80U | number.size()));
    put(number);
}

void ByteSink::putTag(std::uint32_t tag) {
    for (int group = 4; group > 0; --group) {
        const std::uint32_t rest = tag >> (7 * group);
        if (rest != 0) bytes_.push_back(static_cast<std::uint8_t>(0x80U | (rest & 0x7FU)));
    }
    bytes_.push_back(static_cast<std::uint8_t>(tag & 0x7FU));
}

void ByteSink::putItem(std::uint32_t tag, Bytes value) {
    putTag(tag);
    putMember(value);
}

void ByteSink::putItem(std::uint32_t tag, std::string_view text) {
    putItem(tag, Bytes(reinterpret_cast<const std::uint8_t*>(text.data()), text.size()));
}

void ByteSink::putMember(Bytes value) {
    putLength(value.size());
    put(value);
}

}  // namespace eyrie::klv
