#pragma once

#include <functional>
#include <memory>
#include <stop_token>
#include <thread>

#include "io/video/frame_source.h"

namespace eyrie {

class FrameCache;

/// Reads beforehand what a cache expects to be asked for: from a source of its own, on a thread of the lowest priority,
/// and while nobody asks the cache for anything. So a request never waits for it.
class ExpectedFrames {
 public:
    /// Opens the video that the cache reads once more; called on the thread, when there is something to read.
    using Open = std::function<std::unique_ptr<FrameSource>(const std::stop_token& stop)>;

    /// The cache must outlive this.
    ExpectedFrames(FrameCache& cache, Open open);
    /// Gives up what is being read.
    ~ExpectedFrames();
    ExpectedFrames(const ExpectedFrames&) = delete;
    ExpectedFrames& operator=(const ExpectedFrames&) = delete;

 private:
    void work(const std::stop_token& stop) const;
    bool isOfCache(const VideoInfo& video) const;

    FrameCache& cache_;
    const Open open_;
    std::jthread thread_;  ///< last: it uses all others
};

}  // namespace eyrie
