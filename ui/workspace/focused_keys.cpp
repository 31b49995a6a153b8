#include "workspace/focused_keys.h"

#include <QAbstractButton>
#include <QAbstractSlider>
#include <QApplication>
#include <QComboBox>
#include <QFocusEvent>
#include <QKeyEvent>
#include <QTabBar>

namespace eyrie::ui {

namespace {

bool goesThroughValues(int key) {
    switch (key) {
        case Qt::Key_Left:
        case Qt::Key_Right:
        case Qt::Key_Up:
        case Qt::Key_Down:
        case Qt::Key_PageUp:
        case Qt::Key_PageDown:
        case Qt::Key_Home:
        case Qt::Key_End:
            return true;
        default:
            return false;
    }
}

bool goesThroughChoices(const QKeyEvent& key) {
    const bool sideways = key.key() == Qt::Key_Left || key.key() == Qt::Key_Right;
    return key.key() == Qt::Key_Space || (goesThroughValues(key.key()) && !sideways);
}

bool opensChoices(const QKeyEvent& key, Qt::KeyboardModifiers modifiers) {
    return modifiers == Qt::AltModifier && (key.key() == Qt::Key_Down || key.key() == Qt::Key_Up);
}

}  // namespace

FocusedKeys::FocusedKeys(QObject* parent) : QObject(parent) {
    qApp->installEventFilter(this);
}

bool FocusedKeys::eventFilter(QObject* watched, QEvent* event) {
    const QEvent::Type type = event->type();
    if (type != QEvent::ShortcutOverride && type != QEvent::FocusIn && type != QEvent::MouseButtonPress) return false;
    const auto* widget = qobject_cast<const QWidget*>(watched);
    if (widget == nullptr) return false;
    if (type == QEvent::FocusIn) {
        const Qt::FocusReason reason = static_cast<QFocusEvent*>(event)->reason();
        // Back from a menu or another window, it is as it was.
        const bool back =
            reason == Qt::PopupFocusReason || reason == Qt::MenuBarFocusReason || reason == Qt::ActiveWindowFocusReason;
        if (!back) gotFocus(*widget, reason == Qt::MouseFocusReason);
        return false;
    }
    if (type == QEvent::MouseButtonPress) {  // keys may have led to it before
        if (widget == QApplication::focusWidget()) gotFocus(*widget, true);
        return false;
    }
    if (!wants(*widget, *static_cast<QKeyEvent*>(event))) return false;
    event->accept();
    return true;
}

void FocusedKeys::gotFocus(const QWidget& widget, bool by_mouse) {
    clicked_.removeIf([&](const auto& one) { return one.isNull() || one->window() == widget.window(); });
    if (by_mouse) clicked_.append(&widget);
}

bool FocusedKeys::wants(const QWidget& widget, const QKeyEvent& key) const {
    if (widget.window()->windowType() == Qt::Popup) return true;
    if (clicked_.contains(&widget)) return false;
    const Qt::KeyboardModifiers modifiers = key.modifiers() & ~Qt::KeypadModifier;  // arrows beside the digits, too
    if (const auto* box = qobject_cast<const QComboBox*>(&widget)) {
        // One that can be written in has what is written already.
        if (opensChoices(key, modifiers)) return true;
        return modifiers == Qt::NoModifier && goesThroughChoices(key) && !box->isEditable();
    }
    if (modifiers != Qt::NoModifier) return false;
    if (qobject_cast<const QAbstractButton*>(&widget) != nullptr) return key.key() == Qt::Key_Space;
    if (qobject_cast<const QAbstractSlider*>(&widget) != nullptr) return goesThroughValues(key.key());
    const bool sideways = key.key() == Qt::Key_Left || key.key() == Qt::Key_Right;
    return sideways && qobject_cast<const QTabBar*>(&widget) != nullptr;
}

}  // namespace eyrie::ui

#include "moc_focused_keys.cpp"
