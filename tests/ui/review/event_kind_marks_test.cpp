#include "review/events/event_kind_marks.h"

#include <QApplication>
#include <QCheckBox>
#include <QMenu>
#include <QTest>
#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <string>
#include <utility>

#include "review/events/event_kinds_button.h"
#include "review/events/found_events.h"
#include "ui/support/ui_test.h"

namespace eyrie::ui::event_kind_marks_test {

namespace {

double linear(double value) {
    return value <= 0.04045 ? value / 12.92 : std::pow((value + 0.055) / 1.055, 2.4);
}

double luminanceOf(const QColor& colour) {
    return 0.2126 * linear(colour.redF()) + 0.7152 * linear(colour.greenF()) + 0.0722 * linear(colour.blueF());
}

/// As the guidelines for accessible contents define it: 1 … 21.
double contrastOf(const QColor& a, const QColor& b) {
    const auto [darker, brighter] = std::minmax({luminanceOf(a), luminanceOf(b)});
    return (brighter + 0.05) / (darker + 0.05);
}

/// Rows of a map of red, green and blue, linear.
using EyeMap = std::array<std::array<double, 3>, 3>;

/// What people see whose eyes have all kinds of cones, or lack one (Machado, Oliveira and Fernandes 2009).
constexpr std::array<EyeMap, 4> kEyes{{
    {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}},
    {{{0.152286, 1.052583, -0.204868}, {0.114503, 0.786281, 0.099216}, {-0.003882, -0.048116, 1.051998}}},
    {{{0.367322, 0.860646, -0.227968}, {0.280085, 0.672501, 0.047413}, {-0.011820, 0.042940, 0.968881}}},
    {{{1.255528, -0.076749, -0.178779}, {-0.078411, 0.930809, 0.147602}, {0.004733, 0.691367, 0.303900}}},
}};

std::array<double, 3> mapped(const EyeMap& map, const std::array<double, 3>& from) {
    std::array<double, 3> to{};
    for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t j = 0; j < 3; ++j) to[i] += map[i][j] * from[j];
    return to;
}

/// How an eye sees a colour: CIELAB under daylight.
std::array<double, 3> seenBy(const EyeMap& eye, const QColor& colour) {
    std::array<double, 3> light = mapped(eye, {linear(colour.redF()), linear(colour.greenF()), linear(colour.blueF())});
    for (double& value : light) value = std::clamp(value, 0.0, 1.0);
    constexpr EyeMap kXyzOverWhite{
        {{0.43390, 0.37622, 0.18990}, {0.2126, 0.7152, 0.0722}, {0.01773, 0.10948, 0.87294}}};
    std::array<double, 3> root = mapped(kXyzOverWhite, light);
    for (double& value : root) value = value > 0.008856 ? std::cbrt(value) : 7.787 * value + 16.0 / 116;
    return {116 * root[1] - 16, 500 * (root[0] - root[1]), 200 * (root[1] - root[2])};
}

double differenceOf(const std::array<double, 3>& a, const std::array<double, 3>& b) {
    return std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
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

    void groupsAreToldApartAlsoWhereOneKindOfConeIsMissing() {
        constexpr double kToldApart = 12;  // of CIELAB; 2 is just seen side by side
        constexpr int kGroups = static_cast<int>(EventGroup::unsearched) + 1;
        for (const bool dark : {false, true})
            for (const EyeMap& eye : kEyes)
                for (int one = 0; one < kGroups; ++one)
                    for (int other = 0; other < one; ++other) {
                        const auto seen = [&](int group) {
                            return seenBy(eye, groupColour(static_cast<EventGroup>(group), dark));
                        };
                        const double difference = differenceOf(seen(one), seen(other));
                        QVERIFY2(difference > kToldApart, qPrintable(QStringLiteral("groups %1 and %2, %3, eye %4: %5")
                                                                         .arg(one)
                                                                         .arg(other)
                                                                         .arg(dark ? "dark" : "light")
                                                                         .arg(&eye - kEyes.data())
                                                                         .arg(difference)));
                    }
    }

    void platesInTheMenuFollowTheTheme() {
        QPalette light, dark;
        light.setColor(QPalette::Window, Qt::white);
        light.setColor(QPalette::WindowText, Qt::black);
        dark.setColor(QPalette::Window, Qt::black);
        dark.setColor(QPalette::WindowText, Qt::white);
        EventKindsButton button;
        const auto* first = button.menu()->findChild<QCheckBox*>();
        QVERIFY(first != nullptr);
        for (const QPalette& theme : {light, dark, light}) {
            button.setPalette(theme);
            const QSize size = first->iconSize();
            const QImage plate = first->icon().pixmap(size).toImage();
            QCOMPARE(plate.pixelColor(2, plate.height() / 2),
                     groupColour(EventGroup::passage, theme.color(QPalette::Window) == Qt::black));
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
