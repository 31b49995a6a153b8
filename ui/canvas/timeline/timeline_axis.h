#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/values/ids.h"

namespace eyrie::ui {

/// A mark on the ruler.
struct TimelineTick {
    double x = 0;
    std::int64_t time_us = 0;
    bool labelled = false;
};

/// The map between frames and the horizontal place on the timeline. Arithmetic only. Frame f covers [f, f + 1).
class TimelineAxis {
 public:
    static constexpr double kMaxPixelsPerFrame = 40;

    /// Frames 0 … count − 1. Shows all of them when the count changed.
    void setFrameCount(int count);
    /// The same frames and some behind them: all are shown if all were shown, else the same ones.
    void extend(int count);
    /// Where frames are drawn, logical px.
    void setSpan(double left, double width);

    int frameCount() const { return count_; }
    double left() const { return left_; }
    double right() const { return left_ + width_; }
    double pixelsPerFrame() const { return pixels_per_frame_; }
    bool showsAll() const;

    /// Left edge of a frame's cell.
    double xOf(double frame) const { return left_ + (frame - first_) * pixels_per_frame_; }
    double centreOf(FrameIndex frame) const { return xOf(frame + 0.5); }
    /// The frame under x, limited to existing ones; 0 when there is none.
    FrameIndex frameAt(double x) const;
    /// First and last frame of which a part is visible.
    FrameIndex firstVisible() const;
    FrameIndex lastVisible() const;

    void showAll();
    /// Shows these frames as large as they fit, and others beside them where they are few.
    void showFrames(FrameIndex first, FrameIndex last);
    /// The frame under `x` stays there.
    void zoomAround(double x, double factor);
    void panBy(double pixels);
    /// Scrolls so that a frame is visible.
    void reveal(FrameIndex frame);

    /// Marks at round times (1, 2, 5 × 10ⁿ, or minutes), labelled at least `min_gap_px` apart. `times_us` holds each
    /// frame's presentation time, ascending, one per frame. The times that are round are those plus `shift_us`.
    std::vector<TimelineTick> ticks(const std::vector<std::int64_t>& times_us, double min_gap_px,
                                    std::int64_t shift_us = 0) const;

 private:
    void limit();

    int count_ = 0;
    double left_ = 0;
    double width_ = 1;
    double first_ = 0;  ///< frame at the left edge
    double pixels_per_frame_ = 1;
};

}  // namespace eyrie::ui
