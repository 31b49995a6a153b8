#include "io/video/video_writer.h"

#include <cmath>
#include <opencv2/imgproc.hpp>

#include "core/error.h"
#include "core/text.h"
#include "io/atomic_file.h"
#include "io/video/libav.h"

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

struct VideoWriter::Implementation {
    std::filesystem::path path;
    std::filesystem::path part;  ///< where it is written until it is complete; a device or pipe itself
    bool in_place = false;
    cv::Size size;
    VideoWriterOptions options;
    libav::Muxer muxer;
    libav::Codec codec;
    libav::Scaler scaler;
    libav::Picture picture{av_frame_alloc()};
    libav::Packet packet{av_packet_alloc()};
    std::int64_t last_ticks = -1;
    int frames = 0;
    bool finished = false;
    bool abandoned = false;

    ~Implementation() {
        muxer.reset();
        std::error_code ignored;
        if (!finished && !in_place && !part.empty()) std::filesystem::remove(part, ignored);
    }

    [[noreturn]] void fail(const std::string& what, int reason = 0) const {
        throw Error(ErrorKind::output, displayText(path) + ": " + what +
                                           (reason < 0 ? " (" + libav::errorText(reason) + ")" : std::string()) +
                                           "; choose another place or format");
    }

    void open() {
        av_log_set_level(AV_LOG_QUIET);
        std::error_code ignored;
        if (std::filesystem::is_directory(path, ignored)) fail("is a folder");
        in_place = isOwnStream(path) ||
                   (std::filesystem::exists(path, ignored) && !std::filesystem::is_regular_file(path, ignored));
        if (!in_place) removeAbandonedParts(throughLinks(path));
        part = in_place ? path : temporaryBeside(throughLinks(path));
        AVFormatContext* raw = nullptr;
        const std::string url = "file:" + part.string();
        // The temporary name has not the extension that tells the format.
        const AVOutputFormat* format = av_guess_format(nullptr, path.filename().c_str(), nullptr);
        const int made = format == nullptr ? AVERROR_MUXER_NOT_FOUND
                                           : avformat_alloc_output_context2(&raw, format, nullptr, url.c_str());
        if (made < 0) fail("no video format has this extension; use .mp4", made);
        muxer.reset(raw);
        openEncoder();
        AVStream* stream = avformat_new_stream(muxer.get(), nullptr);
        stream->time_base = codec->time_base;
        stream->avg_frame_rate = codec->framerate;
        avcodec_parameters_from_context(stream->codecpar, codec.get());
        if (const int opened = avio_open(&muxer->pb, url.c_str(), AVIO_FLAG_WRITE); opened < 0)
            fail("the video cannot be written", opened);
        if (const int written = avformat_write_header(muxer.get(), nullptr); written < 0)
            fail("the video cannot be written", written);
    }

    void openEncoder() {
        const AVCodec* encoder = findEncoder(options.codec);
        if (encoder == nullptr) fail("there is no video encoder " + options.codec);
        codec.reset(avcodec_alloc_context3(encoder));
        codec->width = size.width + size.width % 2;
        codec->height = size.height + size.height % 2;
        codec->pix_fmt = pixelFormatFor(*encoder);
        codec->color_range = codec->pix_fmt == AV_PIX_FMT_YUVJ420P ? AVCOL_RANGE_JPEG : AVCOL_RANGE_MPEG;
        codec->colorspace = AVCOL_SPC_SMPTE170M;
        codec->framerate = av_d2q(options.frame_rate_hz, 100000);
        codec->time_base = {1, kTicksPerSecond};
        codec->gop_size = options.key_frame_distance;
        if (options.b_frames >= 0) codec->max_b_frames = options.b_frames;
        if (encoder->id == AV_CODEC_ID_MPEG1VIDEO || encoder->id == AV_CODEC_ID_MPEG2VIDEO ||
            encoder->id == AV_CODEC_ID_MPEG4)
            codec->time_base = av_inv_q(codec->framerate);  // these count in frames
        codec->global_quality = FF_QP2LAMBDA * 4;
        if (encoder->id != AV_CODEC_ID_H264 && encoder->id != AV_CODEC_ID_HEVC) codec->flags |= AV_CODEC_FLAG_QSCALE;
        if (muxer->oformat->flags & AVFMT_GLOBALHEADER) codec->flags |= AV_CODEC_FLAG_GLOBAL_HEADER;
        codec->thread_count = 2;
        AVDictionary* settings = nullptr;
        av_dict_set_int(&settings, "crf", options.quality, 0);
        av_dict_set(&settings, "preset", "veryfast", 0);
        av_dict_parse_string(&settings, options.encoder_options.c_str(), "=", ":", 0);
        const int opened = avcodec_open2(codec.get(), encoder, &settings);
        av_dict_free(&settings);
        if (opened < 0)
            fail("the video encoder cannot be started for " + std::to_string(size.width) + "×" +
                     std::to_string(size.height) + " px",
                 opened);
    }

