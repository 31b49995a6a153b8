#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <vector>

#include "metadata/klv_bytes.h"

namespace eyrie::klv {

/// Why bytes of a stream could not be read as a set.
enum class Fault {
    foreign_bytes,   ///< bytes between two sets that belong to none
    cut_off,         ///< a set that ends before its length says
    bad_length,      ///< a length that is none, or beyond all reason
    wrong_checksum,  ///< the sum over the set is not the one it states
    broken_items,    ///< the items within do not add up to the set
};
inline constexpr std::size_t kFaultCount = 5;
/// For people: "checksum differs".
const char* nameOf(Fault fault);

/// How often each fault occurred.
using FaultCounts = std::array<int, kFaultCount>;

/// A set or pack as it lies in the stream.
struct Set {
    Bytes whole;  ///< from its key to its last byte
    Bytes key;    ///< 16 bytes
    Bytes value;
};

/// Finds sets in a stream that comes packet by packet. A set may go on in the next packet; what is no set is skipped
/// and counted. Headers of access unit cells (synchronous carriage, ISO/IEC 13818-1) are passed over.
class Splitter {
 public:
    /// Answers what is wrong with a set, if anything; then sets within it are looked for, because its length cannot be
    /// trusted.
    using Visitor = std::function<std::optional<Fault>(const Set&)>;

    /// What begins with a key ends whatever was left open.
    void feed(Bytes packet, const Visitor& visit);
    /// A piece of a stream without packets, cut anywhere.
    void feedPiece(Bytes piece, const Visitor& visit);
    /// The stream has ended.
    void finish(const Visitor& visit);
    const FaultCounts& faults() const { return faults_; }

 private:
    void split(bool at_end, const Visitor& visit);
    void count(Fault fault) { ++faults_[static_cast<std::size_t>(fault)]; }
    void skip(Bytes bytes);

    std::vector<std::uint8_t> held_;
    FaultCounts faults_{};
    std::uint64_t fed_ = 0;     ///< bytes of the stream
    std::uint64_t wasted_ = 0;  ///< bytes of sets at fault, which are read again for what lies within
};

}  // namespace eyrie::klv
