#include "widgets/charts/copy_menu.h"

#include <QApplication>
#include <QClipboard>
#include <QMenu>
#include <QPixmap>
#include <QWidget>

namespace eyrie::ui {

void offerCopies(QWidget& chart, const QString& text, QPoint global) {
    QMenu menu;
    menu.addAction(QApplication::translate("Charts", "Copy as text"), &chart,
                   [&text] { QApplication::clipboard()->setText(text); });
    menu.addAction(QApplication::translate("Charts", "Copy as picture"), &chart,
                   [&chart] { QApplication::clipboard()->setPixmap(chart.grab()); });
    menu.exec(global);
}

}  // namespace eyrie::ui
