#include "canvas/drawing/loupe.h"

#include <QCoreApplication>
#include <QPainter>
#include <QPainterPath>
#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

namespace eyrie::ui {

namespace {
constexpr double kSide = kLoupeSide;
constexpr double kBetween = 6;  ///< two loupes
constexpr double kNoteHeight = 64;
constexpr double kDistance = 28;  ///< from the cursor
constexpr double kDegrees = 180 / std::numbers::pi;
const QColor kRim(20, 20, 24);
const QColor kOutside(34, 36, 40);

/// Where it stands: to the upper right of the point, or where there is room.
QPointF cornerOf(const Loupe& loupe, double width) {
    QPointF corner = loupe.view_point + QPointF(kDistance, -kDistance - kSide);
    if (corner.x() + width > loupe.view.right()) corner.setX(loupe.view_point.x() - kDistance - width);
    if (corner.y() < loupe.view.top()) corner.setY(loupe.view_point.y() + kDistance);
    corner.setX(std::max(loupe.view.left(), corner.x()));
    corner.setY(std::max(loupe.view.top(), std::min(corner.y(), loupe.view.bottom() - kSide)));
    return corner;
}

/// Turns and scales, so that what follows is drawn in image coordinates around the middle of `frame`.
void enterImage(QPainter& painter, const QRectF& frame, const Loupe& loupe) {
    painter.translate(frame.center());
    painter.rotate(loupe.rotation * kDegrees);
    painter.scale(loupe.magnification, loupe.magnification);
    painter.translate(-loupe.image_point);
}

void paintRaw(QPainter& painter, const QImage& image, const Loupe& loupe) {
    const double half = kSide / 2 / loupe.magnification * (loupe.rotation == 0 ? 1 : std::numbers::sqrt2);
    const QRect whole = QRect(QPoint(static_cast<int>(std::floor(loupe.image_point.x() - half)),
                                     static_cast<int>(std::floor(loupe.image_point.y() - half))),
                              QPoint(static_cast<int>(std::ceil(loupe.image_point.x() + half)),
                                     static_cast<int>(std::ceil(loupe.image_point.y() + half)))) &
                        image.rect();
    if (whole.isEmpty()) return;
    painter.setRenderHint(QPainter::SmoothPixmapTransform, false);
    painter.drawImage(QRectF(QPointF(whole.topLeft()) - QPointF(0.5, 0.5), QSizeF(whole.size())), image, QRectF(whole));
}

void paintStack(QPainter& painter, const LoupeStack& stack) {
    const OrientedBox& area = stack.area;
    painter.setRenderHint(QPainter::SmoothPixmapTransform, true);
    painter.translate(area.centre.x, area.centre.y);
    painter.rotate(area.heading * kDegrees);
    painter.drawImage(QRectF(-area.length / 2, -area.width / 2, area.length, area.width), stack.image,
                      QRectF(stack.image.rect()));
}

void paintPane(QPainter& painter, const QRectF& frame, const Loupe& loupe, const QString& caption,
               const std::function<void()>& content) {
    painter.save();
    QPainterPath outline;
    outline.addRoundedRect(frame, 6, 6);
    painter.setPen(Qt::NoPen);
    painter.setBrush(kOutside);
    painter.drawPath(outline);
    painter.setClipPath(outline);
    painter.save();
    enterImage(painter, frame, loupe);
    content();
    painter.restore();
    painter.setBrush(Qt::NoBrush);
    if (loupe.box) {
        painter.save();
        enterImage(painter, frame, loupe);
        QPolygonF polygon;
        for (const cv::Point2d& corner : loupe.box->corners()) polygon << QPointF(corner.x, corner.y);
        for (const auto& [colour, width] : {std::pair(kRim, 2.6), std::pair(loupe.colour, 1.3)}) {
            QPen pen(colour, width);
            pen.setCosmetic(true);
            painter.setPen(pen);
            painter.drawPolygon(polygon);
        }
        painter.restore();
    }
    const QPointF middle = frame.center();
    painter.setPen(QPen(QColor(255, 255, 255, 150), 1));
    for (const QPointF way : {QPointF(1, 0), QPointF(-1, 0), QPointF(0, 1), QPointF(0, -1)})
        painter.drawLine(middle + way * 3, middle + way * 8);
    if (!caption.isEmpty()) {
        QFont font = painter.font();
        font.setPointSizeF(font.pointSizeF() * 0.85);
        painter.setFont(font);
        const QRectF line = QRectF(painter.fontMetrics().boundingRect(caption)).adjusted(-5, -2, 5, 2);
        const QRectF place(frame.bottomLeft() + QPointF(4, -4 - line.height()), line.size());
        painter.setPen(Qt::NoPen);
        painter.setBrush(QColor(0, 0, 0, 150));
        painter.drawRoundedRect(place, 3, 3);
        painter.setPen(QColor(240, 240, 240));
        painter.drawText(place, Qt::AlignCenter, caption);
        painter.setBrush(Qt::NoBrush);
    }
    painter.setClipping(false);
    painter.setPen(QPen(kRim, 2));
    painter.drawPath(outline);
    painter.restore();
}

/// What stands where a stack will be.
void paintNote(QPainter& painter, const QRectF& frame, const QString& text) {
    painter.save();
    painter.setPen(QPen(kRim, 2));
    painter.setBrush(kOutside);
    painter.drawRoundedRect(frame, 6, 6);
    QFont font = painter.font();
    font.setBold(false);
    painter.setFont(font);
    painter.setPen(QColor(225, 225, 225));
    painter.drawText(frame.adjusted(8, 4, -8, -4), Qt::AlignCenter | Qt::TextWordWrap, text);
    painter.restore();
}

}  // namespace

void paintLoupe(QPainter& painter, const QImage& image, const Loupe& loupe, const LoupeStack* stack) {
    if (image.isNull()) return;
    const bool stacked = stack != nullptr && !stack->image.isNull();
    const bool two = stacked || (stack != nullptr && !stack->missing.isEmpty());
    const QPointF corner = cornerOf(loupe, two ? 2 * kSide + kBetween : kSide);
    const QSizeF size(kSide, kSide);
    const QString caption = two ? QCoreApplication::translate("Loupe", "this frame") : QString();
    paintPane(painter, QRectF(corner, size), loupe, caption, [&] { paintRaw(painter, image, loupe); });
    if (!two) return;
    if (!stacked) {
        paintNote(painter, QRectF(corner + QPointF(kSide + kBetween, 0), QSizeF(kSide, kNoteHeight)), stack->missing);
        return;
    }
    paintPane(painter, QRectF(corner + QPointF(kSide + kBetween, 0), size), loupe,
              QCoreApplication::translate("Loupe", "stack of %1").arg(stack->layers),
              [&] { paintStack(painter, *stack); });
}

}  // namespace eyrie::ui
