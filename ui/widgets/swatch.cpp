#include "widgets/swatch.h"

#include <QPainter>

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

}  // namespace eyrie::ui
