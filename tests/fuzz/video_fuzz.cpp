#include <dlfcn.h>

extern "C" {
#include <libavcodec/avcodec.h>
#include <libavutil/log.h>
}

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

/// Bytes as a video: its index is built and some frames are read.
extern "C" int LLVMFuzzerInitialize(int*, char***) {
    av_log_set_level(AV_LOG_QUIET);
    return 0;
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    static const eyrie::fuzz::MemoryFolder folder;
    static const std::filesystem::path file = folder / "fuzzed.mp4";
    eyrie::fuzz::writeBytes(file, data, size);
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
