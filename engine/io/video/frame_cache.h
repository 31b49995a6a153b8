#pragma once

#include <atomic>
#include <condition_variable>
#include <functional>
#include <list>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <stop_token>
#include <string>
#include <thread>
#include <vector>

#include "io/video/frame_source.h"

namespace eyrie {

/// How much of a video is kept decoded, and how far it is read ahead.
struct FrameCacheOptions {
    std::size_t max_bytes = 256U << 20U;  ///< pixels kept; one frame is kept even if it is larger
    int ahead = 8;                        ///< frames read beyond the last request, in the direction of the steps
    int behind = 12;  ///< frames read before a request that steps back, so that the next ones are there
    bool with_colour = true;
};

/// Frames of a source for a window: read on a thread of its own, kept, and read ahead in the direction of the requests.
/// What lies farthest from the last request goes first when room is needed, what is expected last but for what lies
/// near it. Reading ahead is given up for a request of something else. All functions may be called from any thread.
class FrameCache {
 public:
    /// Called on the cache's thread when a requested frame has come or failed; must be quick and must not call `get`.
    using Arrived = std::function<void(FrameIndex)>;

    FrameCache(std::unique_ptr<FrameSource> source, FrameCacheOptions options = {}, Arrived arrived = {});
    /// Waits for what is being decoded; no callback follows.
    ~FrameCache();
    FrameCache(const FrameCache&) = delete;
    FrameCache& operator=(const FrameCache&) = delete;

    const VideoInfo& info() const { return info_; }
    /// Microseconds from the start of the video. Throws Error(input) when there is no such frame.
    std::int64_t timeOf(FrameIndex index) const;

    /// The frame if it is there; nullptr if not: then it is read next, and `Arrived` tells when. Never waits for
    /// decoding.
    std::shared_ptr<const Frame> tryGet(FrameIndex index);
    /// Waits for the frame. Throws Error(input) when it cannot be read.
    std::shared_ptr<const Frame> get(FrameIndex index);

    /// Frames that are likely to be asked for, the likeliest first; in place of those before. As many are kept as fit
    /// beside what is read ahead; ExpectedFrames reads them.
    void expect(std::vector<FrameIndex> frames);

    /// Bytes of the pixels kept now.
    std::size_t bytes() const;

    // For ExpectedFrames.

    /// Waits for an expected frame to be missing and to have room while nothing else is to read; nothing once stopped.
    /// From the first one on room for a second decoder's own pictures is left free.
    std::optional<FrameIndex> nextExpected(const std::stop_token& stop);
    /// Whether it still is worth reading, and nothing else is to read.
    bool hasTimeFor(FrameIndex expected) const;
    /// Keeps it; null: it cannot be read this way, and is expected no more.
    void putExpected(FrameIndex index, std::shared_ptr<const Frame> frame);
    bool withColour() const { return options_.with_colour; }

 private:
    /// Somebody in `get`.
    struct Waiter {
        FrameIndex index = 0;
        std::shared_ptr<const Frame> frame;
        std::string error;
        bool done = false;
    };

    /// Frames that are worth keeping before all others, inclusive.
    struct Window {
        FrameIndex first = 0;
        FrameIndex last = -1;
        bool holds(FrameIndex index) const { return index >= first && index <= last; }
    };

    void work(const std::stop_token& stop);
    FrameIndex chooseNext();
    std::list<Waiter*>::const_iterator nextWaiter() const;  ///< who was not answered yet
    void planRun(FrameIndex first, FrameIndex last);
    void request(FrameIndex index);
    bool store(FrameIndex index, std::shared_ptr<const Frame> frame, const std::string& error);
    void keep(FrameIndex index, std::shared_ptr<const Frame> frame);
    void makeRoom();
    std::size_t expectedThatFit() const;
    std::optional<FrameIndex> missingExpected() const;
    void becomeIdle(bool idle);
    Window window() const;
    int stepsBack() const;
    bool isKnown(FrameIndex index) const { return frames_.contains(index) || errors_.contains(index); }
    std::string noSuchFrame(FrameIndex index) const;

    std::unique_ptr<FrameSource> source_;
    const VideoInfo info_;
    std::vector<std::int64_t> times_us_;
    const FrameCacheOptions options_;
    const Arrived arrived_;

    mutable std::mutex mutex_;
    std::condition_variable_any wake_;       ///< work for the thread
    std::condition_variable arrival_;        ///< something for `get`
    std::condition_variable_any idle_wake_;  ///< work for who reads expected frames
    int capacity_;                           ///< frames that fit
    std::size_t max_bytes_;
    std::map<FrameIndex, std::shared_ptr<const Frame>> frames_;
    std::map<FrameIndex, std::string> errors_;
    std::list<Waiter*> waiters_;
    std::size_t bytes_ = 0;
    FrameIndex wanted_ = -1;   ///< last request
    bool announced_ = true;    ///< its arrival was told, or it was there
    int direction_ = 1;        ///< of the last step
    FrameIndex run_next_ = 0;  ///< frames that are read in a row: [run_next_, run_end_)
    FrameIndex run_end_ = 0;
    std::vector<FrameIndex> expected_;
    bool second_decoder_ = false;         ///< has its share of the room
    bool idle_ = false;                   ///< nothing is to read but what is expected
    FrameIndex reading_ahead_ = -1;       ///< what is being read though nobody asked for it; −1: nothing
    std::atomic<bool> given_up_ = false;  ///< something else is asked for
    std::jthread thread_;                 ///< last: it uses all others
};

}  // namespace eyrie
