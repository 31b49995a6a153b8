#include "canvas/layers/overlay_table.h"

#include <QCoreApplication>

#include "canvas/layers/cluster_layer.h"
#include "canvas/layers/corner_layer.h"
#include "canvas/layers/detection_layer.h"
#include "canvas/layers/image_stack_layer.h"
#include "canvas/layers/roi_layer.h"
#include "canvas/layers/track_layer.h"
#include "canvas/layers/truth_layer.h"
#include "canvas/layers/vector_layer.h"
#include "canvas/layers/verdict_layer.h"

namespace eyrie::ui {

namespace {

template <QColor OverlayColours::*colour>
QColor paletteColour(const OverlayStyle& style) {
    return style.colours.*colour;
}

QColor falseAlarmColour(const OverlayStyle& style) {
    return verdictColour(VerdictKind::false_alarm, style.palette);
}

template <class Layer>
std::unique_ptr<OverlayLayer> make() {
    return std::make_unique<Layer>();
}

}  // namespace

const std::array<OverlayRow, kOverlayKindCount>& overlayTable() {
    using Colours = OverlayColours;
    static const std::array<OverlayRow, kOverlayKindCount> table{{
        // kind, name, key, shown at first in review, label, tune, colour, layer
        {OverlayKind::rois, QT_TRANSLATE_NOOP("Overlay", "Motion &ROIs"), Qt::Key_R, false, false, false,
         paletteColour<&Colours::roi>, make<RoiLayer>},
        {OverlayKind::corners, QT_TRANSLATE_NOOP("Overlay", "Stationary &corners"), Qt::Key_C, false, false, false,
         paletteColour<&Colours::stationary_corner>, make<CornerLayer>},
        {OverlayKind::vectors, QT_TRANSLATE_NOOP("Overlay", "Motion &vectors"), Qt::Key_V, false, false, true,
         paletteColour<&Colours::motion_vector>, make<VectorLayer>},
        {OverlayKind::clusters, QT_TRANSLATE_NOOP("Overlay", "&Motion clusters"), Qt::Key_M, false, false, true,
         paletteColour<&Colours::cluster>, make<ClusterLayer>},
        {OverlayKind::ground_truth, QT_TRANSLATE_NOOP("Overlay", "&Ground truth"), Qt::Key_U, false, false, true,
         paletteColour<&Colours::ground_truth>, make<TruthLayer>},
        {OverlayKind::detections, QT_TRANSLATE_NOOP("Overlay", "&Detections"), Qt::Key_D, false, false, true,
         paletteColour<&Colours::detection>, make<DetectionLayer>},
        {OverlayKind::tracks, QT_TRANSLATE_NOOP("Overlay", "&Tracks"), Qt::Key_T, true, false, true,
         paletteColour<&Colours::track>, make<TrackLayer>},
        {OverlayKind::stacks, QT_TRANSLATE_NOOP("Overlay", "Image &stacks"), Qt::Key_S, false, false, false,
         paletteColour<&Colours::stack>, make<ImageStackLayer>},
        {OverlayKind::verdicts, QT_TRANSLATE_NOOP("Overlay", "Errors (found, missed, false)"), Qt::Key_Q, false, false,
         true, falseAlarmColour, make<VerdictLayer>},
    }};
    return table;
}

QString overlayName(const OverlayRow& row) {
    return QCoreApplication::translate("Overlay", row.name);
}

}  // namespace eyrie::ui
