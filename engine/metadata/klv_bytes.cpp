#include "metadata/klv_bytes.h"

#include <bit>
#include <cmath>

namespace eyrie::klv {

std::optional<Bytes> ByteCursor::take(std::uint64_t count) {
    if (count > left()) return std::nullopt;
    const Bytes taken = bytes_.subspan(at_, static_cast<std::size_t>(count));
    at_ += static_cast<std::size_t>(count);
    return taken;
}

std::optional<std::uint64_t> ByteCursor::takeLength() {
    const auto first = take(1);
    if (!first) return std::nullopt;
    const std::uint8_t lead = (*first)[0];
    if (lead < 0x80) return lead;
    const unsigned count = lead & 0x7FU;
    if (count == 0 || count > 8) return std::nullopt;
    const auto bytes = take(count);
    return bytes ? std::optional(unsignedOf(*bytes)) : std::nullopt;
}

std::optional<std::uint32_t> ByteCursor::takeTag() {
    std::uint64_t tag = 0;
    for (int i = 0; i < 5; ++i) {
        const auto byte = take(1);
        if (!byte) return std::nullopt;
        tag = tag << 7 | ((*byte)[0] & 0x7FU);
        if (tag > UINT32_MAX) return std::nullopt;
        if ((*byte)[0] < 0x80) return static_cast<std::uint32_t>(tag);
    }
    return std::nullopt;
}

std::uint64_t unsignedOf(Bytes bytes) {
    std::uint64_t value = 0;
    for (const std::uint8_t byte : bytes) value = value << 8 | byte;
    return value;
}

std::int64_t signedOf(Bytes bytes) {
    std::uint64_t value = unsignedOf(bytes);
    if (!bytes.empty() && bytes.size() < 8 && (bytes[0] & 0x80) != 0) value |= ~std::uint64_t{0} << (8 * bytes.size());
    return std::bit_cast<std::int64_t>(value);
}

std::optional<double> floatOf(Bytes bytes) {
    double value = 0;
    if (bytes.size() == 8) {
        value = std::bit_cast<double>(unsignedOf(bytes));
    } else if (bytes.size() == 4) {
        value = static_cast<double>(std::bit_cast<float>(static_cast<std::uint32_t>(unsignedOf(bytes))));
    } else {
        return std::nullopt;
    }
    return std::isfinite(value) ? std::optional(value) : std::nullopt;
}

std::optional<double> imapbOf(Bytes bytes, double low, double high) {
    if (bytes.empty() || bytes.size() > 8) return std::nullopt;
    const std::uint64_t code = unsignedOf(bytes);
    const int bits = static_cast<int>(8 * bytes.size());
    // The highest bit alone is the top of the range; together with others it stands for infinities and the like.
    const std::uint64_t top = std::uint64_t{1} << (bits - 1);
    if (code > top) return std::nullopt;
    const int range_bits = static_cast<int>(std::ceil(std::log2(high - low)));
    const double forward = std::ldexp(1.0, bits - 1 - range_bits);
    const double offset = low < 0 && high > 0 ? forward * low - std::floor(forward * low) : 0;
    const double value = (static_cast<double>(code) - offset) / forward + low;
    return value >= low - 1e-9 && value <= high + 1e-9 ? std::optional(value) : std::nullopt;
}

std::uint16_t checksumOf(Bytes bytes) {
    std::uint32_t sum = 0;
    for (std::size_t i = 0; i < bytes.size(); ++i) sum += i % 2 == 0 ? bytes[i] * 256U : bytes[i];
    return static_cast<std::uint16_t>(sum);
}

}  // namespace eyrie::klv
