#include "canvas/timeline/timeline_activity.h"

#include <QPainter>
#include <algorithm>
#include <cmath>

#include "widgets/theme_colours.h"

namespace eyrie::ui {

namespace {

/// What is drawn in one column of pixels.
struct ColumnOfFrames {
    FrameIndex end = 0;  ///< behind its last frame
    bool any = false;    ///< a frame of it is done; the rest is of those
    int most_tracks = 0;
    int most_vectors = 0;
    int fewest_vectors = 0;
};

/// The column that begins with a frame; it has one at least.
ColumnOfFrames columnFrom(FrameIndex first, FrameIndex last, const TimelineAxis& axis,
                          const std::vector<TimelineFrame>& frames) {
    ColumnOfFrames column;
    const double pixel = std::floor(axis.xOf(first));
    for (column.end = first; column.end <= last && (column.end == first || std::floor(axis.xOf(column.end)) <= pixel);
         ++column.end) {
        const TimelineFrame& frame = frames[static_cast<std::size_t>(column.end)];
        if (!frame.done) continue;
        column.most_tracks = std::max(column.most_tracks, frame.tracks);
        column.most_vectors = std::max(column.most_vectors, frame.motion_vectors);
        column.fewest_vectors =
            column.any ? std::min(column.fewest_vectors, frame.motion_vectors) : frame.motion_vectors;
        column.any = true;
    }
    return column;
}

}  // namespace

TimelineActivity::TimelineActivity(const std::vector<TimelineFrame>& frames, const OverlayColours& colours,
                                   const QPalette& palette)
    : frames_(frames), colours_(colours), palette_(palette) {
    for (const TimelineFrame& frame : frames) {
        most_tracks_ = std::max(most_tracks_, frame.tracks);
        most_vectors_ = std::max(most_vectors_, frame.motion_vectors);
    }
}

TimelineActivity::Curves TimelineActivity::curves(const QRectF& row, const TimelineAxis& axis) const {
    Curves curves;
    const FrameIndex last = std::min(axis.lastVisible(), static_cast<FrameIndex>(frames_.size()) - 1);
    bool drawing = false;
    const auto close = [&](double x) {
        if (drawing) curves.tracks.lineTo(x, row.bottom());
        drawing = false;
    };
    const auto y_of = [&](int count, int most) { return row.bottom() - (row.height() - 3) * count / most; };
    for (FrameIndex frame = axis.firstVisible(); frame <= last;) {
        const ColumnOfFrames column = columnFrom(frame, last, axis, frames_);
        const double left = axis.xOf(frame), right = axis.xOf(column.end);
        frame = column.end;
        if (!column.any) {
            close(left);
            continue;
        }
        const double track_y = y_of(column.most_tracks, most_tracks_);
        const double vector_y = y_of(column.most_vectors, most_vectors_);
        const double middle = (left + right) / 2;
        if (!drawing) {
            curves.tracks.moveTo(left, row.bottom());
            curves.vectors.moveTo(middle, vector_y);
            drawing = true;
        }
        curves.tracks.lineTo(left, track_y);
        curves.tracks.lineTo(right, track_y);
        curves.vectors.lineTo(middle, vector_y);
        if (column.fewest_vectors < column.most_vectors)
            curves.vectors.lineTo(middle, y_of(column.fewest_vectors, most_vectors_));
    }
    close(axis.xOf(last + 1));
    return curves;
}

void TimelineActivity::paint(QPainter& painter, const QRectF& row, const TimelineAxis& axis) const {
    painter.fillRect(row, palette_.color(QPalette::Base));
    const auto [tracks, vectors] = curves(row, axis);
    const QColor area = blend(colours_.track, palette_.color(QPalette::Base), 0.45);
    painter.fillPath(tracks, area);
    painter.setRenderHint(QPainter::Antialiasing);
    painter.setPen(QPen(vectorColour(), 1.2));
    painter.drawPath(vectors);
    painter.setRenderHint(QPainter::Antialiasing, false);
}

// The overlays' colours are made for video; on the window's ground they are darkened until they read.
QColor TimelineActivity::trackColour() const {
    return isDark(palette_) ? colours_.track.darker(115) : colours_.track.darker(190);
}

QColor TimelineActivity::vectorColour() const {
    return isDark(palette_) ? colours_.motion_vector.darker(115) : colours_.motion_vector.darker(190);
}

}  // namespace eyrie::ui
