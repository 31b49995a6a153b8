#pragma once

#include <algorithm>
#include <chrono>

#include "chain/scale/scale_estimation.h"

namespace eyrie {

/// Tells how far a look at the video before a run is. `told` may be empty.
class LookProgress {
 public:
    LookProgress(const ScaleProgress& told, int frames_total) : told_(told) {
        progress_.estimating_scale = true;
        progress_.frames_total = frames_total;
    }

    /// Another frame is done.
    void step() {
        if (!told_) return;
        const std::chrono::duration<double> passed = std::chrono::steady_clock::now() - begin_;
        ++progress_.frames_done;
        progress_.frames_per_second = progress_.frames_done / std::max(passed.count(), 1e-6);
        progress_.seconds_left = (progress_.frames_total - progress_.frames_done) / progress_.frames_per_second;
        told_(progress_);
    }

 private:
    const ScaleProgress& told_;
    RunProgress progress_;
    std::chrono::steady_clock::time_point begin_ = std::chrono::steady_clock::now();
};

}  // namespace eyrie
