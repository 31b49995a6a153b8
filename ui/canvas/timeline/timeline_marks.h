#pragma once

#include <QColor>
#include <unordered_map>
#include <vector>

#include "canvas/timeline/timeline_axis.h"

namespace eyrie::ui {

/// Something that happened in a frame.
struct TimelineMark {
    int id = 0;
    FrameIndex frame = 0;
    QColor colour;
    int weight = 0;  ///< of several in one place the heaviest is seen
};

/// Marks along a timeline, any number of them: only as many strokes are drawn as fit beside each other.
class TimelineMarks {
 public:
    static constexpr int kStrokeWidth = 3;  ///< px

    struct Stroke {
        double x = 0;  ///< its middle
        QColor colour;
    };

    TimelineMarks() = default;
    explicit TimelineMarks(std::vector<TimelineMark> marks);

    bool empty() const { return marks_.empty(); }
    std::size_t size() const { return marks_.size(); }
    /// Null when there is none of this id.
    const TimelineMark* find(int id) const;
    /// What is to be drawn of the part that the axis shows: at most one stroke a column of pixels.
    std::vector<Stroke> strokes(const TimelineAxis& axis) const;
    /// The mark that is drawn within `reach` px of x and nearest to it; of those in one column the heaviest. Null for
    /// none.
    const TimelineMark* nearest(double x, const TimelineAxis& axis, double reach) const;

 private:
    std::vector<TimelineMark> marks_;  ///< ascending frames
    std::unordered_map<int, std::size_t> places_;
};

}  // namespace eyrie::ui
