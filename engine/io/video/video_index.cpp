#include "io/video/video_index.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <unordered_set>

#include "core/error.h"
#include "core/time/utc_time.h"
#include "io/video/video_decoder.h"

namespace eyrie {

namespace {

/// Pictures that a decoder may hold back to bring others first; H.264 and H.265 allow 16 frames.
constexpr int kDeepestReordering = 40;
/// Frames a second; more is a clock's rate, not a camera's.
constexpr double kHighestRate = 1000;

class Progress {
 public:
    Progress(const IndexProgress& report, std::stop_token stop) : report_(report), stop_(std::move(stop)) {}

    /// Throws when a stop was requested; reports every full per cent.
    void at(const std::filesystem::path& path, double share) {
        if (stop_.stop_requested()) throw Error(ErrorKind::input, path.string() + ": stopped while indexing");
        const int percent = static_cast<int>(std::clamp(share, 0.0, 1.0) * 100);
        if (!report_ || percent <= last_percent_) return;
        last_percent_ = percent;
        report_(percent / 100.0);
    }

 private:
    const IndexProgress& report_;
    std::stop_token stop_;
    int last_percent_ = -1;
};

int quarterTurns(const AVStream& stream) {
    const std::uint8_t* data = av_stream_get_side_data(&stream, AV_PKT_DATA_DISPLAYMATRIX, nullptr);
    if (data == nullptr) return 0;
    std::int32_t matrix[9];
    std::copy_n(data, sizeof matrix, reinterpret_cast<std::uint8_t*>(matrix));
    const double counterclockwise_degrees = av_display_rotation_get(matrix);
    if (std::isnan(counterclockwise_degrees)) return 0;
    const int turns = static_cast<int>(std::lround(-counterclockwise_degrees / 90.0)) % 4;
    return (turns + 4) % 4;
}

/// When a file was begun, as it says; nothing where a clock was never set: those begin in 1904, 1970 or 1980.
std::optional<std::int64_t> creationTimeOf(const AVFormatContext& container, const AVStream& stream) {
    constexpr std::int64_t kFirstBelieved_us = 347'155'200'000'000;  // 1981-01-01
    for (const AVDictionary* tags : {container.metadata, stream.metadata}) {
        const AVDictionaryEntry* tag = av_dict_get(tags, "creation_time", nullptr, 0);
        const auto created_us = tag != nullptr ? utcOf(tag->value) : std::nullopt;
        if (created_us && *created_us >= kFirstBelieved_us) return created_us;
    }
    return std::nullopt;
}

/// Codecs whose every packet shows exactly once and whose stamps are those of its picture.
bool showsEveryPacket(AVCodecID codec) {
    switch (codec) {
        case AV_CODEC_ID_H264:
        case AV_CODEC_ID_HEVC:
        case AV_CODEC_ID_MPEG1VIDEO:
        case AV_CODEC_ID_MPEG2VIDEO:
        case AV_CODEC_ID_VP9:
        case AV_CODEC_ID_AV1:
            return true;
        default: {
            const AVCodecDescriptor* descriptor = avcodec_descriptor_get(codec);
            return descriptor != nullptr && (descriptor->props & AV_CODEC_PROP_INTRA_ONLY) != 0;
        }
    }
}

/// Whether a field may be a packet of its own.
bool mayHoldFields(const AVCodecParameters& parameters) {
    const bool interlaced =
        parameters.field_order != AV_FIELD_PROGRESSIVE && parameters.field_order != AV_FIELD_UNKNOWN;
    return interlaced && (parameters.codec_id == AV_CODEC_ID_H264 || parameters.codec_id == AV_CODEC_ID_HEVC);
}

struct Scan {
    explicit Scan(VideoIndex& to_fill) : index(to_fill) {}
    VideoIndex& index;
    std::vector<bool> discarded;  ///< packets that an edit list hides
    bool order_is_known = true;
};

Scan scanPackets(const std::filesystem::path& path, VideoIndex& index, Progress& progress) {
    const libav::Demuxer demuxer = openContainer(path);
    Scan scan(index);
    index.stream = findVideoStream(path, *demuxer);
    AVStream& stream = *demuxer->streams[index.stream];
    for (unsigned other = 0; other < demuxer->nb_streams; ++other)
        if (static_cast<int>(other) != index.stream) demuxer->streams[other]->discard = AVDISCARD_ALL;
    index.tick_numerator = stream.time_base.num;
    index.tick_denominator = stream.time_base.den;
    index.quarter_turns = quarterTurns(stream);
    const AVRational rate = av_guess_frame_rate(demuxer.get(), &stream, nullptr);
    const double rate_hz = rate.num > 0 && rate.den > 0 ? av_q2d(rate) : 0;
    index.nominal_rate_hz = rate_hz < kHighestRate ? rate_hz : 0;
    index.codec = avcodec_get_name(stream.codecpar->codec_id);
    index.container = demuxer->iformat->name;
    index.created_utc_us = creationTimeOf(*demuxer, stream);
    scan.order_is_known = showsEveryPacket(stream.codecpar->codec_id) && !mayHoldFields(*stream.codecpar);

    const std::int64_t file_size = std::max<std::int64_t>(1, avio_size(demuxer->pb));
    const libav::Packet packet(av_packet_alloc());
    while (readNext(path, *demuxer, *packet)) {
        if (packet->stream_index == index.stream) {
            index.packets.push_back(
                {packet->pts, packet->dts, packet->pos, packet->size, (packet->flags & AV_PKT_FLAG_KEY) != 0});
            scan.discarded.push_back((packet->flags & AV_PKT_FLAG_DISCARD) != 0);
            if (packet->pts == kNoStamp) scan.order_is_known = false;
        }
        progress.at(path, 0.99 * static_cast<double>(avio_tell(demuxer->pb)) / static_cast<double>(file_size));
        av_packet_unref(packet.get());
    }
    if (index.packets.empty())
        throw Error(
            ErrorKind::input,
            path.string() + ": the video track holds no pictures; the file may be cut off: copy or record it again");
    // A recording that begins amid a group of pictures: what comes before its first key frame cannot be decoded
    // rightly.
    const int start = index.firstStart();
    std::fill_n(scan.discarded.begin(), start, true);
    return scan;
}

/// Sorts by presentation stamp; false where the stamps cannot be right.
bool orderByStamps(Scan& scan) {
    VideoIndex& index = scan.index;
    index.shown.clear();
    for (std::size_t number = 0; number < index.packets.size(); ++number)
        if (!scan.discarded[number]) index.shown.push_back(static_cast<std::int32_t>(number));
    std::vector<std::int32_t> file_order = index.shown;
    const auto stamp = [&](std::int32_t number) { return index.packets[static_cast<std::size_t>(number)].pts; };
    std::stable_sort(index.shown.begin(), index.shown.end(), [&](auto a, auto b) { return stamp(a) < stamp(b); });
    for (std::size_t i = 0; i < index.shown.size(); ++i) {
        if (i > 0 && stamp(index.shown[i]) == stamp(index.shown[i - 1])) return false;
        if (std::abs(index.shown[i] - file_order[i]) > kDeepestReordering) return false;
    }
    return true;
}

void orderByDecoding(const std::filesystem::path& path, VideoIndex& index, VideoDecoder& decoder, Progress& progress) {
    std::vector<std::int32_t> shown;
    std::unordered_set<std::int32_t> seen;
    decoder.startAt(index.firstStart());
    while (const AVFrame* picture = decoder.next()) {
        const int packet = decoder.packetOf(*picture);
        if (seen.insert(packet).second) shown.push_back(packet);
        progress.at(path, static_cast<double>(decoder.nextPacket()) / static_cast<double>(index.packets.size()));
    }
    index.shown = std::move(shown);
}

/// Leaves out the frames before the first and behind the last one that the decoder delivers.
void trimToDecodable(VideoIndex& index, VideoDecoder& decoder) {
    std::vector<FrameIndex> frame_of = index.framesOfPackets();
    decoder.startAt(index.firstStart());
    const AVFrame* picture = decoder.next();
    while (picture != nullptr && frame_of[static_cast<std::size_t>(decoder.packetOf(*picture))] < 0)
        picture = decoder.next();
    if (picture == nullptr) {
        index.shown.clear();
        return;
    }
    const FrameIndex first = frame_of[static_cast<std::size_t>(decoder.packetOf(*picture))];

    FrameIndex last = -1;
    for (int start = static_cast<int>(index.packets.size()) - 1; start >= 0 && last < 0; --start) {
        const auto number = static_cast<std::size_t>(start);
        if (!index.packets[number].key || frame_of[number] < 0) continue;
        decoder.startAt(start);
        while (const AVFrame* decoded = decoder.next())
            last = std::max(last, frame_of[static_cast<std::size_t>(decoder.packetOf(*decoded))]);
    }
    if (last >= 0) index.shown.resize(static_cast<std::size_t>(last) + 1);
    index.shown.erase(index.shown.begin(),
                      index.shown.begin() + std::min<std::ptrdiff_t>(first, std::ssize(index.shown)));
}

/// Presentation times: the stamps where they rise; where they are missing or step back, the frame before goes on.
void placeInTime(VideoIndex& index) {
    const auto stamp = [&](std::size_t i) { return index.packets[static_cast<std::size_t>(index.shown[i])].pts; };
    std::vector<std::int64_t> steps;
    for (std::size_t i = 1; i < index.shown.size(); ++i)
        if (stamp(i) != kNoStamp && stamp(i - 1) != kNoStamp && stamp(i) > stamp(i - 1))
            steps.push_back(stamp(i) - stamp(i - 1));
    const double ticks_per_second =
        static_cast<double>(index.tick_denominator) / static_cast<double>(index.tick_numerator);
    double usual_step = ticks_per_second / (index.nominal_rate_hz > 0 ? index.nominal_rate_hz : 25.0);
    if (!steps.empty() && steps.size() * 2 >= index.shown.size()) {
        std::nth_element(steps.begin(), steps.begin() + std::ssize(steps) / 2, steps.end());
        usual_step = static_cast<double>(steps[steps.size() / 2]);
    }

    index.shown_ticks.assign(index.shown.size(), 0);
    double exact = 0;
    for (std::size_t i = 1; i < index.shown.size(); ++i) {
        const bool rises = stamp(i) != kNoStamp && stamp(i - 1) != kNoStamp && stamp(i) > stamp(i - 1);
        exact += rises ? static_cast<double>(stamp(i) - stamp(i - 1)) : usual_step;
        index.shown_ticks[i] = std::max(index.shown_ticks[i - 1] + 1, static_cast<std::int64_t>(std::llround(exact)));
    }
}

cv::Size firstPictureSize(const VideoIndex& index, VideoDecoder& decoder) {
    decoder.startAt(index.firstStart());
    const AVFrame* picture = decoder.next();
    return picture == nullptr ? cv::Size() : cv::Size(picture->width, picture->height);
}

}  // namespace

int VideoIndex::firstStart() const {
    const auto key =
        std::find_if(packets.begin(), packets.end(), [](const PacketRecord& packet) { return packet.key; });
    return key == packets.end() ? 0 : static_cast<int>(key - packets.begin());
}

std::vector<FrameIndex> VideoIndex::framesOfPackets() const {
    std::vector<FrameIndex> frames(packets.size(), -1);
    for (std::size_t frame = 0; frame < shown.size(); ++frame)
        frames[static_cast<std::size_t>(shown[frame])] = static_cast<FrameIndex>(frame);
    return frames;
}

std::unique_ptr<VideoDecoder> buildVideoIndex(const std::filesystem::path& path, VideoIndex& index,
                                              const IndexProgress& report, std::stop_token stop) {
    Progress progress(report, stop);
    progress.at(path, 0);
    Scan scan = scanPackets(path, index, progress);
    auto decoder = std::make_unique<VideoDecoder>(path, index);
    if (scan.order_is_known && orderByStamps(scan)) {
        trimToDecodable(index, *decoder);
    } else {
        Progress decoding(report, stop);
        orderByDecoding(path, index, *decoder, decoding);
    }
    if (!index.shown.empty()) index.coded_size = firstPictureSize(index, *decoder);
    if (index.coded_size.empty())
        throw Error(ErrorKind::input,
                    path.string() +
                        ": no picture of the video can be decoded; the file may be damaged or cut off: copy or "
                        "record it again");
    placeInTime(index);
    progress.at(path, 1);
    return decoder;
}

}  // namespace eyrie
