#include "io/video/stream_copy.h"

#include <algorithm>
#include <cstring>

#include "core/error.h"
#include "io/atomic_file.h"
#include "io/video/libav.h"
#include "io/video/video_decoder.h"

namespace eyrie {
namespace {

constexpr AVRational kMicrosecond{1, 1'000'000};
constexpr int kFirstFreePid = 0x100;
constexpr int kMostPid = 0x1FFA;

/// A transport stream that is being written beside its place.
class StreamCopy {
 public:
    StreamCopy(const std::filesystem::path& from, const std::filesystem::path& to)
        : from_(from), to_(throughLinks(to)), demuxer_(openContainer(from)) {
        removeAbandonedParts(to_);
        part_ = temporaryBeside(to_);
        AVFormatContext* raw = nullptr;
        const std::string url = "file:" + part_.string();
        const int made = avformat_alloc_output_context2(&raw, nullptr, "mpegts", url.c_str());
        if (made < 0) failToWrite(made);
        muxer_.reset(raw);
        takeStreams();
        if (const int opened = avio_open(&muxer_->pb, url.c_str(), AVIO_FLAG_WRITE); opened < 0) failToWrite(opened);
        AVDictionary* options = nullptr;
        // Stamps as they are, where they can be: what else refers to them stays right.
        const bool stream = std::strcmp(demuxer_->iformat->name, "mpegts") == 0;
        if (stream) av_dict_set(&options, "mpegts_copyts", "1", 0);
        const int begun = avformat_write_header(muxer_.get(), &options);
        av_dict_free(&options);
        if (begun < 0)
            throw Error(ErrorKind::input, from_.string() + ": cannot be copied into a transport stream (" +
                                              libav::errorText(begun) +
                                              "); its codec must be one that these carry, such as H.264");
    }
    ~StreamCopy() {
        muxer_.reset();
        std::error_code ignored;
        if (!done_) std::filesystem::remove(part_, ignored);
    }
    StreamCopy(const StreamCopy&) = delete;
    StreamCopy& operator=(const StreamCopy&) = delete;

    /// The next packet of the original, copied; nothing at its end.
    bool next() {
        while (readNext(from_, *demuxer_, *packet_)) {
            // Tracks of a transport stream may begin in its midst: those cannot be copied any more.
            const auto track = static_cast<std::size_t>(packet_->stream_index);
            if (track < places_.size() && places_[track] >= 0) return true;
            av_packet_unref(packet_.get());
        }
        return false;
    }
    /// When it is decoded, µs; kNoStamp where it has no stamp or is no picture.
    std::int64_t pictureStamp() const {
        const AVStream& stream = *demuxer_->streams[packet_->stream_index];
        const std::int64_t ticks = packet_->dts != AV_NOPTS_VALUE ? packet_->dts : packet_->pts;
        if (stream.codecpar->codec_type != AVMEDIA_TYPE_VIDEO || ticks == AV_NOPTS_VALUE) return kNoStamp;
        return av_rescale_q(ticks, stream.time_base, kMicrosecond);
    }
    void copy() {
        const AVStream& source = *demuxer_->streams[packet_->stream_index];
        const bool picture = packet_->stream_index == video_;
        packet_->stream_index = places_[static_cast<std::size_t>(packet_->stream_index)];
        const AVStream& target = *muxer_->streams[packet_->stream_index];
        av_packet_rescale_ts(packet_.get(), source.time_base, target.time_base);
        packet_->pos = -1;
        write(*packet_, picture);
    }
    void add(const AddedPacket& added) {
        const libav::Packet packet(av_packet_alloc());
        if (av_new_packet(packet.get(), static_cast<int>(added.bytes.size())) < 0) failToWrite(AVERROR(ENOMEM));
        std::copy(added.bytes.begin(), added.bytes.end(), packet->data);
        packet->stream_index = klv_->index;
        packet->pts = packet->dts = av_rescale_q(added.stamp_us, kMicrosecond, klv_->time_base);
        write(*packet, false);
    }
    double share() const {
        const auto size = static_cast<double>(std::max<std::int64_t>(1, avio_size(demuxer_->pb)));
        return std::clamp(static_cast<double>(avio_tell(demuxer_->pb)) / size, 0.0, 1.0);
    }
    void finish() {
        int written = av_write_trailer(muxer_.get());
        if (written >= 0) written = avio_closep(&muxer_->pb);
        if (written < 0) failToWrite(written);
        std::error_code failure;
        std::filesystem::rename(part_, to_, failure);
        if (failure) throw Error(ErrorKind::output, to_.string() + ": cannot be replaced (" + failure.message() + ")");
        done_ = true;
    }

