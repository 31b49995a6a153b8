#include <QCoreApplication>
#include <cmath>
#include <memory>

#include "canvas/drawing/track_captions.h"
#include "canvas/layers/overlay_layer.h"

namespace eyrie::ui {

namespace {

/// How likely each track that is shown is a moving vehicle, in per cent beside its box.
class ScoreLayer : public OverlayLayer {
 public:
    void paint(QPainter& painter, const OverlayScene& scene) const override {
        paintTrackCaptions(painter, scene, [](const TrackState& state) {
            return QCoreApplication::translate("Overlay", "%1 %").arg(std::lround(100 * state.score));
        });
    }
};

}  // namespace

std::unique_ptr<OverlayLayer> scoreLayer() {
    return std::make_unique<ScoreLayer>();
}

}  // namespace eyrie::ui
