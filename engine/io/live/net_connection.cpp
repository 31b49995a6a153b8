#include <chrono>
#include <cmath>

#include "core/error.h"
#include "io/live/live_address.h"
#include "io/live/live_connection.h"

namespace eyrie {
namespace {

/// What may be opened: the net, nothing that reads files of this machine.
constexpr char kLiveProtocols[] = "udp,rtp,rtsp,rtsps,srtp,tcp,tls,http,https,srt,rtmp,rtmps,mmsh,crypto";

std::string secondsText(double seconds) {
    return std::to_string(std::lround(seconds)) + " s";
}

class NetConnection : public LiveConnection {
 public:
    NetConnection(const std::string& address, double seconds, const std::stop_token& stop);

    const AVFormatContext& demuxer() const override { return *demuxer_; }
    int video() const override { return video_; }
    bool read(AVPacket& packet, double seconds) override;
    bool wasHeldBack() const override { return std::chrono::steady_clock::now() >= limit_; }
    bool hasEnded() const override { return has_ended_; }

 private:
    static int overdue(void* self);
    void allow(double seconds);

    std::stop_token stop_;
    std::chrono::steady_clock::time_point limit_;
    libav::Demuxer demuxer_;
    int video_ = -1;
    bool has_ended_ = false;
};

NetConnection::NetConnection(const std::string& address, double seconds, const std::stop_token& stop) : stop_(stop) {
    av_log_set_level(AV_LOG_QUIET);
    avformat_network_init();
    AVFormatContext* raw = avformat_alloc_context();
    raw->interrupt_callback = {&NetConnection::overdue, this};
    // A receiver that joins in the midst of a stream waits for a key frame; more need not be looked through.
    raw->max_analyze_duration = static_cast<std::int64_t>(seconds * 500'000);
    AVDictionary* options = nullptr;
    av_dict_set(&options, "protocol_whitelist", kLiveProtocols, 0);
    av_dict_set(&options, "rtsp_transport", "tcp", 0);
    av_dict_set(&options, "fifo_size", "100000", 0);  // packets of 188 bytes
    av_dict_set(&options, "overrun_nonfatal", "1", 0);
    allow(seconds);
    const int opened = avformat_open_input(&raw, address.c_str(), nullptr, &options);
    av_dict_free(&options);
    const auto refuse = [&](int reason) {
        const std::string shown = shownAddress(address);
        if (stop.stop_requested()) throw Error(ErrorKind::input, shown + ": stopped while waiting for it");
        if (reason == AVERROR_EXIT || std::chrono::steady_clock::now() >= limit_)
            throw Error(ErrorKind::input, shown + ": nothing that could be read came within " + secondsText(seconds) +
                                              "; check the address and that it sends");
        throw Error(ErrorKind::input, shown + ": cannot be opened (" + libav::errorText(reason) +
                                          "); check the address and that it sends");
    };
    if (opened < 0) refuse(opened);
    demuxer_.reset(raw);
    if (const int found = avformat_find_stream_info(raw, nullptr); found < 0) refuse(found);
    video_ = av_find_best_stream(raw, AVMEDIA_TYPE_VIDEO, -1, -1, nullptr, 0);
    if (video_ < 0 || raw->streams[video_]->codecpar->width < 1)
        throw Error(ErrorKind::input,
                    shownAddress(address) + ": carries no video; check the address and what it sends");
}

bool NetConnection::read(AVPacket& packet, double seconds) {
    allow(seconds);
    const int got = av_read_frame(demuxer_.get(), &packet);
    // What is made as it is sent has no size, and a broken connection ends like a file but for its error.
    has_ended_ =
        got == AVERROR_EOF && demuxer_->pb != nullptr && demuxer_->pb->error >= 0 && avio_size(demuxer_->pb) > 0;
    return got >= 0;
}

void NetConnection::allow(double seconds) {
    limit_ = std::chrono::steady_clock::now() + std::chrono::milliseconds(std::llround(seconds * 1000));
}

int NetConnection::overdue(void* self) {
    const auto& connection = *static_cast<NetConnection*>(self);
    return connection.stop_.stop_requested() || std::chrono::steady_clock::now() >= connection.limit_ ? 1 : 0;
}

}  // namespace

std::unique_ptr<LiveConnection> connectToNet(const std::string& address, double seconds, const std::stop_token& stop) {
    return std::make_unique<NetConnection>(address, seconds, stop);
}

}  // namespace eyrie
