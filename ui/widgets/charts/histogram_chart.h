#pragma once

#include <QColor>
#include <QStringList>
#include <QWidget>
#include <vector>

class QCustomPlot;

namespace eyrie::ui {

/// Counts per bin, of one or more kinds side by side.
struct HistogramData {
    struct Series {
        QString name;
        QColor colour;
        std::vector<double> counts;
    };
    QString value_label;  ///< with unit
    QString count_label;
    QStringList bins;  ///< a text for every bin; empty: bins are `bin_width` wide, from 0
    double bin_width = 1;
    bool logarithmic = false;  ///< heights
    std::vector<Series> series;

    /// A table with a heading, fields parted by tabs.
    QString text() const;
};

/// A histogram. Can be copied as picture and as text.
class HistogramChart : public QWidget {
    Q_OBJECT

 public:
    explicit HistogramChart(QWidget* parent = nullptr);

    void setData(HistogramData data);
    const HistogramData& data() const { return data_; }
    QSize sizeHint() const override { return {320, 200}; }
    QSize minimumSizeHint() const override { return {160, 120}; }

 protected:
    void changeEvent(QEvent* event) override;
    void resizeEvent(QResizeEvent* event) override;
    void contextMenuEvent(QContextMenuEvent* event) override;

 private:
    void fill();
    void applyColours();
    double largestCount() const;

    HistogramData data_;
    QCustomPlot* plot_;
};

}  // namespace eyrie::ui
