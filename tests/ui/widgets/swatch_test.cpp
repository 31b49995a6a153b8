#include "widgets/swatch.h"

#include <QApplication>
#include <QTest>

#include "ui/support/ui_test.h"

namespace eyrie::ui::swatch_test {

class SwatchTest : public QObject {
    Q_OBJECT

 private slots:
    /// Menus show the icon in place of their own mark.
    void whatIsOnCarriesATick() {
        for (const QColor& colour : {QColor(255, 255, 255), QColor(0, 0, 120), QColor(255, 0, 0)}) {
            const QIcon icon = switchedSwatch(colour, 16);
            const QImage off = icon.pixmap(16, QIcon::Normal, QIcon::Off).toImage();
            const QImage on = icon.pixmap(16, QIcon::Normal, QIcon::On).toImage();
            QCOMPARE(off, swatch(colour, 16).toImage());
            QVERIFY(on != off);
        }
    }
};

}  // namespace eyrie::ui::swatch_test

EYRIE_UI_TEST(QApplication, swatch_test, SwatchTest)
#include "swatch_test.moc"
