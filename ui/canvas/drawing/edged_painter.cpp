#include "canvas/drawing/edged_painter.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace eyrie::ui {

namespace {

std::array<QPointF, 4> cornersInView(const OrientedBox& box, const ViewTransform& transform) {
    std::array<QPointF, 4> corners;
    const auto in_image = box.corners();
    for (size_t i = 0; i < corners.size(); ++i)
        corners[i] = transform.viewFromImage(QPointF(in_image[i].x, in_image[i].y));
    return corners;
}

bool touches(const std::array<QPointF, 4>& corners, const QRectF& view) {
    double left = corners[0].x(), right = left, top = corners[0].y(), bottom = top;
    for (const QPointF& corner : corners) {
        left = std::min(left, corner.x());
        right = std::max(right, corner.x());
        top = std::min(top, corner.y());
        bottom = std::max(bottom, corner.y());
    }
    return right >= view.left() && left <= view.right() && bottom >= view.top() && top <= view.bottom();
}

void drawFast(QPainter& painter, const QVector<QLineF>& lines, const LineLook& look) {
    painter.setRenderHint(QPainter::Antialiasing, false);
    painter.translate(1, 1);
    painter.setPen(QPen(look.edge, 0));
    painter.drawLines(lines);
    painter.translate(-1, -1);
    painter.setPen(QPen(look.colour, 0));
    painter.drawLines(lines);
    painter.setRenderHint(QPainter::Antialiasing, true);
}

}  // namespace

void drawEdgedLines(QPainter& painter, const QVector<QLineF>& lines, const LineLook& look) {
    if (lines.isEmpty()) return;
    if (lines.size() > kFastLines) {
        drawFast(painter, lines, look);
        return;
    }
    // The rim under a dashed line stays solid: gaps then read as dark, not as background.
    QPen pen(look.edge, look.width + 1.3, Qt::SolidLine, Qt::FlatCap);
    painter.setPen(pen);
    painter.drawLines(lines);
    pen = QPen(look.colour, look.width, look.style, look.style == Qt::SolidLine ? Qt::SquareCap : Qt::FlatCap);
    painter.setPen(pen);
    painter.drawLines(lines);
}

void drawEdgedDots(QPainter& painter, const QVector<QPointF>& centres, double size, const QColor& colour,
                   const QColor& edge) {
    if (centres.isEmpty()) return;
    // In whole screen pixels, which is many times faster than anything else.
    const QTransform screen_from_view = painter.combinedTransform();
    const int side = std::max(1, static_cast<int>(std::lround(size * screen_from_view.m11())));
    painter.save();
    painter.resetTransform();
    painter.setRenderHint(QPainter::Antialiasing, false);
    painter.setPen(Qt::NoPen);
    QVector<QRect> squares(centres.size());
    const auto drawSquares = [&](int grown, const QColor& fill) {
        for (qsizetype i = 0; i < centres.size(); ++i) {
            const QPointF centre = screen_from_view.map(centres[i]);
            squares[i] = QRect(static_cast<int>(std::floor(centre.x() - side / 2.0 + 0.5)) - grown,
                               static_cast<int>(std::floor(centre.y() - side / 2.0 + 0.5)) - grown, side + 2 * grown,
                               side + 2 * grown);
        }
        painter.setBrush(fill);
        painter.drawRects(squares);
    };
    drawSquares(1, edge);
    drawSquares(0, colour);
    painter.restore();
}

void appendBox(QVector<QLineF>& lines, const OrientedBox& box, const ViewTransform& transform, const QRectF& view) {
    const auto corners = cornersInView(box, transform);
    if (!touches(corners, view)) return;
    for (size_t i = 0; i < corners.size(); ++i) lines.append({corners[i], corners[(i + 1) % corners.size()]});
}

void appendHeading(QVector<QLineF>& lines, const OrientedBox& box, const ViewTransform& transform, const QRectF& view) {
    const cv::Point2d front = box.toImage({box.length / 2, 0});
    const QPointF from = transform.viewFromImage(QPointF(front.x, front.y));
    if (!view.contains(from)) return;
    const cv::Point2d direction = box.direction();
    const QPointF ahead = transform.viewVector({direction.x, direction.y}, {box.centre.x, box.centre.y});
    const double scale = std::hypot(ahead.x(), ahead.y());
    const double length = std::clamp(box.length * scale * 0.25, 5.0, 14.0);
    lines.append({from, from + ahead / scale * length});
}

}  // namespace eyrie::ui
