#include "tune/compare/computed_frames.h"

#include <vector>

#include "session/frames/trail_history.h"

namespace eyrie::ui {

void ComputedFrames::add(const std::shared_ptr<const FrameResult>& result) {
    const std::scoped_lock lock(mutex_);
    results_[result->motion.frame] = result;
}

void ComputedFrames::replace(const std::map<FrameIndex, std::shared_ptr<const FrameResult>>& results) {
    const std::scoped_lock lock(mutex_);
    results_ = results;
}

void ComputedFrames::addTo(ViewFrame& frame) const {
    std::vector<std::shared_ptr<const FrameResult>> before;  // and the frame itself
    {
        const std::scoped_lock lock(mutex_);
        if (!results_.contains(frame.index)) return;
        const auto end = results_.upper_bound(frame.index);
        for (auto at = results_.lower_bound(frame.index - trail_length_ + 1); at != end; ++at)
            before.push_back(at->second);
    }
    frame.result = before.back();
    if (frame.image.isNull()) frame.time_us = frame.result->motion.time_us;
    TrailHistory history(trail_length_);
    for (const auto& result : before) history.add(*result);
    frame.trails = history.trails();
}

}  // namespace eyrie::ui
