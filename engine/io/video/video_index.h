#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <opencv2/core/types.hpp>
#include <optional>
#include <stop_token>
#include <string>
#include <vector>

#include "core/values/ids.h"
#include "io/video/frame_source.h"

namespace eyrie {

/// A coded picture as it lies in the file. Its number is its place in file (decoding) order.
struct PacketRecord {
    std::int64_t pts = 0;       ///< presentation stamp in ticks; kNoStamp where the file has none
    std::int64_t dts = 0;       ///< decoding stamp in ticks; kNoStamp where the file has none
    std::int64_t position = 0;  ///< byte in the file, -1 if unknown
    std::int32_t size = 0;      ///< bytes
    bool key = false;           ///< decoding may start here
};

class VideoDecoder;

/// Where every frame of a video lies and when it is shown.
///
/// Frames are identified by the number of their packet, which travels through the decoder with the picture. Seeking can
/// then be checked instead of trusted; FFMS2 as Debian 12 ships it returns shifted frames for open groups of pictures
/// (usual in MPEG-2 and H.265) and decoding instead of presentation stamps for transport streams.
struct VideoIndex {
    std::int32_t stream = 0;          ///< number of the video stream in its container
    std::int64_t tick_numerator = 1;  ///< one tick lasts numerator / denominator seconds
    std::int64_t tick_denominator = 1;
    cv::Size coded_size;             ///< px, before turning
    std::int32_t quarter_turns = 0;  ///< clockwise turns that put the picture upright, 0 … 3
    double nominal_rate_hz = 0;      ///< what the container says; 0: nothing
    std::string codec;
    std::string container;
    std::optional<std::int64_t> created_utc_us;  ///< VideoInfo::created_utc_us
    std::vector<PacketRecord> packets;           ///< in file order
    std::vector<std::int32_t> shown;             ///< packet number of each frame, in the order of presentation
    std::vector<std::int64_t> shown_ticks;       ///< presentation time of each frame from the first, strictly ascending

    /// Packet that decoding the whole video starts from: the first key frame, or 0 in a video without any.
    int firstStart() const;
    /// Frame of each packet; -1 for packets that never show.
    std::vector<FrameIndex> framesOfPackets() const;
};

/// Reads through a video once. Frames that cannot be decoded at its ends (a recording that starts or stops amid a group
/// of pictures, a truncated file) are left out. Streams whose stamps do not tell the order of presentation (none at
/// all, duplicates, jumps, field pictures) are decoded once to learn it. Answers with the decoder that it needed, so
/// that the video need not be opened again; `index` must outlive it. Throws Error(input).
std::unique_ptr<VideoDecoder> buildVideoIndex(const std::filesystem::path& path, VideoIndex& index,
                                              const IndexProgress& progress, std::stop_token stop);

}  // namespace eyrie
