#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <stop_token>
#include <vector>

#include "io/video/frame_source.h"

namespace eyrie {

/// What a copied stream carries beside what was in it.
struct AddedPacket {
    std::int64_t stamp_us = 0;  ///< on the clock of the container, as PictureStamp has it; ascending
    std::vector<std::uint8_t> bytes;
};

/// Copies a video into an MPEG transport stream as it is, nothing decoded, and adds a track of KLV to it, whose packets
/// lie before the picture of their time. Packets are asked for one after the other; nothing: there are no more. What
/// was at `to` stays until all is there. Throws Error(input) for what cannot be read or cannot lie in a transport
/// stream, and "stopped while copying it" when `stop` was requested; Error(output) for what cannot be written.
void copyWithKlv(const std::filesystem::path& from, const std::function<std::optional<AddedPacket>()>& added,
                 const std::filesystem::path& to, const IndexProgress& progress = {}, const std::stop_token& stop = {});

}  // namespace eyrie
