#pragma once

#include <QLabel>

namespace eyrie::ui {

/// One line of plain text that gives way where there is too little room: it is cut with "…", and its tooltip says all
/// of it then. A tooltip of its own, set with setToolTip(), comes below.
class ElidedLabel : public QLabel {
    Q_OBJECT

 public:
    explicit ElidedLabel(Qt::TextElideMode mode, QWidget* parent = nullptr);

    QSize minimumSizeHint() const override;

 protected:
    bool event(QEvent* event) override;
    void paintEvent(QPaintEvent* event) override;

 private:
    bool isCut() const;

    Qt::TextElideMode mode_;
};

}  // namespace eyrie::ui
