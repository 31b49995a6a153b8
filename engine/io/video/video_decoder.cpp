#include "io/video/video_decoder.h"

#include <algorithm>
#include <mutex>

#include "core/error.h"

namespace eyrie {

namespace {

/// Packets to look at after a seek before giving it up; more than any demuxer drops to find its feet.
constexpr int kPacketsToRecognise = 500;
/// Whatever the machine: how damaged pictures come out depends on it, and so would results.
constexpr int kDecodingThreads = 2;

std::uint64_t signature(std::int64_t pts, std::int64_t position, std::int32_t size) {
    const auto place = static_cast<std::uint64_t>(pts != kNoStamp ? pts : position);
    return place * 0x9E3779B97F4A7C15ULL ^ static_cast<std::uint64_t>(size) * 0xC2B2AE3D27D4EB4FULL;
}

bool identifiable(std::int64_t pts, std::int64_t position) {
    return pts != kNoStamp || position >= 0;
}

/// Codecs that say of a picture, for certain, whether any other is decoded by it; in H.265 it depends on the layers.
bool marksUnreferenced(AVCodecID codec) {
    return codec == AV_CODEC_ID_H264 || codec == AV_CODEC_ID_MPEG1VIDEO || codec == AV_CODEC_ID_MPEG2VIDEO;
}

void quietLibraries() {
    static std::once_flag once;
    std::call_once(once, [] { av_log_set_level(AV_LOG_QUIET); });
}

}  // namespace

libav::Demuxer openContainer(const std::filesystem::path& path) {
    static_assert(kNoStamp == AV_NOPTS_VALUE);
    quietLibraries();
    AVDictionary* options = nullptr;
    av_dict_set(&options, "protocol_whitelist", "file", 0);
    AVFormatContext* raw = nullptr;
    const std::string url = "file:" + path.string();
    const int opened = avformat_open_input(&raw, url.c_str(), nullptr, &options);
    av_dict_free(&options);
    libav::Demuxer demuxer(raw);
    // The teletype demuxer takes any text for a video.
    if (opened < 0 || std::string(demuxer->iformat->name) == "tty")
        throw Error(ErrorKind::input,
                    path.string() + ": not a video that can be read (" +
                        (opened < 0 ? libav::errorText(opened) : "it is text") +
                        "); if it was copied or recorded, it may be cut off: repair or copy it again");
    if (const int found = avformat_find_stream_info(demuxer.get(), nullptr); found < 0)
        throw Error(ErrorKind::input, path.string() + ": the streams of this file cannot be read (" +
                                          libav::errorText(found) +
                                          "); it may be damaged: repair, copy or record it again");
    return demuxer;
}

bool readNext(const std::filesystem::path& path, AVFormatContext& demuxer, AVPacket& packet) {
    if (av_read_frame(&demuxer, &packet) >= 0) return true;
    if (demuxer.pb != nullptr && demuxer.pb->error < 0)
        throw Error(ErrorKind::input, path.string() + ": cannot be read to its end (" +
                                          libav::errorText(demuxer.pb->error) +
                                          "); check the disk or the net that it lies on");
    return false;
}

int findVideoStream(const std::filesystem::path& path, AVFormatContext& demuxer) {
    const int stream = av_find_best_stream(&demuxer, AVMEDIA_TYPE_VIDEO, -1, -1, nullptr, 0);
    if (stream < 0 || (demuxer.streams[stream]->disposition & AV_DISPOSITION_ATTACHED_PIC))
        throw Error(ErrorKind::input,
                    path.string() + ": the file has no video track; choose a video or an image folder");
    return stream;
}

VideoDecoder::VideoDecoder(std::filesystem::path path, const VideoIndex& index)
    : path_(std::move(path)), index_(index), packet_(av_packet_alloc()), picture_(av_frame_alloc()) {
    numbers_.reserve(index.packets.size());
    for (std::size_t number = 0; number < index.packets.size(); ++number) {
        const PacketRecord& record = index.packets[number];
        if (!identifiable(record.pts, record.position)) continue;
        const auto [place, is_new] =
            numbers_.try_emplace(signature(record.pts, record.position, record.size), static_cast<int>(number));
        if (!is_new) place->second = -1;
    }
    open();
}

void VideoDecoder::open() {
    demuxer_ = openContainer(path_);
    const auto stream = static_cast<unsigned>(index_.stream);
    if (stream >= demuxer_->nb_streams)
        throw Error(ErrorKind::input, path_.string() + ": the file has changed since it was opened; open it again");
    for (unsigned other = 0; other < demuxer_->nb_streams; ++other)
        if (other != stream) demuxer_->streams[other]->discard = AVDISCARD_ALL;

    const AVCodecParameters& parameters = *demuxer_->streams[stream]->codecpar;
    const AVCodec* decoder = avcodec_find_decoder(parameters.codec_id);
    if (decoder == nullptr)
        throw Error(ErrorKind::input, path_.string() + ": there is no decoder for its codec (" +
                                          avcodec_get_name(parameters.codec_id) + "); convert the video to H.264");
    codec_.reset(avcodec_alloc_context3(decoder));
    avcodec_parameters_to_context(codec_.get(), &parameters);
    codec_->thread_count = kDecodingThreads;
    if (const int opened = avcodec_open2(codec_.get(), decoder, nullptr); opened < 0)
        throw Error(ErrorKind::input, path_.string() + ": the decoder cannot be started (" + libav::errorText(opened) +
                                          "); convert the video to H.264");
    waiting_ = false;
    drained_ = false;
    next_packet_ = 0;
}

int VideoDecoder::numberOf(const AVPacket& packet) const {
    if (!identifiable(packet.pts, packet.pos)) return -1;
    const auto found = numbers_.find(signature(packet.pts, packet.pos, packet.size));
    return found == numbers_.end() ? -1 : found->second;
}

bool VideoDecoder::readPacket() {
    while (true) {
        av_packet_unref(packet_.get());
        if (!readNext(path_, *demuxer_, *packet_)) return false;
        if (packet_->stream_index == index_.stream) return true;
    }
}

bool VideoDecoder::readUntil(int packet) {
    int number = -1;
    for (int tries = 0; number < 0; ++tries) {
        if (tries == kPacketsToRecognise || !readPacket()) return false;
        number = numberOf(*packet_);
    }
    while (number < packet) {
        if (!readPacket()) return false;
        ++number;
        const int recognised = numberOf(*packet_);
        if (recognised >= 0 && recognised != number) return false;
    }
    return number == packet;
}

bool VideoDecoder::seekNear(std::int64_t stamp, int packet) {
    if (av_seek_frame(demuxer_.get(), index_.stream, stamp, AVSEEK_FLAG_BACKWARD) < 0) return false;
    return readUntil(packet);
}

void VideoDecoder::startAt(int packet) {
    avcodec_flush_buffers(codec_.get());
    drained_ = false;
    const PacketRecord& record = index_.packets.at(static_cast<std::size_t>(packet));
    const std::int64_t stamp = record.dts != kNoStamp ? record.dts : record.pts;
    bool there = false;
    if (stamp != kNoStamp) {
        // Demuxers search by stamps of their own making; when they land too far on, aim earlier.
        const std::int64_t second = std::max<std::int64_t>(1, index_.tick_denominator / index_.tick_numerator);
        for (const int seconds_earlier : {0, 1, 5}) {
            there = seekNear(stamp - seconds_earlier * second, packet);
            if (there) break;
        }
    }
    if (!there) {
        open();
        for (int number = 0; number <= packet; ++number)
            if (!readPacket())
                throw Error(ErrorKind::input, path_.string() + ": the file has become shorter; open it again");
    }
    waiting_ = true;
    next_packet_ = packet;
}

bool VideoDecoder::feed() {
    if (!waiting_) {
        if (drained_) return false;
        if (!readPacket() || next_packet_ >= static_cast<int>(index_.packets.size())) {
            drained_ = true;
            avcodec_send_packet(codec_.get(), nullptr);
            return true;
        }
        waiting_ = true;
    }
    const bool left_out = unwanted_ && marksUnreferenced(codec_->codec_id) && unwanted_(next_packet_);
    codec_->skip_frame = left_out ? AVDISCARD_NONREF : AVDISCARD_DEFAULT;
    // The packet's number travels in place of its stamp and comes out with the picture.
    packet_->pts = next_packet_;
    packet_->dts = AV_NOPTS_VALUE;
    if (avcodec_send_packet(codec_.get(), packet_.get()) == AVERROR(EAGAIN)) return true;
    // A packet that the decoder refuses is damaged: its picture will be missing, the others may be fine.
    waiting_ = false;
    ++next_packet_;
    return true;
}

const AVFrame* VideoDecoder::next() {
    int damaged_in_a_row = 0;
    while (true) {
        const int received = avcodec_receive_frame(codec_.get(), picture_.get());
        if (received == 0) {
            const bool ours = picture_->pts >= 0 && picture_->pts < static_cast<std::int64_t>(index_.packets.size());
            if (ours) return picture_.get();
            continue;
        }
        if (received == AVERROR_EOF) return nullptr;
        if (received != AVERROR(EAGAIN) && ++damaged_in_a_row < kPacketsToRecognise) continue;
        if (!feed()) return nullptr;
    }
}

}  // namespace eyrie
