#pragma once

#include <QColor>
#include <QPalette>

#include "core/values/frame_result.h"

/// Colours that follow the system's light or dark theme.
namespace eyrie::ui {

/// `share` of `over` laid on `ground`.
QColor blend(const QColor& ground, const QColor& over, double share);
bool isDark(const QPalette& palette);
/// Text of lesser weight that still reads on the palette's ground.
QColor quietText(const QPalette& palette);
/// The colour of a stage in charts, told apart from its neighbours on light and dark grounds.
QColor stageColour(Stage stage, const QPalette& palette);

}  // namespace eyrie::ui
