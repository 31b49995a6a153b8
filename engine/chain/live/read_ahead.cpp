#include "chain/live/read_ahead.h"

#include <utility>
#include <vector>

#include "core/error.h"
#include "io/live/live_stream.h"

namespace eyrie {
namespace {

/// Frames that are in memory.
class KeptFrames : public FrameSource {
 public:
    KeptFrames(VideoInfo info, std::vector<Frame> frames) : info_(std::move(info)), frames_(std::move(frames)) {
        info_.frame_count = static_cast<int>(frames_.size());
    }
    const VideoInfo& info() const override { return info_; }
    std::int64_t timeOf(FrameIndex index) const override { return frames_.at(static_cast<std::size_t>(index)).time_us; }
    Frame read(FrameIndex index, bool) override { return frames_.at(static_cast<std::size_t>(index)); }

 private:
    VideoInfo info_;
    std::vector<Frame> frames_;
};

}  // namespace

std::unique_ptr<FrameSource> ReadAhead::first(int frames) {
    try {
        while (static_cast<int>(ahead_.size()) < frames)
            ahead_.push_back(source_.read(static_cast<FrameIndex>(ahead_.size()), true));
    } catch (const StreamEnded&) {  // those that came are looked at
    } catch (const Error&) {        // the run will come to it and tell
    }
    return std::make_unique<KeptFrames>(info(), std::vector<Frame>(ahead_.begin(), ahead_.end()));
}

Frame ReadAhead::read(FrameIndex index, bool with_colour) {
    if (ahead_.empty() || ahead_.front().index != index) return source_.read(index, with_colour);
    Frame frame = std::move(ahead_.front());
    ahead_.pop_front();
    return frame;
}

}  // namespace eyrie
