#include "io/video/encoding/picture_encoder.h"

#include <cmath>
#include <cstdint>
#include <opencv2/imgproc.hpp>
#include <utility>

#include "core/error.h"

namespace eyrie {
namespace {

/// Ticks a second; a multiple of the usual frame rates and fine enough for any other.
constexpr int kTicksPerSecond = 90000;

const AVCodec* findEncoder(const std::string& name) {
    if (!name.empty()) return avcodec_find_encoder_by_name(name.c_str());
    const AVCodec* encoder = avcodec_find_encoder_by_name("libx264");
    return encoder != nullptr ? encoder : avcodec_find_encoder(AV_CODEC_ID_MPEG4);
}

/// What every player shows: 4:2:0, or what the encoder prefers if it is bound to another.
AVPixelFormat pixelFormatFor(const AVCodec& encoder) {
    if (encoder.pix_fmts == nullptr) return AV_PIX_FMT_YUV420P;
    if (encoder.id == AV_CODEC_ID_MJPEG) return AV_PIX_FMT_YUVJ420P;
    for (const AVPixelFormat* format = encoder.pix_fmts; *format != AV_PIX_FMT_NONE; ++format)
        if (*format == AV_PIX_FMT_YUV420P) return *format;
    return encoder.pix_fmts[0];
}

}  // namespace

PictureEncoder::PictureEncoder(cv::Size size, const VideoWriterOptions& options, bool header_apart, Fail fail)
    : size_(size), frame_rate_hz_(options.frame_rate_hz), fail_(std::move(fail)) {
    open(options, header_apart);
}

void PictureEncoder::fail(const std::string& what, int reason) const {
    fail_(what, reason);
    throw Error(ErrorKind::internal, what);
}

void PictureEncoder::open(const VideoWriterOptions& options, bool header_apart) {
    const AVCodec* encoder = findEncoder(options.codec);
    if (encoder == nullptr) fail("there is no video encoder " + options.codec);
    codec_.reset(avcodec_alloc_context3(encoder));
    codec_->width = size_.width + size_.width % 2;
    codec_->height = size_.height + size_.height % 2;
    codec_->pix_fmt = pixelFormatFor(*encoder);
    codec_->color_range = codec_->pix_fmt == AV_PIX_FMT_YUVJ420P ? AVCOL_RANGE_JPEG : AVCOL_RANGE_MPEG;
    codec_->colorspace = AVCOL_SPC_SMPTE170M;
    codec_->framerate = av_d2q(options.frame_rate_hz, 100000);
    codec_->time_base = {1, kTicksPerSecond};
    codec_->gop_size = options.key_frame_distance;
    if (options.b_frames >= 0) codec_->max_b_frames = options.b_frames;
    if (encoder->id == AV_CODEC_ID_MPEG1VIDEO || encoder->id == AV_CODEC_ID_MPEG2VIDEO ||
        encoder->id == AV_CODEC_ID_MPEG4)
        codec_->time_base = av_inv_q(codec_->framerate);  // these count in frames
    codec_->global_quality = FF_QP2LAMBDA * 4;
    if (encoder->id != AV_CODEC_ID_H264 && encoder->id != AV_CODEC_ID_HEVC) codec_->flags |= AV_CODEC_FLAG_QSCALE;
    if (header_apart) codec_->flags |= AV_CODEC_FLAG_GLOBAL_HEADER;
    codec_->thread_count = 2;
    AVDictionary* settings = nullptr;
    av_dict_set_int(&settings, "crf", options.quality, 0);
    av_dict_set(&settings, "preset", "veryfast", 0);
    av_dict_parse_string(&settings, options.encoder_options.c_str(), "=", ":", 0);
    const int opened = avcodec_open2(codec_.get(), encoder, &settings);
    av_dict_free(&settings);
    if (opened < 0)
        fail("the video encoder cannot be started for " + std::to_string(size_.width) + "×" +
                 std::to_string(size_.height) + " px",
             opened);
}

void PictureEncoder::convert(const cv::Mat& image) {
    cv::Mat even = image;
    if (size_.width % 2 != 0 || size_.height % 2 != 0)
        cv::copyMakeBorder(image, even, 0, size_.height % 2, 0, size_.width % 2, cv::BORDER_REPLICATE);
    SwsContext* context =
        sws_getCachedContext(scaler_.release(), even.cols, even.rows, AV_PIX_FMT_BGR24, even.cols, even.rows,
                             codec_->pix_fmt, SWS_BILINEAR | SWS_ACCURATE_RND, nullptr, nullptr, nullptr);
    if (context == nullptr) fail("the images cannot be converted for the encoder");
    scaler_.reset(context);
    const int* matrix = sws_getCoefficients(SWS_CS_ITU601);
    sws_setColorspaceDetails(context, matrix, 1, matrix, codec_->color_range == AVCOL_RANGE_JPEG ? 1 : 0, 0, 1 << 16,
                             1 << 16);
    av_frame_unref(picture_.get());
    picture_->format = codec_->pix_fmt;
    picture_->width = even.cols;
    picture_->height = even.rows;
    picture_->color_range = codec_->color_range;
    picture_->colorspace = codec_->colorspace;
    if (const int made = av_frame_get_buffer(picture_.get(), 0); made < 0) fail("out of memory", made);
    const std::uint8_t* rows[4] = {even.data, nullptr, nullptr, nullptr};
    const int strides[4] = {static_cast<int>(even.step), 0, 0, 0};
    sws_scale(context, rows, strides, 0, even.rows, picture_->data, picture_->linesize);
}

void PictureEncoder::encode(const cv::Mat& image, std::int64_t ticks, const Visit& visit) {
    convert(image);
    picture_->pts = ticks;
    send(picture_.get(), visit);
}

void PictureEncoder::finish(const Visit& visit) {
    send(nullptr, visit);
}

void PictureEncoder::send(const AVFrame* frame, const Visit& visit) {
    if (const int sent = avcodec_send_frame(codec_.get(), frame); sent < 0) fail("a frame cannot be encoded", sent);
    while (true) {
        const int received = avcodec_receive_packet(codec_.get(), packet_.get());
        if (received == AVERROR(EAGAIN) || received == AVERROR_EOF) return;
        if (received < 0) fail("a frame cannot be encoded", received);
        if (packet_->duration == 0) packet_->duration = std::llround(1 / (frame_rate_hz_ * av_q2d(codec_->time_base)));
        visit(*packet_);
        av_packet_unref(packet_.get());
    }
}

}  // namespace eyrie
