#pragma once

#include <QColor>
#include <QPalette>
#include <QRectF>
#include <QString>
#include <optional>
#include <utility>
#include <vector>

#include "canvas/timeline/timeline_axis.h"

namespace eyrie::ui {

/// Something that lasts from one frame to another, both included.
struct TimelineHappening {
    int id = 0;
    FrameIndex first = 0;
    FrameIndex last = 0;
};

/// What of its row's height a bar takes, so that kinds of one colour are told apart.
enum class BarShape { full_height, upper_half, lower_half, edges };
/// The parts of a row's bar that are filled, one or two.
std::vector<QRectF> filledParts(BarShape shape, const QRectF& bar);

/// All that happened of one kind.
struct TimelineKind {
    QString name;
    QColor on_light;  ///< its colour on the ground of the light theme …
    QColor on_dark;   ///< … and of the dark one
    BarShape shape = BarShape::full_height;
    std::vector<TimelineHappening> happenings;
};

/// Thin rows along a timeline, one for each kind of what happened. Where kinds are many, the most frequent ones share
/// the last row. Any number of happenings: only as many bars are drawn as fit beside each other. Arithmetic only.
class TimelineKinds {
 public:
    static constexpr int kMostRows = 8;
    static constexpr double kRowHeight = 4;  ///< px
    static constexpr double kRowStep = 5;
    static constexpr double kLeastBar = 2;

    /// From … to, px.
    using Bar = std::pair<double, double>;

    TimelineKinds() = default;
    /// Kinds without happenings are left out.
    explicit TimelineKinds(std::vector<TimelineKind> kinds);

    bool empty() const { return rows_.empty(); }
    int rowCount() const { return static_cast<int>(rows_.size()); }
    /// All rows, px.
    double height() const { return kRowStep * rowCount(); }
    /// The row at so many px below the first one's top; nothing outside of them.
    std::optional<int> rowAt(double y) const;
    /// "Stops", or "9 other kinds".
    QString nameOf(int row) const;
    /// On the palette's ground; of several kinds no one's.
    QColor colourOf(int row, const QPalette& palette) const;
    BarShape shapeOf(int row) const { return at(row).shape; }
    /// What is to be drawn of a row, ascending and apart: at most one bar a column of pixels.
    std::vector<Bar> bars(int row, const TimelineAxis& axis) const;
    /// How many of each kind of the row lie within `reach` px of x, in lines: "Stops: 3 here, 214 in all".
    QString textAt(int row, double x, const TimelineAxis& axis, double reach) const;
    /// The id of the one nearest to x of those; of several there the one that began last. Nothing for none.
    std::optional<int> nearest(int row, double x, const TimelineAxis& axis, double reach) const;
    /// Row and frames; nothing for an id that there is not.
    std::optional<std::pair<int, TimelineHappening>> find(int id) const;

 private:
    struct Entry {
        TimelineHappening happening;
        std::size_t kind = 0;  ///< among those of the row
    };
    struct Row {
        std::vector<QString> names;
        std::vector<int> counts;  ///< of each kind
        QColor on_light;          ///< null for several kinds
        QColor on_dark;
        BarShape shape = BarShape::full_height;
        std::vector<Entry> entries;  ///< ascending first frames
    };
    static void add(Row& row, TimelineKind kind);
    const Row& at(int row) const { return rows_.at(static_cast<std::size_t>(row)); }

    std::vector<Row> rows_;
};

}  // namespace eyrie::ui
