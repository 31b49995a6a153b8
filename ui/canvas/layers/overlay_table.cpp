#include "canvas/layers/overlay_table.h"

#include <QCoreApplication>

#include "canvas/layers/north_layer.h"
#include "canvas/layers/speed_layer.h"
#include "canvas/layers/stages/cluster_layer.h"
#include "canvas/layers/stages/corner_layer.h"
#include "canvas/layers/stages/detection_layer.h"
#include "canvas/layers/stages/image_stack_layer.h"
#include "canvas/layers/stages/roi_layer.h"
#include "canvas/layers/stages/vector_layer.h"
#include "canvas/layers/track_layer.h"
#include "canvas/layers/truth_layer.h"
#include "canvas/layers/verdict_layer.h"
#include "canvas/layers/zone_layer.h"

namespace eyrie::ui {

// Layers that nothing else names are one file each.
std::unique_ptr<OverlayLayer> scoreLayer();
std::unique_ptr<OverlayLayer> shadowLayer();

namespace {

template <QColor OverlayColours::*colour>
QColor paletteColour(const OverlayStyle& style) {
    return style.colours.*colour;
}

QColor falseAlarmColour(const OverlayStyle& style) {
    return verdictColour(VerdictKind::false_alarm, style.palette);
}

OverlayRow row(OverlayKind kind, std::unique_ptr<OverlayLayer> (*make)(), const char* name, Qt::Key key, bool in_review,
               bool in_label, bool in_tune, QColor (*colour)(const OverlayStyle&)) {
    return {kind, name, key, in_review, in_label, in_tune, colour, make};
}

/// Of a layer with a header, since others name its kind.
template <class Layer>
OverlayRow row(const char* name, Qt::Key key, bool in_review, bool in_label, bool in_tune,
               QColor (*colour)(const OverlayStyle&)) {
    const auto make = [] { return std::unique_ptr<OverlayLayer>(std::make_unique<Layer>()); };
    return row(Layer::kKind, make, name, key, in_review, in_label, in_tune, colour);
}

}  // namespace

const std::vector<OverlayRow>& overlayTable() {
    using Colours = OverlayColours;
    static const std::vector<OverlayRow> table{
        // name, key with Alt, shown at first in review, label, tune, colour
        row<ZoneLayer>(QT_TRANSLATE_NOOP("Overlay", "&Zones and lines"), Qt::Key_Z, true, false, false,
                       paletteColour<&Colours::zone>),
        row<RoiLayer>(QT_TRANSLATE_NOOP("Overlay", "Search a&reas"), Qt::Key_R, false, false, false,
                      paletteColour<&Colours::roi>),
        row<CornerLayer>(QT_TRANSLATE_NOOP("Overlay", "Stationary &corners"), Qt::Key_C, false, false, false,
                         paletteColour<&Colours::stationary_corner>),
        row<VectorLayer>(QT_TRANSLATE_NOOP("Overlay", "Motion &vectors"), Qt::Key_V, false, false, true,
                         paletteColour<&Colours::motion_vector>),
        row<ClusterLayer>(QT_TRANSLATE_NOOP("Overlay", "&Motion clusters"), Qt::Key_M, false, false, true,
                          paletteColour<&Colours::cluster>),
        row<TruthLayer>(QT_TRANSLATE_NOOP("Overlay", "&Ground truth"), Qt::Key_U, false, false, true,
                        paletteColour<&Colours::ground_truth>),
        row<DetectionLayer>(QT_TRANSLATE_NOOP("Overlay", "&Detections"), Qt::Key_D, false, false, true,
                            paletteColour<&Colours::detection>),
        row({"shadows"}, shadowLayer, QT_TRANSLATE_NOOP("Overlay", "S&hadows of tracks"), Qt::Key_9, false, false,
            false, paletteColour<&Colours::shadow>),
        row<TrackLayer>(QT_TRANSLATE_NOOP("Overlay", "&Tracks"), Qt::Key_T, true, false, true,
                        paletteColour<&Colours::track>),
        row<SpeedLayer>(QT_TRANSLATE_NOOP("Overlay", "S&peeds of tracks"), Qt::Key_6, false, false, false,
                        paletteColour<&Colours::track>),
        row({"scores"}, scoreLayer, QT_TRANSLATE_NOOP("Overlay", "Scores of trac&ks"), Qt::Key_7, false, false, false,
            paletteColour<&Colours::track>),
        row<ImageStackLayer>(QT_TRANSLATE_NOOP("Overlay", "Image &stacks"), Qt::Key_S, false, false, false,
                             paletteColour<&Colours::stack>),
        row<VerdictLayer>(QT_TRANSLATE_NOOP("Overlay", "Errors (found, missed, false)"), Qt::Key_Q, false, false, true,
                          falseAlarmColour),
        row<NorthLayer>(QT_TRANSLATE_NOOP("Overlay", "North arrow"), Qt::Key_8, true, false, false,
                        paletteColour<&Colours::north>),
    };
    return table;
}

QString overlayName(const OverlayRow& row) {
    return QCoreApplication::translate("Overlay", row.name);
}

}  // namespace eyrie::ui
