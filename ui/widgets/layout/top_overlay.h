#pragma once

#include <QObject>
#include <functional>

class QWidget;

namespace eyrie::ui {

/// Keeps a widget at the top of an area, above whatever is shown there: as high as it needs, across the middle, and
/// without taking any room from the area. The mouse works on the area wherever the widget is not.
class TopOverlay : public QObject {
    Q_OBJECT

 public:
    /// `overlay` and `area` have the same parent, whose layout knows nothing of `overlay`, and live as long as this
    /// does.
    TopOverlay(QWidget& overlay, QWidget& area, QObject* parent);
    /// Who is told how much of the area is covered at its top, px, whenever that may have changed.
    void setCovers(std::function<void(int covered_px)> covers);

 protected:
    bool eventFilter(QObject* watched, QEvent* event) override;

 private:
    void place();
    void tell() const;

    std::function<void(int covered_px)> covers_ = [](int) {};
    QWidget& overlay_;
    QWidget& area_;
};

}  // namespace eyrie::ui
