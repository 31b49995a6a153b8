#pragma once

#include <QWidget>

#include "widgets/charts/sweep_chart_data.h"

class QCustomPlot;
class QCPColorScale;
class QCPMarginGroup;

namespace eyrie::ui {

/// The curves or the heat map of a sweep. The best point and its neighbourhood are marked; points are chosen by clicks
/// or with the arrow keys; the chart can be copied as picture and as table.
class SweepChart : public QWidget {
    Q_OBJECT

 public:
    explicit SweepChart(QWidget* parent = nullptr);

    void setData(SweepChartData data);
    const SweepChartData& data() const { return data_; }
    /// The point of the sweep from which arrow keys go on; −1: none.
    void setChosen(int position) { chosen_ = position; }
    void copyText() const;
    void copyPicture();
    QSize sizeHint() const override { return {360, 280}; }
    QSize minimumSizeHint() const override { return {220, 110}; }

 signals:
    /// A point of the sweep was clicked, or reached with an arrow key.
    void pointClicked(int position);

 protected:
    void changeEvent(QEvent* event) override;
    void resizeEvent(QResizeEvent* event) override;
    void contextMenuEvent(QContextMenuEvent* event) override;
    bool event(QEvent* event) override;
    void keyPressEvent(QKeyEvent* event) override;
    bool eventFilter(QObject* watched, QEvent* event) override;

 private:
    void fill();
    void fillCurves();
    void fillMap();
    void setTexts(const QStringList& texts, bool vertical, double room);
    void applyColours();
    QColor colourOf(int index) const;
    /// The point of the sweep under a place of the plot, −1 without one, and what to say of it.
    int pointAt(QPointF place, QString& text) const;
    /// The point so many steps to the right of the chosen one and above it; −1 where there is none.
    int pointBeside(int right, int up) const;

    SweepChartData data_;
    int chosen_ = -1;
    QCustomPlot* plot_;
    QCPMarginGroup* margins_;  ///< keeps the heat map and its scale at one height
    QCPColorScale* scale_ = nullptr;
};

}  // namespace eyrie::ui
