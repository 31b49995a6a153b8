#include "canvas/layers/zone_layer.h"

#include <QPainter>
#include <QPolygonF>

#include "canvas/drawing/caption_placer.h"
#include "canvas/drawing/edged_painter.h"

namespace eyrie::ui {

namespace {

constexpr double kArrow = 9;  ///< logical px
constexpr double kWayHead = 14;
constexpr double kWayWidth = 1.6;  ///< more than the outline of a zone has
constexpr int kGroundAlpha = 34;

void appendArrow(QVector<QLineF>& lines, const QLineF& last, double length) {
    if (last.length() < 1) return;
    for (const double angle : {155.0, -155.0}) {
        QLineF side(last.p2(), last.p2() + QPointF(1, 0));
        side.setAngle(last.angle() + angle);
        side.setLength(length);
        lines.append(side);
    }
}

void writeZoneName(QPainter& painter, const OverlayScene& scene, const ZoneMark& zone, const QPolygonF& points) {
    const QSizeF size = QSizeF(painter.fontMetrics().size(Qt::TextSingleLine, zone.name)) + QSizeF(8, 2);
    // Beside the first corner that is seen: areas may be larger than the view.
    for (const QPointF& point : points) {
        if (!scene.view.contains(point)) continue;
        const auto place = scene.captions.place(QRectF(point - QPointF(3, 3), QSizeF(6, 6)), size);
        if (!place) continue;
        painter.setPen(Qt::NoPen);
        painter.setBrush(scene.style.colours.edge);
        painter.drawRoundedRect(*place, 3, 3);
        painter.setPen(zone.colour);
        painter.drawText(*place, Qt::AlignCenter, zone.name);
        return;
    }
}

}  // namespace

void ZoneLayer::paint(QPainter& painter, const OverlayScene& scene) const {
    for (const ZoneMark& zone : scene.frame.zones) {
        QPolygonF points;
        for (const QPointF& point : zone.points) points << scene.transform.viewFromImage(point);
        if (points.size() < 2) continue;
        QVector<QLineF> lines;
        for (int i = 1; i < points.size(); ++i) lines.append({points[i - 1], points[i]});
        if (zone.closed) {
            lines.append({points.back(), points.front()});
            QColor ground = zone.colour;
            ground.setAlpha(kGroundAlpha);
            painter.setPen(Qt::NoPen);
            painter.setBrush(ground);
            painter.drawPolygon(points);
            painter.setBrush(Qt::NoBrush);
        } else {
            // A right way tells its direction wherever one looks, also where its end is out of view.
            const QVector<QLineF> parts = lines;
            for (const QLineF& part : parts)
                if (zone.right_way) appendArrow(lines, {part.p1(), part.center()}, kWayHead);
            appendArrow(lines, parts.back(), zone.right_way ? kWayHead : kArrow);
        }
        const double width = scene.style.line_width + (zone.selected ? 1.4 : 0.2) + (zone.right_way ? kWayWidth : 0);
        drawEdgedLines(painter, lines, {zone.colour, scene.style.colours.edge, width});
    }
    if (!scene.style.detail.labels) return;
    // Vehicles are drawn on top: names that they cover could not be read.
    std::vector<QRectF> vehicles;
    for (const TrackState& track : scene.result.tracks) {
        QPolygonF box;
        for (const cv::Point2d& corner : track.box.corners())
            box << scene.transform.viewFromImage({corner.x, corner.y});
        vehicles.push_back(box.boundingRect());
    }
    scene.captions.keepClearOf(std::move(vehicles));
    for (const ZoneMark& zone : scene.frame.zones) {
        QPolygonF points;
        for (const QPointF& point : zone.points) points << scene.transform.viewFromImage(point);
        writeZoneName(painter, scene, zone, points);
    }
}

}  // namespace eyrie::ui
