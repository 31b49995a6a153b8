#pragma once

#include <QColor>
#include <QPointF>
#include <vector>

#include "core/geometry/oriented_box.h"

namespace eyrie::ui {

/// A place of the frame that is asked about, with dots in it.
struct PlaceMark {
    struct Dot {
        QPointF place;  ///< image px
        QColor colour;
    };
    OrientedBox area;
    std::vector<Dot> dots;
};

}  // namespace eyrie::ui
