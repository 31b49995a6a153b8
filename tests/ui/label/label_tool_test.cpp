#include "label/canvas/label_tool.h"

#include <QSignalSpy>
#include <QTest>
#include <cmath>
#include <numbers>

#include "canvas/video_view.h"
#include "label/canvas/box_handles.h"
#include "label/canvas/label_layer.h"
#include "ui/support/ui_test.h"

namespace eyrie::ui::label_tool_test {

namespace {

OrientedBox box(double x, double y, double length, double width, double heading) {
    OrientedBox made;
    made.centre = {x, y};
    made.length = length;
    made.width = width;
    made.heading = heading;
    return made;
}

bool near(double a, double b, double tolerance = 1e-9) {
    return std::abs(a - b) <= tolerance;
}

}  // namespace

/// The tool on a canvas of 400 × 300 px over an image of 200 × 150 at two screen pixels per image pixel.
class LabelToolTest : public QObject {
    Q_OBJECT

    struct Canvas {
        OverlaySettings settings;
        VideoView view{settings};
        LabelTool tool;
        OrientedBox drawn, changed;
        int drawings = 0, changes = 0;
        bool turned = false, resized = false;
        std::optional<ObjectId> clicked;
        std::vector<cv::Point2d> region;

        Canvas() {
            view.resize(400, 300);
            view.show();
            ViewFrame frame;
            frame.image = QImage(200, 150, QImage::Format_RGB32);
            frame.image.fill(Qt::gray);
            view.setFrame(frame);
            view.restore(2, {100, 75});
            view.setTool(&tool);
            tool.setCommands({
                .add_region = [this](const std::vector<cv::Point2d>& corners, FrameIndex) { region = corners; },
                .add_box =
                    [this](const OrientedBox& b, FrameIndex) {
                        drawn = b;
                        ++drawings;
                    },
                .change_box =
                    [this](ObjectId, FrameIndex, const OrientedBox& b, bool t, bool r) {
                        changed = b;
                        turned = t;
                        resized = r;
                        ++changes;
                    },
                .choose_object = [this](std::optional<ObjectId> id, bool) { clicked = id; },
            });
        }
        QPoint at(double x, double y) const { return view.transform().viewFromImage({x, y}).toPoint(); }
        void click(double x, double y, Qt::KeyboardModifiers keys = {}) {
            QTest::mouseClick(&view, Qt::LeftButton, keys, at(x, y));
        }
        void drag(QPoint from, QPoint to) {
            QTest::mousePress(&view, Qt::LeftButton, {}, from);
            QTest::mouseMove(&view, (from + to) / 2);
            QTest::mouseMove(&view, to);
            QTest::mouseRelease(&view, Qt::LeftButton, {}, to);
        }
        void select(const OrientedBox& b) {
            LabelScene scene;
            LabelMark mark;
            mark.id = 7;
            mark.box = b;
            mark.selected = true;
            mark.colour = Qt::cyan;
            scene.marks = {mark};
            scene.selected = 7;
            tool.setScene(scene);
        }
        QPoint handle(const OrientedBox& b, BoxHandle wanted) const {
            for (const auto& [name, place] : boxHandles(b, view.transform()))
                if (name == wanted) return place.toPoint();
            return {};
        }
    };

 private slots:
    void twoClicksDrawAlongTheHeading() {
        Canvas canvas;
        LabelScene scene;
        scene.drawn_width = 7;
        canvas.tool.setScene(scene);
        canvas.tool.startDrawing();
        const double zoom = canvas.view.transform().zoom();
        canvas.click(60, 40);
        QVERIFY(canvas.tool.drawing());
        canvas.click(60, 60);
        QCOMPARE(canvas.drawings, 1);
        QVERIFY(!canvas.tool.drawing());
        QVERIFY(near(canvas.drawn.centre.x, 60, 0.3) && near(canvas.drawn.centre.y, 50, 0.3));
        QVERIFY(near(canvas.drawn.length, 20, 0.6));
        QVERIFY(near(canvas.drawn.width, 7));
        QVERIFY(near(canvas.drawn.heading, std::numbers::pi / 2, 0.03));  // y points down
        QCOMPARE(canvas.view.transform().zoom(), zoom);
    }

    void inAnObliqueViewTheWidthIsThatOfThePlace() {
        Canvas canvas;
        LabelScene scene;
        scene.drawn_width = 8;
        scene.slope = ScaleSlope::ofPicture({200, 150}, 0, 0.01);
        canvas.tool.setScene(scene);
        for (const double y : {40.0, 110.0}) {
            canvas.tool.startDrawing();
            canvas.click(60, y);
            canvas.click(80, y);
            QVERIFY(near(canvas.drawn.width, 8 * (1 + 0.01 * (y - 74.5)), 0.05));
        }
    }

