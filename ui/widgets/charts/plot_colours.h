#pragma once

#include <vector>

class QCPAxis;
class QCustomPlot;
class QWidget;

namespace eyrie::ui {

/// Gives ground, axes, grid and the legend's text of a chart the colours and the font of its widget. `further`: axes
/// besides the plot's own, such as a colour scale's.
void applyTheme(QCustomPlot& plot, const QWidget& widget, const std::vector<QCPAxis*>& further = {});

}  // namespace eyrie::ui
