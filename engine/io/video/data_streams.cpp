#include "io/video/data_streams.h"

#include <algorithm>

#include "core/error.h"
#include "io/video/libav.h"
#include "io/video/video_decoder.h"

namespace eyrie {
namespace {

bool holdsData(const AVStream& stream) {
    switch (stream.codecpar->codec_type) {
        case AVMEDIA_TYPE_VIDEO:
        case AVMEDIA_TYPE_AUDIO:
        case AVMEDIA_TYPE_SUBTITLE:
        case AVMEDIA_TYPE_ATTACHMENT:
            return false;
        default:
            return true;
    }
}

/// In microseconds; what does not fit into them is no time.
std::int64_t microseconds(std::int64_t ticks, AVRational tick) {
    if (ticks == AV_NOPTS_VALUE) return kNoStamp;
    const std::int64_t stamp = av_rescale_q(ticks, tick, AVRational{1, 1'000'000});
    return stamp == INT64_MIN || stamp == INT64_MAX ? kNoStamp : stamp;
}

/// In the order of their numbers.
std::vector<DataStream> dataStreamsOf(const AVFormatContext& demuxer) {
    std::vector<DataStream> streams;
    for (unsigned number = 0; number < demuxer.nb_streams; ++number) {
        const AVStream& stream = *demuxer.streams[number];
        if (holdsData(stream))
            streams.push_back({static_cast<int>(number), stream.id, avcodec_get_name(stream.codecpar->codec_id)});
    }
    return streams;
}

/// Whether reading through the file can bring metadata: containers that name all their tracks at their beginning say
/// so.
bool mayHoldMetadata(const AVFormatContext& demuxer, const std::vector<DataStream>& streams) {
    return (demuxer.ctx_flags & AVFMTCTX_NOHEADER) != 0 ||
           std::any_of(streams.begin(), streams.end(), [](const DataStream& one) { return one.codec == "klv"; });
}

}  // namespace

std::vector<DataStream> readDataStreams(const std::filesystem::path& path,
                                        const std::function<void(const DataPacket&)>& visit,
                                        const IndexProgress& progress, const std::stop_token& stop) {
    const libav::Demuxer demuxer = openContainer(path);
    if (auto streams = dataStreamsOf(*demuxer); !mayHoldMetadata(*demuxer, streams)) return streams;
    const int video = av_find_best_stream(demuxer.get(), AVMEDIA_TYPE_VIDEO, -1, -1, nullptr, 0);
    const std::int64_t file_size = std::max<std::int64_t>(1, avio_size(demuxer->pb));
    const libav::Packet packet(av_packet_alloc());
    int pictures = 0;
    int told_percent = -1;
    while (readNext(path, *demuxer, *packet)) {
        if (stop.stop_requested())
            throw Error(ErrorKind::input, path.string() + ": stopped while reading its metadata");
        const AVStream& stream = *demuxer->streams[packet->stream_index];
        if (packet->stream_index == video) {
            ++pictures;
        } else if (holdsData(stream) && packet->size > 0) {
            visit({packet->stream_index, microseconds(packet->pts, stream.time_base), packet->pos, pictures,
                   std::span<const std::uint8_t>(packet->data, static_cast<std::size_t>(packet->size))});
        }
        av_packet_unref(packet.get());
        const auto percent =
            static_cast<int>(std::clamp<std::int64_t>(100 * avio_tell(demuxer->pb) / file_size, 0, 100));
        if (progress && percent > told_percent) {
            told_percent = percent;
            progress(percent / 100.0);
        }
    }
    // Tracks of a transport stream may begin in its midst, so they are listed last.
    return dataStreamsOf(*demuxer);
}

}  // namespace eyrie
