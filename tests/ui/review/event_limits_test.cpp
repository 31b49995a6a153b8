#include <QSignalSpy>
#include <QTest>
#include <QToolButton>

#include "review/events/event_thresholds.h"
#include "ui/support/ui_support.h"
#include "ui/support/ui_test.h"
#include "widgets/parameters/parameter_row.h"

namespace eyrie::ui::event_limits_test {

/// The form of the thresholds of events.
class EventLimitsTest : public QObject {
    Q_OBJECT

    std::unique_ptr<test::OwnHome> home_;

 private slots:
    void init() { home_ = std::make_unique<test::OwnHome>(); }
    void cleanup() { home_.reset(); }

    void limitsAreKeptAndShownWithTheirCounts() {
        {
            EventThresholds limits;
            QSignalSpy edited(&limits, &EventThresholds::edited);
            limits.setValue(QStringLiteral("events.over"), QStringLiteral("70"));
            QCOMPARE(edited.count(), 1);
            QCOMPARE(limits.options().over_kmh, 70.0);
            limits.setValue(QStringLiteral("events.over"), QStringLiteral("fast"));
            QCOMPARE(edited.count(), 1);
            EventKindsButton::Counts counts{};
            counts.at(static_cast<std::size_t>(EventKind::over_speed)) = 12;
            limits.setCounts(counts);
            bool told = false;
            for (const auto* title : limits.findChildren<QToolButton*>())
                told = told || title->text() == QStringLiteral("Over speed 12, Under speed 0");
            QVERIFY(told);
        }
        EventThresholds limits;
        QCOMPARE(limits.options().over_kmh, 70.0);
        limits.resetAll();
        QCOMPARE(limits.options().over_kmh, EventOptions().over_kmh);
        QCOMPARE(EventThresholds().options().over_kmh, EventOptions().over_kmh);
    }

    void everyLimitIsInTheForm() {
        const EventThresholds limits;
        EventOptions options;
        QCOMPARE(limits.findChildren<ParameterRow*>().size(),
                 static_cast<qsizetype>(listParameters(describeOf(options)).size()));
    }
};

}  // namespace eyrie::ui::event_limits_test

EYRIE_UI_TEST(QApplication, event_limits_test, EventLimitsTest)
#include "event_limits_test.moc"
