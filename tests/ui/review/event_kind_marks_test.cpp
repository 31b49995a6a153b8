#include "review/events/event_kind_marks.h"

#include <QApplication>
#include <QTest>
#include <algorithm>
#include <cmath>
#include <set>
#include <string>
#include <utility>

#include "review/events/found_events.h"
#include "ui/support/ui_test.h"

namespace eyrie::ui::event_kind_marks_test {

namespace {

double luminanceOf(const QColor& colour) {
    const auto linear = [](double value) {
        return value <= 0.04045 ? value / 12.92 : std::pow((value + 0.055) / 1.055, 2.4);
    };
    return 0.2126 * linear(colour.redF()) + 0.7152 * linear(colour.greenF()) + 0.0722 * linear(colour.blueF());
}

/// As the guidelines for accessible contents define it: 1 … 21.
double contrastOf(const QColor& a, const QColor& b) {
    const auto [darker, brighter] = std::minmax({luminanceOf(a), luminanceOf(b)});
    return (brighter + 0.05) / (darker + 0.05);
}

}  // namespace

/// Kinds of events are told apart without colours, and seen in both themes.
class EventKindMarksTest : public QObject {
    Q_OBJECT

 private slots:
    void noTwoKindsLookTheSame() {
        std::set<std::string> letters;
        std::set<std::pair<EventGroup, BarShape>> rows;
        for (int kind = 0; kind < kListedKinds; ++kind) {
            const EventKindMark& mark = markOf(kind);
            QCOMPARE(std::string(mark.letters).size(), std::size_t(2));
            QVERIFY2(letters.insert(mark.letters).second, mark.letters);
            QVERIFY2(rows.insert({mark.group, mark.shape}).second, mark.letters);
        }
        QCOMPARE(markOf(static_cast<int>(EventKind::loiters)).group, EventGroup::standing);
        QCOMPARE(markOf(static_cast<int>(EventKind::crosses)).group, EventGroup::zone);
        QCOMPARE(markOf(kEventKinds).group, EventGroup::unsearched);
    }

    void coloursAreSeenOnTheGroundsOfBothThemesAndLettersOnThem() {
        for (int kind = 0; kind < kListedKinds; ++kind) {
            const EventKindMark& mark = markOf(kind);
            const QColor light = groupColour(mark.group, false);
            const QColor dark = groupColour(mark.group, true);
            QVERIFY2(contrastOf(light, QColor(239, 240, 241)) > 4.5, mark.letters);
            QVERIFY2(contrastOf(light, Qt::white) > 4.5, mark.letters);
            QVERIFY2(contrastOf(dark, QColor(49, 54, 59)) > 4.5, mark.letters);
            QVERIFY2(contrastOf(dark, Qt::black) > 4.5, mark.letters);
        }
    }

    void aPlateHasTheColourOfItsGroup() {
        const QImage plate = kindPlate(static_cast<int>(EventKind::stops), true).toImage();
        QCOMPARE(plate.pixelColor(2, plate.height() / 2), groupColour(EventGroup::standing, true));
        const QPixmap judged = judgedKindPlate(Judgement::relevant, static_cast<int>(EventKind::stops), true);
        QVERIFY(judged.width() > plate.width());
        const QPixmap open = judgedKindPlate(Judgement::open, static_cast<int>(EventKind::stops), true);
        QVERIFY(judged.toImage() != open.toImage());
    }
};

}  // namespace eyrie::ui::event_kind_marks_test

EYRIE_UI_TEST(QApplication, event_kind_marks_test, EventKindMarksTest)
#include "event_kind_marks_test.moc"
