#include <dlfcn.h>

extern "C" {
#include <libavcodec/avcodec.h>
#include <libavformat/avformat.h>
#include <libavutil/log.h>
}

#include <algorithm>
#include <cstring>

#include "fuzz/input_file.h"
#include "io/video/frame_source.h"

/// Stands before the library's: a decoder works in one thread here, as making threads for some small pictures would
/// take most of the time.
extern "C" int avcodec_open2(AVCodecContext* context, const AVCodec* codec, AVDictionary** options) {
    using Open = int(AVCodecContext*, const AVCodec*, AVDictionary**);
    static const auto open = reinterpret_cast<Open*>(dlsym(RTLD_NEXT, "avcodec_open2"));
    context->thread_count = 1;
    return open(context, codec, options);
}

namespace {

constexpr std::size_t kLookedAt = 1024;  ///< of a file, to tell what it is

/// What is tried at this moment, for every opening of it.
struct Tried {
    const std::uint8_t* data = nullptr;
    std::size_t size = 0;
    const AVInputFormat* format = nullptr;  ///< as the first opening found it
};
Tried tried;

struct Position {
    Tried bytes;
    std::int64_t at = 0;
};

int readBytes(void* opaque, std::uint8_t* to, int size) {
    auto& position = *static_cast<Position*>(opaque);
    const auto left = static_cast<std::int64_t>(position.bytes.size) - position.at;
    if (left <= 0) return AVERROR_EOF;  // also far behind the end, where a damaged offset may lead
    const auto count = static_cast<int>(std::min<std::int64_t>(size, left));
    std::memcpy(to, position.bytes.data + position.at, static_cast<std::size_t>(count));
    position.at += count;
    return count;
}

std::int64_t seekBytes(void* opaque, std::int64_t offset, int whence) {
    auto& position = *static_cast<Position*>(opaque);
    const auto size = static_cast<std::int64_t>(position.bytes.size);
    if (whence == AVSEEK_SIZE) return size;
    const std::int64_t from = whence == SEEK_CUR ? position.at : whence == SEEK_END ? size : 0;
    if (from + offset < 0) return AVERROR(EINVAL);
    return position.at = from + offset;
}

}  // namespace

/// Stands before the library's: reads the bytes from memory, and what the first opening of an input found to be its
/// format the others need not find again among three hundred.
extern "C" int avformat_open_input(AVFormatContext** context, const char* url, const AVInputFormat* format,
                                   AVDictionary** options) {
    using Open = int(AVFormatContext**, const char*, const AVInputFormat*, AVDictionary**);
    static const auto open = reinterpret_cast<Open*>(dlsym(RTLD_NEXT, "avformat_open_input"));
    constexpr int kBuffer = 4096;
    auto* position = new Position{tried, 0};
    *context = avformat_alloc_context();
    (*context)->pb = avio_alloc_context(static_cast<unsigned char*>(av_malloc(kBuffer)), kBuffer, 0, position,
                                        readBytes, nullptr, seekBytes);
    AVIOContext* io = (*context)->pb;
    const int opened = open(context, url, tried.format != nullptr ? tried.format : format, options);
    if (opened < 0) {
        av_freep(&io->buffer);
        avio_context_free(&io);
        delete position;
    } else {
        tried.format = (*context)->iformat;
    }
    return opened;
}

/// Stands before the library's: frees what the one above made, too.
extern "C" void avformat_close_input(AVFormatContext** context) {
    using Close = void(AVFormatContext**);
    static const auto close = reinterpret_cast<Close*>(dlsym(RTLD_NEXT, "avformat_close_input"));
    AVIOContext* io = *context != nullptr ? (*context)->pb : nullptr;
    close(context);
    if (io == nullptr) return;
    delete static_cast<Position*>(io->opaque);
    av_freep(&io->buffer);
    avio_context_free(&io);
}

/// Bytes as a video: its index is built and some frames are read.
extern "C" int LLVMFuzzerInitialize(int*, char***) {
    av_log_set_level(AV_LOG_QUIET);
    return 0;
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    static const eyrie::fuzz::MemoryFolder folder;
    static const std::filesystem::path file = folder / "fuzzed.mp4";
    eyrie::fuzz::writeBytes(file, data, std::min<std::size_t>(size, kLookedAt));  // for who looks at its beginning
    tried = {data, size, nullptr};
    eyrie::fuzz::expectAnswer([] {
        eyrie::SourceOptions options;
        options.index_folder = folder / "cache";
        const auto source = eyrie::openSource(file, options);
        const int last = source->info().frame_count - 1;
        for (const int frame : {0, last / 2, last}) source->read(frame, false);
    });
    std::filesystem::remove_all(folder / "cache");
    return 0;
}
