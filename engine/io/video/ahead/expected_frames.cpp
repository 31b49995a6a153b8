#include "io/video/ahead/expected_frames.h"

#include <sys/resource.h>
#include <unistd.h>

#include <exception>
#include <utility>

#include "io/video/frame_cache.h"

namespace eyrie {

namespace {
constexpr int kLeastPriority = 19;  // its decoder's threads inherit it
}  // namespace

ExpectedFrames::ExpectedFrames(FrameCache& cache, Open open)
    : cache_(cache), open_(std::move(open)), thread_([this](const std::stop_token& stop) { work(stop); }) {}

ExpectedFrames::~ExpectedFrames() = default;

bool ExpectedFrames::isOfCache(const VideoInfo& video) const {
    const VideoInfo& cached = cache_.info();
    return video.path == cached.path && video.size == cached.size && video.frame_count == cached.frame_count;
}

void ExpectedFrames::work(const std::stop_token& stop) const {
    setpriority(PRIO_PROCESS, static_cast<id_t>(gettid()), kLeastPriority);
    std::unique_ptr<FrameSource> source;
    while (const auto next = cache_.nextExpected(stop)) {
        const FrameIndex index = *next;
        try {
            if (!source) source = open_(stop);
            if (!isOfCache(source->info())) return;  // the file has become another
            source->giveUpWhen([&] { return stop.stop_requested() || !cache_.hasTimeFor(index); });
            cache_.putExpected(index, std::make_shared<const Frame>(source->read(index, cache_.withColour())));
        } catch (const ReadingGivenUp&) {
            continue;
        } catch (const std::exception&) {
            cache_.putExpected(index, nullptr);  // what is wrong is told when it is asked for
        }
    }
}

}  // namespace eyrie
