#pragma once

#include <QPointF>
#include <QRectF>

#include "canvas/view_transform.h"
#include "core/geometry/oriented_box.h"

namespace eyrie::ui {

/// The upright box around `box` in pixels of the view.
inline QRectF uprightInView(const OrientedBox& box, const ViewTransform& transform) {
    const OrientedBox upright = box.upright();
    const QPointF half(upright.length / 2, upright.width / 2);
    const QPointF centre(upright.centre.x, upright.centre.y);
    return {transform.viewFromImage(centre - half), transform.viewFromImage(centre + half)};
}

}  // namespace eyrie::ui
