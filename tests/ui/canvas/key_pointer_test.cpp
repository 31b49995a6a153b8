#include "canvas/key_pointer.h"

#include <QKeyEvent>
#include <QMouseEvent>
#include <QPainter>
#include <QSignalSpy>
#include <QTest>
#include <cmath>

#include "canvas/canvas_tool.h"
#include "canvas/video_view.h"
#include "ui/support/ui_test.h"

namespace eyrie::ui::key_pointer_test {

namespace {

/// Remembers what it was told, in view coordinates.
class RecordingTool : public CanvasTool {
 public:
    void paint(QPainter&, const CanvasPlace&) const override {}
    bool press(const QMouseEvent& event, const CanvasPlace&) override { return note("press", event); }
    bool move(const QMouseEvent& event, const CanvasPlace&) override { return note("move", event); }
    bool release(const QMouseEvent& event, const CanvasPlace&) override { return note("release", event); }
    bool doubleClick(const QMouseEvent& event, const CanvasPlace&) override { return note("double", event); }
    void leave() override {}
    const QCursor* cursor() const override { return nullptr; }
    bool takesPlaces() const override { return takes_places; }
    bool dragsFrom(QPointF, const CanvasPlace&) const override { return drags; }
    bool takeBack() override { return note("back"); }

    QStringList told;  ///< all but moves
    QPointF last_place;
    Qt::MouseButtons last_buttons;
    bool takes_places = true;
    bool drags = false;

 private:
    bool note(const char* what) {
        told << QString::fromLatin1(what);
        return true;
    }
    bool note(const char* what, const QMouseEvent& event) {
        last_place = event.position();
        last_buttons = event.buttons();
        return std::string_view(what) == "move" || note(what);
    }
};

}  // namespace

/// The cross that keys move while a tool takes places.
class KeyPointerTest : public QObject {
    Q_OBJECT

    struct Canvas {
        OverlaySettings settings;
        VideoView view{settings};
        RecordingTool tool;

        explicit Canvas(QColor ground = Qt::gray) {
            view.resize(400, 300);
            view.show();
            ViewFrame frame;
            frame.image = QImage(200, 150, QImage::Format_RGB32);
            frame.image.fill(ground);
            view.setFrame(frame);
            view.setTool(&tool);
        }
        void key(Qt::Key key, Qt::KeyboardModifiers modifiers = {}) { QTest::keyClick(&view, key, modifiers); }
        /// Whether the canvas keeps a key from commands that have it.
        bool keeps(Qt::Key key, Qt::KeyboardModifiers modifiers = {}) {
            QKeyEvent event(QEvent::ShortcutOverride, key, modifiers);
            event.ignore();
            QApplication::sendEvent(&view, &event);
            return event.isAccepted();
        }
    };

 private slots:
    void arrowsMoveItByOnePixelAndWithShiftByTen() {
        Canvas canvas;
        QVERIFY(!canvas.view.keyPointer());
        canvas.key(Qt::Key_Right);
        QVERIFY(canvas.view.keyPointer());
        const QPointF begin = *canvas.view.keyPointer();
        canvas.key(Qt::Key_Right);
        canvas.key(Qt::Key_Down, Qt::ShiftModifier);
        canvas.key(Qt::Key_Left, Qt::ShiftModifier);
        canvas.key(Qt::Key_Up);
        const QPointF moved = *canvas.view.keyPointer() - begin;
        const double px = 1 / canvas.view.devicePixelRatioF();
        QVERIFY(std::abs(moved.x() + 9 * px) < 1e-9);
        QVERIFY(std::abs(moved.y() - 9 * px) < 1e-9);
        QCOMPARE(canvas.tool.last_place, *canvas.view.keyPointer());  // the tool was told as by a mouse
        QVERIFY(canvas.tool.told.isEmpty());
    }

