#include "canvas/layers/stages/roi_layer.h"

#include "canvas/drawing/edged_painter.h"

namespace eyrie::ui {

void RoiLayer::paint(QPainter& painter, const OverlayScene& scene) const {
    QVector<QLineF> lines;
    for (const OrientedBox& roi : scene.result.rois) appendBox(lines, roi, scene.transform, scene.view);
    drawEdgedLines(painter, lines, {scene.style.colours.roi, QColor(0, 0, 0, 60), 1.2, Qt::DashLine});
}

}  // namespace eyrie::ui
