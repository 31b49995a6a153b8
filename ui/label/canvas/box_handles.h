#pragma once

#include <QPointF>
#include <optional>
#include <utility>
#include <vector>

#include "canvas/view_transform.h"
#include "core/geometry/oriented_box.h"

/// Boxes changed with the mouse. Arithmetic only.
namespace eyrie::ui {

enum class BoxHandle { centre, front, rear, left, right, front_left, front_right, rear_left, rear_right, turn };

/// Where the handles of a box are, logical px of the view. Those of the sides keep a little apart from the box when it
/// is small on screen, so that all can be hit.
std::vector<std::pair<BoxHandle, QPointF>> boxHandles(const OrientedBox& box, const ViewTransform& transform);

/// The handle under a view point, `reach` logical px around it; the centre answers to the whole inside of the box.
std::optional<BoxHandle> handleAt(const OrientedBox& box, const ViewTransform& transform, QPointF view_point,
                                  double reach = 7);

/// The box after a handle was dragged from one image point to another. Sides opposite to the one dragged stay, so do
/// centre and size when it is turned; nothing gets smaller than a pixel.
OrientedBox draggedBox(const OrientedBox& box, BoxHandle handle, QPointF from, QPointF to);

/// A box from the middle of a vehicle's rear to the middle of its front.
OrientedBox boxFromRearToFront(QPointF rear, QPointF front, double width);

/// A box from corner to corner, heading along its longer side; upright on a picture turned by `rotation` (radians).
OrientedBox boxFromCorners(QPointF a, QPointF b, double rotation = 0);

}  // namespace eyrie::ui
