#pragma once

#include <QPainter>
#include <QRectF>
#include <QString>

namespace eyrie::ui {

/// Says at the lower edge of a view what the tool at work wants.
inline void paintToolHint(QPainter& painter, const QRectF& view, const QString& text) {
    const QRectF room(view.left() + 10, view.top(), view.width() - 20, view.height() - 10);
    const int flags = Qt::AlignHCenter | Qt::AlignBottom | Qt::TextWordWrap;
    const QRectF plate = painter.fontMetrics().boundingRect(room.adjusted(10, 0, -10, -5).toRect(), flags, text);
    painter.setPen(Qt::NoPen);
    painter.setBrush(QColor(12, 12, 14, 200));
    painter.drawRoundedRect(plate.adjusted(-10, -5, 10, 5), 4, 4);
    painter.setPen(Qt::white);
    painter.drawText(plate, flags, text);
}

}  // namespace eyrie::ui
