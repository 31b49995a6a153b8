#include <QLabel>
#include <QPushButton>
#include <QTest>
#include <QToolButton>

#include "panels_support.h"
#include "ui/support/ui_test.h"
#include "widgets/message_bar.h"

namespace eyrie::ui::panels_messages_test {

class MessagesTest : public QObject {
    Q_OBJECT

 private slots:
    void messagesStayUntilDismissed() {
        MessageBar bar;
        QVERIFY(bar.isHidden());
        bar.showMessage(MessageKind::error, QStringLiteral("cannot read a.mp4"));
        bar.showMessage(MessageKind::info, QStringLiteral("stored"));
        QVERIFY(!bar.isHidden());
        QCOMPARE(bar.texts(), (QStringList{QStringLiteral("stored"), QStringLiteral("cannot read a.mp4")}));
        bar.findChildren<MessageStrip*>().first()->findChild<QToolButton*>()->click();
        QCOMPARE(bar.texts(), QStringList{QStringLiteral("stored")});
        bar.dismiss(MessageKind::error);
        QCOMPARE(bar.texts().size(), 1);
        bar.dismissAll();
        QVERIFY(bar.isHidden());
    }

    void theSameMessageIsCounted() {
        MessageBar bar;
        for (int i = 0; i < 3; ++i) bar.showMessage(MessageKind::error, QStringLiteral("disk full"));
        QCOMPARE(bar.texts().size(), 1);
        bool counted = false;
        for (const QLabel* label : bar.findChildren<QLabel*>())
            counted = counted || label->text().contains(QStringLiteral("3"));
        QVERIFY(counted);
        bar.showMessage(MessageKind::warning, QStringLiteral("disk full"));
        QCOMPARE(bar.texts().size(), 2);
    }

    void manyMessagesDoNotPushTheCanvasAway() {
        MessageBar bar;
        for (int i = 0; i < 50; ++i) bar.showMessage(MessageKind::warning, QStringLiteral("frame %1").arg(i));
        QVERIFY(bar.texts().size() <= 5);
        QCOMPARE(bar.texts().first(), QStringLiteral("frame 49"));
    }

    void anActionActsAndMayShowTheNext() {
        MessageBar bar;
        int acted = 0;
        bar.showMessage(MessageKind::error, QStringLiteral("no project"), QStringLiteral("Choose…"), [&] {
            ++acted;
            bar.showMessage(MessageKind::info, QStringLiteral("chosen"));
        });
        bar.findChild<QPushButton*>()->click();
        QCOMPARE(acted, 1);
        QCOMPARE(bar.texts(), QStringList{QStringLiteral("chosen")});
    }

    void textIsTextAndReadsInBothThemes() {
        for (const bool dark : {false, true}) {
            QWidget window;
            if (dark) window.setPalette(test::darkPalette());
            MessageBar bar(&window);
            window.resize(600, 200);
            for (const MessageKind kind : {MessageKind::info, MessageKind::warning, MessageKind::error}) {
                bar.showMessage(kind,
                                QStringLiteral("the video <b>/videos/a.mp4</b> ends at frame 12; run it again "
                                               "with --frames 0:11, or repair the file"),
                                QStringLiteral("Details"), [] {});
            }
            window.show();
            bar.resize(600, bar.sizeHint().height());
            for (const MessageStrip* strip : bar.findChildren<MessageStrip*>()) {
                QVERIFY(test::contrast(strip->palette().color(QPalette::Window),
                                       strip->palette().color(QPalette::WindowText)) > 4.5);
            }
            test::keepPicture(bar, dark ? QStringLiteral("messages_dark") : QStringLiteral("messages_light"));
        }
    }

    void followsAThemeThatChanges() {
        QWidget window;
        window.setPalette(QPalette(Qt::white));
        MessageBar bar(&window);
        bar.showMessage(MessageKind::error, QStringLiteral("x"));
        window.show();
        window.setPalette(test::darkPalette());
        const auto* strip = bar.findChild<MessageStrip*>();
        QVERIFY(strip->palette().color(QPalette::Window).lightness() < 128);
        QVERIFY(test::contrast(strip->palette().color(QPalette::Window), strip->palette().color(QPalette::WindowText)) >
                4.5);
    }
};

}  // namespace eyrie::ui::panels_messages_test

EYRIE_UI_TEST(QApplication, panels_messages_test, MessagesTest)
#include "panels_messages_test.moc"
