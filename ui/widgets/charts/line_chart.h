#pragma once

#include <QColor>
#include <QStringList>
#include <QWidget>
#include <optional>
#include <vector>

class QCPItemStraightLine;
class QCustomPlot;

namespace eyrie::ui {

/// Values over a common axis, one curve for each series.
struct LineData {
    struct Series {
        QString name;
        QColor colour;               ///< in the light theme; in the dark one it is made lighter
        std::vector<double> values;  ///< as many as `places`; NaN: a gap
    };
    QString place_label;  ///< with unit
    QString value_label;  ///< with unit
    std::vector<double> places;
    std::vector<Series> series;
    std::optional<double> top;  ///< end of the value axis; nothing: as the values need
    bool filled = false;        ///< areas on top of each other instead of curves
    int decimals = 3;           ///< of values, in text and under the cursor

    /// A table with a heading, fields parted by tabs.
    QString text() const;
};

/// Curves over frames. The value under the cursor is told; a click reports the place. Can be copied as picture and as
/// text.
class LineChart : public QWidget {
    Q_OBJECT

 public:
    explicit LineChart(QWidget* parent = nullptr);

    void setData(LineData data);
    const LineData& data() const { return data_; }
    /// A vertical line, such as at the frame shown; nothing: none.
    void setMarker(std::optional<double> place);
    QPixmap picture() const { return const_cast<LineChart*>(this)->grab(); }

    QSize sizeHint() const override { return {340, 170}; }
    QSize minimumSizeHint() const override { return {180, 120}; }

 signals:
    void placeActivated(double place);

 protected:
    void changeEvent(QEvent* event) override;
    void contextMenuEvent(QContextMenuEvent* event) override;
    bool eventFilter(QObject* watched, QEvent* event) override;

 private:
    void fill();
    void applyColours();
    QString readoutAt(double place) const;

    LineData data_;
    QCustomPlot* plot_;
    QCPItemStraightLine* marker_;
};

}  // namespace eyrie::ui
