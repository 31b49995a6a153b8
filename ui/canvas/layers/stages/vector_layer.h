#pragma once

#include "canvas/layers/overlay_layer.h"

namespace eyrie::ui {

/// Motion vectors: from where the corner is to where it will be in `vector_length_factor` frames, relative to the
/// ground.
class VectorLayer : public OverlayLayer {
 public:
    static constexpr OverlayKind kKind{"vectors"};

    void paint(QPainter& painter, const OverlayScene& scene) const override;
};

}  // namespace eyrie::ui
