#pragma once

#include <atomic>
#include <chrono>
#include <functional>
#include <mutex>
#include <optional>
#include <vector>

#include "chain/chain_run.h"
#include "session/background/frame_mailbox.h"
#include "session/frames/trail_history.h"
#include "store/runs/run_store.h"

namespace eyrie::ui {

/// Passes what a run finds on to the eye: pictures and overlays at most `kFramesPerSecond`, the newest winning; the
/// summary of every frame. Fed on the run's thread, and on those that look for the scale before it; read on another;
/// the run never waits.
class LiveFeed : public ChainObserver {
 public:
    static constexpr int kFramesPerSecond = 25;

    /// `notify` is called on the run's thread when there is something to fetch and nobody was told yet.
    LiveFeed(int trail_length, std::function<void()> notify);

    void onFrame(const std::shared_ptr<const FrameResult>& result, const Frame& frame) override;
    void onProgress(const RunProgress& progress) override;
    /// The run is over: its last frame is passed on even if it came early.
    void flush();

    std::optional<ViewFrame> takeFrame() { return mailbox_.take(); }
    /// The frames done since the last call, in order.
    std::vector<FrameSummary> takeSummaries();
    std::optional<RunProgress> takeProgress() { return progress_.take(); }
    /// The reader is about to fetch: later news are to be told again.
    void fetching() { told_ = false; }

 private:
    void show(const std::shared_ptr<const FrameResult>& result, const Frame& frame);
    void tell();

    std::function<void()> notify_;
    std::atomic<bool> told_ = false;
    FrameMailbox mailbox_;
    Mailbox<RunProgress> progress_;
    std::mutex summaries_mutex_;
    std::vector<FrameSummary> summaries_;
    TrailHistory history_;
    std::chrono::steady_clock::time_point last_shown_;
    std::shared_ptr<const FrameResult> held_result_;  ///< of the last frame, if it was not shown
    Frame held_frame_;
};

}  // namespace eyrie::ui
