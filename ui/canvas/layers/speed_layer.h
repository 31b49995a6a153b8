#pragma once

#include "canvas/layers/overlay_layer.h"

namespace eyrie::ui {

/// How fast each track that is shown moves over the ground, beside its box: km/h where the GSD is known, else px/frame.
class SpeedLayer : public OverlayLayer {
 public:
    static constexpr OverlayKind kKind{"speeds"};

    void paint(QPainter& painter, const OverlayScene& scene) const override;
};

}  // namespace eyrie::ui
