#include "canvas/layers/north_layer.h"

#include <QPainter>
#include <cmath>

#include "canvas/drawing/edged_painter.h"
#include "canvas/drawing/mark_colours.h"

namespace eyrie::ui {

namespace {

// Logical px.
constexpr double kPlate = 26;  ///< radius
constexpr double kFromEdge = 18;
constexpr double kTail = 15;
constexpr double kTip = 6;
constexpr double kHead = 8;
constexpr double kLetter = 16;
constexpr double kHeadAngle = 2.6;  ///< radians between the arrow and the sides of its head
constexpr double kStep_px = 8;      ///< of the picture, over which its direction is taken
constexpr int kPlateAlpha = 150;

QPointF along(double angle, double distance) {
    return {distance * std::cos(angle), distance * std::sin(angle)};
}

}  // namespace

void NorthLayer::paint(QPainter& painter, const OverlayScene& scene) const {
    const QSize size = scene.transform.imageSize();
    if (!scene.frame.north_deg || size.isEmpty()) return;
    const QPointF middle((size.width() - 1) / 2.0, (size.height() - 1) / 2.0);
    const double in_image = *scene.frame.north_deg * M_PI / 180;
    const QPointF in_view = scene.transform.viewVector(along(in_image, kStep_px), middle);
    const double angle = std::atan2(in_view.y(), in_view.x());
    const QPointF centre(scene.view.right() - kFromEdge - kPlate, scene.view.top() + kFromEdge + kPlate);
    painter.setPen(Qt::NoPen);
    painter.setBrush(edgeColour(kPlateAlpha));
    painter.drawEllipse(centre, kPlate, kPlate);
    painter.setBrush(Qt::NoBrush);
    const QPointF tip = centre + along(angle, kTip);
    const QVector<QLineF> arrow{{centre - along(angle, kTail), tip},
                                {tip, tip + along(angle + kHeadAngle, kHead)},
                                {tip, tip + along(angle - kHeadAngle, kHead)}};
    drawEdgedLines(painter, arrow, {scene.style.colours.north, scene.style.colours.edge, 2});
    const QSizeF room(20, 20);
    const QRectF letter(centre + along(angle, kLetter) - QPointF(room.width() / 2, room.height() / 2), room);
    painter.setPen(scene.style.colours.north);
    painter.drawText(letter, Qt::AlignCenter, QStringLiteral("N"));
}

}  // namespace eyrie::ui
