#pragma once

#include <functional>
#include <opencv2/core/mat.hpp>
#include <string>

#include "io/video/libav.h"
#include "io/video/video_writer.h"

/// Inside of this room only.
namespace eyrie {

/// Turns images into the packets of a video, wherever these go.
class PictureEncoder {
 public:
    /// Throws what makes an Error of what went wrong, and of libav's code (0: none).
    using Fail = std::function<void(const std::string& what, int reason)>;
    /// Gets a packet, stamped by the time base of codec(), which it may take over; it is gone afterwards.
    using Visit = std::function<void(AVPacket& packet)>;

    /// All images have this size; odd sizes are grown by a row or column. `header_apart`: what a decoder has to know
    /// first stands in the container, not before each key frame.
    PictureEncoder(cv::Size size, const VideoWriterOptions& options, bool header_apart, Fail fail);

    /// Its time base is that of `ticks` and of the packets.
    const AVCodecContext& codec() const { return *codec_; }
    /// CV_8UC3, blue-green-red. `ticks` must rise. Visits the packets that are complete, which is not always one.
    void encode(const cv::Mat& image, std::int64_t ticks, const Visit& visit);
    /// Visits what was held back. Nothing can be encoded afterwards.
    void finish(const Visit& visit);

 private:
    [[noreturn]] void fail(const std::string& what, int reason = 0) const;
    void open(const VideoWriterOptions& options, bool header_apart);
    void convert(const cv::Mat& image);
    void send(const AVFrame* frame, const Visit& visit);

    cv::Size size_;
    double frame_rate_hz_;
    Fail fail_;
    libav::Codec codec_;
    libav::Scaler scaler_;
    libav::Picture picture_{av_frame_alloc()};
    libav::Packet packet_{av_packet_alloc()};
};

}  // namespace eyrie
