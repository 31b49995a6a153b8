#include "io/video/video_writer.h"

#include <cmath>

#include "core/error.h"
#include "core/text.h"
#include "io/atomic_file.h"
#include "io/video/encoding/picture_encoder.h"
#include "io/video/libav.h"

namespace eyrie {

struct VideoWriter::Implementation {
    std::filesystem::path path;
    std::filesystem::path part;  ///< where it is written until it is complete; a device or pipe itself
    bool in_place = false;
    cv::Size size;
    VideoWriterOptions options;
    libav::Muxer muxer;
    std::unique_ptr<PictureEncoder> encoder;
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
        encoder = std::make_unique<PictureEncoder>(size, options, (muxer->oformat->flags & AVFMT_GLOBALHEADER) != 0,
                                                   [this](const std::string& what, int reason) { fail(what, reason); });
        AVStream* stream = avformat_new_stream(muxer.get(), nullptr);
        stream->time_base = encoder->codec().time_base;
        stream->avg_frame_rate = encoder->codec().framerate;
        avcodec_parameters_from_context(stream->codecpar, &encoder->codec());
        if (const int opened = avio_open(&muxer->pb, url.c_str(), AVIO_FLAG_WRITE); opened < 0)
            fail("the video cannot be written", opened);
        if (const int written = avformat_write_header(muxer.get(), nullptr); written < 0)
            fail("the video cannot be written", written);
    }

    std::int64_t ticksOf(std::int64_t time_us) const {
        const AVRational tick = encoder->codec().time_base;
        if (time_us < 0) return last_ticks < 0 ? 0 : std::llround(frames / (options.frame_rate_hz * av_q2d(tick)));
        return av_rescale_q(time_us, {1, 1'000'000}, tick);
    }

    void put(AVPacket& packet) const {
        av_packet_rescale_ts(&packet, encoder->codec().time_base, muxer->streams[0]->time_base);
        packet.stream_index = 0;
        int written = av_interleaved_write_frame(muxer.get(), &packet);
        if (written >= 0) written = muxer->pb->error;
        if (written < 0) fail("the video cannot be written; the disk may be full", written);
    }

    void finish() {
        encoder->finish([this](AVPacket& packet) { put(packet); });
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
    writer.last_ticks = ticks;
    ++writer.frames;
    writer.encoder->encode(image, ticks, [&writer](AVPacket& packet) { writer.put(packet); });
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
