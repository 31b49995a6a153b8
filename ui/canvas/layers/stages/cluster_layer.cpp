#include "canvas/layers/stages/cluster_layer.h"

#include "canvas/drawing/edged_painter.h"

namespace eyrie::ui {

void ClusterLayer::paint(QPainter& painter, const OverlayScene& scene) const {
    QVector<QLineF> lines;
    for (const MotionCluster& cluster : scene.result.clusters) {
        appendBox(lines, cluster.box, scene.transform, scene.view);
        appendHeading(lines, cluster.box, scene.transform, scene.view);
    }
    drawEdgedLines(painter, lines, {scene.style.colours.cluster, scene.style.colours.edge, scene.style.line_width});
}

}  // namespace eyrie::ui
