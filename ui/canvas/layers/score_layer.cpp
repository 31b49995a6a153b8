#include "canvas/layers/score_layer.h"

#include <QCoreApplication>
#include <cmath>

#include "canvas/drawing/track_captions.h"

namespace eyrie::ui {

void ScoreLayer::paint(QPainter& painter, const OverlayScene& scene) const {
    paintTrackCaptions(painter, scene, [](const TrackState& state) {
        return QCoreApplication::translate("Overlay", "%1 %").arg(std::lround(100 * state.score));
    });
}

}  // namespace eyrie::ui
