#include "canvas/layers/speed_layer.h"

#include <cmath>

#include "canvas/drawing/track_captions.h"
#include "widgets/display_text.h"

namespace eyrie::ui {

void SpeedLayer::paint(QPainter& painter, const OverlayScene& scene) const {
    paintTrackCaptions(painter, scene, [&](const TrackState& state) {
        return shortSpeedText(std::hypot(state.velocity.x, state.velocity.y), scene.frame.scale.at(state.box.centre));
    });
}

}  // namespace eyrie::ui
