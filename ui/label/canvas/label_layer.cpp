#include "label/canvas/label_layer.h"

#include <QFontMetricsF>
#include <QPainter>
#include <algorithm>
#include <map>
#include <tuple>

#include "canvas/drawing/caption_placer.h"
#include "canvas/drawing/edged_painter.h"
#include "canvas/drawing/mark_colours.h"
#include "canvas/upright_in_view.h"

namespace eyrie::ui {

namespace {

constexpr double kWidth = 1.6;
constexpr double kSelectedWidth = 2.4;

Qt::PenStyle styleOf(const LabelMark& mark) {
    switch (mark.kind) {
        case LabelKind::keyframe:
            return Qt::SolidLine;
        case LabelKind::interpolated:
            return Qt::DashLine;
        case LabelKind::planned:
            return Qt::DashDotLine;
        default:
            return Qt::DotLine;
    }
}

QColor colourOf(const LabelMark& mark) {
    QColor colour = mark.colour;
    if (mark.ignore || mark.kind == LabelKind::proposal) colour.setAlphaF(mark.selected ? 0.95F : 0.7F);
    return colour;
}

void appendLine(QVector<QLineF>& lines, const OrientedBox& box, cv::Point2d from, cv::Point2d to,
                const ViewTransform& transform) {
    const cv::Point2d a = box.toImage(from);
    const cv::Point2d b = box.toImage(to);
    lines.append({transform.viewFromImage({a.x, a.y}), transform.viewFromImage({b.x, b.y})});
}

/// Occlusion: a bar across the rear, two when it is fully hidden. Ignored: crossed out.
void appendFlags(QVector<QLineF>& lines, const LabelMark& mark, const ViewTransform& transform) {
    const double l = mark.box.length / 2;
    const double w = mark.box.width / 2;
    if (mark.occlusion != Occlusion::none) appendLine(lines, mark.box, {-l / 2, -w}, {-l / 2, w}, transform);
    if (mark.occlusion == Occlusion::fully) appendLine(lines, mark.box, {0, -w}, {0, w}, transform);
    if (!mark.ignore) return;
    appendLine(lines, mark.box, {-l, -w}, {l, w}, transform);
    appendLine(lines, mark.box, {-l, w}, {l, -w}, transform);
}

void paintBoxes(QPainter& painter, const LabelScene& scene, const ViewTransform& transform, const QRectF& view) {
    // One batch for each way of drawing; the selected ones last, on top.
    std::map<std::tuple<bool, int, QRgb>, QVector<QLineF>> batches;
    std::map<std::tuple<bool, QRgb>, QVector<QLineF>> flags;
    for (const LabelMark& mark : scene.marks) {
        auto& lines = batches[{mark.selected, static_cast<int>(styleOf(mark)), colourOf(mark).rgba()}];
        appendBox(lines, mark.box, transform, view);
        auto& small = flags[{mark.selected, colourOf(mark).rgba()}];
        appendHeading(small, mark.box, transform, view);
        appendFlags(small, mark, transform);
    }
    for (const bool selected : {false, true}) {
        for (const auto& [key, lines] : batches)
            if (std::get<0>(key) == selected)
                drawEdgedLines(painter, lines,
                               {QColor::fromRgba(std::get<2>(key)), edgeColour(), selected ? kSelectedWidth : kWidth,
                                static_cast<Qt::PenStyle>(std::get<1>(key))});
        for (const auto& [key, lines] : flags)
            if (std::get<0>(key) == selected)
                drawEdgedLines(painter, lines, {QColor::fromRgba(std::get<1>(key)), edgeColour(), 1.3});
    }
}

void paintLabelTexts(QPainter& painter, const LabelScene& scene, const ViewTransform& transform, const QRectF& view) {
    struct Labelled {
        const LabelMark* mark;
        QRectF object;
    };
    std::vector<Labelled> labelled;
    std::vector<QRectF> objects;
    for (const LabelMark& mark : scene.marks) {
        QRectF object = uprightInView(mark.box, transform);
        if (!object.intersects(view)) continue;
        // Handles stand around the one that has them.
        constexpr double kHandles = 14;
        if (scene.editable && scene.selected == mark.id && isObject(mark.kind))
            object.adjust(-kHandles, -kHandles, kHandles, kHandles);
        objects.push_back(object);
        if (!mark.text.isEmpty()) labelled.push_back({&mark, object});
    }
    std::stable_partition(labelled.begin(), labelled.end(), [](const Labelled& l) { return l.mark->selected; });
    CaptionPlacer placer(view, objects);
    const QFontMetricsF metrics(painter.font());
    for (const Labelled& label : labelled) {
        const LabelMark& mark = *label.mark;
        const QString text = mark.review == ReviewState::checked        ? mark.text + QStringLiteral(" ✓")
                             : mark.review == ReviewState::questionable ? mark.text + QStringLiteral(" ?")
                                                                        : mark.text;
        const QSizeF size(metrics.horizontalAdvance(text) + 6, metrics.height());
        auto rectangle = placer.place(label.object, size);
        if (!rectangle && mark.selected)  // the one that is worked on is always named
            rectangle = QRectF(
                label.object.center().x() - size.width() / 2,
                mark.kind == LabelKind::planned ? label.object.bottom() + 16 : label.object.top() - size.height() - 18,
                size.width(), size.height());
        if (!rectangle) continue;
        painter.setPen(Qt::NoPen);
        painter.setBrush(mark.selected ? mark.colour : QColor(0, 0, 0, 165));
        painter.drawRoundedRect(*rectangle, 2.5, 2.5);
        painter.setBrush(Qt::NoBrush);
        painter.setPen(mark.selected ? QColor(0, 0, 0) : mark.colour);
        painter.drawText(*rectangle, Qt::AlignCenter, text);
    }
}

void paintRegions(QPainter& painter, const LabelScene& scene, const ViewTransform& transform) {
    for (const RegionMark& region : scene.regions) {
        QPolygonF polygon;
        for (const cv::Point2d& p : region.polygon) polygon << transform.viewFromImage({p.x, p.y});
        painter.setPen(QPen(QColor(255, 160, 40), 1.2, Qt::DashLine));
        painter.setBrush(QBrush(QColor(255, 160, 40, 70), Qt::BDiagPattern));
        painter.drawPolygon(polygon);
        painter.setBrush(Qt::NoBrush);
    }
}

}  // namespace

void paintLabels(QPainter& painter, const LabelScene& scene, const ViewTransform& transform, const QRectF& view) {
    paintRegions(painter, scene, transform);
    paintBoxes(painter, scene, transform, view);
    paintLabelTexts(painter, scene, transform, view);
}

const LabelMark* markAt(const LabelScene& scene, QPointF image_point, double margin) {
    const LabelMark* hit = nullptr;
    const auto rank = [](const LabelMark& mark) {
        return std::tuple(mark.kind == LabelKind::proposal || mark.kind == LabelKind::expected, mark.box.area());
    };
    for (const LabelMark& mark : scene.marks) {
        if (mark.kind == LabelKind::planned) continue;
        if (!mark.box.contains({image_point.x(), image_point.y()}, margin)) continue;
        if (hit == nullptr || rank(mark) < rank(*hit)) hit = &mark;
    }
    return hit;
}

const LabelMark* proposalAt(const LabelScene& scene, QPointF image_point, double margin) {
    const LabelMark* hit = nullptr;
    for (const LabelMark& mark : scene.marks)
        if (mark.kind == LabelKind::proposal && mark.box.contains({image_point.x(), image_point.y()}, margin) &&
            (hit == nullptr || mark.box.area() < hit->box.area()))
            hit = &mark;
    return hit;
}

}  // namespace eyrie::ui
