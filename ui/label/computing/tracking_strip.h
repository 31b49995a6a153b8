#pragma once

#include <QWidget>
#include <functional>

#include "label/computing/label_tracking.h"

class QLabel;
class QProgressBar;

namespace eyrie::ui {

/// Says over the video which object is being tracked, how far, and how long it may still take, with a button that ends
/// it. Hidden until then.
class TrackingStrip : public QWidget {
    Q_OBJECT

 public:
    explicit TrackingStrip(std::function<void()> stop, QWidget* parent = nullptr);

    void showAdvance(const TrackingAdvance& advance);
    QString text() const;

 private:
    QLabel* text_;
    QProgressBar* bar_;
};

}  // namespace eyrie::ui
