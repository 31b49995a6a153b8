#pragma once

#include "canvas/layers/overlay_layer.h"

namespace eyrie::ui {

/// Motion clusters: boxes with their heading.
class ClusterLayer : public OverlayLayer {
 public:
    OverlayKind kind() const override { return OverlayKind::clusters; }
    void paint(QPainter& painter, const OverlayScene& scene) const override;
};

}  // namespace eyrie::ui
