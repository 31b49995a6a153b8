#include "core/review/seen_frames.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace eyrie {
namespace {

/// Farther apart in the video, two frames were not played but jumped to.
constexpr double kLongestStep_s = 0.5;
/// So long speeds are measured.
constexpr double kMeasured_s = 0.5;
/// A clock that is asked at each frame is not exact.
constexpr double kClockSlack = 0.05;

}  // namespace

std::vector<FrameSpan> mergedSpans(std::vector<FrameSpan> spans) {
    std::erase_if(spans, [](const FrameSpan& span) { return span.last < span.first; });
    std::sort(spans.begin(), spans.end(), [](const FrameSpan& a, const FrameSpan& b) { return a.first < b.first; });
    std::vector<FrameSpan> merged;
    for (const FrameSpan& span : spans) {
        if (!merged.empty() && span.first <= merged.back().last + 1) {
            merged.back().last = std::max(merged.back().last, span.last);
        } else {
            merged.push_back(span);
        }
    }
    return merged;
}

std::int64_t framesIn(const std::vector<FrameSpan>& merged) {
    std::int64_t frames = 0;
    for (const FrameSpan& span : merged) frames += span.last - span.first + 1;
    return frames;
}

double seenShare(const std::vector<FrameSpan>& merged, FrameSpan all) {
    if (all.last < all.first) return 0;
    std::int64_t seen = 0;
    for (const FrameSpan& span : merged) {
        seen += std::max(0, std::min(span.last, all.last) - std::max(span.first, all.first) + 1);
    }
    return static_cast<double>(seen) / (static_cast<double>(all.last) - all.first + 1);
}

bool SeenRecorder::measure(double wall_s) {
    const double passed = wall_s - stretch_->begun_s;
    if (passed < kMeasured_s) return false;
    if (stretch_->way_s <= kFastestSeen * passed * (1 + kClockSlack)) seen_.push_back(stretch_->span);
    return true;
}

void SeenRecorder::show(FrameIndex frame, double video_s, double wall_s) {
    const auto begin = [&] { stretch_ = Stretch{{frame, frame}, wall_s, 0, video_s, frame, wall_s}; };
    if (!stretch_) return begin();
    const double step = std::abs(video_s - stretch_->at_s);
    const bool stood = wall_s - stretch_->shown_s > kMeasured_s;
    if (step > kLongestStep_s || (stood && std::abs(frame - stretch_->at) > 1)) {
        // The frame that was shown until now may have been looked at for long.
        measure(wall_s);
        return begin();
    }
    stretch_->way_s += step;
    stretch_->at_s = video_s;
    stretch_->at = frame;
    stretch_->shown_s = wall_s;
    stretch_->span = {std::min(stretch_->span.first, frame), std::max(stretch_->span.last, frame)};
    if (measure(wall_s)) begin();
}

void SeenRecorder::interrupt(double wall_s) {
    if (stretch_) measure(wall_s);
    stretch_.reset();
}

std::vector<FrameSpan> SeenRecorder::take() {
    return mergedSpans(std::exchange(seen_, {}));
}

}  // namespace eyrie
