#pragma once

#include <QStringList>
#include <QWidget>

namespace eyrie::ui {

/// What the tints of the coverage mean: all of them in a row, and below the times of the first, the middle and the last
/// one.
class CoverageLegend : public QWidget {
    Q_OBJECT

 public:
    explicit CoverageLegend(QWidget* parent = nullptr);

    /// As many times as there are, from the darkest tint to the brightest; a single one stands for all the ground, in
    /// the brightest.
    void setTimes(const QStringList& times);
    const QStringList& times() const { return times_; }

    QSize sizeHint() const override;
    QSize minimumSizeHint() const override;

 protected:
    void paintEvent(QPaintEvent* event) override;

 private:
    QStringList times_;
};

}  // namespace eyrie::ui
