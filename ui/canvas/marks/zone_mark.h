#pragma once

#include <QColor>
#include <QPointF>
#include <QString>
#include <vector>

namespace eyrie::ui {

/// A zone or a line that is watched, or the right way that was drawn, as it lies in one frame.
struct ZoneMark {
    QString name;
    std::vector<QPointF> points;  ///< image coordinates
    bool closed = true;           ///< an area; else a line or arrow from its first to its last point
    QColor colour;
    bool selected = false;
    bool right_way = false;  ///< an arrow along a lane; not closed
};

}  // namespace eyrie::ui
