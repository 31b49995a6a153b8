#include "view/loupe.h"

#include <QPainter>
#include <QPainterPath>
#include <cmath>
#include <numbers>

namespace eyrie::ui {

namespace {
constexpr double kSide = 168;     ///< logical px
constexpr double kDistance = 28;  ///< from the cursor
const QColor kRim(20, 20, 24);
const QColor kOutside(34, 36, 40);
}  // namespace

void paintLoupe(QPainter& painter, const QImage& image, QPointF image_point, QPointF view_point, const QRectF& view,
                double magnification, const std::optional<OrientedBox>& box, const QColor& colour, double rotation) {
    if (image.isNull()) return;
    QPointF corner = view_point + QPointF(kDistance, -kDistance - kSide);
    if (corner.x() + kSide > view.right()) corner.setX(view_point.x() - kDistance - kSide);
    if (corner.y() < view.top()) corner.setY(view_point.y() + kDistance);
    const QRectF frame(corner, QSizeF(kSide, kSide));
    const QPointF middle = frame.center();
    const auto place = [&](QPointF point) { return middle + (point - image_point) * magnification; };

    painter.save();
    QPainterPath outline;
    outline.addRoundedRect(frame, 6, 6);
    painter.setPen(Qt::NoPen);
    painter.setBrush(kOutside);
    painter.drawPath(outline);
    painter.setClipPath(outline);
    const double half = kSide / 2 / magnification * (rotation == 0 ? 1 : std::numbers::sqrt2);
    const QRect whole = QRect(QPoint(static_cast<int>(std::floor(image_point.x() - half)),
                                     static_cast<int>(std::floor(image_point.y() - half))),
                              QPoint(static_cast<int>(std::ceil(image_point.x() + half)),
                                     static_cast<int>(std::ceil(image_point.y() + half)))) &
                        image.rect();
    painter.setRenderHint(QPainter::SmoothPixmapTransform, false);
    painter.translate(middle);
    painter.rotate(rotation * 180 / std::numbers::pi);
    painter.translate(-middle);
    if (!whole.isEmpty())
        painter.drawImage(
            QRectF(place(QPointF(whole.topLeft()) - QPointF(0.5, 0.5)), QSizeF(whole.size()) * magnification), image,
            QRectF(whole));
    painter.setBrush(Qt::NoBrush);
    if (box) {
        QPolygonF polygon;
        for (const cv::Point2d& c : box->corners()) polygon << place({c.x, c.y});
        painter.setPen(QPen(kRim, 2.6));
        painter.drawPolygon(polygon);
        painter.setPen(QPen(colour, 1.3));
        painter.drawPolygon(polygon);
    }
    painter.translate(middle);
    painter.rotate(-rotation * 180 / std::numbers::pi);
    painter.translate(-middle);
    painter.setPen(QPen(QColor(255, 255, 255, 150), 1));
    painter.drawLine(middle - QPointF(8, 0), middle - QPointF(3, 0));
    painter.drawLine(middle + QPointF(3, 0), middle + QPointF(8, 0));
    painter.drawLine(middle - QPointF(0, 8), middle - QPointF(0, 3));
    painter.drawLine(middle + QPointF(0, 3), middle + QPointF(0, 8));
    painter.setClipping(false);
    painter.setPen(QPen(kRim, 2));
    painter.drawPath(outline);
    painter.restore();
}

}  // namespace eyrie::ui
