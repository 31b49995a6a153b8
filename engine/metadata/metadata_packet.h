#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "metadata/klv_splitter.h"
#include "metadata/metadata_tag.h"

namespace eyrie {

/// What kind of set a packet is.
enum class SetKind {
    local,      ///< MISB ST 0601, the UAS datalink local set
    universal,  ///< MISB EG 0104, its predecessor of 16-byte keys
    other       ///< known to be a set, but not read: moving targets, security …
};
SetKind kindOf(klv::Bytes key);

/// One set of metadata with the values that could be read.
struct MetadataPacket {
    struct Number {
        int tag = 0;
        double value = 0;
    };
    struct Text {
        int tag = 0;
        std::string value;
    };

    SetKind kind = SetKind::local;
    std::optional<std::int64_t> utc_us;  ///< µs since 1970-01-01, as the set states it
    std::int64_t stamp_us = 0;           ///< on the clock of the container; kNoStamp: none
    std::int64_t position = -1;          ///< byte in the file where the packet that holds it begins; -1: unknown
    int pictures_before = 0;             ///< packets of the video that lie before it in the file
    int part = 0;                        ///< of a video in parts: number of the file that holds it, from 0
    bool has_checksum = false;           ///< states a checksum, and it agrees
    std::vector<Number> numbers;         ///< ascending by tag
    std::vector<Text> texts;             ///< in the order of the set

    std::optional<double> number(int tag) const;
};

/// What was in a set beside its values.
struct SetRemarks {
    std::vector<int> tags;        ///< all that occur, in the order of the set
    std::vector<int> unreadable;  ///< those that say "no value", or whose length is wrong
};

/// Reads an ST 0601 local set or an EG 0104 universal set. Answers what is wrong with the whole of it, if anything;
/// then nothing of it is to be used. Single values that cannot be read are left out.
std::optional<klv::Fault> readSet(const klv::Set& set, MetadataPacket& packet, SetRemarks& remarks);

}  // namespace eyrie
