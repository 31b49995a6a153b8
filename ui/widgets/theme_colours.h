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
/// Text that tells what is wrong, on the palette's window.
QColor faultText(const QPalette& palette);

/// How things stand.
enum class Signal { good, warning, bad };
/// Its colour, told apart on light and dark grounds.
QColor signalColour(Signal signal);
/// The colour of a stage in charts, told apart from its neighbours on light and dark grounds.
QColor stageColour(Stage stage, const QPalette& palette);

}  // namespace eyrie::ui
