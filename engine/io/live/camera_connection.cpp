#include <algorithm>
#include <chrono>
#include <cmath>
#include <deque>
#include <optional>
#include <utility>

#include "core/error.h"
#include "io/live/camera_reader.h"
#include "io/live/live_address.h"
#include "io/live/live_connection.h"
#include "io/video/encoding/picture_encoder.h"

namespace eyrie {
namespace {

/// Of a camera that does not say how many pictures a second it sends, Hz.
constexpr double kUsualRate_hz = 25;
/// So little is lost that small vehicles stay what they were.
constexpr int kCameraQuality = 16;

/// The run is one over the recording, as of every live source: what the chain works on was encoded before, too.
class CameraConnection : public LiveConnection {
 public:
    CameraConnection(const std::string& address, const CameraOpener& open, const CameraPatience& patience,
                     std::stop_token stop)
        : device_(cameraDevice(address)), stop_(std::move(stop)), camera_(device_, open, patience, stop_) {
        picture_ = camera_.next(patience.connect_s, stop_);
        if (stop_.stop_requested()) throw Error(ErrorKind::input, device_ + ": stopped while waiting for it");
        if (!picture_)
            throw Error(ErrorKind::input,
                        device_ +
                            ": no picture came from this camera; disconnect it, connect it again and try once "
                            "more");
        size_ = picture_->pixels.size();
        begin_ = picture_->came;
        const double rate = camera_.frameRate();
        VideoWriterOptions options;
        options.frame_rate_hz = rate > 1 && rate < 1000 ? rate : kUsualRate_hz;
        options.quality = kCameraQuality;
        options.key_frame_distance = static_cast<int>(std::ceil(options.frame_rate_hz));
        options.b_frames = 0;
        options.encoder_options = "tune=zerolatency";  // a picture is a packet at once
        encoder_ = std::make_unique<PictureEncoder>(size_, options, false, [this](const std::string& what, int reason) {
            throw Error(ErrorKind::input,
                        device_ + ": " + what + (reason < 0 ? " (" + libav::errorText(reason) + ")" : ""));
        });
        described_.reset(avformat_alloc_context());
        AVStream* stream = avformat_new_stream(described_.get(), nullptr);
        stream->time_base = encoder_->codec().time_base;
        stream->avg_frame_rate = encoder_->codec().framerate;
        avcodec_parameters_from_context(stream->codecpar, &encoder_->codec());
    }

    const AVFormatContext& demuxer() const override { return *described_; }
    int video() const override { return 0; }
    bool read(AVPacket& packet, double seconds) override {
        while (packets_.empty()) {
            if (!picture_) picture_ = camera_.next(seconds, stop_);
            if (!picture_ || picture_->pixels.size() != size_) return false;  // whoever connects again learns the size
            encoder_->encode(picture_->pixels, tickOf(*picture_),
                             [this](AVPacket& made) { packets_.emplace_back(av_packet_clone(&made)); });
            picture_.reset();
        }
        av_packet_move_ref(&packet, packets_.front().get());
        packets_.pop_front();
        return true;
    }

 private:
    /// When a picture came, on a clock that rises.
    std::int64_t tickOf(const CameraPicture& picture) {
        const double seconds = std::chrono::duration<double>(picture.came - begin_).count();
        const auto now = static_cast<std::int64_t>(std::llround(seconds / av_q2d(encoder_->codec().time_base)));
        return last_tick_ = std::max(now, last_tick_ + 1);
    }

    std::string device_;
    std::stop_token stop_;
    CameraReader camera_;
    std::optional<CameraPicture> picture_;  ///< until it is sent
    cv::Size size_;
    std::unique_ptr<PictureEncoder> encoder_;
    libav::Demuxer described_;
    std::deque<libav::Packet> packets_;
    std::chrono::steady_clock::time_point begin_;
    std::int64_t last_tick_ = -1;
};

}  // namespace

std::unique_ptr<LiveConnection> connectToCamera(const std::string& address, const CameraOpener& open,
                                                const CameraPatience& patience, const std::stop_token& stop) {
    return std::make_unique<CameraConnection>(address, open ? open : openCamera, patience, stop);
}

}  // namespace eyrie
