#include "session/live_feed.h"

#include <utility>

#include "canvas/drawing/image_convert.h"

namespace eyrie::ui {

LiveFeed::LiveFeed(int trail_length, std::function<void()> notify)
    : notify_(std::move(notify)), history_(trail_length) {}

void LiveFeed::onFrame(const std::shared_ptr<const FrameResult>& result, const Frame& frame) {
    history_.add(*result);
    {
        const std::scoped_lock lock(summaries_mutex_);
        summaries_.push_back(summaryOf(*result));
    }
    const auto now = std::chrono::steady_clock::now();
    if (now - last_shown_ < std::chrono::milliseconds(1000 / kFramesPerSecond)) {
        held_result_ = result;
        held_frame_ = frame;
        return;
    }
    last_shown_ = now;
    held_result_.reset();
    show(result, frame);
    tell();
}

void LiveFeed::onProgress(const RunProgress& progress) {
    progress_.put(progress);
}

void LiveFeed::flush() {
    if (held_result_) show(std::exchange(held_result_, nullptr), std::exchange(held_frame_, {}));
    tell();
}

void LiveFeed::show(const std::shared_ptr<const FrameResult>& result, const Frame& frame) {
    ViewFrame view;
    view.index = result->motion.frame;
    view.time_us = result->motion.time_us;
    view.image = imageForDisplay(frame.colour.empty() ? frame.gray : frame.colour);
    view.result = result;
    view.trails = history_.trails();
    mailbox_.put(std::move(view));
}

void LiveFeed::tell() {
    if (!told_.exchange(true)) notify_();
}

std::vector<FrameSummary> LiveFeed::takeSummaries() {
    const std::scoped_lock lock(summaries_mutex_);
    return std::exchange(summaries_, {});
}

}  // namespace eyrie::ui
