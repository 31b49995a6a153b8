#include "canvas/layers/verdict_layer.h"

#include <QCoreApplication>
#include <QPainter>
#include <array>
#include <cmath>

#include "canvas/drawing/caption_placer.h"
#include "canvas/drawing/edged_painter.h"
#include "canvas/drawing/mark_colours.h"

namespace eyrie::ui {

namespace {

constexpr double kThin = 1.3;
constexpr double kThick = 2.4;
constexpr double kSelectedGap = 5;  ///< logical px between a box and the frame around the selected one
constexpr double kLegendMargin = 10;
constexpr double kSwatch = 10;

QRectF boundsOf(const OrientedBox& box, const ViewTransform& transform) {
    QPolygonF polygon;
    for (const cv::Point2d& corner : box.corners()) polygon << transform.viewFromImage(QPointF(corner.x, corner.y));
    return polygon.boundingRect();
}

void paintTexts(QPainter& painter, const OverlayScene& scene) {
    std::vector<QRectF> objects;
    for (const VerdictMark& mark : scene.frame.verdicts) objects.push_back(boundsOf(mark.box, scene.transform));
    scene.captions.keepClearOf(objects);
    const QFontMetricsF metrics(painter.font());
    for (std::size_t i = 0; i < objects.size(); ++i) {
        const VerdictMark& mark = scene.frame.verdicts[i];
        if (mark.text.isEmpty() || !scene.view.intersects(objects[i])) continue;
        const QSizeF size(metrics.horizontalAdvance(mark.text) + 6, metrics.height() + 1);
        const auto place = scene.captions.place(objects[i], size);
        if (!place) continue;
        painter.fillRect(*place, edgeColour(215));
        painter.setPen(verdictColour(mark.kind, scene.style.palette));
        painter.drawText(*place, Qt::AlignCenter, mark.text);
    }
}

void paintLegend(QPainter& painter, const OverlayScene& scene) {
    std::array<int, kVerdictKinds> counts{};
    for (const VerdictMark& mark : scene.frame.verdicts) ++counts[static_cast<std::size_t>(mark.kind)];
    const QFontMetricsF metrics(painter.font());
    QStringList texts;
    QList<VerdictKind> kinds;
    double width = 0;
    for (int i = 0; i < kVerdictKinds; ++i) {
        const auto kind = static_cast<VerdictKind>(i);
        const int count = counts[static_cast<std::size_t>(i)];
        // The three that every frame has; the others where they occur.
        if (count == 0 && i > static_cast<int>(VerdictKind::false_alarm)) continue;
        kinds << kind;
        texts << QStringLiteral("%1  %2").arg(count).arg(verdictText(kind));
        width = std::max(width, metrics.horizontalAdvance(texts.back()));
    }
    const double line = metrics.height() + 3;
    const QRectF frame(scene.view.left() + 8 + kLegendMargin, scene.view.top() + 8 + kLegendMargin,
                       width + kSwatch + 22, line * static_cast<double>(kinds.size()) + 8);
    painter.setPen(Qt::NoPen);
    painter.setBrush(edgeColour(200));
    painter.drawRoundedRect(frame, 4, 4);
    painter.setBrush(Qt::NoBrush);
    for (int i = 0; i < kinds.size(); ++i) {
        const double top = frame.top() + 4 + i * line;
        painter.fillRect(QRectF(frame.left() + 7, top + (line - kSwatch) / 2, kSwatch, kSwatch),
                         verdictColour(kinds[i], scene.style.palette));
        painter.setPen(QColor(235, 235, 235));
        painter.drawText(QRectF(frame.left() + kSwatch + 13, top, width + 8, line), Qt::AlignVCenter, texts[i]);
    }
}

}  // namespace

QColor verdictColour(VerdictKind kind, PaletteKind palette) {
    const bool safe = palette == PaletteKind::colour_blind;
    switch (kind) {
        case VerdictKind::found:
            return safe ? QColor(0, 190, 140) : QColor(80, 220, 90);
        case VerdictKind::missed:
            return safe ? QColor(240, 228, 66) : QColor(255, 205, 40);
        case VerdictKind::false_alarm:
            return safe ? QColor(213, 94, 0) : QColor(255, 75, 65);
        case VerdictKind::switched:
            return safe ? QColor(204, 121, 167) : QColor(255, 110, 255);
        case VerdictKind::fragment:
            return safe ? QColor(86, 180, 233) : QColor(90, 190, 255);
        case VerdictKind::ignored:
            return {170, 170, 170};
    }
    return {};
}

QString verdictText(VerdictKind kind) {
    const auto tr = [](const char* text) { return QCoreApplication::translate("VerdictLayer", text); };
    switch (kind) {
        case VerdictKind::found:
            return tr("found");
        case VerdictKind::missed:
            return tr("missed");
        case VerdictKind::false_alarm:
            return tr("false");
        case VerdictKind::switched:
            return tr("switched");
        case VerdictKind::fragment:
            return tr("lost here");
        case VerdictKind::ignored:
            return tr("not counted");
    }
    return {};
}

void VerdictLayer::paint(QPainter& painter, const OverlayScene& scene) const {
    if (!scene.frame.evaluated) return;
    std::array<QVector<QLineF>, kVerdictKinds> lines;
    QVector<QLineF> around;
    for (const VerdictMark& mark : scene.frame.verdicts) {
        appendBox(lines[static_cast<std::size_t>(mark.kind)], mark.box, scene.transform, scene.view);
        if (!mark.selected) continue;
        const double gap = 2 * kSelectedGap / scene.transform.scaleAt({mark.box.centre.x, mark.box.centre.y});
        OrientedBox wider = mark.box;
        wider.length += gap;
        wider.width += gap;
        appendBox(around, wider, scene.transform, scene.view);
    }
    const QColor edge = scene.style.colours.edge;
    for (const VerdictKind kind : {VerdictKind::ignored, VerdictKind::found, VerdictKind::missed,
                                   VerdictKind::false_alarm, VerdictKind::fragment, VerdictKind::switched}) {
        const bool quiet = kind == VerdictKind::found || kind == VerdictKind::ignored;
        const bool without_result = kind == VerdictKind::missed || kind == VerdictKind::fragment;
        const Qt::PenStyle style = kind == VerdictKind::ignored ? Qt::DotLine
                                   : without_result             ? Qt::DashLine
                                                                : Qt::SolidLine;
        drawEdgedLines(painter, lines[static_cast<std::size_t>(kind)],
                       {verdictColour(kind, scene.style.palette), edge, quiet ? kThin : kThick, style});
    }
    drawEdgedLines(painter, around, {QColor(255, 255, 255), edge, kThin});
    if (scene.style.detail.labels) paintTexts(painter, scene);
    paintLegend(painter, scene);
}

}  // namespace eyrie::ui
