#pragma once

#include "canvas/layers/overlay_layer.h"

namespace eyrie::ui {

/// Corners of the ground: dots.
class CornerLayer : public OverlayLayer {
 public:
    static constexpr OverlayKind kKind{"corners"};

    void paint(QPainter& painter, const OverlayScene& scene) const override;
};

}  // namespace eyrie::ui
