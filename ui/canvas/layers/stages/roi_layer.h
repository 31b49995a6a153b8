#pragma once

#include "canvas/layers/overlay_layer.h"

namespace eyrie::ui {

/// Motion ROIs, the areas searched by the detector: dashed boxes.
class RoiLayer : public OverlayLayer {
 public:
    static constexpr OverlayKind kKind{"rois"};

    void paint(QPainter& painter, const OverlayScene& scene) const override;
};

}  // namespace eyrie::ui
