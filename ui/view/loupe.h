#pragma once

#include <QColor>
#include <QImage>
#include <optional>

#include "core/oriented_box.h"

class QPainter;

namespace eyrie::ui {

/// The picture around an image point, magnified, beside the cursor: raw pixels as squares, and a box over them.
/// `view_point`: the cursor; `view`: what the loupe must stay in; `magnification`: logical px per image px; turned
/// clockwise by `rotation`, radians.
void paintLoupe(QPainter& painter, const QImage& image, QPointF image_point, QPointF view_point, const QRectF& view,
                double magnification, const std::optional<OrientedBox>& box, const QColor& colour, double rotation = 0);

}  // namespace eyrie::ui
