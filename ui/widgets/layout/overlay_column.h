#pragma once

#include <QWidget>

class QVBoxLayout;

namespace eyrie::ui {

/// What lies over the top of an area, one below the other; there as long as one of them is.
class OverlayColumn : public QWidget {
    Q_OBJECT

 public:
    explicit OverlayColumn(QWidget* parent = nullptr);

    /// Above what was added before, so that what comes and goes more often moves nothing that stays. Takes it over.
    void add(QWidget& widget);

 protected:
    bool eventFilter(QObject* watched, QEvent* event) override;

 private:
    void follow();

    QVBoxLayout* rows_;
};

}  // namespace eyrie::ui
