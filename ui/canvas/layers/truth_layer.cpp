#include "canvas/layers/truth_layer.h"

#include "canvas/drawing/edged_painter.h"

namespace eyrie::ui {

void TruthLayer::paint(QPainter& painter, const OverlayScene& scene) const {
    QVector<QLineF> vehicles;
    QVector<QLineF> others;
    QVector<QLineF> ignored;
    for (const BoxRecord& record : scene.frame.ground_truth) {
        QVector<QLineF>& lines = record.ignore ? ignored : isVehicleClass(record.object_class) ? vehicles : others;
        appendBox(lines, record.box, scene.transform, scene.view);
    }
    const OverlayColours& colours = scene.style.colours;
    drawEdgedLines(painter, ignored, {colours.ground_truth, colours.edge, 1.2, Qt::DotLine});
    drawEdgedLines(painter, others, {colours.non_vehicle, colours.edge, scene.style.line_width});
    drawEdgedLines(painter, vehicles, {colours.ground_truth, colours.edge, scene.style.line_width});
}

}  // namespace eyrie::ui
