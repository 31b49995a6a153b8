#include "canvas/timeline/timeline_activity.h"

#include <QPainter>
#include <QPainterPath>
#include <algorithm>

#include "widgets/theme_colours.h"

namespace eyrie::ui {

TimelineActivity::TimelineActivity(const std::vector<TimelineFrame>& frames, const OverlayColours& colours,
                                   const QPalette& palette)
    : frames_(frames), colours_(colours), palette_(palette) {
    for (const TimelineFrame& frame : frames) {
        most_tracks_ = std::max(most_tracks_, frame.tracks);
        most_vectors_ = std::max(most_vectors_, frame.motion_vectors);
    }
}

void TimelineActivity::paint(QPainter& painter, const QRectF& row, const TimelineAxis& axis) const {
    painter.fillRect(row, palette_.color(QPalette::Base));
    const FrameIndex first = axis.firstVisible();
    const FrameIndex last = std::min(axis.lastVisible(), static_cast<FrameIndex>(frames_.size()) - 1);
    QPainterPath tracks;
    QPainterPath vectors;
    bool drawing = false;
    const auto close = [&](FrameIndex before) {
        if (!drawing) return;
        tracks.lineTo(axis.xOf(before), row.bottom());
        drawing = false;
    };
    for (FrameIndex f = first; f <= last; ++f) {
        const TimelineFrame& frame = frames_[static_cast<size_t>(f)];
        if (!frame.done) {
            close(f);
            continue;
        }
        const double track_y = row.bottom() - (row.height() - 3) * frame.tracks / most_tracks_;
        const double vector_y = row.bottom() - (row.height() - 3) * frame.motion_vectors / most_vectors_;
        if (!drawing) {
            tracks.moveTo(axis.xOf(f), row.bottom());
            tracks.lineTo(axis.xOf(f), track_y);
            vectors.moveTo(axis.centreOf(f), vector_y);
            drawing = true;
        }
        tracks.lineTo(axis.xOf(f), track_y);
        tracks.lineTo(axis.xOf(f + 1), track_y);
        vectors.lineTo(axis.centreOf(f), vector_y);
    }
    close(last + 1);
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
