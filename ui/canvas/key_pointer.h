#pragma once

#include <QPointF>
#include <QRectF>
#include <optional>

class QKeyEvent;
class QPainter;
class QString;

namespace eyrie::ui {

class CanvasTool;
struct CanvasPlace;

/// The cross that keys move over the canvas in place of the mouse while a tool takes places: arrows move it by one
/// pixel of the screen, with Shift by ten; Enter and Space do what a click does, once more without moving in between
/// what a double click does. Where a press takes hold of something, the first presses and the next lets go. It tells
/// the tool what the mouse would.
class KeyPointer {
 public:
    /// Whether a key is the cross's own, as long as the tool takes places: nobody else may have it.
    static bool owns(const QKeyEvent& key);
    /// How far a key moves it, screen px; nothing for other keys.
    static std::optional<QPointF> stepOf(const QKeyEvent& key);

    /// Where it is, view coordinates; nothing while the mouse has the canvas.
    const std::optional<QPointF>& at() const { return at_; }
    /// Shows it somewhere; stays where it is if it is shown already.
    void showAt(QPointF view_point);
    void hide();
    /// Whether it has taken hold of something and has not let go.
    bool holds() const { return holds_; }
    /// Moves it, logical px; answers how far it would have left the view.
    QPointF moveBy(QPointF step, const QRectF& view);
    /// Tells the tool where it is.
    void point(CanvasTool& tool, const CanvasPlace& place) const;
    /// Sets a place, or lets go what is held. The tool may end meanwhile. `key`: its modifiers go on to the tool.
    void set(const QKeyEvent& key, CanvasTool& tool, const CanvasPlace& place);
    /// What was set or taken hold of last is gone.
    void forget();
    /// What lies under it changed: what comes next is no double click, but what is held is held still.
    void forgetPlace() { set_here_ = false; }

    void paint(QPainter& painter) const;
    /// What keys can do now, for people.
    QString hint() const;

 private:
    std::optional<QPointF> at_;
    bool set_here_ = false;  ///< a place was set where it is
    bool holds_ = false;
};

}  // namespace eyrie::ui
