#pragma once

#include <chrono>
#include <deque>

#include "chain/chain_run.h"

namespace eyrie {

/// Frames per second over the last seconds of a run, and how long what is left of it takes.
class ProgressMeter {
 public:
    using Moment = std::chrono::steady_clock::time_point;

    /// `done`: frames of the `total` that were done before.
    ProgressMeter(int total, int done) : total_(total), done_(done) {}

    RunProgress frameDone(Moment now = std::chrono::steady_clock::now()) {
        constexpr std::chrono::seconds kLast(5);
        recent_.push_back(now);
        while (recent_.size() > 2 && now - recent_.front() > kLast) recent_.pop_front();
        RunProgress progress;
        progress.frames_done = ++done_;
        progress.frames_total = total_;
        const double span = std::chrono::duration<double>(recent_.back() - recent_.front()).count();
        if (span > 0) {
            progress.frames_per_second = static_cast<double>(recent_.size() - 1) / span;
            progress.seconds_left = (total_ - done_) / progress.frames_per_second;
        }
        return progress;
    }

 private:
    int total_;
    int done_;
    std::deque<Moment> recent_;
};

}  // namespace eyrie
