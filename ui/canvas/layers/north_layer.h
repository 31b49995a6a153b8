#pragma once

#include "canvas/layers/overlay_layer.h"

namespace eyrie::ui {

/// An arrow in the upper right corner of the view that points to where north is in the middle of the picture, however
/// that is turned; nothing where nobody knows. Belongs to the video: it needs no run.
class NorthLayer : public OverlayLayer {
 public:
    static constexpr OverlayKind kKind{"north"};

    void paint(QPainter& painter, const OverlayScene& scene) const override;
    bool needsResult() const override { return false; }
};

}  // namespace eyrie::ui
