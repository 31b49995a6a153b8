#pragma once

#include "canvas/layers/overlay_layer.h"

namespace eyrie::ui {

/// Ground truth: boxes; objects that count neither way dotted.
class TruthLayer : public OverlayLayer {
 public:
    static constexpr OverlayKind kKind{"ground_truth"};

    void paint(QPainter& painter, const OverlayScene& scene) const override;
};

}  // namespace eyrie::ui
