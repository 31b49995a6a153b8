#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <stop_token>
#include <vector>

#include "io/video/frame_source.h"

namespace eyrie {

/// What a copied stream carries beside what was in it.
struct AddedPacket {
    std::int64_t stamp_us = 0;  ///< on the clock of the container, as PictureStamp has it; ascending
    std::vector<std::uint8_t> bytes;
};

/// Takes what is to be added, one after the other.
using TakePacket = std::function<void(const AddedPacket&)>;

/// Copies a video into an MPEG transport stream as it is, nothing decoded, and adds a track of KLV to it, whose packets
/// lie before the picture of their time. `add` is called once and hands all packets over; the video is copied
/// meanwhile, so that none need be held. What was at `to` stays until all is there. Throws Error(input) for what cannot
/// be read or cannot lie in a transport stream, and "stopped while copying it" when `stop` was requested; Error(output)
/// for what cannot be written.
void copyWithKlv(const std::filesystem::path& from, const std::function<void(const TakePacket&)>& add,
                 const std::filesystem::path& to, const IndexProgress& progress = {}, const std::stop_token& stop = {});

}  // namespace eyrie
