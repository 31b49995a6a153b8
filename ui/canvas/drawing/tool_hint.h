#pragma once

#include <QPainter>
#include <QRectF>
#include <QString>

#include "canvas/drawing/mark_colours.h"

namespace eyrie::ui {

enum class HintEdge { lower, upper };

/// Says at an edge of a view what the tool at work wants.
inline void paintToolHint(QPainter& painter, const QRectF& view, HintEdge edge, const QString& text) {
    const QRectF room = view.adjusted(20, 15, -20, -15);
    const int flags = Qt::AlignHCenter | (edge == HintEdge::lower ? Qt::AlignBottom : Qt::AlignTop) | Qt::TextWordWrap;
    const QRectF plate = painter.fontMetrics().boundingRect(room.toRect(), flags, text);
    painter.setPen(Qt::NoPen);
    painter.setBrush(edgeColour(200));
    painter.drawRoundedRect(plate.adjusted(-10, -5, 10, 5), 4, 4);
    painter.setPen(Qt::white);
    painter.drawText(plate, flags, text);
}

}  // namespace eyrie::ui