    void convert(const cv::Mat& image) {
        cv::Mat even = image;
        if (size.width % 2 != 0 || size.height % 2 != 0)
            cv::copyMakeBorder(image, even, 0, size.height % 2, 0, size.width % 2, cv::BORDER_REPLICATE);
        SwsContext* context =
            sws_getCachedContext(scaler.release(), even.cols, even.rows, AV_PIX_FMT_BGR24, even.cols, even.rows,
                                 codec->pix_fmt, SWS_BILINEAR | SWS_ACCURATE_RND, nullptr, nullptr, nullptr);
        if (context == nullptr) fail("the images cannot be converted for the encoder");
        scaler.reset(context);
        const int* matrix = sws_getCoefficients(SWS_CS_ITU601);
        sws_setColorspaceDetails(context, matrix, 1, matrix, codec->color_range == AVCOL_RANGE_JPEG ? 1 : 0, 0, 1 << 16,
                                 1 << 16);
        av_frame_unref(picture.get());
        picture->format = codec->pix_fmt;
        picture->width = even.cols;
        picture->height = even.rows;
        picture->color_range = codec->color_range;
        picture->colorspace = codec->colorspace;
        if (const int made = av_frame_get_buffer(picture.get(), 0); made < 0) fail("out of memory", made);
        const std::uint8_t* rows[4] = {even.data, nullptr, nullptr, nullptr};
        const int strides[4] = {static_cast<int>(even.step), 0, 0, 0};
        sws_scale(context, rows, strides, 0, even.rows, picture->data, picture->linesize);
    }

    std::int64_t ticksOf(std::int64_t time_us) const {
        if (time_us < 0)
            return last_ticks < 0 ? 0 : std::llround(frames / (options.frame_rate_hz * av_q2d(codec->time_base)));
        return av_rescale_q(time_us, {1, 1'000'000}, codec->time_base);
    }

    /// Encodes one picture, or what is left when it is null.
    void encode(const AVFrame* frame) {
        if (const int sent = avcodec_send_frame(codec.get(), frame); sent < 0) fail("a frame cannot be encoded", sent);
        while (true) {
            const int received = avcodec_receive_packet(codec.get(), packet.get());
            if (received == AVERROR(EAGAIN) || received == AVERROR_EOF) return;
            if (received < 0) fail("a frame cannot be encoded", received);
            AVStream* stream = muxer->streams[0];
            if (packet->duration == 0)
                packet->duration = std::llround(1 / (options.frame_rate_hz * av_q2d(codec->time_base)));
            av_packet_rescale_ts(packet.get(), codec->time_base, stream->time_base);
            packet->stream_index = 0;
            int written = av_interleaved_write_frame(muxer.get(), packet.get());
            if (written >= 0) written = muxer->pb->error;
            if (written < 0) fail("the video cannot be written; the disk may be full", written);
        }
    }

    void finish() {
        encode(nullptr);
        int written = av_write_trailer(muxer.get());
        if (written >= 0) written = avio_closep(&muxer->pb);
        if (written < 0) fail("the video cannot be completed; the disk may be full", written);
        std::error_code failure;
        if (!in_place) std::filesystem::rename(part, throughLinks(path), failure);
        if (failure) fail("cannot be replaced: " + failure.message());
        finished = true;
    }
};

VideoWriter::VideoWriter(const std::filesystem::path& path, cv::Size size, const VideoWriterOptions& options)
    : implementation_(std::make_unique<Implementation>()) {
    implementation_->path = path;
    implementation_->size = size;
    implementation_->options = options;
    if (size.empty() || !(options.frame_rate_hz > 0)) implementation_->fail("a video needs a size and a frame rate");
    implementation_->open();
}

VideoWriter::~VideoWriter() {
    try {
        finish();
    } catch (const std::exception&) {
        // finish() is there for those who want to know
    }
}

void VideoWriter::write(const cv::Mat& image, std::int64_t time_us) {
    Implementation& writer = *implementation_;
    if (image.type() != CV_8UC3 || image.size() != writer.size)
        throw Error(ErrorKind::internal, "a frame of another size or type was given to the video writer");
    const std::int64_t ticks = writer.ticksOf(time_us);
    if (ticks <= writer.last_ticks) throw Error(ErrorKind::internal, "the times of written frames must rise");
    writer.convert(image);
    writer.picture->pts = ticks;
    writer.last_ticks = ticks;
    ++writer.frames;
    writer.encode(writer.picture.get());
}

void VideoWriter::finish() {
    if (implementation_->finished || implementation_->abandoned) return;
    if (!implementation_->muxer || implementation_->muxer->pb == nullptr) return;
    implementation_->finish();
}

void VideoWriter::abandon() {
    implementation_->abandoned = true;
}

}  // namespace eyrie
