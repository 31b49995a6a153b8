#pragma once

#include <cstdint>

#include "core/values/corner.h"

namespace eyrie {

/// Over how many frames pictures may have moved on, by the video's clock. Pictures that come too soon, as cameras and
/// networks hand them out in bursts, are remembered: the wait before the next burst misses none.
class ClockFollower {
 public:
    explicit ClockFollower(double frame_rate_hz) : frame_rate_hz_(frame_rate_hz) {}

    /// Takes a frame of this time, µs, once it is registered. `repeats_before`: so many before it stood still.
    void next(std::int64_t time_us, const Registration& registration, int repeats_before);
    /// How many frames have passed at most between pictures of two times, µs; 1 where the clock does not tell.
    int mostPassed(std::int64_t from_us, std::int64_t to_us) const;

    /// What is remembered of the frames so far, written or read; see core/state_archive.h.
    template <class Archive>
    void transfer(Archive& archive);

 private:
    double frame_rate_hz_;
    std::int64_t last_time_us_ = 0;
    double ahead_ = 0;  ///< frames, ≥ 0, by which pictures came too soon
};

}  // namespace eyrie
