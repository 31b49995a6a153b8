#pragma once

#include <QColor>
#include <array>

#include "core/review/zone.h"

namespace eyrie::ui {

/// Colours of zones: told apart from each other, and from tracks, on any picture.
inline const std::array<QColor, 8>& zoneColours() {
    static const std::array<QColor, 8> colours{QColor(120, 180, 255), QColor(255, 170, 60), QColor(240, 120, 220),
                                               QColor(255, 235, 90),  QColor(90, 225, 225), QColor(255, 110, 100),
                                               QColor(185, 145, 255), QColor(225, 225, 225)};
    return colours;
}

inline QColor colourOf(const StoredZone& zone) {
    if (zone.colour != StoredZone::kColourByNumber) return QColor(QRgb(zone.colour));
    return zoneColours()[static_cast<std::size_t>(zone.id - 1) % zoneColours().size()];
}

}  // namespace eyrie::ui
