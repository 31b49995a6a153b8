#pragma once

#include <QColor>
#include <QLineF>
#include <QPainter>
#include <QVector>

#include "canvas/view_transform.h"
#include "core/geometry/oriented_box.h"

namespace eyrie::ui {

/// How a batch of lines looks.
struct LineLook {
    QColor colour;
    QColor edge;
    double width = 1.6;  ///< logical px
    Qt::PenStyle style = Qt::SolidLine;
};

/// Above this many lines a batch is drawn without antialiasing, with a shadow instead of a rim: five times faster.
inline constexpr int kFastLines = 6000;

/// Draws all lines with a thin dark rim, in two passes over the batch.
void drawEdgedLines(QPainter& painter, const QVector<QLineF>& lines, const LineLook& look);

/// Draws dots of `size` logical px with a thin dark rim.
void drawEdgedDots(QPainter& painter, const QVector<QPointF>& centres, double size, const QColor& colour,
                   const QColor& edge);

/// Appends the four sides of a box; nothing when it lies outside `view`.
void appendBox(QVector<QLineF>& lines, const OrientedBox& box, const ViewTransform& transform, const QRectF& view);

/// Appends the short line from the centre through the front that shows where a box is heading.
void appendHeading(QVector<QLineF>& lines, const OrientedBox& box, const ViewTransform& transform, const QRectF& view);

}  // namespace eyrie::ui
