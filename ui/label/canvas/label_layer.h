#pragma once

#include <QRectF>

#include "canvas/view_transform.h"
#include "label/canvas/label_mark.h"

class QPainter;

namespace eyrie::ui {

/// Draws the labels of a frame: keyframes solid, interpolated boxes dashed, what is only expected dotted, ignored ones
/// faint and crossed, occluded ones with a bar; ids where there is room.
void paintLabels(QPainter& painter, const LabelScene& scene, const ViewTransform& transform, const QRectF& view);

/// The mark under an image point, the smallest if several are; `margin` px around boxes count as hit. Objects win over
/// proposals.
const LabelMark* markAt(const LabelScene& scene, QPointF image_point, double margin);
/// The smallest proposal under an image point, whatever objects lie there, too.
const LabelMark* proposalAt(const LabelScene& scene, QPointF image_point, double margin);

}  // namespace eyrie::ui
