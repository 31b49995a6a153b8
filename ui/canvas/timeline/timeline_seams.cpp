#include "canvas/timeline/timeline_seams.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace eyrie::ui {

TimelineSeams::TimelineSeams(std::vector<FrameIndex> frames) : frames_(std::move(frames)) {
    std::sort(frames_.begin(), frames_.end());
}

std::vector<double> TimelineSeams::places(const TimelineAxis& axis) const {
    std::vector<double> places;
    const auto first = std::lower_bound(frames_.begin(), frames_.end(), axis.firstVisible());
    for (auto frame = first; frame != frames_.end() && *frame <= axis.lastVisible(); ++frame) {
        const double x = std::floor(axis.xOf(*frame)) + 0.5;
        if (x < axis.left() || x > axis.right()) continue;
        if (places.empty() || x - places.back() >= kLeastGap) places.push_back(x);
    }
    return places;
}

}  // namespace eyrie::ui