    void shiftAsksForTheWidthByAThirdClick() {
        Canvas canvas;
        canvas.tool.startDrawing();
        canvas.click(50, 50);
        canvas.click(80, 50, Qt::ShiftModifier);
        QCOMPARE(canvas.drawings, 0);
        QTest::mouseMove(&canvas.view, canvas.at(60, 56));
        canvas.click(60, 56);
        QCOMPARE(canvas.drawings, 1);
        QVERIFY(near(canvas.drawn.width, 12, 0.6));
        QVERIFY(near(canvas.drawn.length, 30, 0.6));
    }

    void draggingDrawsAnUprightBox() {
        Canvas canvas;
        canvas.tool.startDrawing();
        canvas.drag(canvas.at(100, 40), canvas.at(110, 70));
        QCOMPARE(canvas.drawings, 1);
        QVERIFY(near(canvas.drawn.length, 30, 0.6) && near(canvas.drawn.width, 10, 0.6));
        QVERIFY(near(canvas.drawn.heading, std::numbers::pi / 2));
    }

    void escapeAndRightClickGiveUp() {
        Canvas canvas;
        canvas.tool.startDrawing();
        canvas.click(50, 50);
        QTest::mouseClick(&canvas.view, Qt::RightButton, {}, canvas.at(80, 50));
        QVERIFY(!canvas.tool.drawing());
        canvas.tool.startDrawing();
        canvas.click(50, 50);
        QVERIFY(canvas.tool.cancel());
        QVERIFY(!canvas.tool.cancel());
        QCOMPARE(canvas.drawings, 0);
    }

    void draggingTheInsideMovesTheBox() {
        Canvas canvas;
        const OrientedBox start = box(100, 75, 60, 40, 0.3);
        canvas.select(start);
        canvas.drag(canvas.at(108, 80), canvas.at(118, 70));
        QCOMPARE(canvas.changes, 1);
        QVERIFY(!canvas.turned && !canvas.resized);
        QVERIFY(near(canvas.changed.centre.x, 110, 0.6) && near(canvas.changed.centre.y, 65, 0.6));
        QVERIFY(near(canvas.changed.heading, 0.3) && near(canvas.changed.length, 60));
    }

    void aSideIsDraggedWhileTheOtherStays() {
        Canvas canvas;
        const OrientedBox start = box(100, 75, 60, 40, 0);
        canvas.select(start);
        const QPoint from = canvas.handle(start, BoxHandle::front);
        canvas.drag(from, from + QPoint(20, 0));
        QVERIFY(canvas.resized);
        QVERIFY(near(canvas.changed.length, 70, 0.1));
        QVERIFY(near(canvas.changed.centre.x - canvas.changed.length / 2, 70, 0.1));  // the rear
        QVERIFY(near(canvas.changed.width, 40));
    }

    void theTurningHandleTurnsAboutTheCentre() {
        Canvas canvas;
        const OrientedBox start = box(100, 75, 60, 40, 0);
        canvas.select(start);
        const QPoint from = canvas.handle(start, BoxHandle::turn);
        const QPoint centre = canvas.at(100, 75);
        canvas.drag(from, centre + QPoint(0, from.x() - centre.x()));
        QVERIFY(canvas.turned);
        QVERIFY(near(canvas.changed.heading, std::numbers::pi / 2, 0.03));
        QVERIFY(near(canvas.changed.centre.x, 100) && near(canvas.changed.length, 60));
    }

    void handlesOfATinyBoxCanAllBeHit() {
        Canvas canvas;
        const OrientedBox tiny = box(100, 75, 6, 3, 0.7);
        for (const auto& [handle, place] : boxHandles(tiny, canvas.view.transform()))
            QCOMPARE(handleAt(tiny, canvas.view.transform(), place), std::optional(handle));
    }

    void everyHandleDraggedBackRestoresTheBox() {
        const OrientedBox start = box(40, 30, 20, 9, 2.2);
        for (const BoxHandle handle :
             {BoxHandle::centre, BoxHandle::front, BoxHandle::rear, BoxHandle::left, BoxHandle::right,
              BoxHandle::front_left, BoxHandle::rear_right, BoxHandle::turn}) {
            const QPointF from(50, 33);
            const QPointF to(53.5, 36);
            const OrientedBox there = draggedBox(start, handle, from, to);
            const OrientedBox back = draggedBox(there, handle, to, from);
            QVERIFY(near(back.centre.x, start.centre.x, 1e-6) && near(back.centre.y, start.centre.y, 1e-6));
            QVERIFY(near(back.length, start.length, 1e-6) && near(back.width, start.width, 1e-6));
            QVERIFY(near(std::remainder(back.heading - start.heading, 2 * std::numbers::pi), 0, 1e-6));
        }
    }

