#pragma once

#include <string_view>
#include <vector>

#include "metadata/klv_bytes.h"

/// Writing KLV: the counterpart of klv_bytes.h.
namespace eyrie::klv {

/// `value` in `count` bytes, 1 … 8, most significant first.
std::vector<std::uint8_t> unsignedBytes(std::uint64_t value, int count);
/// The same in as few bytes as hold it, one at least.
std::vector<std::uint8_t> fewestBytes(std::uint64_t value);
/// MISB ST 1201 IMAPB over [low, high] in `count` bytes; values outside are clamped.
std::vector<std::uint8_t> imapbBytes(double value, double low, double high, int count);

/// Bytes that grow: tags, lengths and values.
class ByteSink {
 public:
    const std::vector<std::uint8_t>& bytes() const { return bytes_; }
    void put(Bytes bytes) { bytes_.insert(bytes_.end(), bytes.begin(), bytes.end()); }
    /// A BER length: short form below 128, else the shortest long form.
    void putLength(std::uint64_t length);
    /// A BER-OID number.
    void putTag(std::uint32_t tag);
    /// Tag, length, value.
    void putItem(std::uint32_t tag, Bytes value);
    void putItem(std::uint32_t tag, std::string_view text);
    /// Length and value, as series hold their members.
    void putMember(Bytes value);

 private:
    std::vector<std::uint8_t> bytes_;
};

}  // namespace eyrie::klv
