#include "sweep/clip_frames.h"

#include <string>
#include <utility>

#include "core/error.h"

namespace eyrie {

ClipFrames::ClipFrames(Open open, FrameRange range, std::size_t max_bytes) : open_(std::move(open)), source_(open_()) {
    info_ = source_->info();
    first_ = range.first;
    last_ = range.last < 0 ? info_.frame_count - 1 : range.last;
    if (first_ < 0 || last_ >= info_.frame_count || first_ > last_) {
        throw Error(ErrorKind::parameter, "frames " + std::to_string(first_) + " to " + std::to_string(last_) +
                                              " are not in " + info_.path.string() + ", which has frames 0 to " +
                                              std::to_string(info_.frame_count - 1));
    }
    const auto frames = static_cast<std::size_t>(count());
    in_memory_ = static_cast<std::size_t>(info_.size.area()) * frames <= max_bytes;
    if (!in_memory_) return;
    frames_.resize(frames);
    loaded_ = std::vector<std::atomic<bool>>(frames);
}

Frame ClipFrames::kept(FrameIndex index) const {
    const auto at = static_cast<std::size_t>(index - first_);
    if (!loaded_[at].load(std::memory_order_acquire)) {
        const std::scoped_lock lock(mutex_);
        if (!loaded_[at].load(std::memory_order_relaxed)) {
            frames_[at] = source_->read(index, false);
            loaded_[at].store(true, std::memory_order_release);
        }
    }
    return frames_[at];
}

Frame ClipFrames::Reader::read(FrameIndex index) {
    if (clip_.in_memory_) return clip_.kept(index);
    if (!own_) own_ = clip_.open_();
    return own_->read(index, false);
}

}  // namespace eyrie
