#pragma once

#include "canvas/layers/overlay_layer.h"

namespace eyrie::ui {

/// Detections: boxes; rejected ones faint and dotted when wanted.
class DetectionLayer : public OverlayLayer {
 public:
    OverlayKind kind() const override { return OverlayKind::detections; }
    void paint(QPainter& painter, const OverlayScene& scene) const override;
};

}  // namespace eyrie::ui
