#include "io/live/live_recording.h"

#include <algorithm>
#include <cstdlib>

#include "core/error.h"

namespace eyrie {
namespace {

constexpr AVRational kLiveMicrosecond{1, 1'000'000};
constexpr std::int64_t kLiveOrigin_us = 1'000'000;  ///< room for stamps before the first picture
constexpr std::int64_t kClockJump_us = 10'000'000;  ///< the clock of the sender was set
constexpr std::int64_t kHeldBack_us = 200'000;      ///< how long a packet may wait for those of a silent track

}  // namespace

LiveRecording::LiveRecording(std::filesystem::path path) : path_(std::move(path)) {}

LiveRecording::~LiveRecording() {
    try {
        finish();
    } catch (const std::exception&) {
        // finish() is there for those who want to know
    }
}

void LiveRecording::fail(int reason) const {
    throw Error(ErrorKind::output, path_.string() + ": the recording cannot be written (" + libav::errorText(reason) +
                                       "); check that its folder may be written and that the disk has space");
}

void LiveRecording::open(const AVFormatContext& demuxer, int video) {
    const AVCodecID pictures = demuxer.streams[video]->codecpar->codec_id;
    if (!libav::fitsTransportStream(pictures))
        throw Error(ErrorKind::input, path_.string() +
                                          ": the recording is a transport stream, which cannot carry the "
                                          "source's codec (" +
                                          avcodec_get_name(pictures) + "); let the source send H.264 or HEVC");
    AVFormatContext* raw = nullptr;
    const std::string url = "file:" + path_.string();
    if (const int made = avformat_alloc_output_context2(&raw, nullptr, "mpegts", url.c_str()); made < 0) fail(made);
    libav::Muxer muxer(raw);
    muxer->flags |= AVFMT_FLAG_FLUSH_PACKETS;
    muxer->max_interleave_delta = kHeldBack_us;
    for (unsigned i = 0; i < demuxer.nb_streams; ++i) {
        const AVCodecParameters& codec = *demuxer.streams[i]->codecpar;
        if (codec.codec_id == AV_CODEC_ID_NONE) continue;
        AVStream* track = avformat_new_stream(raw, nullptr);
        avcodec_parameters_copy(track->codecpar, &codec);
        track->codecpar->codec_tag = 0;
        track->time_base = {1, 90000};
        places_[i] = track->index;
    }
    if (const int opened = avio_open(&raw->pb, url.c_str(), AVIO_FLAG_WRITE); opened < 0) fail(opened);
    AVDictionary* options = nullptr;
    av_dict_set(&options, "mpegts_copyts", "1", 0);
    const int begun = avformat_write_header(raw, &options);
    av_dict_free(&options);
    if (begun < 0) fail(begun);
    muxer_ = std::move(muxer);
}

void LiveRecording::begin(const AVFormatContext& demuxer, int video) {
    places_.assign(demuxer.nb_streams, -1);
    video_ = video;
    waits_for_key_ = true;
    shift_us_.reset();
    if (!muxer_) return open(demuxer, video);
    std::vector<bool> taken(muxer_->nb_streams);
    for (unsigned i = 0; i < demuxer.nb_streams; ++i) {
        for (unsigned k = 0; k < muxer_->nb_streams && places_[i] < 0; ++k) {
            if (taken[k] || muxer_->streams[k]->codecpar->codec_id != demuxer.streams[i]->codecpar->codec_id) continue;
            taken[k] = true;
            places_[i] = static_cast<int>(k);
        }
    }
}

void LiveRecording::shift(AVPacket& packet, AVRational tick, std::int64_t gap_us) {
    const std::int64_t stamp = packet.dts != AV_NOPTS_VALUE ? packet.dts : packet.pts;
    if (stamp == AV_NOPTS_VALUE) {  // the clock goes on by what is usual
        packet.pts = packet.dts =
            av_rescale_q(last_us_ + usual_step_us_ - shift_us_.value_or(0), kLiveMicrosecond, tick);
    }
    const bool picture = packet.stream_index == video_;
    const std::int64_t now_us =
        av_rescale_q(packet.dts != AV_NOPTS_VALUE ? packet.dts : packet.pts, tick, kLiveMicrosecond);
    if (!shift_us_) {
        const bool begins = last_us_ == 0;
        shift_us_ = (begins ? kLiveOrigin_us : last_us_ + std::max(gap_us, usual_step_us_)) - now_us;
    } else if (picture) {
        const std::int64_t step = now_us + *shift_us_ - last_us_;
        if (step <= 0 || step > kClockJump_us) *shift_us_ += usual_step_us_ - step;
        if (step > 0 && step < kClockJump_us / 10) usual_step_us_ = step;
    }
    if (picture) last_us_ = now_us + *shift_us_;
    const std::int64_t ticks = av_rescale_q(*shift_us_, kLiveMicrosecond, tick);
    if (packet.pts != AV_NOPTS_VALUE) packet.pts += ticks;
    if (packet.dts != AV_NOPTS_VALUE) packet.dts += ticks;
}

bool LiveRecording::write(AVPacket& packet, const AVFormatContext& demuxer, std::int64_t gap_us) {
    const auto track = static_cast<std::size_t>(packet.stream_index);
    if (track >= places_.size() || places_[track] < 0) return false;
    const bool picture = packet.stream_index == video_;
    if (waits_for_key_ && !(picture && (packet.flags & AV_PKT_FLAG_KEY) != 0)) return false;
    waits_for_key_ = false;
    const AVStream& source = *demuxer.streams[packet.stream_index];
    shift(packet, source.time_base, gap_us);
    AVPacket* copy = av_packet_clone(&packet);
    if (copy == nullptr) fail(AVERROR(ENOMEM));
    const libav::Packet owner(copy);
    copy->stream_index = places_[track];
    copy->pos = -1;
    av_packet_rescale_ts(copy, source.time_base, muxer_->streams[copy->stream_index]->time_base);
    const int written = av_interleaved_write_frame(muxer_.get(), copy);
    // A packet of another track whose stamps go back is left out, as players would do.
    if (written < 0 && (picture || written != AVERROR(EINVAL))) fail(written);
    if (muxer_->pb->error < 0) fail(muxer_->pb->error);
    return true;
}

std::uint64_t LiveRecording::bytes() const {
    return muxer_ ? static_cast<std::uint64_t>(std::max<std::int64_t>(0, avio_tell(muxer_->pb))) : 0;
}

void LiveRecording::discard() {
    if (!muxer_) return;
    muxer_.reset();
    std::error_code left_behind;
    std::filesystem::remove(path_, left_behind);
}

void LiveRecording::finish() {
    if (!muxer_) return;
    int written = av_write_trailer(muxer_.get());
    if (const int closed = avio_closep(&muxer_->pb); written >= 0) written = closed;
    muxer_.reset();
    if (written < 0) fail(written);
}

}  // namespace eyrie
