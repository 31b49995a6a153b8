#pragma once

#include <QColor>

namespace eyrie::ui {

/// The dark rim of all that is drawn over pictures, in every palette; with less than full `alpha` (0 … 255) the plate
/// under words.
inline QColor edgeColour(int alpha = 255) {
    return {12, 12, 14, alpha};
}

/// What a person draws or measures just now, and what has to be seen at once.
inline QColor toolColour() {
    return {255, 200, 40};
}

}  // namespace eyrie::ui
