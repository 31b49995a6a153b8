#include <QTest>
#include <QToolButton>

#include "canvas/drawing/mark_colours.h"
#include "canvas/video_view.h"
#include "label/computing/tracking_strip.h"
#include "tune/compare/preview_bar.h"
#include "ui/support/ui_support.h"
#include "ui/support/ui_test.h"
#include "ui/window/shown_window.h"
#include "widgets/message_bar.h"
#include "window/docks/tuning.h"
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

    void whatIsWorkedWithForAWhileMovesNothingEither() {
        const auto window = windowWithVideo();
        QVERIFY(window);
        QVERIFY(settled(*window));
        window->messages().dismissAll();
        QCoreApplication::processEvents();
        const QRect picture = onScreen(window->canvas());
        auto* tracking = window->findChild<TrackingStrip*>();
        PreviewBar& preview = window->tuning().previewBar();
        tracking->showAdvance({QStringLiteral("car 1"), 2, 2, 4, 1});
        preview.show();
        const auto lies_over_the_picture = [&](const QWidget& bar) {
            return bar.isVisible() && bar.height() >= bar.sizeHint().height() && picture.contains(onScreen(bar));
        };
        QTRY_VERIFY_WITH_TIMEOUT(lies_over_the_picture(*tracking) && lies_over_the_picture(preview), kPatience_ms);
        QVERIFY(!onScreen(*tracking).intersects(onScreen(preview)));
        QCOMPARE(onScreen(window->canvas()), picture);
        // A message comes below: the buttons stay where they are.
        const QRect before = onScreen(preview);
        window->messages().showMessage(MessageKind::error, QStringLiteral("cannot read a.mp4"));
        QTRY_VERIFY_WITH_TIMEOUT(onScreen(window->messages()).top() > before.bottom(), kPatience_ms);
        QCOMPARE(onScreen(preview), before);
    }

    void whatStandsOnThePictureIsNotCovered() {
        const auto window = windowWithVideo();
        QVERIFY(window);
        QVERIFY(settled(*window));
        window->messages().dismissAll();
        QCoreApplication::processEvents();
        VideoView& canvas = window->canvas();
        canvas.setBadge(QStringLiteral("Preview"));
        const auto top_of_badge = [&] {
            const QImage picture = canvas.picture();
            for (int y = 0; y < picture.height(); ++y)
                for (int x = 0; x < picture.width() / 4; ++x)
                    if (picture.pixelColor(x, y) == toolColour())
                        return static_cast<int>(y / picture.devicePixelRatio());
            return -1;
        };
        const int alone = top_of_badge();
        QVERIFY(alone >= 0 && alone < 20);
        window->messages().showMessage(MessageKind::error, QStringLiteral("cannot read a.mp4"));
        const auto covered = [&] { return onScreen(window->messages()).bottom() - onScreen(canvas).top(); };
        QTRY_VERIFY_WITH_TIMEOUT(window->messages().height() > 10 && top_of_badge() > covered(), kPatience_ms);
        window->messages().dismissAll();
        QTRY_COMPARE_WITH_TIMEOUT(top_of_badge(), alone, kPatience_ms);
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
