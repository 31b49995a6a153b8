// How the rows of the timeline are drawn.
#include <QPainter>
#include <QPolygonF>
#include <algorithm>
#include <cmath>

#include "canvas/timeline/timeline_view.h"
#include "widgets/theme_colours.h"

namespace eyrie::ui {

namespace {
constexpr double kWatchedBar = 4;
constexpr double kLabelGap = 80;  ///< px from one time on the ruler to the next, at least
}  // namespace

void TimelineView::paintEvent(QPaintEvent*) {
    QPainter painter(this);
    painter.fillRect(rect(), palette().window());
    if (axis_.frameCount() == 0) return;
    const Rows row = rows();
    const TimelineActivity curves = activity();
    paintNames(painter, row, curves);
    paintRuler(painter, row.ruler);
    painter.save();
    painter.setClipRect(QRectF(axis_.left() - 1, 0, axis_.right() - axis_.left() + 2, height()));
    paintQuality(painter, row.quality);
    if (!brief_) {
        paintMarks(painter, row.marks);
        paintKinds(painter, row.kinds);
        paintWatched(painter, row.watched);
        curves.paint(painter, row.activity, axis_);
        paintTrackLife(painter, row.track);
    }
    paintSeams(painter);
    painter.restore();
    paintCursor(painter);
}

void TimelineView::paintNames(QPainter& painter, const Rows& row, const TimelineActivity& curves) const {
    painter.setPen(palette().color(QPalette::PlaceholderText));
    const auto name = [&](const QRectF& beside, const QString& text) {
        painter.drawText(QRectF(8, beside.top(), axis_.left() - 16, beside.height()), Qt::AlignVCenter | Qt::AlignRight,
                         fontMetrics().elidedText(text, Qt::ElideRight, static_cast<int>(axis_.left()) - 16));
    };
    name(row.ruler, utc_at_ ? tr("Time (UTC)") : tr("Time"));
    name(row.quality, tr("Registration"));
    if (brief_) return;
    if (!marks_.empty())
        name(row.marks, kinds_.empty() ? marks_name_
                        : kinds_shown_ ? QStringLiteral("▾ ") + marks_name_
                                       : QStringLiteral("▸ ") + marks_name_);
    if (row.kinds.height() >= fontMetrics().height()) name(row.kinds, tr("by kind"));
    if (watched_) name(row.watched, tr("Watched"));
    if (frames_.empty()) {
        name(row.activity, tr("Activity"));
    } else {
        // Name, colour and height of both curves.
        const double half = row.activity.height() / 2;
        painter.setPen(curves.trackColour());
        name(row.activity.adjusted(0, 0, 0, -half), tr("tracks (max %1)").arg(curves.mostTracks()));
        painter.setPen(curves.vectorColour());
        name(row.activity.adjusted(0, half, 0, 0), tr("vectors (max %1)").arg(curves.mostVectors()));
        painter.setPen(palette().color(QPalette::PlaceholderText));
    }
    name(row.track, track_life_ ? track_name_ : tr("Selected"));
}

void TimelineView::paintRuler(QPainter& painter, const QRectF& row) const {
    // Round times of the day, as they are where the view begins.
    const std::int64_t begin_us = times_us_[static_cast<size_t>(axis_.firstVisible())];
    const auto begin_utc_us = utc_at_ ? utc_at_(begin_us) : std::nullopt;
    const auto ticks = axis_.ticks(times_us_, kLabelGap, begin_utc_us.value_or(begin_us) - begin_us);
    const QColor text = palette().color(QPalette::WindowText);
    QColor faint = text;
    faint.setAlphaF(0.35F);
    std::int64_t step = 1'000'000;
    std::int64_t previous = -1;
    for (const TimelineTick& tick : ticks) {
        if (!tick.labelled) continue;
        if (previous >= 0) step = std::min(step, tick.time_us - previous);
        previous = tick.time_us;
    }
    const int decimals = step >= 1'000'000 ? 0 : step >= 100'000 ? 1 : 2;
    for (const TimelineTick& tick : ticks) {
        const double x = std::floor(tick.x) + 0.5;
        painter.setPen(faint);
        painter.drawLine(QLineF(x, row.bottom() - (tick.labelled ? 7 : 3), x, row.bottom()));
        if (!tick.labelled) continue;
        const QString label = rulerText(tick.time_us, decimals);
        const double label_width = fontMetrics().horizontalAdvance(label);
        if (x + 3 + label_width > row.right()) continue;
        painter.setPen(text);
        painter.drawText(QPointF(x + 3, row.bottom() - 6), label);
    }
}

void TimelineView::paintQuality(QPainter& painter, const QRectF& row) const {
    painter.fillRect(row, palette().color(QPalette::Base));
    if (run_range_) {
        const double from = axis_.xOf(run_range_->first);
        const double to = axis_.xOf(run_range_->second + 1);
        painter.fillRect(QRectF(from, row.top(), to - from, row.height()),
                         QBrush(palette().color(QPalette::Mid), Qt::BDiagPattern));
    }
    // One bar per frame, or per screen column with the worst frame in it. Its height says how many corners agree.
    const FrameIndex last = std::min(axis_.lastVisible(), static_cast<FrameIndex>(frames_.size()) - 1);
    FrameIndex frame = axis_.firstVisible();
    while (frame <= last) {
        const double left = std::floor(axis_.xOf(frame));
        FrameIndex end = frame + 1;
        while (end <= last && std::floor(axis_.xOf(end)) <= left) ++end;
        const TimelineFrame* worst = nullptr;
        for (FrameIndex f = frame; f < end; ++f) {
            const TimelineFrame& candidate = frames_[static_cast<size_t>(f)];
            if (candidate.done && (worst == nullptr || badness(candidate) > badness(*worst))) worst = &candidate;
        }
        if (worst != nullptr) {
            const double right = std::floor(axis_.xOf(end));
            const double gap = axis_.pixelsPerFrame() > 6 ? 1 : 0;
            const bool measured = worst->state == RegistrationState::registered && worst->corners > 0;
            const double share =
                measured ? std::clamp(worst->inliers / static_cast<double>(worst->corners), 0.25, 1.0) : 1;
            const double height = std::round(row.height() * share);
            painter.fillRect(QRectF(left, row.bottom() - height, std::max(1.0, right - left - gap), height),
                             qualityColour(*worst));
        }
        frame = end;
    }
}

void TimelineView::paintMarks(QPainter& painter, const QRectF& row) const {
    if (marks_.empty()) return;
    painter.fillRect(row, palette().color(QPalette::Base));
    for (const TimelineMarks::Stroke& stroke : marks_.strokes(axis_))
        painter.fillRect(QRectF(stroke.x - 1, row.top() + 1, TimelineMarks::kStrokeWidth, row.height() - 2),
                         stroke.colour);
}

void TimelineView::paintKinds(QPainter& painter, const QRectF& row) const {
    for (int i = 0; kinds_shown_ && i < kinds_.rowCount(); ++i) {
        const double top = row.top() + i * TimelineKinds::kRowStep;
        painter.fillRect(QRectF(row.left(), top, row.width(), TimelineKinds::kRowHeight),
                         palette().color(QPalette::Base));
        const QColor colour = kinds_.colourOf(i, palette());
        for (const auto& [from, to] : kinds_.bars(i, axis_))
            for (const QRectF& part :
                 filledParts(kinds_.shapeOf(i), QRectF(from, top, to - from, TimelineKinds::kRowHeight)))
                painter.fillRect(part, colour);
    }
}

void TimelineView::paintWatched(QPainter& painter, const QRectF& row) const {
    if (!watched_) return;
    const QRectF bar(row.left(), row.center().y() - kWatchedBar / 2, row.width(), kWatchedBar);
    painter.fillRect(bar, palette().color(QPalette::Base));
    const QColor colour = blend(palette().color(QPalette::WindowText), palette().color(QPalette::Base), 0.4);
    for (const FrameSpan& span : *watched_) {
        if (span.last < axis_.firstVisible() || span.first > axis_.lastVisible()) continue;
        const double from = axis_.xOf(span.first);
        painter.fillRect(QRectF(from, bar.top(), std::max(1.0, axis_.xOf(span.last + 1) - from), bar.height()), colour);
    }
}

void TimelineView::paintTrackLife(QPainter& painter, const QRectF& row) const {
    painter.fillRect(row, palette().color(QPalette::Base));
    if (!track_life_) return;
    const double from = axis_.xOf(track_life_->first);
    const double to = axis_.xOf(track_life_->second + 1);
    painter.setRenderHint(QPainter::Antialiasing);
    painter.setPen(Qt::NoPen);
    painter.setBrush(blend(colours_.track, palette().color(QPalette::Base), 0.25));
    painter.drawRoundedRect(QRectF(from, row.top() + 2, std::max(2.0, to - from), row.height() - 4), 3, 3);
    painter.setBrush(Qt::NoBrush);
    painter.setRenderHint(QPainter::Antialiasing, false);
}

void TimelineView::paintSeams(QPainter& painter) const {
    QPen pen(palette().color(QPalette::WindowText), 1);
    pen.setDashPattern({3, 3});
    painter.setPen(pen);
    for (const double x : seams_.places(axis_)) painter.drawLine(QLineF(x, kRulerHeight - 7, x, height() - 2));
}

void TimelineView::paintCursor(QPainter& painter) const {
    const double x = std::floor(axis_.centreOf(current_)) + 0.5;
    if (x < axis_.left() - 1 || x > axis_.right() + 1) return;
    const QColor colour = palette().color(QPalette::Highlight);
    if (axis_.pixelsPerFrame() > 3) {
        QColor cell = colour;
        cell.setAlphaF(0.25F);
        painter.fillRect(QRectF(axis_.xOf(current_), kRulerHeight, axis_.pixelsPerFrame(), height() - kRulerHeight),
                         cell);
    }
    painter.setPen(QPen(colour, 1));
    painter.drawLine(QLineF(x, kRulerHeight - 4, x, height()));
    painter.setRenderHint(QPainter::Antialiasing);
    painter.setPen(Qt::NoPen);
    painter.setBrush(colour);
    painter.drawPolygon(
        QPolygonF({QPointF(x - 5, kRulerHeight - 9), QPointF(x + 5, kRulerHeight - 9), QPointF(x + 5, kRulerHeight - 5),
                   QPointF(x, kRulerHeight), QPointF(x - 5, kRulerHeight - 5)}));
    painter.setRenderHint(QPainter::Antialiasing, false);
}

}  // namespace eyrie::ui
