#pragma once

#include "canvas/layers/overlay_layer.h"

namespace eyrie::ui {

/// Image stacks: a cross, turned to the heading, where the master vector lies, and dots on its motion vectors, each
/// stack in a colour of its own (fig. 5.5–5.9).
class ImageStackLayer : public OverlayLayer {
 public:
    static constexpr OverlayKind kKind{"stacks"};

    void paint(QPainter& painter, const OverlayScene& scene) const override;
};

}  // namespace eyrie::ui
