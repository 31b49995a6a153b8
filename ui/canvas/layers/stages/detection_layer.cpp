#include "canvas/layers/stages/detection_layer.h"

#include "canvas/drawing/edged_painter.h"

namespace eyrie::ui {

void DetectionLayer::paint(QPainter& painter, const OverlayScene& scene) const {
    QVector<QLineF> kept;
    QVector<QLineF> rejected;
    for (const Detection& detection : scene.result.detections) {
        const bool is_kept = detection.rejection == Rejection::none;
        appendBox(is_kept ? kept : rejected, detection.box, scene.transform, scene.view);
    }
    const OverlayColours& colours = scene.style.colours;
    if (scene.style.detail.rejected_detections)
        drawEdgedLines(painter, rejected, {colours.rejected, QColor(0, 0, 0, 60), 1.2, Qt::DotLine});
    drawEdgedLines(painter, kept, {colours.detection, colours.edge, scene.style.line_width});
}

}  // namespace eyrie::ui
