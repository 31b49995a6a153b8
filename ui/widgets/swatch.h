#pragma once

#include <QColor>
#include <QPixmap>

namespace eyrie::ui {

/// A rounded square with an edge in a colour, transparent around it, `side` px wide: what tells colours in lists and
/// menus.
QPixmap swatch(const QColor& colour, int side);

}  // namespace eyrie::ui
