#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <unordered_map>
#include <utility>

#include "io/video/libav.h"
#include "io/video/video_index.h"

namespace eyrie {

/// Opens a container read-only, local files only. Throws Error(input).
libav::Demuxer openContainer(const std::filesystem::path& path);

/// Reads the next packet of any stream; false at the end of the file, also where a recording was cut off. Throws
/// Error(input) where the disk or the net does not hand over what is there.
bool readNext(const std::filesystem::path& path, AVFormatContext& demuxer, AVPacket& packet);

/// Number of the video stream to read. Throws Error(input) when there is none.
int findVideoStream(const std::filesystem::path& path, AVFormatContext& demuxer);

/// Decodes the packets of an index from any packet on.
class VideoDecoder {
 public:
    /// `packets` of the index must be complete; `index` must outlive the decoder.
    VideoDecoder(std::filesystem::path path, const VideoIndex& index);

    /// Starts decoding at this packet. Throws Error(input) when the file no longer is what was indexed.
    void startAt(int packet);
    /// The next picture in the order of presentation, or nullptr at the end. Valid until the next call.
    const AVFrame* next();
    /// From the next packet on: pictures of which this says that nobody wants them are not decoded where no other is
    /// decoded by them, and do not come; others of them still do.
    void leaveOut(std::function<bool(int packet)> unwanted) { unwanted_ = std::move(unwanted); }
    /// Packet number of the picture that `next` returned last.
    int packetOf(const AVFrame& picture) const { return static_cast<int>(picture.pts); }
    /// Number of the next packet that goes into the decoder.
    int nextPacket() const { return next_packet_; }

 private:
    void open();
    bool seekNear(std::int64_t stamp, int packet);
    bool readUntil(int packet);
    int numberOf(const AVPacket& packet) const;
    bool readPacket();
    bool feed();

    std::filesystem::path path_;
    const VideoIndex& index_;
    std::unordered_map<std::uint64_t, int> numbers_;  ///< packet number by signature; -1 where it is not unique
    libav::Demuxer demuxer_;
    libav::Codec codec_;
    libav::Packet packet_;
    libav::Picture picture_;
    bool waiting_ = false;  ///< packet_ was read and not yet taken by the decoder
    bool drained_ = false;  ///< the decoder was told that the file has ended
    int next_packet_ = 0;
    std::function<bool(int packet)> unwanted_;
};

}  // namespace eyrie
