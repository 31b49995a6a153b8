#pragma once

#include <vector>

#include "metadata/metadata_recording.h"
#include "support/klv_writer.h"

namespace eyrie::test {

/// A packet as a container brings it.
struct Carried {
    KlvBytes bytes;
    std::int64_t stamp_us = kNoStamp;
    int pictures_before = 0;
};

inline MetadataStream collected(const std::vector<Carried>& packets) {
    MetadataCollector collector({1, 0x101, "klv"});
    std::int64_t position = 0;
    for (const Carried& packet : packets) {
        collector.feed({1, packet.stamp_us, position, packet.pictures_before, packet.bytes});
        position += static_cast<std::int64_t>(packet.bytes.size());
    }
    return collector.finish();
}

inline int faultsOf(const MetadataStream& stream, klv::Fault fault) {
    return stream.faults[static_cast<std::size_t>(fault)];
}

}  // namespace eyrie::test
