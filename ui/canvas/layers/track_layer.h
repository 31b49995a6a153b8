#pragma once

#include <span>

#include "canvas/layers/overlay_layer.h"

namespace eyrie::ui {

/// Tracks: boxes with heading, trail and id; coasting ones dashed, the selected one stronger.
class TrackLayer : public OverlayLayer {
 public:
    static constexpr OverlayKind kKind{"tracks"};

    void paint(QPainter& painter, const OverlayScene& scene) const override;

 private:
    void paintTrails(QPainter& painter, const OverlayScene& scene) const;
    void paintBoxes(QPainter& painter, const OverlayScene& scene) const;
};

/// The track whose box lies under an image point, the smallest if several do; `margin` px around boxes count as hit.
std::optional<TrackId> trackAt(std::span<const TrackState> states, const OverlayStyle& style, QPointF image_point,
                               double margin);

}  // namespace eyrie::ui
