#pragma once

#include "canvas/layers/overlay_layer.h"

namespace eyrie::ui {

/// Motion clusters: boxes with their heading.
class ClusterLayer : public OverlayLayer {
 public:
    static constexpr OverlayKind kKind{"clusters"};

    void paint(QPainter& painter, const OverlayScene& scene) const override;
};

}  // namespace eyrie::ui
