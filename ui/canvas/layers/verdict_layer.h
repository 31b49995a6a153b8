#pragma once

#include "canvas/layers/overlay_layer.h"

namespace eyrie::ui {

/// The colour of a verdict, told apart with any colour vision in the one palette.
QColor verdictColour(VerdictKind kind, PaletteKind palette);
/// For the legend: "found", "missed" …
QString verdictText(VerdictKind kind);

/// What the evaluation says of the frame: boxes in the colours of their verdicts and a legend with counts. What was
/// found is drawn thin, so that errors stand out; missed objects are dashed, since no result is there.
class VerdictLayer : public OverlayLayer {
 public:
    static constexpr OverlayKind kKind{"verdicts"};

    void paint(QPainter& painter, const OverlayScene& scene) const override;
};

}  // namespace eyrie::ui
