#pragma once

#include <vector>

#include "canvas/timeline/timeline_axis.h"

namespace eyrie::ui {

/// Where the parts of a video meet: the first frame of each but the first. Arithmetic only.
class TimelineSeams {
 public:
    static constexpr double kLeastGap = 3;  ///< px between two that are drawn

    TimelineSeams() = default;
    explicit TimelineSeams(std::vector<FrameIndex> frames);

    /// The horizontal places to draw of what the axis shows, ascending; of those too near each other the first.
    std::vector<double> places(const TimelineAxis& axis) const;

 private:
    std::vector<FrameIndex> frames_;  ///< ascending
};

}  // namespace eyrie::ui
