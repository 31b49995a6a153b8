#pragma once

#include <cstdint>
#include <optional>
#include <span>

/// The numbers of SMPTE 336 (KLV) in bytes: most significant byte first.
namespace eyrie::klv {

using Bytes = std::span<const std::uint8_t>;

/// Reads along a run of bytes; never beyond its end.
class ByteCursor {
 public:
    explicit ByteCursor(Bytes bytes) : bytes_(bytes) {}

    std::size_t left() const { return bytes_.size() - at_; }
    std::size_t position() const { return at_; }
    /// The next `count` bytes; nothing where fewer are left.
    std::optional<Bytes> take(std::uint64_t count);
    /// A BER length, short or long form; nothing where it is cut off, indefinite or longer than eight bytes.
    std::optional<std::uint64_t> takeLength();
    /// A BER-OID number (seven bits a byte, the last without its highest bit); nothing beyond 32 bits.
    std::optional<std::uint32_t> takeTag();

 private:
    Bytes bytes_;
    std::size_t at_ = 0;
};

/// 1 … 8 bytes as a number without sign.
std::uint64_t unsignedOf(Bytes bytes);
/// 1 … 8 bytes as a number in two's complement.
std::int64_t signedOf(Bytes bytes);
/// Four or eight bytes as IEEE 754; nothing for other lengths and for what is not finite.
std::optional<double> floatOf(Bytes bytes);
/// 1 … 8 bytes as MISB ST 1201 IMAPB over [low, high]; nothing for its special values.
std::optional<double> imapbOf(Bytes bytes, double low, double high);
/// The running 16-bit sum of MISB ST 0601 over these bytes.
std::uint16_t checksumOf(Bytes bytes);

}  // namespace eyrie::klv
