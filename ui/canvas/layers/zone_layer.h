#pragma once

#include "canvas/layers/overlay_layer.h"

namespace eyrie::ui {

/// What is watched: areas with a faint ground, lines with an arrow that tells their right from their left, the
/// right ways that were drawn, and names.
class ZoneLayer : public OverlayLayer {
 public:
    static constexpr OverlayKind kKind{"zones"};

    void paint(QPainter& painter, const OverlayScene& scene) const override;
};

}  // namespace eyrie::ui
