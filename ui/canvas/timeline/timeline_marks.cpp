#include "canvas/timeline/timeline_marks.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace eyrie::ui {

namespace {

auto firstFrom(const std::vector<TimelineMark>& marks, FrameIndex frame) {
    return std::lower_bound(marks.begin(), marks.end(), frame,
                            [](const TimelineMark& mark, FrameIndex wanted) { return mark.frame < wanted; });
}

}  // namespace

TimelineMarks::TimelineMarks(std::vector<TimelineMark> marks) : marks_(std::move(marks)) {
    std::stable_sort(marks_.begin(), marks_.end(),
                     [](const TimelineMark& a, const TimelineMark& b) { return a.frame < b.frame; });
    for (std::size_t i = 0; i < marks_.size(); ++i) places_[marks_[i].id] = i;
}

const TimelineMark* TimelineMarks::find(int id) const {
    const auto place = places_.find(id);
    return place == places_.end() ? nullptr : &marks_[place->second];
}

std::vector<TimelineMarks::Stroke> TimelineMarks::strokes(const TimelineAxis& axis) const {
    std::vector<Stroke> strokes;
    const FrameIndex last = axis.lastVisible();
    int weight = 0;
    for (auto mark = firstFrom(marks_, axis.firstVisible()); mark != marks_.end() && mark->frame <= last; ++mark) {
        const double x = std::floor(axis.centreOf(mark->frame));
        if (strokes.empty() || strokes.back().x != x) {
            strokes.push_back({x, mark->colour});
            weight = mark->weight;
        } else if (mark->weight > weight) {
            strokes.back().colour = mark->colour;
            weight = mark->weight;
        }
    }
    return strokes;
}

const TimelineMark* TimelineMarks::nearest(double x, const TimelineAxis& axis, double reach) const {
    const TimelineMark* best = nullptr;
    double best_far = reach;
    const FrameIndex last = axis.frameAt(x + reach);
    for (auto mark = firstFrom(marks_, axis.frameAt(x - reach)); mark != marks_.end() && mark->frame <= last; ++mark) {
        const double far = std::abs(std::floor(axis.centreOf(mark->frame)) + 0.5 - x);
        if (far > best_far || (best != nullptr && far == best_far && mark->weight <= best->weight)) continue;
        best = &*mark;
        best_far = far;
    }
    return best;
}

}  // namespace eyrie::ui
