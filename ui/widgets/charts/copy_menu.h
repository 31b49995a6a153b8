#pragma once

#include <QPoint>
#include <QString>

class QWidget;

namespace eyrie::ui {

/// Offers to copy a chart, as text or as it is seen, in a menu at a place of the screen.
void offerCopies(QWidget& chart, const QString& text, QPoint global);

}  // namespace eyrie::ui
