#pragma once

#include <QFrame>

#include "tune/compare/live_preview.h"

class QLabel;
class QPushButton;
class QSpinBox;

namespace eyrie::ui {

/// Says that the picture is a preview, of what, and what can be done with it. Hidden while it is none.
class PreviewBar : public QFrame {
    Q_OBJECT

 public:
    /// `preview` must outlive the bar.
    explicit PreviewBar(LivePreview& preview, QWidget* parent = nullptr);

    QString text() const;

 signals:
    void runRequested();
    void discardRequested();

 protected:
    void resizeEvent(QResizeEvent* event) override;

 private:
    void showText();
    void refresh();

    LivePreview& preview_;
    QString whole_text_;
    QLabel* text_;
    QSpinBox* range_;
    QPushButton* run_;
    QPushButton* discard_;
};

}  // namespace eyrie::ui
