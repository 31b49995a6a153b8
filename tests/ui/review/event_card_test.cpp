#include "review/card/event_card.h"

#include <QLabel>
#include <QLineEdit>
#include <QTest>
#include <vector>

#include "review/card/story_sketch.h"
#include "ui/support/ui_test.h"

namespace eyrie::ui::event_card_test {

/// The card by itself: what stands on it.
class EventCardTest : public QObject {
    Q_OBJECT

 private slots:
    void whoJudgedStandsOnTheCardOfAnEventAlone() {
        EventCard card;
        CardSubject subject;
        subject.title = QStringLiteral("Stops");
        subject.event = 3;
        subject.track = 7;
        subject.judged = QStringLiteral("Relevant: Anna, 4 Mar 2026 14:03");
        card.show(subject);
        QVERIFY(!card.judged().isHidden());
        QCOMPARE(card.judged().text(), subject.judged);

        subject.judged.clear();
        card.show(subject);
        QVERIFY(card.judged().isHidden());
        QVERIFY(!card.note().isHidden());
    }

    void keysGoAlongTheSpeedAndTheWay() {
        std::vector<StoryPoint> points(101);
        for (std::size_t i = 0; i < points.size(); ++i) {
            points[i].frame = 200 + static_cast<FrameIndex>(i);
            points[i].seconds = static_cast<double>(i) / 25;
        }
        for (const auto kind : {StorySketch::Kind::speed, StorySketch::Kind::way}) {
            StorySketch sketch(kind);
            sketch.setPoints(points, {});
            sketch.setMark(250);
            sketch.show();
            FrameIndex frame = 250;
            sketch.setGoTo([&](FrameIndex asked) {
                frame = asked;
                sketch.setMark(asked);
            });
            const auto after = [&](Qt::Key key) {
                QTest::keyClick(&sketch, key);
                return frame;
            };
            QVERIFY((sketch.focusPolicy() & Qt::TabFocus) != 0);
            QCOMPARE(after(Qt::Key_Right), 255);
            QCOMPARE(after(Qt::Key_Left), 250);
            QCOMPARE(after(Qt::Key_Home), 200);
            QCOMPARE(after(Qt::Key_Left), 200);
            QCOMPARE(after(Qt::Key_End), 300);
            QCOMPARE(after(Qt::Key_Right), 300);
        }
    }

    void whatIsBeingWrittenStaysWhileNothingElseIsStored() {
        EventCard card;
        CardSubject subject;
        subject.title = QStringLiteral("Stops · 0:12.4");
        subject.event = 3;
        subject.note = QStringLiteral("van");
        subject.tags = QStringLiteral("gate 3");
        card.show(subject);
        card.note().setText(QStringLiteral("van, wh"));
        card.tags().setText(QStringLiteral("gate 3, lo"));
        subject.title = QStringLiteral("Stops · 08:00:12");  // the clock became known
        card.show(subject);
        QCOMPARE(card.note().text(), QStringLiteral("van, wh"));
        QCOMPARE(card.tags().text(), QStringLiteral("gate 3, lo"));

        subject.tags = QStringLiteral("gate 4");
        card.show(subject);
        QCOMPARE(card.note().text(), QStringLiteral("van, wh"));
        QCOMPARE(card.tags().text(), QStringLiteral("gate 4"));

        subject.event = 4;
        card.show(subject);
        QCOMPARE(card.note().text(), QStringLiteral("van"));
        card.note().setText(QStringLiteral("of this one"));
        card.show(std::nullopt);
        card.show(subject);
        QCOMPARE(card.note().text(), QStringLiteral("van"));
    }

    void whatIsBeingWrittenIsKeptWhenItIsAskedFor() {
        EventCard card;
        QStringList kept;
        card.setCommands({.write_note = [&](int event, const QString& note) {
            kept << QStringLiteral("%1 %2").arg(event).arg(note);
        }});
        card.keepWritten();  // there is no card
        CardSubject subject;
        subject.event = 3;
        card.show(subject);
        QTest::keyClicks(&card.note(), QStringLiteral("white van"));
        card.keepWritten();  // the project is about to be another
        card.keepWritten();
        QCOMPARE(kept, QStringList{QStringLiteral("3 white van")});
    }

    void whatWasTypedIsKeptWhenAnotherEventIsShown() {
        EventCard card;
        QStringList kept;
        CardSubject subject;
        subject.event = 3;
        subject.note = QStringLiteral("van");
        card.setCommands(
            {.write_note =
                 [&](int event, const QString& note) {
                     kept << QStringLiteral("note %1 %2").arg(event).arg(note);
                     subject.note = note;
                     card.show(subject);  // as the list does once it is stored
                 },
             .write_tags = [&](int event,
                               const QString& tags) { kept << QStringLiteral("tags %1 %2").arg(event).arg(tags); }});
        card.show(subject);
        card.note().setCursorPosition(3);
        QTest::keyClicks(&card.note(), QStringLiteral(" white"));
        QTest::keyClicks(&card.tags(), QStringLiteral("gate"));
        CardSubject other;
        other.event = 4;
        card.show(other);  // by Ctrl and the arrow: the focus stays in the field
        QCOMPARE(kept, (QStringList{QStringLiteral("note 3 van white"), QStringLiteral("tags 3 gate")}));
        QCOMPARE(card.subject()->event, 4);
        QVERIFY(card.note().text().isEmpty() && card.tags().text().isEmpty());
        card.show(subject);
        QCOMPARE(kept.size(), 2);  // nothing was written on the other one
    }
};

}  // namespace eyrie::ui::event_card_test

EYRIE_UI_TEST(QApplication, event_card_test, EventCardTest)
#include "event_card_test.moc"
