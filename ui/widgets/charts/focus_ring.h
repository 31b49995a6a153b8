#pragma once

#include <QWidget>

namespace eyrie::ui {

/// A ring around a widget while it has the keyboard's focus, above what the widget and its children paint. The mouse
/// does not notice it.
class FocusRing : public QWidget {
    Q_OBJECT

 public:
    /// A child of what it surrounds.
    explicit FocusRing(QWidget& around);

 protected:
    bool eventFilter(QObject* watched, QEvent* event) override;
    void paintEvent(QPaintEvent* event) override;

 private:
    void follow(bool focused);
};

}  // namespace eyrie::ui