 private:
    [[noreturn]] void failToWrite(int reason) const {
        throw Error(ErrorKind::output, to_.string() + ": cannot be written (" + libav::errorText(reason) +
                                           "); choose another place, the disk may be full");
    }

    void takeStreams() {
        int free_pid = kFirstFreePid;
        video_ = findVideoStream(from_, *demuxer_);
        if (const AVCodecID codec = demuxer_->streams[video_]->codecpar->codec_id; !libav::fitsTransportStream(codec))
            throw Error(ErrorKind::input, from_.string() + ": a transport stream cannot carry its codec (" +
                                              avcodec_get_name(codec) +
                                              "); convert the video to H.264, and make the run over that");
        for (unsigned i = 0; i < demuxer_->nb_streams; ++i) {
            const AVStream& source = *demuxer_->streams[i];
            if (source.codecpar->codec_id == AV_CODEC_ID_NONE ||
                source.codecpar->codec_type == AVMEDIA_TYPE_ATTACHMENT ||
                (source.disposition & AV_DISPOSITION_ATTACHED_PIC) != 0) {
                places_.push_back(-1);
                continue;
            }
            AVStream* target = avformat_new_stream(muxer_.get(), nullptr);
            avcodec_parameters_copy(target->codecpar, source.codecpar);
            target->codecpar->codec_tag = 0;
            target->time_base = source.time_base;
            if (source.id >= kFirstFreePid && source.id < kMostPid) target->id = source.id;
            free_pid = std::max(free_pid, target->id + 1);
            av_dict_copy(&target->metadata, source.metadata, 0);
            places_.push_back(target->index);
        }
        klv_ = avformat_new_stream(muxer_.get(), nullptr);
        klv_->codecpar->codec_type = AVMEDIA_TYPE_DATA;
        klv_->codecpar->codec_id = AV_CODEC_ID_SMPTE_KLV;
        klv_->time_base = {1, 90000};
        if (free_pid > kFirstFreePid) klv_->id = free_pid;
    }

    /// Takes the packet's bytes.
    void write(AVPacket& packet, bool picture) {
        const int written = av_interleaved_write_frame(muxer_.get(), &packet);
        if (written >= 0) return;
        if (written != AVERROR(EINVAL)) failToWrite(written);
        // Without it the copy's frames would have other numbers than those of the original.
        if (picture)
            throw Error(ErrorKind::input, from_.string() +
                                              ": a picture cannot be copied, since its stamps are missing or go back; "
                                              "convert the video, and make the run over that");
        av_packet_unref(&packet);  // stamps that go back: this packet is left out, as players would do
    }

    std::filesystem::path from_, to_, part_;
    libav::Demuxer demuxer_;
    libav::Muxer muxer_;
    libav::Packet packet_{av_packet_alloc()};
    AVStream* klv_ = nullptr;
    int video_ = -1;           ///< track of the original whose pictures are the frames
    std::vector<int> places_;  ///< where each track of the original lies in the copy; −1: nowhere
    bool done_ = false;
};

/// How far a copy is, and whether it is to go on.
class CopyWatch {
 public:
    CopyWatch(const std::filesystem::path& from, const IndexProgress& progress, const std::stop_token& stop)
        : from_(from), progress_(progress), stop_(stop) {}
    void goOn() const {
        if (stop_.stop_requested()) throw Error(ErrorKind::input, from_.string() + ": stopped while copying it");
    }
    void tell(double share) {
        const int percent = static_cast<int>(100 * share);
        if (progress_ && percent > told_percent_) progress_(share);
        told_percent_ = std::max(told_percent_, percent);
    }

 private:
    const std::filesystem::path& from_;
    const IndexProgress& progress_;
    const std::stop_token& stop_;
    int told_percent_ = -1;
};

}  // namespace

void copyWithKlv(const std::filesystem::path& from, const std::function<void(const TakePacket&)>& add,
                 const std::filesystem::path& to, const IndexProgress& progress, const std::stop_token& stop) {
    StreamCopy copy(from, to);
    CopyWatch watch(from, progress, stop);
    bool more = copy.next();
    const auto copyOne = [&] {
        copy.copy();
        watch.tell(copy.share());
        more = copy.next();
    };
    add([&](const AddedPacket& packet) {
        watch.goOn();
        // A picture is shown when it is decoded or later, so that nothing is added too late.
        for (; more && (copy.pictureStamp() == kNoStamp || copy.pictureStamp() < packet.stamp_us); copyOne())
            watch.goOn();
        copy.add(packet);
    });
    for (; more; copyOne()) watch.goOn();
    copy.finish();
}

}  // namespace eyrie
