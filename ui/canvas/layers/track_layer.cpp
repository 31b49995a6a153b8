#include "canvas/layers/track_layer.h"

#include <QCoreApplication>

#include "canvas/drawing/edged_painter.h"
#include "canvas/drawing/track_captions.h"

namespace eyrie::ui {

void TrackLayer::paint(QPainter& painter, const OverlayScene& scene) const {
    if (scene.style.detail.trails) paintTrails(painter, scene);
    paintBoxes(painter, scene);
    if (scene.style.detail.labels)
        paintTrackCaptions(painter, scene, [](const TrackState& state) {
            const QString id = QString::number(state.id);
            return state.origin == StateOrigin::by_hand ? QCoreApplication::translate("Overlay", "%1 by hand").arg(id)
                                                        : id;
        });
}

void TrackLayer::paintTrails(QPainter& painter, const OverlayScene& scene) const {
    // Trails fade with age in three steps, each one batch.
    constexpr int kSteps = 3;
    QVector<QLineF> steps[kSteps];
    QVector<QLineF> selected;
    for (const Trail& trail : scene.frame.trails) {
        const TrackState* state = stateOf(scene.frame, trail.id);
        if (state == nullptr || !isShown(*state, scene)) continue;
        const size_t count = trail.points.size();
        for (size_t i = 1; i < count; ++i) {
            const QPointF from = scene.transform.viewFromImage(QPointF(trail.points[i - 1].x, trail.points[i - 1].y));
            const QPointF to = scene.transform.viewFromImage(QPointF(trail.points[i].x, trail.points[i].y));
            QVector<QLineF>& lines = scene.selected_track == trail.id ? selected : steps[kSteps * i / count];
            lines.append({from, to});
        }
    }
    for (int step = 0; step < kSteps; ++step) {
        // Darker with age; the rim only under the newest part.
        const QColor colour = scene.style.colours.track.darker(190 - 40 * step);
        const QColor edge = step == kSteps - 1 ? scene.style.colours.edge : colour.darker(200);
        drawEdgedLines(painter, steps[step], {colour, edge, 1.2});
    }
    drawEdgedLines(painter, selected, {scene.style.colours.selected_track, scene.style.colours.edge, 2});
}

void TrackLayer::paintBoxes(QPainter& painter, const OverlayScene& scene) const {
    QVector<QLineF> seen;
    QVector<QLineF> coasting;
    QVector<QLineF> tentative;
    QVector<QLineF> selected;
    Qt::PenStyle selected_style = Qt::SolidLine;
    visitShown(scene, [&](const TrackState& state) {
        const bool is_selected = scene.selected_track == state.id;
        if (is_selected && state.status == TrackStatus::coasting) selected_style = Qt::DashLine;
        QVector<QLineF>& lines = is_selected                              ? selected
                                 : state.status == TrackStatus::coasting  ? coasting
                                 : state.status == TrackStatus::tentative ? tentative
                                                                          : seen;
        appendBox(lines, state.box, scene.transform, scene.view);
        appendHeading(lines, state.box, scene.transform, scene.view);
    });
    const OverlayColours& colours = scene.style.colours;
    QColor faint = colours.track;
    faint.setAlphaF(0.6F);
    drawEdgedLines(painter, tentative, {faint, QColor(0, 0, 0, 60), 1.1, Qt::DotLine});
    drawEdgedLines(painter, coasting, {colours.track, colours.edge, scene.style.line_width, Qt::DashLine});
    drawEdgedLines(painter, seen, {colours.track, colours.edge, scene.style.line_width});
    drawEdgedLines(painter, selected,
                   {colours.selected_track, colours.edge, scene.style.line_width + 1.4, selected_style});
}

std::optional<TrackId> trackAt(std::span<const TrackState> states, const OverlayStyle& style, QPointF image_point,
                               double margin) {
    std::optional<TrackId> hit;
    double smallest_area = 0;
    for (const TrackState& state : states) {
        if (!isShown(state, style)) continue;
        if (!state.box.contains({image_point.x(), image_point.y()}, margin)) continue;
        if (hit && state.box.area() >= smallest_area) continue;
        hit = state.id;
        smallest_area = state.box.area();
    }
    return hit;
}

}  // namespace eyrie::ui
