#pragma once

#include <QColor>

#include "canvas/drawing/mark_colours.h"

namespace eyrie::ui {

/// A set of colours for overlays.
enum class PaletteKind {
    thesis,       ///< the thesis' colours, but for corners
    colour_blind  ///< told apart with any colour vision (after Okabe and Ito's set)
};

/// The colour of each kind of overlay. One meaning, one colour, in the canvas, the lists and the timeline.
struct OverlayColours {
    QColor stationary_corner;
    QColor motion_vector;
    QColor cluster;
    QColor roi;
    QColor stack;
    QColor detection;
    QColor rejected;
    QColor track;
    QColor selected_track;
    QColor ground_truth;
    QColor non_vehicle;
    QColor zone;  ///< of the first one; each may have its own
    QColor north;
    QColor shadow;
    /// Thin dark rim that keeps lines readable on any ground. Opaque: blending would cost four times as much.
    QColor edge;
};

inline OverlayColours overlayColours(PaletteKind kind) {
    const QColor edge = edgeColour();
    if (kind == PaletteKind::colour_blind)
        return {.stationary_corner = QColor(213, 94, 0),
                .motion_vector = QColor(240, 228, 66),
                .cluster = QColor(86, 180, 233),
                .roi = QColor(86, 180, 233, 150),
                .stack = QColor(204, 121, 167),
                .detection = QColor(230, 159, 0),
                .rejected = QColor(230, 159, 0, 140),
                .track = QColor(0, 190, 140),
                .selected_track = QColor(255, 255, 255),
                .ground_truth = QColor(245, 245, 245),
                .non_vehicle = QColor(0, 114, 178),
                .zone = QColor(120, 180, 255),
                .north = QColor(250, 250, 245),
                .shadow = QColor(240, 215, 185),
                .edge = edge};
    // The text has corners in red (Teutsch fig. 4.3) and detections, too (figs. 6.3, 7.15, 7.20). Here both may be
    // drawn over one picture: red are detections, which more figures show, and corners have a hue that nothing else
    // has.
    return {.stationary_corner = QColor(165, 115, 255),
            .motion_vector = QColor(255, 230, 0),
            .cluster = QColor(0, 229, 255),
            .roi = QColor(0, 229, 255, 140),
            .stack = QColor(255, 64, 255),
            .detection = QColor(255, 60, 50),
            .rejected = QColor(255, 60, 50, 130),
            .track = QColor(64, 235, 80),
            .selected_track = QColor(210, 255, 120),
            .ground_truth = QColor(255, 255, 255),
            .non_vehicle = QColor(255, 160, 40),
            .zone = QColor(120, 180, 255),
            .north = QColor(250, 250, 245),
            .shadow = QColor(240, 205, 160),
            .edge = edge};
}

}  // namespace eyrie::ui
