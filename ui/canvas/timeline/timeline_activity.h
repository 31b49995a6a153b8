#pragma once

#include <QPainterPath>
#include <QPalette>
#include <vector>

#include "canvas/overlay_colours.h"
#include "canvas/timeline/timeline_axis.h"
#include "canvas/timeline/timeline_frame.h"

class QPainter;

namespace eyrie::ui {

/// How much goes on along a timeline: tracks as an area, motion vectors as a line, each as high as its most.
class TimelineActivity {
 public:
    /// `frames` and `colours` must outlive it; `palette` is that of the widget.
    TimelineActivity(const std::vector<TimelineFrame>& frames, const OverlayColours& colours, const QPalette& palette);

    /// The most of any frame, at least 1.
    int mostTracks() const { return most_tracks_; }
    int mostVectors() const { return most_vectors_; }
    QColor trackColour() const;
    QColor vectorColour() const;
    void paint(QPainter& painter, const QRectF& row, const TimelineAxis& axis) const;

    struct Curves {
        QPainterPath tracks;   ///< an area
        QPainterPath vectors;  ///< a line
    };
    /// As they are painted in a row. Frames that share a column of pixels are drawn as one: tracks by the most, vectors
    /// from the most to the fewest. Of an hour, more points would paint for longer than a frame is shown.
    Curves curves(const QRectF& row, const TimelineAxis& axis) const;

 private:
    const std::vector<TimelineFrame>& frames_;
    const OverlayColours& colours_;
    QPalette palette_;
    int most_tracks_ = 1;
    int most_vectors_ = 1;
};

}  // namespace eyrie::ui
