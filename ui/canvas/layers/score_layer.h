#pragma once

#include "canvas/layers/overlay_layer.h"

namespace eyrie::ui {

/// How likely each track that is shown is a moving vehicle, in per cent beside its box.
class ScoreLayer : public OverlayLayer {
 public:
    static constexpr OverlayKind kKind{"scores"};

    void paint(QPainter& painter, const OverlayScene& scene) const override;
};

}  // namespace eyrie::ui
