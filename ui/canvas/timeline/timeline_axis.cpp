#include "canvas/timeline/timeline_axis.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <limits>

namespace eyrie::ui {

void TimelineAxis::setFrameCount(int count) {
    if (count == count_) return;
    count_ = std::max(0, count);
    showAll();
}

void TimelineAxis::extend(int count) {
    const bool all = showsAll();
    count_ = std::max(count_, count);
    if (all) showAll();
}

void TimelineAxis::setSpan(double left, double width) {
    const bool all = showsAll();
    left_ = left;
    width_ = std::max(1.0, width);
    if (all)
        showAll();
    else
        limit();
}

bool TimelineAxis::showsAll() const {
    return count_ == 0 || pixels_per_frame_ * count_ <= width_ + 1e-6;
}

FrameIndex TimelineAxis::frameAt(double x) const {
    if (count_ == 0) return 0;
    const double frame = std::floor((x - left_) / pixels_per_frame_ + first_);
    return static_cast<FrameIndex>(std::clamp(frame, 0.0, count_ - 1.0));
}

FrameIndex TimelineAxis::firstVisible() const {
    return frameAt(left_);
}

FrameIndex TimelineAxis::lastVisible() const {
    return frameAt(left_ + width_);
}

void TimelineAxis::showAll() {
    first_ = 0;
    pixels_per_frame_ = count_ > 0 ? width_ / count_ : 1;
}

void TimelineAxis::showFrames(FrameIndex first, FrameIndex last) {
    if (count_ == 0) return;
    const double smallest = width_ / count_;
    pixels_per_frame_ =
        std::clamp(width_ / std::max(1, last - first + 1), smallest, std::max(smallest, kMaxPixelsPerFrame));
    first_ = (first + last + 1) / 2.0 - width_ / pixels_per_frame_ / 2;
    limit();
}

void TimelineAxis::zoomAround(double x, double factor) {
    if (count_ == 0) return;
    const double frame = (x - left_) / pixels_per_frame_ + first_;
    const double smallest = width_ / count_;
    pixels_per_frame_ = std::clamp(pixels_per_frame_ * factor, smallest, std::max(smallest, kMaxPixelsPerFrame));
    first_ = frame - (x - left_) / pixels_per_frame_;
    limit();
}

void TimelineAxis::panBy(double pixels) {
    first_ -= pixels / pixels_per_frame_;
    limit();
}

void TimelineAxis::reveal(FrameIndex frame) {
    const double shown = width_ / pixels_per_frame_;
    if (frame < first_)
        first_ = frame;
    else if (frame + 1 > first_ + shown)
        first_ = frame + 1 - shown;
    limit();
}

void TimelineAxis::limit() {
    if (count_ == 0) return;
    pixels_per_frame_ = std::max(pixels_per_frame_, width_ / count_);
    const double shown = width_ / pixels_per_frame_;
    first_ = std::clamp(first_, 0.0, std::max(0.0, count_ - shown));
}

std::vector<TimelineTick> TimelineAxis::ticks(const std::vector<std::int64_t>& times_us, double min_gap_px,
                                              std::int64_t shift_us) const {
    if (count_ < 2 || times_us.size() != static_cast<size_t>(count_)) return {};
    const FrameIndex first = firstVisible();
    const FrameIndex last = lastVisible();
    const double shown_us =
        static_cast<double>(times_us[static_cast<size_t>(last)] - times_us[static_cast<size_t>(first)]);
    const double shown_px = (last - first) * pixels_per_frame_;
    if (shown_us <= 0 || shown_px <= 0) return {};
    const double wanted_us = shown_us / shown_px * min_gap_px;
    constexpr std::array<double, 17> steps_s{0.01, 0.02, 0.05, 0.1, 0.2, 0.5, 1,   2,   5,
                                             10,   20,   30,   60,  120, 300, 600, 1800};
    double step_s = 3600;
    for (const double candidate : steps_s)
        if (candidate * 1e6 >= wanted_us) {
            step_s = candidate;
            break;
        }
    // Five small marks per label, or as many as make round numbers.
    const auto step_us = static_cast<std::int64_t>(std::llround(step_s * 1e6));
    const std::int64_t small_us = std::max<std::int64_t>(1, step_us / 5);
    std::vector<TimelineTick> result;
    double free_from = -std::numeric_limits<double>::infinity();
    FrameIndex frame = first;
    for (std::int64_t time = (times_us[static_cast<size_t>(first)] + shift_us) / small_us * small_us - shift_us;
         time <= times_us[static_cast<size_t>(last)]; time += small_us) {
        while (frame < last && times_us[static_cast<size_t>(frame) + 1] <= time) ++frame;
        const std::int64_t from = times_us[static_cast<size_t>(frame)];
        if (time < from) continue;
        const bool has_next = frame + 1 < count_;
        const std::int64_t length = has_next ? times_us[static_cast<size_t>(frame) + 1] - from : 0;
        const double part = length > 0 ? static_cast<double>(time - from) / static_cast<double>(length) : 0;
        const double x = xOf(frame + part);
        // Where pictures are missing much time passes on a few pixels.
        const bool labelled = (time + shift_us) % step_us == 0 && x >= free_from;
        if (labelled) free_from = x + min_gap_px - 1;
        result.push_back({x, time, labelled});
    }
    return result;
}

}  // namespace eyrie::ui