    void clickingChoosesTheSmallestAndNothingDeselects() {
        Canvas canvas;
        LabelScene scene;
        for (const auto& [id, size] : {std::pair(1, 60.0), std::pair(2, 14.0)}) {
            LabelMark mark;
            mark.id = id;
            mark.box = box(100, 75, size, size / 2, 0);
            mark.colour = Qt::cyan;
            scene.marks.push_back(mark);
        }
        canvas.tool.setScene(scene);
        canvas.click(100, 75);
        QCOMPARE(canvas.clicked, std::optional<ObjectId>(2));
        canvas.click(80, 75);
        QCOMPARE(canvas.clicked, std::optional<ObjectId>(1));
        canvas.click(20, 20);
        QVERIFY(!canvas.clicked);
    }

    void aRegionIsDrawnCornerByCorner() {
        Canvas canvas;
        std::vector<cv::Point2d>& polygon = canvas.region;
        canvas.tool.startRegion();
        canvas.click(20, 20);
        canvas.click(80, 20);
        canvas.click(80, 60);
        QVERIFY(canvas.tool.drawingRegion());
        QTest::mouseClick(&canvas.view, Qt::RightButton, {}, canvas.at(50, 50));
        QVERIFY(!canvas.tool.drawingRegion());
        QCOMPARE(polygon.size(), std::size_t(3));
        QVERIFY(near(polygon[1].x, 80, 0.6) && near(polygon[2].y, 60, 0.6));
    }

    void cornersWithoutAnAreaAreNoRegionYet() {
        Canvas canvas;
        const CanvasPlace place{canvas.view.transform(), canvas.view.frame().image, QRectF(canvas.view.rect())};
        const auto refused = [&] {
            return canvas.tool.drawingRegion() && canvas.region.empty() &&
                   canvas.tool.hint(place).contains(QStringLiteral("three corners"));
        };
        canvas.tool.startRegion();
        QVERIFY(canvas.tool.hint(place).contains(QStringLiteral("Enter")));
        QTest::mouseClick(&canvas.view, Qt::RightButton, {}, canvas.at(50, 50));
        QVERIFY(!canvas.tool.drawingRegion());  // nothing was begun
        canvas.tool.startRegion();
        canvas.click(20, 20);
        QTest::mouseClick(&canvas.view, Qt::RightButton, {}, canvas.at(50, 50));
        QVERIFY(refused());
        canvas.click(80, 20);
        QVERIFY(!canvas.tool.hint(place).contains(QStringLiteral("three corners")));
        canvas.click(50, 20);
        QTest::keyClick(&canvas.view, Qt::Key_Return);
        QVERIFY(refused());  // all on one line
        QTest::keyClick(&canvas.view, Qt::Key_Backspace);
        canvas.click(80, 60);
        QTest::keyClick(&canvas.view, Qt::Key_Return);
        QVERIFY(!canvas.tool.drawingRegion());
        QCOMPARE(canvas.region.size(), std::size_t(3));
    }

    void everyStepOfABoxSaysWhatComesNext() {
        Canvas canvas;
        const CanvasPlace place{canvas.view.transform(), canvas.view.frame().image, QRectF(canvas.view.rect())};
        const auto says = [&](const char* word) { return canvas.tool.hint(place).contains(QLatin1String(word)); };
        QVERIFY(canvas.tool.hint(place).isEmpty());
        canvas.tool.startDrawing();
        QVERIFY(says("Click the rear") && says("drag") && says("Esc"));
        canvas.click(60, 40);
        QVERIFY(says("Click the front") && says("Shift") && says("Backspace") && says("Esc"));
        canvas.click(60, 60, Qt::ShiftModifier);
        QVERIFY(says("Click a side") && says("Backspace") && says("Esc"));
        QTest::keyClick(&canvas.view, Qt::Key_Backspace);
        QVERIFY(says("Click the front"));
    }

