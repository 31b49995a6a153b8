#pragma once

#include <QImage>
#include <QRectF>

#include "canvas/view_transform.h"

class QKeyEvent;
class QMouseEvent;
class QPainter;

namespace eyrie::ui {

/// What a tool sees of the canvas it works on.
struct CanvasPlace {
    const ViewTransform& transform;
    const QImage& image;  ///< the picture shown; may be null
    QRectF view;          ///< logical px
};

/// Something that is done with the mouse on the canvas, and what it draws over the picture. The canvas asks it before
/// it pans, zooms or selects itself; whatever answers true is done.
class CanvasTool {
 public:
    virtual ~CanvasTool() = default;
    virtual void paint(QPainter& painter, const CanvasPlace& place) const = 0;
    virtual bool press(const QMouseEvent& event, const CanvasPlace& place) = 0;
    virtual bool move(const QMouseEvent& event, const CanvasPlace& place) = 0;
    virtual bool release(const QMouseEvent& event, const CanvasPlace& place) = 0;
    virtual bool doubleClick(const QMouseEvent& event, const CanvasPlace& place) = 0;
    /// The mouse left the canvas.
    virtual void leave() = 0;
    /// Nothing while the canvas' own shape holds.
    virtual const QCursor* cursor() const = 0;
};

}  // namespace eyrie::ui
