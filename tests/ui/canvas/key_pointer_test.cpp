#include "canvas/key_pointer.h"

#include <QKeyEvent>
#include <QMouseEvent>
#include <QPainter>
#include <QSignalSpy>
#include <QTest>
#include <cmath>
#include <optional>

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
    bool finishByKey() override { return finishes && note("finish"); }
    QString hint(const CanvasPlace&) const override { return QStringLiteral("Click somewhere"); }

    QStringList told;  ///< all but moves
    QPointF last_place;
    Qt::MouseButtons last_buttons;
    bool finishes = false;
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
            show(0, ground);
            view.setTool(&tool);
        }
        void show(FrameIndex index, QColor ground = Qt::gray) {
            ViewFrame frame;
            frame.index = index;
            frame.image = QImage(200, 150, QImage::Format_RGB32);
            frame.image.fill(ground);
            view.setFrame(frame);
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

    void whereThePictureMovedUnderItEnterIsNoDoubleClick() {
        const QStringList two_clicks{"press", "release", "press", "release"};
        Canvas canvas;
        canvas.view.restore(8, {100, 75});
        for (int i = 0; i < 45; ++i) canvas.key(Qt::Key_Left, Qt::ShiftModifier);
        const QPointF edge = *canvas.view.keyPointer();
        QCOMPARE(edge.x(), 0.0);
        canvas.key(Qt::Key_Return);
        const QPointF before = canvas.view.transform().imageFromView(edge);
        canvas.key(Qt::Key_Left);  // the picture comes to meet it
        QCOMPARE(*canvas.view.keyPointer(), edge);
        QVERIFY(canvas.view.transform().imageFromView(edge) != before);
        canvas.key(Qt::Key_Return);
        QCOMPARE(canvas.tool.told, two_clicks);
        canvas.tool.told.clear();
        canvas.key(Qt::Key_Right);
        canvas.key(Qt::Key_Return);
        canvas.view.centreOn({80, 75});
        canvas.key(Qt::Key_Return);
        QCOMPARE(canvas.tool.told, two_clicks);
    }

    void inAnotherFrameEnterIsNoDoubleClick() {
        Canvas canvas;
        canvas.key(Qt::Key_Right);
        canvas.key(Qt::Key_Return);
        canvas.show(1);
        canvas.key(Qt::Key_Return);
        QCOMPARE(canvas.tool.told, QStringList({"press", "release", "press", "release"}));
        canvas.show(1);  // the same once more, as when its results came
        canvas.key(Qt::Key_Return);
        QCOMPARE(canvas.tool.told.mid(4), QStringList({"double", "release"}));
    }

    void whatIsHeldIsHeldThroughAMoveOfThePicture() {
        Canvas canvas;
        canvas.tool.drags = true;
        canvas.key(Qt::Key_Right);
        canvas.key(Qt::Key_Return);
        canvas.view.zoomBy(2);
        canvas.show(1);
        canvas.key(Qt::Key_Return);
        QCOMPARE(canvas.tool.told, QStringList({"press", "release"}));
    }

    void enterEndsWhileNoCrossIsShown() {
        Canvas canvas;
        canvas.tool.finishes = true;
        canvas.key(Qt::Key_Space);  // plays
        canvas.key(Qt::Key_Return, Qt::ShiftModifier);
        QVERIFY(canvas.tool.told.isEmpty());
        QVERIFY(canvas.view.keyPointer());
        canvas.key(Qt::Key_Return);
        QCOMPARE(canvas.tool.told, QStringList({"press", "release"}));
        canvas.view.hideKeyPointer();
        canvas.tool.told.clear();
        canvas.key(Qt::Key_Enter);
        QCOMPARE(canvas.tool.told, QStringList({"finish"}));
        QVERIFY(!canvas.view.keyPointer());
        // What has nothing to end is shown where Enter would click.
        canvas.tool.finishes = false;
        canvas.key(Qt::Key_Enter);
        QVERIFY(canvas.view.keyPointer());
        QCOMPARE(canvas.tool.told, QStringList({"finish"}));
    }

    void theHintMakesWay() {
        Canvas canvas;
        canvas.view.restore(4, {100, 75});
        /// How many rows of the middle the plate of the hint covers.
        const auto covered = [&](int from, int to) {
            const QImage picture = canvas.view.picture();
            const double ratio = picture.devicePixelRatio();
            int rows = 0;
            for (int y = from; y < to; ++y) rows += qGray(picture.pixel((QPointF(200, y) * ratio).toPoint())) < 100;
            return rows;
        };
        const auto go = [&](Qt::Key key) {
            for (int i = 0; i < 40; ++i) canvas.key(key, Qt::ShiftModifier);
            canvas.view.restore(4, {100, 75});
        };
        go(Qt::Key_Right);
        go(Qt::Key_Up);
        QCOMPARE(canvas.view.keyPointer()->y(), 0.0);
        QCOMPARE(covered(0, 150), 0);
        QVERIFY(covered(220, 300) > 5);
        go(Qt::Key_Down);
        QCOMPARE(covered(150, 300), 0);
        QVERIFY(covered(0, 80) > 5);
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

    void aMouseThatTakesOverDropsWhatKeysHold() {
        Canvas canvas;
        canvas.tool.drags = true;
        canvas.key(Qt::Key_Right);
        canvas.key(Qt::Key_Return);
        QTest::mouseMove(&canvas.view, {150, 60});
        QTest::mouseMove(&canvas.view, {155, 60});
        QVERIFY(!canvas.view.keyPointer());
        QCOMPARE(canvas.tool.told, QStringList({"press", "back"}));
        canvas.key(Qt::Key_Right);
        canvas.key(Qt::Key_Return);
        QCOMPARE(canvas.tool.told.last(), QStringLiteral("press"));
    }

    void thePlaceUnderItIsTakenBackWhenItHides() {
        Canvas canvas;
        std::optional<QPointF> place;
        connect(&canvas.view, &VideoView::cursorMoved, this, [&](std::optional<QPointF> point) { place = point; });
        canvas.key(Qt::Key_Right);
        QVERIFY(place);
        canvas.view.setTool(nullptr);
        QVERIFY(!place);
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
