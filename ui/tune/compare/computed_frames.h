#pragma once

#include <map>
#include <memory>
#include <mutex>

#include "canvas/view_frame.h"
#include "core/values/frame_result.h"

namespace eyrie::ui {

/// Frames that are computed on one thread while they are looked at on another.
class ComputedFrames {
 public:
    explicit ComputedFrames(int trail_length) : trail_length_(trail_length) {}

    void add(const std::shared_ptr<const FrameResult>& result);
    void replace(const std::map<FrameIndex, std::shared_ptr<const FrameResult>>& results);

    /// Fills result, trails and, if it has none, time; leaves the frame as it is when it was not computed yet.
    void addTo(ViewFrame& frame) const;

 private:
    int trail_length_;
    mutable std::mutex mutex_;
    std::map<FrameIndex, std::shared_ptr<const FrameResult>> results_;
};

}  // namespace eyrie::ui
