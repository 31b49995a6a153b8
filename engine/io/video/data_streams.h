#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <span>
#include <stop_token>
#include <string>
#include <vector>

#include "io/video/frame_source.h"
#include "io/video/video_index.h"

namespace eyrie {

/// A track of a container that holds neither pictures nor sound nor subtitles.
struct DataStream {
    int number = 0;     ///< its place among all tracks of the container, from 0
    int id = 0;         ///< what the container calls it: the PID of a transport stream
    std::string codec;  ///< "klv", "bin_data", "none" …
};

/// A packet of such a track, as it comes in the file.
struct DataPacket {
    int stream = 0;                       ///< DataStream::number
    std::int64_t stamp_us = 0;            ///< presentation stamp on the clock of the container, µs; kNoStamp: has none
    std::int64_t position = -1;           ///< byte in the file, -1 if unknown
    int pictures_before = 0;              ///< packets of the video track that lie before it, numbered as in VideoIndex
    std::span<const std::uint8_t> bytes;  ///< valid during the visit
};

/// Reads through a file once and shows every packet of its data tracks, in file order; nothing is decoded. A damaged
/// file is read as far as it goes; one of a container that names its tracks at its beginning, none of them KLV, is not
/// read. Answers the data tracks. Throws Error(input) for a file that is no container, and "stopped while reading its
/// metadata" when `stop` was requested.
std::vector<DataStream> readDataStreams(const std::filesystem::path& path,
                                        const std::function<void(const DataPacket&)>& visit,
                                        const IndexProgress& progress = {}, const std::stop_token& stop = {});

}  // namespace eyrie
