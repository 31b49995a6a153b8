#include "canvas/layers/stages/image_stack_layer.h"

#include <cmath>

#include "canvas/drawing/edged_painter.h"

namespace eyrie::ui {

namespace {
constexpr double kGoldenRatio = 0.618033988749895;
constexpr double kArm = 9;      ///< of the cross, logical px; the one that points ahead is longer
constexpr double kDotSize = 4;  ///< logical px
constexpr double kLineWidth = 2.2;
}  // namespace

QColor stackColour(int id) {
    const double hue = id * kGoldenRatio;
    // Light and dark ones take turns, too, so that hues that come near each other differ.
    return QColor::fromHsvF(static_cast<float>(hue - std::floor(hue)), id % 2 == 0 ? 0.75F : 0.95F, 1.0F);
}

void ImageStackLayer::paint(QPainter& painter, const OverlayScene& scene) const {
    for (const StackMark& stack : scene.frame.stacks) {
        const QColor colour = stackColour(stack.id);
        QVector<QPointF> dots;
        for (const cv::Point2f& point : stack.related) {
            const QPointF dot = scene.transform.viewFromImage(QPointF(point.x, point.y));
            if (scene.view.contains(dot)) dots.append(dot);
        }
        drawEdgedDots(painter, dots, kDotSize, colour, scene.style.colours.edge);
        const QPointF centre = scene.transform.viewFromImage(QPointF(stack.position.x, stack.position.y));
        if (!scene.view.contains(centre)) continue;
        const double heading = stack.heading + scene.transform.turnAt({stack.position.x, stack.position.y});
        const QPointF ahead(std::cos(heading) * kArm, std::sin(heading) * kArm);
        const QPointF aside(-ahead.y(), ahead.x());
        drawEdgedLines(painter, {{centre - ahead, centre + ahead * 1.8}, {centre - aside, centre + aside}},
                       {colour, scene.style.colours.edge, kLineWidth});
    }
}

}  // namespace eyrie::ui
