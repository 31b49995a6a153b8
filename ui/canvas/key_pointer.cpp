#include "canvas/key_pointer.h"

#include <QCoreApplication>
#include <QKeyEvent>
#include <QMouseEvent>
#include <QPainter>
#include <algorithm>
#include <utility>

#include "canvas/canvas_tool.h"

namespace eyrie::ui {

namespace {

constexpr double kLargeStep_px = 10;  ///< of the screen, with Shift
constexpr double kCrossGap = 4;       ///< logical px: the place itself stays to be seen
constexpr double kCrossArm = 18;      ///< from the middle, logical px

QMouseEvent asMouse(QEvent::Type type, QPointF at, Qt::MouseButton button, Qt::MouseButtons held,
                    Qt::KeyboardModifiers keys = {}) {
    return {type, at, at, button, held, keys};
}

}  // namespace

std::optional<QPointF> KeyPointer::stepOf(const QKeyEvent& key) {
    const auto modifiers = key.modifiers() & ~Qt::KeypadModifier;
    if (modifiers != Qt::NoModifier && modifiers != Qt::ShiftModifier) return std::nullopt;
    const double step = modifiers == Qt::ShiftModifier ? kLargeStep_px : 1;
    switch (key.key()) {
        case Qt::Key_Left:
            return QPointF(-step, 0);
        case Qt::Key_Right:
            return QPointF(step, 0);
        case Qt::Key_Up:
            return QPointF(0, -step);
        case Qt::Key_Down:
            return QPointF(0, step);
        default:
            return std::nullopt;
    }
}

bool KeyPointer::owns(const QKeyEvent& key) {
    if (stepOf(key)) return true;
    const auto modifiers = key.modifiers() & ~Qt::KeypadModifier;
    switch (key.key()) {
        case Qt::Key_Return:
        case Qt::Key_Enter:
            return modifiers == Qt::NoModifier || modifiers == Qt::ShiftModifier;
        case Qt::Key_Backspace:
            return modifiers == Qt::NoModifier;
        default:
            return false;
    }
}

void KeyPointer::showAt(QPointF view_point) {
    if (!at_) at_ = view_point;
}

void KeyPointer::hide() {
    at_.reset();
    forget();
}

void KeyPointer::forget() {
    forgetPlace();
    holds_ = false;
}

QPointF KeyPointer::moveBy(QPointF step, const QRectF& view) {
    forgetPlace();
    const QPointF wanted = *at_ + step;
    at_ = QPointF(std::clamp(wanted.x(), view.left(), view.right()), std::clamp(wanted.y(), view.top(), view.bottom()));
    return wanted - *at_;
}

void KeyPointer::point(CanvasTool& tool, const CanvasPlace& place) const {
    tool.move(asMouse(QEvent::MouseMove, *at_, Qt::NoButton, holds_ ? Qt::LeftButton : Qt::NoButton), place);
}

void KeyPointer::set(const QKeyEvent& key, CanvasTool& tool, const CanvasPlace& place) {
    const QPointF at = *at_;
    const auto keys = key.modifiers() & ~Qt::KeypadModifier;
    const auto let_go = [&] {
        tool.release(asMouse(QEvent::MouseButtonRelease, at, Qt::LeftButton, Qt::NoButton, keys), place);
    };
    // What the pointer remembers comes first: a tool that ends hides it.
    if (std::exchange(holds_, false)) {
        let_go();
        return;
    }
    const bool again = std::exchange(set_here_, !set_here_);
    if (tool.dragsFrom(at, place)) {
        holds_ = true;
        tool.press(asMouse(QEvent::MouseButtonPress, at, Qt::LeftButton, Qt::LeftButton, keys), place);
        return;
    }
    if (again)
        tool.doubleClick(asMouse(QEvent::MouseButtonDblClick, at, Qt::LeftButton, Qt::LeftButton, keys), place);
    else
        tool.press(asMouse(QEvent::MouseButtonPress, at, Qt::LeftButton, Qt::LeftButton, keys), place);
    let_go();
}

void KeyPointer::paint(QPainter& painter) const {
    if (!at_) return;
    QVector<QLineF> lines;
    for (const QPointF way : {QPointF(1, 0), QPointF(-1, 0), QPointF(0, 1), QPointF(0, -1)})
        lines.append({*at_ + way * kCrossGap, *at_ + way * kCrossArm});
    // White on black shows on any picture.
    for (const auto& [colour, width] : {std::pair(QColor(Qt::black), 5.0), std::pair(QColor(Qt::white), 2.0)}) {
        painter.setPen(QPen(colour, width, Qt::SolidLine, Qt::SquareCap));
        painter.drawLines(lines);
    }
}

QString KeyPointer::hint() const {
    const auto words = [](const char* text) { return QCoreApplication::translate("eyrie::ui::KeyPointer", text); };
    if (holds_) return words(QT_TR_NOOP("Arrow keys: move · Enter or Space: release here"));
    if (at_) return words(QT_TR_NOOP("Enter or Space: click here; again without moving: double-click"));
    return words(QT_TR_NOOP("Arrow keys: move a cross (Shift: 10 px), to click with Enter or Space"));
}

}  // namespace eyrie::ui
