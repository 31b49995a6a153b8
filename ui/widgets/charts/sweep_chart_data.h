#pragma once

#include <QColor>
#include <QPointF>
#include <QString>
#include <QStringList>
#include <optional>
#include <utility>
#include <vector>

namespace eyrie::ui {

/// A curve or a heat map of a sweep, ready to be drawn. Missing values are not numbers.
struct SweepChartData {
    /// A line through points; each belongs to a point of the sweep.
    struct Series {
        QString name;
        int colour = 0;  ///< which of the chart's colours
        bool bold = false;
        std::vector<double> x;
        std::vector<double> y;
        std::vector<int> positions;
    };
    QString x_label;  ///< with unit
    QString y_label;
    QStringList x_words;  ///< texts of x = 0, 1, 2 …; empty: x is a number
    std::vector<Series> series;
    std::optional<std::pair<double, double>> band;  ///< of x: as good as the best
    std::vector<QPointF> best;                      ///< marked points
    bool share = false;                             ///< y lies in 0 … 1 and the axis shows no more than that

    // A heat map, in place of series.
    QStringList columns;  ///< values along x; empty: no heat map
    QStringList rows;     ///< values along y
    QString value_label;
    std::vector<double> cells;                     ///< row after row; the position of a cell is its index
    std::optional<std::pair<int, int>> best_cell;  ///< row and column
    std::optional<std::pair<std::pair<int, int>, std::pair<int, int>>> best_rows_columns;  ///< as good as the best
    int decimals = 4;

    bool isMap() const { return !columns.isEmpty(); }
    /// A table with a heading, fields parted by tabs.
    QString text() const;
};

}  // namespace eyrie::ui
