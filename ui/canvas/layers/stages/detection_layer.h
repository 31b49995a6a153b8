#pragma once

#include "canvas/layers/overlay_layer.h"

namespace eyrie::ui {

/// Detections: boxes; rejected ones faint and dotted when wanted.
class DetectionLayer : public OverlayLayer {
 public:
    static constexpr OverlayKind kKind{"detections"};

    void paint(QPainter& painter, const OverlayScene& scene) const override;
};

}  // namespace eyrie::ui
