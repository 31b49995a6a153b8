#pragma once

#include <QList>
#include <QObject>
#include <QPointer>

class QKeyEvent;
class QWidget;

namespace eyrie::ui {

/// Keys belong to what has the focus where it knows them, though they are commands of the window elsewhere: Space
/// presses a button and opens a box of choices, arrows move a slider, and whatever is opened over the window has them
/// all. What a mouse was pressed on has the focus, too, but leaves them to the window: Space goes on playing.
class FocusedKeys : public QObject {
    Q_OBJECT

 public:
    /// Heeds every widget of the application, as long as `parent` lives.
    explicit FocusedKeys(QObject* parent);

 protected:
    bool eventFilter(QObject* watched, QEvent* event) override;

 private:
    void gotFocus(const QWidget& widget, bool by_mouse);
    bool wants(const QWidget& widget, const QKeyEvent& key) const;

    QList<QPointer<const QWidget>> clicked_;  ///< what has the focus by the mouse, at most one of each window
};

}  // namespace eyrie::ui
