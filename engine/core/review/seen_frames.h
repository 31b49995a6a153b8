#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "core/values/ids.h"

/// Which frames of a video somebody has watched.
namespace eyrie {

/// Frames from the first to the last, both included.
struct FrameSpan {
    FrameIndex first = 0;
    FrameIndex last = 0;

    bool operator==(const FrameSpan&) const = default;
};

/// The same frames in as few spans as possible, ascending. Spans that hold no frame are left out.
std::vector<FrameSpan> mergedSpans(std::vector<FrameSpan> spans);
/// Frames in merged spans.
std::int64_t framesIn(const std::vector<FrameSpan>& merged);
/// Share, 0 … 1, of the frames of `all` that are in merged spans; 0 where `all` holds none.
double seenShare(const std::vector<FrameSpan>& merged, FrameSpan all);

/// Nothing that runs faster counts as seen: seconds of the video in one second.
inline constexpr double kFastestSeen = 4;

/// Tells from the frames that a window shows which of them were watched: frames between those that were shown count,
/// too, where time in the video did not pass faster than kFastestSeen, measured over half a second, and did not leap.
/// After a picture that stood for as long as that, only the next frame joins it: going from event to event is no
/// playing.
class SeenRecorder {
 public:
    /// A frame is shown at `video_s` in the video, at `wall_s` by a steady clock; not to be called while the window is
    /// behind another.
    void show(FrameIndex frame, double video_s, double wall_s);
    /// The window goes behind another, is closed, or will show another video.
    void interrupt(double wall_s);
    /// What was seen since this was asked last, merged.
    std::vector<FrameSpan> take();

 private:
    /// What was shown since the speed was measured last.
    struct Stretch {
        FrameSpan span;
        double begun_s = 0;  ///< by the steady clock
        double way_s = 0;    ///< in the video, back and forth
        double at_s = 0;     ///< in the video, the newest frame
        FrameIndex at = 0;   ///< the newest frame
        double shown_s = 0;  ///< by the steady clock, when the newest frame came
    };
    /// Counts the stretch if it was slow; false while it is too short to tell.
    bool measure(double wall_s);

    std::optional<Stretch> stretch_;
    std::vector<FrameSpan> seen_;
};

}  // namespace eyrie
