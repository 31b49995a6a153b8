#include "metadata/klv_splitter.h"

#include <algorithm>

namespace eyrie::klv {
namespace {

constexpr std::array<std::uint8_t, 4> kPrefix{0x06, 0x0E, 0x2B, 0x34};
constexpr std::uint8_t kGroup = 0x02;  ///< the fifth byte of a key: sets and packs, not single items
constexpr std::size_t kKeyBytes = 16;
constexpr std::size_t kCellHeaderBytes = 5;
constexpr std::uint64_t kLongestSet = 1U << 18;  ///< bytes; known sets have some thousand
constexpr std::uint64_t kReadAgain = 4;          ///< times the stream's bytes that faults may cost

/// Where the next key of a set begins, or may begin with the last bytes; the end where none does.
std::size_t findKey(Bytes bytes, std::size_t from) {
    for (std::size_t at = from; at < bytes.size(); ++at) {
        const std::size_t left = std::min(kPrefix.size(), bytes.size() - at);
        if (!std::equal(kPrefix.begin(), kPrefix.begin() + static_cast<std::ptrdiff_t>(left),
                        bytes.begin() + static_cast<std::ptrdiff_t>(at)))
            continue;
        if (at + 4 >= bytes.size() || bytes[at + 4] == kGroup) return at;
    }
    return bytes.size();
}

/// Bytes that the length after a key takes; one where it cannot be one.
std::size_t lengthBytes(Bytes from_key) {
    if (from_key.size() <= kKeyBytes) return 1;
    const std::size_t lead = from_key[kKeyBytes];
    return lead > 0x80 && lead <= 0x88 ? 1 + (lead & 0x7FU) : 1;
}

bool beginsWithKey(Bytes packet) {
    const std::size_t at = findKey(packet, 0);
    return (at == 0 || at == kCellHeaderBytes) && at + kKeyBytes <= packet.size();
}

}  // namespace

const char* nameOf(Fault fault) {
    switch (fault) {
        case Fault::foreign_bytes:
            return "bytes that belong to no set";
        case Fault::cut_off:
            return "cut off";
        case Fault::bad_length:
            return "impossible length";
        case Fault::wrong_checksum:
            return "checksum differs";
        case Fault::broken_items:
            return "items do not fit the set";
    }
    return "";
}

void Splitter::skip(Bytes bytes) {
    if (bytes.empty()) return;
    // A cell header: service, sequence, flags with four reserved bits, length of what follows.
    const bool is_header = bytes.size() == kCellHeaderBytes && (bytes[2] & 0x0F) == 0x0F;
    if (!is_header) count(Fault::foreign_bytes);
}

void Splitter::split(bool at_end, const Visitor& visit) {
    const Bytes bytes(held_);
    std::size_t at = 0;
    std::size_t told = 0;  // bytes before are accounted for
    while (true) {
        const std::size_t key = findKey(bytes, at);
        at = key;
        if (key == bytes.size() || (bytes.size() - key <= kKeyBytes && !at_end)) break;
        skip(bytes.subspan(told, key - told));
        told = key;
        ByteCursor cursor(bytes.subspan(key));
        const auto name = cursor.take(kKeyBytes);
        const bool length_is_whole = cursor.left() >= lengthBytes(bytes.subspan(key));
        const auto length = cursor.takeLength();
        const bool length_is_bad = length_is_whole && (!length || *length > kLongestSet);
        const auto value = length && !length_is_bad ? cursor.take(*length) : std::nullopt;
        if (!name || !value) {
            if (!length_is_bad && !at_end) break;
            count(length_is_bad ? Fault::bad_length : Fault::cut_off);
            // What follows the damaged head up to the next key goes with it.
            told = at = findKey(bytes, key + kPrefix.size());
            continue;
        }
        const Set set{bytes.subspan(key, cursor.position()), *name, *value};
        const std::size_t end = key + cursor.position();
        if (const auto fault = visit(set)) {
            count(*fault);
            // Sets within sets within sets, each at fault, would be read over and over.
            wasted_ += set.whole.size();
            const bool look_within = wasted_ <= kLongestSet + kReadAgain * fed_;
            told = at = look_within ? std::min(findKey(bytes, key + kPrefix.size()), end) : end;
        } else {
            told = at = end;
        }
    }
    if (at_end) {
        skip(bytes.subspan(told));
        held_.clear();
        return;
    }
    // Foreign bytes need not wait for a key; a header of a cell stands in the packet of its set.
    if (at == bytes.size()) skip(bytes.subspan(told));
    const std::size_t keep_from = at == bytes.size() ? at : told;
    held_.erase(held_.begin(), held_.begin() + static_cast<std::ptrdiff_t>(keep_from));
}

void Splitter::feed(Bytes packet, const Visitor& visit) {
    if (!held_.empty() && beginsWithKey(packet)) split(true, visit);
    feedPiece(packet, visit);
}

void Splitter::feedPiece(Bytes piece, const Visitor& visit) {
    held_.insert(held_.end(), piece.begin(), piece.end());
    fed_ += piece.size();
    split(false, visit);
}

void Splitter::finish(const Visitor& visit) {
    split(true, visit);
}

}  // namespace eyrie::klv
