#pragma once

#include <QColor>
#include <QIcon>
#include <QPixmap>

namespace eyrie::ui {

/// A rounded square with an edge in a colour, transparent around it, `side` px wide: what tells colours in lists and
/// menus.
QPixmap swatch(const QColor& colour, int side);
/// The same for what can be switched: with a tick on it while it is on. Menus show an icon in place of their own mark.
QIcon switchedSwatch(const QColor& colour, int side);

}  // namespace eyrie::ui
