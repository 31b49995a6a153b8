#pragma once

#include <QImage>
#include <QRectF>
#include <QString>

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
    /// Keys moved the cross there, not a hand the mouse: it does not shake, and each of its steps is meant.
    bool by_keys = false;
};

/// Something that is done with the mouse on the canvas, or with keys that stand for it (KeyPointer), and what it draws
/// over the picture. The canvas asks it before it pans, zooms or selects itself; whatever answers true is done.
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
    /// What it wants of the user, for the lower edge of the view, where the canvas writes it; empty: nothing.
    virtual QString hint(const CanvasPlace&) const { return {}; }
    /// Whether it waits for places now, so that keys may set them, too.
    virtual bool takesPlaces() const { return true; }
    /// Whether a press at a place of the view takes hold of something until the button is let go.
    virtual bool dragsFrom(QPointF, const CanvasPlace&) const { return false; }
    /// Takes the last place back, if it has any; answers whether it did.
    virtual bool takeBack() { return false; }
    /// Enter was pressed while no cross is shown: ends what is drawn, if it can be; answers whether Enter meant that.
    virtual bool finishByKey() { return false; }
};

}  // namespace eyrie::ui
