#include "canvas/layers/stages/vector_layer.h"

#include "canvas/drawing/edged_painter.h"

namespace eyrie::ui {

namespace {
constexpr double kScaleWithDots = 2;  ///< from this zoom on a dot marks where the corner is
}

void VectorLayer::paint(QPainter& painter, const OverlayScene& scene) const {
    const auto& vectors = scene.result.motion.motion_vectors;
    const double factor = scene.style.detail.vector_length_factor;
    QVector<QLineF> lines;
    QVector<QPointF> heads;
    QVector<QPointF> inferred;
    lines.reserve(static_cast<qsizetype>(vectors.size()));
    heads.reserve(static_cast<qsizetype>(vectors.size()));
    for (const MotionVector& vector : vectors) {
        const QPointF from = scene.transform.viewFromImage(QPointF(vector.position.x, vector.position.y));
        const QPointF along = factor * scene.transform.viewVector(QPointF(vector.velocity.x, vector.velocity.y),
                                                                  QPointF(vector.position.x, vector.position.y));
        if (!scene.view.contains(from) && !scene.view.contains(from + along)) continue;
        if (vector.isInferred()) {
            inferred.append(from);
            continue;
        }
        lines.append({from, from + along});
        heads.append(from);
    }
    // Vectors stand close together: a black rim around each would hide the vehicle under them.
    const QColor colour = scene.style.colours.motion_vector;
    const LineLook look{colour, colour.darker(330), 1.1};
    drawEdgedLines(painter, lines, look);
    if (heads.size() <= kFastLines && scene.transform.scale() >= kScaleWithDots)
        drawEdgedDots(painter, heads, 3, look.colour, look.edge);
    // No corner is there: the outline of a silhouette.
    if (inferred.size() <= kFastLines && scene.transform.scale() >= kScaleWithDots)
        drawEdgedDots(painter, inferred, 1.5, look.colour, look.edge);
}

}  // namespace eyrie::ui
