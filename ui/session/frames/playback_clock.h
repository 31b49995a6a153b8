#pragma once

#include <cstdint>
#include <vector>

#include "core/values/ids.h"

namespace eyrie::ui {

/// Which frame is due while playing by the video's own time stamps. Arithmetic only; `now_us` is any steady clock.
class PlaybackClock {
 public:
    /// Presentation time per frame, ascending, microseconds. Where the clock leaps ahead nobody waits for it.
    void setTimes(std::vector<std::int64_t> times_us);
    int frameCount() const { return static_cast<int>(times_us_.size()); }

    /// Plays on from `frame`; `speed` 1 is real time, negative runs backwards, never 0.
    void start(FrameIndex frame, double speed, std::int64_t now_us);
    /// The frame due now, limited to the video.
    FrameIndex frameAt(std::int64_t now_us) const;
    /// True when the last frame (the first when going backwards) has been shown for its time.
    bool ended(std::int64_t now_us) const;
    /// How long until another frame is due, microseconds, at least 1000.
    std::int64_t untilNext(std::int64_t now_us) const;

 private:
    double mediaTime(std::int64_t now_us) const;
    std::int64_t lastFrameLength() const;

    std::vector<std::int64_t> times_us_;
    double start_media_us_ = 0;
    std::int64_t start_us_ = 0;
    double speed_ = 1;
};

}  // namespace eyrie::ui
