#pragma once

#include <atomic>
#include <functional>
#include <memory>
#include <mutex>
#include <vector>

#include "chain/chain_run.h"
#include "io/video/frame_source.h"

namespace eyrie {

/// The grey frames of a part of a video, for reading them many times: kept in memory where they fit, otherwise decoded
/// anew by every reader. May be used by several threads.
class ClipFrames {
 public:
    /// Opens the video once more; called from any thread. Throws Error(input).
    using Open = std::function<std::unique_ptr<FrameSource>()>;

    /// Throws Error(parameter) for a range outside the video.
    ClipFrames(Open open, FrameRange range, std::size_t max_bytes);

    const VideoInfo& info() const { return info_; }
    FrameIndex first() const { return first_; }
    FrameIndex last() const { return last_; }
    int count() const { return last_ - first_ + 1; }
    bool inMemory() const { return in_memory_; }

    /// Reads frames for one thread.
    class Reader {
     public:
        explicit Reader(const ClipFrames& clip) : clip_(clip) {}
        /// Throws Error(input) when the frame cannot be decoded.
        Frame read(FrameIndex index);

     private:
        const ClipFrames& clip_;
        std::unique_ptr<FrameSource> own_;  ///< where frames are not kept
    };
    Reader reader() const { return Reader(*this); }
    /// The video once more. Throws Error(input).
    std::unique_ptr<FrameSource> openAnew() const { return open_(); }

 private:
    Frame kept(FrameIndex index) const;

    Open open_;
    VideoInfo info_;
    FrameIndex first_ = 0;
    FrameIndex last_ = 0;
    bool in_memory_ = false;
    mutable std::mutex mutex_;  ///< held while `source_` decodes
    mutable std::unique_ptr<FrameSource> source_;
    mutable std::vector<Frame> frames_;
    mutable std::vector<std::atomic<bool>> loaded_;
};

}  // namespace eyrie
