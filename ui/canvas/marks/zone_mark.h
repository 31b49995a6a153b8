#pragma once

#include <QColor>
#include <QPointF>
#include <QString>
#include <vector>

namespace eyrie::ui {

/// A zone or a line that is watched, as it lies in one frame.
struct ZoneMark {
    QString name;
    std::vector<QPointF> points;  ///< image coordinates
    bool closed = true;           ///< an area; else a line from its first to its last point
    QColor colour;
    bool selected = false;
};

}  // namespace eyrie::ui
