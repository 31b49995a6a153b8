#include "widgets/swatch.h"

#include <QPainter>
#include <QPolygonF>

namespace eyrie::ui {

QPixmap swatch(const QColor& colour, int side) {
    QPixmap pixmap(side, side);
    pixmap.fill(Qt::transparent);
    QPainter painter(&pixmap);
    painter.setRenderHint(QPainter::Antialiasing);
    painter.setPen(QColor(0, 0, 0, 150));
    painter.setBrush(colour);
    const double margin = side / 8 + 0.5;  // lines in the middle of pixels are sharp
    painter.drawRoundedRect(QRectF(margin, margin, side - 2 * margin, side - 2 * margin), 2, 2);
    return pixmap;
}

QIcon switchedSwatch(const QColor& colour, int side) {
    QIcon icon(swatch(colour, side));
    QPixmap ticked = swatch(colour, side);
    QPainter painter(&ticked);
    painter.setRenderHint(QPainter::Antialiasing);
    const QColor tick = qGray(colour.rgb()) > 110 ? Qt::black : Qt::white;
    painter.setPen(QPen(tick, side / 8.0, Qt::SolidLine, Qt::RoundCap, Qt::RoundJoin));
    painter.drawPolyline(QPolygonF{QPointF(0.28 * side, 0.52 * side), QPointF(0.44 * side, 0.68 * side),
                                   QPointF(0.72 * side, 0.34 * side)});
    painter.end();
    icon.addPixmap(ticked, QIcon::Normal, QIcon::On);
    return icon;
}

}  // namespace eyrie::ui
