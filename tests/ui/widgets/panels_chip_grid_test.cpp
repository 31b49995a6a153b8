#include <QApplication>
#include <QKeyEvent>
#include <QSignalSpy>
#include <QTest>

#include "panels_support.h"
#include "ui/support/ui_test.h"
#include "widgets/chip_grid.h"

namespace eyrie::ui::panels_chip_grid_test {

namespace {

Chip greyChip(const QString& title, int value, QSize size = {20, 40}) {
    Chip chip;
    chip.title = title;
    chip.values = cv::Mat(size.height(), size.width(), CV_8UC1, cv::Scalar(value));
    chip.image = QImage(size, QImage::Format_RGB32);
    chip.image.fill(qRgb(value, value, value));
    return chip;
}

std::vector<ChipCard> cardsOf(int count, QSize size = {20, 40}) {
    std::vector<ChipCard> cards;
    for (int i = 0; i < count; ++i) {
        ChipCard card;
        card.id = i;
        card.chips.push_back(greyChip(QStringLiteral("chip %1").arg(i), 10 * i, size));
        cards.push_back(card);
    }
    return cards;
}

}  // namespace

class ChipGridTest : public QObject {
    Q_OBJECT

 private slots:
    void fittedChipsAreSeenAllAtOnceWhereThereIsRoom() {
        for (const int width : {150, 320, 700}) {
            ChipGrid grid;
            grid.resize(width, 600);
            grid.setCards(cardsOf(7));
            grid.show();
            QVERIFY(grid.fitted());
            for (int i = 0; i < 7; ++i) {
                const QRectF picture = grid.pictureRect(i, 0);
                QVERIFY(picture.left() >= 0);
                QVERIFY(picture.right() <= grid.viewport()->width());
                QVERIFY(picture.height() >= 129);
                QVERIFY(width < 320 || picture.bottom() <= grid.viewport()->height());
                QCOMPARE(picture.height(), 2 * picture.width());
                for (int j = 0; j < i; ++j) QVERIFY(!picture.intersects(grid.pictureRect(j, 0)));
            }
        }
    }

    void oneZoomHoldsForAllAndStaysWhenTheFrameChanges() {
        ChipGrid grid;
        grid.resize(300, 300);
        grid.setCards(cardsOf(3));
        grid.show();
        QSignalSpy zoomed(&grid, &ChipGrid::zoomChanged);
        const double fitted = grid.zoom();
        grid.zoomBy(2);
        QVERIFY(!zoomed.isEmpty());
        QCOMPARE(grid.zoom(), 2 * fitted);
        grid.setCards(cardsOf(4, {30, 30}));
        QCOMPARE(grid.zoom(), 2 * fitted);
        for (int i = 0; i < 4; ++i) QCOMPARE(grid.pictureRect(i, 0).width(), 30 * grid.zoom());
        grid.setFocus();
        QTest::keyClick(&grid, Qt::Key_0);
        QVERIFY(grid.fitted());
        QTest::keyClick(&grid, Qt::Key_Plus);
        QVERIFY(!grid.fitted());
    }

    void keysWithAModifierBelongToTheWindow() {
        ChipGrid grid;
        grid.resize(300, 300);
        grid.setCards(cardsOf(3));
        grid.show();
        grid.zoomBy(2);
        const auto wants = [&](Qt::Key key, Qt::KeyboardModifiers modifiers) {
            QKeyEvent asked(QEvent::ShortcutOverride, key, modifiers);
            asked.ignore();
            QApplication::sendEvent(&grid, &asked);
            return asked.isAccepted();
        };
        QVERIFY(wants(Qt::Key_0, {}) && wants(Qt::Key_Plus, Qt::ShiftModifier) && wants(Qt::Key_0, Qt::KeypadModifier));
        QVERIFY2(!wants(Qt::Key_0, Qt::AltModifier), "it hides the overlays");
        QVERIFY(!wants(Qt::Key_Plus, Qt::ControlModifier));
        QTest::keyClick(&grid, Qt::Key_0, Qt::AltModifier);
        QVERIFY(!grid.fitted());
    }

    void theCursorReadsTheValueOfTheSamePixelInAll() {
        Chip grey = greyChip({}, 37);
        grey.unit = QStringLiteral("grey");
        QCOMPARE(ChipGrid::valueText(grey, {3, 4}), QStringLiteral("37 grey"));
        QCOMPARE(ChipGrid::valueText(grey, {20, 4}), QString());
        QCOMPARE(ChipGrid::valueText(grey, {-1, 4}), QString());
        Chip real = greyChip({}, 0);
        real.values = cv::Mat(40, 20, CV_32FC1, cv::Scalar(-1.5));
        QCOMPARE(ChipGrid::valueText(real, {0, 0}), QLocale().toString(-1.5, 'f', 2));
    }

    void clickingACardReportsIt() {
        ChipGrid grid;
        grid.resize(400, 400);
        grid.setCards(cardsOf(3));
        grid.show();
        QSignalSpy clicked(&grid, &ChipGrid::cardClicked);
        QTest::mouseClick(grid.viewport(), Qt::LeftButton, {}, grid.pictureRect(1, 0).center().toPoint());
        QCOMPARE(clicked.count(), 1);
        QCOMPARE(clicked[0][0].toInt(), 1);
    }

    void boxesHistogramAndCursorArePainted() {
        ChipGrid grid;
        grid.setPalette(test::darkPalette());
        grid.resize(400, 300);
        auto cards = cardsOf(2);
        cards[0].chips[0].boxes.push_back(QRectF(4.5, 9.5, 8, 20));
        ChipHistogram histogram;
        histogram.counts = {100, 30, 10, 3, 1};
        histogram.largest = 50;
        histogram.threshold = 30;
        cards[1].chips[0].histogram = histogram;
        grid.setCards(cards);
        grid.show();
        const QImage picture = grid.grab().toImage();
        const QRectF first = grid.pictureRect(0, 0);
        // The left side of the box lies between pixels 4 and 5.
        const QPoint at = (first.topLeft() + QPointF(5, 20) * grid.zoom()).toPoint();
        bool side = false;
        for (int dx = -1; dx <= 1; ++dx) side = side || picture.pixelColor(at + QPoint(dx, 0)).red() > 150;
        QVERIFY(side);
        const QRectF second = grid.pictureRect(1, 0);
        bool orange = false;
        for (int x = static_cast<int>(second.left()); x < second.right(); ++x)
            for (int y = static_cast<int>(second.top()); y < second.bottom(); ++y)
                orange = orange || picture.pixelColor(x, y) == QColor(230, 120, 30);
        QVERIFY(orange);
    }

    void nothingToShowIsNoProblem() {
        ChipGrid grid;
        grid.resize(40, 40);
        grid.setCards({});
        grid.show();
        grid.setCards({ChipCard{}});
        ChipCard empty;
        empty.chips.emplace_back();
        grid.setCards({empty});
        grid.grab();
        grid.zoomBy(1e9);
        QVERIFY(grid.zoom() <= 32);
    }
};

}  // namespace eyrie::ui::panels_chip_grid_test

EYRIE_UI_TEST(QApplication, panels_chip_grid_test, ChipGridTest)
#include "panels_chip_grid_test.moc"