    void enterAndSpaceClickAndAgainInTheSamePlaceDoubleClick() {
        Canvas canvas;
        QSignalSpy played(&canvas.view, &VideoView::playToggled);
        canvas.key(Qt::Key_Right);
        canvas.key(Qt::Key_Return);
        QCOMPARE(canvas.tool.told, QStringList({"press", "release"}));
        QCOMPARE(canvas.tool.last_place, *canvas.view.keyPointer());
        canvas.key(Qt::Key_Right);
        canvas.key(Qt::Key_Space);
        QCOMPARE(canvas.tool.told, QStringList({"press", "release", "press", "release"}));
        canvas.tool.told.clear();
        canvas.key(Qt::Key_Enter);
        QCOMPARE(canvas.tool.told, QStringList({"double", "release"}));
        QCOMPARE(played.count(), 0);
    }

    void whatIsDraggedIsPressedByTheFirstEnterAndReleasedByTheSecond() {
        Canvas canvas;
        canvas.tool.drags = true;
        canvas.key(Qt::Key_Right);
        canvas.key(Qt::Key_Return);
        QCOMPARE(canvas.tool.told, QStringList({"press"}));
        canvas.key(Qt::Key_Down, Qt::ShiftModifier);
        QVERIFY(canvas.tool.last_buttons.testFlag(Qt::LeftButton));
        canvas.key(Qt::Key_Return);
        QCOMPARE(canvas.tool.told, QStringList({"press", "release"}));
        // What was taken back needs no release.
        canvas.key(Qt::Key_Up);
        canvas.key(Qt::Key_Return);
        canvas.key(Qt::Key_Backspace);
        canvas.key(Qt::Key_Return);
        QCOMPARE(canvas.tool.told.mid(2), QStringList({"press", "back", "press"}));
    }

    void itsKeysBelongToOthersWhileNoPlaceIsWanted() {
        Canvas canvas;
        for (const Qt::Key key : {Qt::Key_Left, Qt::Key_Up, Qt::Key_Return, Qt::Key_Backspace})
            QVERIFY(canvas.keeps(key));
        QVERIFY(canvas.keeps(Qt::Key_Right, Qt::ShiftModifier));
        QVERIFY(!canvas.keeps(Qt::Key_Right, Qt::ControlModifier));
        QVERIFY(!canvas.keeps(Qt::Key_Comma));  // frames are stepped still, to measure across them
        canvas.key(Qt::Key_Right);
        canvas.tool.takes_places = false;
        for (const Qt::Key key : {Qt::Key_Left, Qt::Key_Up, Qt::Key_Return, Qt::Key_Backspace})
            QVERIFY(!canvas.keeps(key));
        QVERIFY(!canvas.view.keyPointer());
        QSignalSpy played(&canvas.view, &VideoView::playToggled);
        canvas.key(Qt::Key_Space);
        QCOMPARE(played.count(), 1);
        canvas.view.setTool(nullptr);
        QVERIFY(!canvas.keeps(Qt::Key_Left));
        canvas.key(Qt::Key_Return);
        QVERIFY(canvas.tool.told.isEmpty());
    }

    void aMouseThatMovesTakesOver() {
        Canvas canvas;
        canvas.key(Qt::Key_Right);
        QVERIFY(canvas.view.keyPointer());
        QTest::mouseMove(&canvas.view, {50, 60});
        QTest::mouseMove(&canvas.view, {55, 60});
        QVERIFY(!canvas.view.keyPointer());
    }

    void itIsSeenOnBrightAndOnDarkGround() {
        for (const QColor& ground : {QColor(Qt::black), QColor(Qt::white), QColor(128, 128, 128)}) {
            Canvas canvas(ground);
            canvas.key(Qt::Key_Right);
            const QImage picture = canvas.view.picture();
            const double ratio = picture.devicePixelRatio();
            const QPointF at = *canvas.view.keyPointer();
            int brightest = 0;
            int darkest = 255;
            for (int across = -4; across <= 4; ++across) {
                const QPoint sample = ((at + QPointF(11, across)) * ratio).toPoint();
                const int grey = qGray(picture.pixel(sample));
                brightest = std::max(brightest, grey);
                darkest = std::min(darkest, grey);
            }
            QVERIFY(brightest > 220 && darkest < 40);
        }
    }
};

}  // namespace eyrie::ui::key_pointer_test

EYRIE_UI_TEST(QApplication, key_pointer_test, KeyPointerTest)
#include "key_pointer_test.moc"
