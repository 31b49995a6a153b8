#pragma once

#include <QFont>
#include <QRectF>
#include <compare>
#include <optional>
#include <string_view>

#include "canvas/overlay_colours.h"
#include "canvas/view_frame.h"
#include "canvas/view_transform.h"
#include "core/values/ids.h"

class QPainter;

namespace eyrie::ui {

class CaptionPlacer;

/// A kind of overlay. Layers that others name declare their own, `kKind`; the others' stand in their rows of the
/// overlay table.
struct OverlayKind {
    std::string_view word;  ///< by which settings know it, so it stays

    auto operator<=>(const OverlayKind&) const = default;
};

/// The shortest and the longest that vectors can be drawn: as this many frames of motion.
inline constexpr double kShortestVectors = 1;
inline constexpr double kLongestVectors = 100;

/// What overlays are drawn with: which of their details, and how long. Each workspace keeps its own.
struct OverlayDetail {
    bool labels = true;  ///< captions beside tracks, zones and errors
    bool trails = true;
    bool rejected_detections = false;
    bool tentative_tracks = false;
    double vector_length_factor = 5;  ///< a vector is drawn as long as this many frames of motion

    bool operator==(const OverlayDetail&) const = default;
};

/// How overlays are drawn, whichever frame they belong to.
struct OverlayStyle {
    OverlayColours colours = overlayColours(PaletteKind::thesis);
    PaletteKind palette = PaletteKind::thesis;
    OverlayDetail detail;
    double min_score = 0;     ///< tracks of a lower score are not shown
    double line_width = 1.6;  ///< logical px, whatever the zoom
};

/// One frame to be drawn over, as seen through a view.
struct OverlayScene {
    const ViewFrame& frame;
    const FrameResult& result;
    const ViewTransform& transform;
    const OverlayStyle& style;
    std::optional<TrackId> selected_track;
    QRectF view;              ///< what lies outside need not be drawn; logical px
    CaptionPlacer& captions;  ///< of all layers, so that none writes over another
};

/// Draws one kind of thing over the video. Painters come in view coordinates (logical px), antialiasing on; a layer
/// maps its own points and leaves no state but pen and brush behind.
class OverlayLayer {
 public:
    virtual ~OverlayLayer() = default;
    virtual void paint(QPainter& painter, const OverlayScene& scene) const = 0;
    /// Whether there is nothing to paint in a frame that no run knows: where it is painted nevertheless, the result is
    /// empty.
    virtual bool needsResult() const { return true; }
};

}  // namespace eyrie::ui