    void aBoxAndARegionAreDrawnWithoutAMouse() {
        Canvas canvas;
        LabelScene scene;
        scene.drawn_width = 7;
        canvas.tool.setScene(scene);
        const auto press = [&](Qt::Key key, int times = 1, Qt::KeyboardModifiers modifiers = {}) {
            for (int i = 0; i < times; ++i) QTest::keyClick(&canvas.view, key, modifiers);
        };
        const auto place = [&] {
            return canvas.view.transform().imageFromView(canvas.view.keyPointer().value_or(QPointF()));
        };
        QTest::mouseMove(&canvas.view, canvas.at(100, 75));  // the cross begins there
        canvas.tool.startDrawing();
        press(Qt::Key_Left);
        const QPointF rear = place();
        press(Qt::Key_Return);
        press(Qt::Key_Right, 4, Qt::ShiftModifier);  // 40 px of the screen, 20 of the picture
        QVERIFY(canvas.tool.draft());
        press(Qt::Key_Return);
        QCOMPARE(canvas.drawings, 1);
        QVERIFY(near(canvas.drawn.length, 20, 1e-6) && near(canvas.drawn.width, 7, 1e-6));
        QVERIFY(near(canvas.drawn.centre.x, rear.x() + 10, 1e-6) && near(canvas.drawn.centre.y, rear.y(), 1e-6));
        QVERIFY(near(canvas.drawn.heading, 0, 1e-6));
        canvas.tool.startRegion();
        press(Qt::Key_Left);
        const QPointF corner = place();
        press(Qt::Key_Return);
        press(Qt::Key_Left, 4, Qt::ShiftModifier);
        press(Qt::Key_Return);
        press(Qt::Key_Up, 2, Qt::ShiftModifier);
        press(Qt::Key_Return);
        press(Qt::Key_Backspace);
        press(Qt::Key_Up, 2, Qt::ShiftModifier);
        press(Qt::Key_Return);
        QVERIFY(canvas.tool.drawingRegion());
        press(Qt::Key_Return);  // once more without moving: done
        QVERIFY(!canvas.tool.drawingRegion());
        QCOMPARE(canvas.region.size(), std::size_t(3));
        QVERIFY(near(canvas.region[0].x, corner.x(), 1e-6) && near(canvas.region[0].y, corner.y(), 1e-6));
        QVERIFY(near(canvas.region[2].x, corner.x() - 20, 1e-6) && near(canvas.region[2].y, corner.y() - 20, 1e-6));
    }

    void readOnlyLabelsHaveNoHandles() {
        Canvas canvas;
        const OrientedBox start = box(100, 75, 60, 40, 0);
        canvas.select(start);
        LabelScene scene = canvas.tool.scene();
        scene.editable = false;
        canvas.tool.setScene(scene);
        canvas.drag(canvas.handle(start, BoxHandle::front), canvas.at(160, 75));
        QCOMPARE(canvas.changes, 0);
    }

    void whatIsDraggedIsNotLetGoOnAnObjectThatWasChosenMeanwhile() {
        Canvas canvas;
        canvas.select(box(100, 75, 60, 40, 0));
        QTest::mousePress(&canvas.view, Qt::LeftButton, {}, canvas.at(100, 75));
        QTest::mouseMove(&canvas.view, canvas.at(110, 75));
        QTest::mouseMove(&canvas.view, canvas.at(120, 75));
        LabelScene scene = canvas.tool.scene();
        LabelMark other = scene.marks.front();
        other.id = 8;
        other.box = box(40, 30, 20, 10, 0);
        scene.marks.front().selected = false;
        scene.marks.push_back(other);
        scene.selected = 8;  // by N, the key for the next object
        canvas.tool.setScene(scene);
        QTest::mouseRelease(&canvas.view, Qt::LeftButton, {}, canvas.at(120, 75));
        QCOMPARE(canvas.changes, 0);
        QVERIFY(!canvas.tool.draft());
    }

    void everythingCanBePaintedAtAnyZoom() {
        Canvas canvas;
        canvas.select(box(100, 75, 20, 9, 1));
        LabelScene scene = canvas.tool.scene();
        for (int i = 0; i < 40; ++i) {
            LabelMark mark;
            mark.id = 100 + i;
            mark.kind = static_cast<LabelKind>(i % 4);
            mark.occlusion = static_cast<Occlusion>(i % 3);
            mark.ignore = i % 5 == 0;
            mark.review = static_cast<ReviewState>(i % 3);
            mark.box = box(10 + 4 * i, 20 + 2 * i, 12, 6, 0.1 * i);
            mark.colour = Qt::yellow;
            mark.text = QString::number(i);
            scene.marks.push_back(mark);
        }
        scene.regions.push_back({1, {{10, 10}, {40, 10}, {30, 60}}});
        canvas.tool.setScene(scene);
        const QImage plain = canvas.view.picture();
        canvas.view.restore(40, {100, 75});
        QVERIFY(canvas.view.picture() != plain);
        canvas.tool.startDrawing();
        canvas.click(100, 75);
        QTest::mouseMove(&canvas.view, QPoint(220, 160));
        QVERIFY(canvas.tool.draft());
        QVERIFY(!canvas.view.picture().isNull());
    }
};

}  // namespace eyrie::ui::label_tool_test

EYRIE_UI_TEST(QApplication, label_tool_test, LabelToolTest)
#include "label_tool_test.moc"
