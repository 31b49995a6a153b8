#include <QTest>
#include <QToolButton>

#include "canvas/video_view.h"
#include "ui/support/ui_support.h"
#include "ui/support/ui_test.h"
#include "ui/window/shown_window.h"
#include "widgets/message_bar.h"
#include "window/main_window.h"

namespace eyrie::ui::message_overlay_test {

using test::kPatience_ms;
using test::windowWithVideo;

/// Messages lie over the picture.
class MessageOverlayTest : public QObject {
    Q_OBJECT

    std::unique_ptr<test::OwnHome> home_;

    static QRect onScreen(const QWidget& widget) { return {widget.mapToGlobal(QPoint()), widget.size()}; }
    /// Its project is open and its first picture in view.
    static bool settled(MainWindow& window) {
        return QTest::qWaitFor(
            [&] {
                return !window.session().project().empty() && !window.session().opening() &&
                       !window.canvas().frame().image.isNull();
            },
            kPatience_ms);
    }

 private slots:
    void init() { home_ = std::make_unique<test::OwnHome>(); }
    void cleanup() { home_.reset(); }

    void aMessageMovesNothingThatAPersonPointsAt() {
        const auto window = windowWithVideo();
        QVERIFY(window);
        VideoView& canvas = window->canvas();
        QVERIFY(settled(*window));
        MessageBar& messages = window->messages();
        messages.dismissAll();
        QCoreApplication::processEvents();
        const QRect picture = onScreen(canvas);
        const QPointF place = canvas.transform().viewFromImage({20, 30});
        const auto lies_at_the_top = [&] {
            return messages.isVisible() && messages.height() > 0 && picture.contains(onScreen(messages)) &&
                   onScreen(messages).top() < picture.top() + 20;
        };
        messages.showMessage(MessageKind::error, QStringLiteral("cannot read a.mp4"));
        QTRY_VERIFY_WITH_TIMEOUT(lies_at_the_top(), kPatience_ms);
        const int one = messages.height();
        messages.showMessage(MessageKind::warning, QStringLiteral("frames were left out"));
        QTRY_VERIFY_WITH_TIMEOUT(messages.height() > one, kPatience_ms);
        QVERIFY(lies_at_the_top());
        QCOMPARE(onScreen(canvas), picture);
        QCOMPARE(canvas.transform().viewFromImage({20, 30}), place);
        // The mouse is the picture's wherever no message is.
        QWidget* in_the_middle = window->childAt(window->mapFromGlobal(picture.center()));
        QCOMPARE(in_the_middle, static_cast<QWidget*>(&canvas));
        const QPoint on_a_message = onScreen(messages).topLeft() + QPoint(messages.width() / 2, one / 2);
        QVERIFY(messages.isAncestorOf(window->childAt(window->mapFromGlobal(on_a_message))));
    }

    void aMessageIsClosedWithKeys() {
        const auto window = windowWithVideo();
        QVERIFY(window);
        QVERIFY(settled(*window));
        window->messages().dismissAll();
        const QString text = QStringLiteral("cannot read a.mp4");
        window->messages().showMessage(MessageKind::error, text);
        QToolButton* close = nullptr;
        for (const MessageStrip* strip : window->messages().findChildren<MessageStrip*>())
            if (strip->text() == text) close = strip->findChild<QToolButton*>();
        QVERIFY(close != nullptr && (close->focusPolicy() & Qt::TabFocus) != 0);
        close->setFocus(Qt::TabFocusReason);
        QTest::keyClick(close, Qt::Key_Space);
        QVERIFY(window->messages().texts().isEmpty());
        QVERIFY(window->messages().isHidden());
    }
};

}  // namespace eyrie::ui::message_overlay_test

EYRIE_UI_TEST(QApplication, message_overlay_test, MessageOverlayTest)
#include "message_overlay_test.moc"
