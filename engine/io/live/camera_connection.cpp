#include <algorithm>
#include <chrono>
#include <cmath>
#include <deque>

#include "core/error.h"
#include "io/live/live_address.h"
#include "io/live/live_connection.h"
#include "io/video/encoding/picture_encoder.h"

namespace eyrie {
namespace {

using CameraClock = std::chrono::steady_clock;

/// Of a camera that does not say how many pictures a second it sends, Hz.
constexpr double kUsualRate_hz = 25;
/// So little is lost that small vehicles stay what they were.
constexpr int kCameraQuality = 16;

/// The run is one over the recording, as of every live source: what the chain works on was encoded before, too.
class CameraConnection : public LiveConnection {
 public:
    CameraConnection(const std::string& address, const CameraOpener& open)
        : device_(cameraDevice(address)), camera_(open(device_)) {
        if (!camera_->read(picture_) || picture_.empty())
            throw Error(ErrorKind::input,
                        device_ +
                            ": no picture came from this camera; disconnect it, connect it again and try once "
                            "more");
        size_ = picture_.size();
        const double rate = camera_->frameRate();
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
    /// The camera itself decides how long it waits.
    bool read(AVPacket& packet, double) override {
        while (packets_.empty()) {
            if (picture_.empty() && !camera_->read(picture_)) return false;
            if (picture_.empty() || picture_.size() != size_) return false;  // whoever connects again learns the size
            encoder_->encode(picture_, nextTick(),
                             [this](AVPacket& made) { packets_.emplace_back(av_packet_clone(&made)); });
            picture_.release();
        }
        av_packet_move_ref(&packet, packets_.front().get());
        packets_.pop_front();
        return true;
    }

 private:
    /// When the picture came, on a clock that rises.
    std::int64_t nextTick() {
        const double seconds = std::chrono::duration<double>(CameraClock::now() - begin_).count();
        const auto now = static_cast<std::int64_t>(std::llround(seconds / av_q2d(encoder_->codec().time_base)));
        return last_tick_ = std::max(now, last_tick_ + 1);
    }

    std::string device_;
    std::unique_ptr<CameraDevice> camera_;
    cv::Mat picture_;  ///< the first one, until it is sent
    cv::Size size_;
    std::unique_ptr<PictureEncoder> encoder_;
    libav::Demuxer described_;
    std::deque<libav::Packet> packets_;
    CameraClock::time_point begin_ = CameraClock::now();
    std::int64_t last_tick_ = -1;
};

}  // namespace

std::unique_ptr<LiveConnection> connectToCamera(const std::string& address, const CameraOpener& open,
                                                const std::stop_token& stop) {
    if (stop.stop_requested()) throw Error(ErrorKind::input, cameraDevice(address) + ": stopped while waiting for it");
    return std::make_unique<CameraConnection>(address, open ? open : openCamera);
}

}  // namespace eyrie
