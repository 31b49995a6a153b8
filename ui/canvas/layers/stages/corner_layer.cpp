#include "canvas/layers/stages/corner_layer.h"

#include "canvas/drawing/edged_painter.h"

namespace eyrie::ui {

void CornerLayer::paint(QPainter& painter, const OverlayScene& scene) const {
    QVector<QPointF> dots;
    dots.reserve(static_cast<qsizetype>(scene.result.motion.stationary_corners.size()));
    for (const cv::Point2f& corner : scene.result.motion.stationary_corners) {
        const QPointF dot = scene.transform.viewFromImage(QPointF(corner.x, corner.y));
        if (scene.view.contains(dot)) dots.append(dot);
    }
    // Where dots would cover the picture (a whole video in a small view) they shrink.
    const double size = scene.transform.scale() < 0.75 ? 1 : scene.transform.scale() < 3 ? 2 : 3;
    drawEdgedDots(painter, dots, size, scene.style.colours.stationary_corner, scene.style.colours.edge);
}

}  // namespace eyrie::ui
