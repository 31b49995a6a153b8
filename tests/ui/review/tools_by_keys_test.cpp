#include <QApplication>
#include <QTest>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include "canvas/video_view.h"
#include "review/correct/vehicle_box_tool.h"
#include "review/earth/control_point_tool.h"
#include "review/zones/zone_points_tool.h"
#include "review/zones/zone_tool.h"
#include "ui/support/ui_test.h"

namespace eyrie::ui::tools_by_keys_test {

namespace {

bool near(QPointF a, QPointF b) {
    return std::hypot(a.x() - b.x(), a.y() - b.y()) < 1e-6;
}

}  // namespace

/// What is drawn on the canvas can be drawn with the keys alone.
class ToolsByKeysTest : public QObject {
    Q_OBJECT

    /// 400 × 300 px over a picture of 200 × 150, two of the screen for each of the picture.
    struct Canvas {
        OverlaySettings settings;
        VideoView view{settings};

        Canvas() {
            view.resize(400, 300);
            view.show();
            ViewFrame frame;
            frame.image = QImage(200, 150, QImage::Format_RGB32);
            frame.image.fill(Qt::gray);
            view.setFrame(frame);
            view.restore(2, {100, 75});
            QTest::mouseMove(&view, {150, 100});  // where the cross begins
        }
        void key(Qt::Key key, int times = 1, Qt::KeyboardModifiers modifiers = {}) {
            for (int i = 0; i < times; ++i) QTest::keyClick(&view, key, modifiers);
        }
        /// By so many px of the picture.
        void go(Qt::Key way, int px) {
            key(way, 2 * px % 10);
            key(way, 2 * px / 10, Qt::ShiftModifier);
        }
        /// Where the cross is, px of the picture.
        QPointF at() const { return view.transform().imageFromView(view.keyPointer().value_or(QPointF(-999, -999))); }
        /// The mouse comes back, far from the cross.
        void moveMouse() {
            QTest::mouseMove(&view, {370, 270});
            QTest::mouseMove(&view, {380, 280});
        }
    };

 private slots:
    void aBoxAroundAVehicleBeginsAndEndsWithEnter() {
        Canvas canvas;
        VehicleBoxTool tool(canvas.view);
        std::vector<OrientedBox> drawn;
        tool.setFinished([&](const OrientedBox& box) { drawn.push_back(box); });
        tool.start();
        canvas.go(Qt::Key_Right, 1);
        const QPointF corner = canvas.at();
        canvas.key(Qt::Key_Return);
        canvas.go(Qt::Key_Right, 20);
        canvas.go(Qt::Key_Down, 8);
        canvas.key(Qt::Key_Space);
        QCOMPARE(drawn.size(), std::size_t(1));
        QVERIFY(!tool.drawing());
        QVERIFY(near({drawn[0].centre.x, drawn[0].centre.y}, corner + QPointF(10, 4)));
        QVERIFY(std::abs(drawn[0].length - 20) < 1e-6 && std::abs(drawn[0].width - 8) < 1e-6);
        QCOMPARE(drawn[0].heading, 0.0);
    }

    void aMouseThatMovesDropsABoxThatKeysBegan() {
        Canvas canvas;
        VehicleBoxTool tool(canvas.view);
        int drawn = 0;
        tool.setFinished([&](const OrientedBox&) { ++drawn; });
        tool.start();
        canvas.go(Qt::Key_Right, 1);
        canvas.key(Qt::Key_Return);
        canvas.go(Qt::Key_Down, 10);
        canvas.moveMouse();
        QTest::mouseRelease(&canvas.view, Qt::LeftButton, {}, {380, 280});
        QCOMPARE(drawn, 0);
        QVERIFY(tool.drawing());
    }

    void aControlPointIsSetAndMovedByTwoPixelsOfTheScreen() {
        Canvas canvas;
        ControlPointTool tool(canvas.view);
        std::vector<QPointF> added, moved;
        tool.setCommands({.add = [&](QPointF px) { added.push_back(px); },
                          .move =
                              [&](int number, QPointF px) {
                                  QCOMPARE(number, 1);
                                  moved.push_back(px);
                              }});
        tool.start();
        canvas.go(Qt::Key_Right, 1);
        const QPointF place = canvas.at();
        canvas.key(Qt::Key_Return);
        QCOMPARE(added.size(), std::size_t(1));
        QVERIFY(near(added[0], place));
        tool.setMarks({{1, place, true, false}});
        canvas.key(Qt::Key_Return);
        canvas.key(Qt::Key_Right, 2);
        QVERIFY(near(tool.marks()[0].px, place + QPointF(1, 0)));
        canvas.key(Qt::Key_Return);
        QCOMPARE(moved.size(), std::size_t(1));
        QVERIFY(near(moved[0], place + QPointF(1, 0)));
        QCOMPARE(added.size(), std::size_t(1));
    }

    void whatHoldsAControlPointLetsItGoWhereItWas() {
        Canvas canvas;
        ControlPointTool tool(canvas.view);
        int changes = 0;
        tool.setCommands({.add = [&](QPointF) { ++changes; }, .move = [&](int, QPointF) { ++changes; }});
        tool.start();
        canvas.go(Qt::Key_Right, 1);
        const QPointF place = canvas.at();
        const auto hold = [&] {
            tool.setMarks({{1, place, true, false}});
            canvas.key(Qt::Key_Return);
            canvas.go(Qt::Key_Down, 10);
            return !near(tool.marks()[0].px, place);
        };
        QVERIFY(hold());
        canvas.key(Qt::Key_Backspace);
        QVERIFY(near(tool.marks()[0].px, place));
        canvas.go(Qt::Key_Up, 10);
        QVERIFY(hold());
        canvas.moveMouse();
        QVERIFY(near(tool.marks()[0].px, place));
        QTest::mouseRelease(&canvas.view, Qt::LeftButton, {}, {380, 280});
        QCOMPARE(changes, 0);
        // The mouse holds it.
        const QPoint at = canvas.view.transform().viewFromImage(place).toPoint();
        QTest::mousePress(&canvas.view, Qt::LeftButton, {}, at);
        QTest::mouseMove(&canvas.view, at + QPoint(20, 20));
        QTest::mouseMove(&canvas.view, at + QPoint(30, 20));
        tool.end();
        QVERIFY(near(tool.marks()[0].px, place));
        QCOMPARE(changes, 0);
    }

    void pointsOfALineMayBeAPixelApartAndTheLastIsNotSetTwice() {
        Canvas canvas;
        ZoneTool tool(canvas.view);
        std::vector<cv::Point2d> line;
        tool.setFinished([&](ZoneShape, const std::vector<cv::Point2d>& points) { line = points; });
        tool.start(ZoneShape::line);
        canvas.go(Qt::Key_Right, 1);
        const QPointF begin = canvas.at();
        canvas.key(Qt::Key_Return);
        canvas.key(Qt::Key_Right, 2);
        canvas.key(Qt::Key_Return);
        canvas.go(Qt::Key_Down, 20);
        canvas.key(Qt::Key_Return);
        QCOMPARE(tool.points().size(), std::size_t(3));
        canvas.key(Qt::Key_Return);
        QVERIFY(!tool.drawing());
        QCOMPARE(line.size(), std::size_t(3));
        QVERIFY(near({line[1].x, line[1].y}, begin + QPointF(1, 0)));
        QVERIFY(near({line[2].x, line[2].y}, begin + QPointF(1, 20)));
    }

    void tabGoesToTheNextPointOfAZoneAndArrowsMoveIt() {
        Canvas canvas;
        ZonePointsTool tool(canvas.view);
        std::vector<std::pair<std::size_t, QPointF>> moved;
        tool.setMoved([&](std::size_t point, cv::Point2d to) { moved.emplace_back(point, QPointF(to.x, to.y)); });
        tool.start({{40, 40}, {120, 40}, {120, 100}}, true);
        canvas.key(Qt::Key_Tab, 2);
        QVERIFY(near(canvas.at(), {120, 40}));
        canvas.key(Qt::Key_Return);
        canvas.go(Qt::Key_Right, 10);
        canvas.key(Qt::Key_Tab);  // it is held: nowhere else
        QVERIFY(near({tool.points()[1].x, tool.points()[1].y}, {130, 40}));
        tool.setPoints({{40, 40}, {120, 40}, {120, 100}});  // nothing new
        QVERIFY(near({tool.points()[1].x, tool.points()[1].y}, {130, 40}));
        canvas.key(Qt::Key_Backspace);
        QVERIFY(near({tool.points()[1].x, tool.points()[1].y}, {120, 40}));
        QVERIFY(moved.empty());
        canvas.key(Qt::Key_Tab);
        QVERIFY(near(canvas.at(), {120, 100}));
        canvas.key(Qt::Key_Backtab, 1, Qt::ShiftModifier);
        canvas.key(Qt::Key_Return);
        canvas.go(Qt::Key_Down, 5);
        canvas.key(Qt::Key_Return);
        QCOMPARE(moved.size(), std::size_t(1));
        QCOMPARE(moved[0].first, std::size_t(1));
        QVERIFY(near(moved[0].second, {120, 45}));
        canvas.key(Qt::Key_Return);
        tool.setPoints({{40, 40}, {120, 45}, {110, 100}});  // another frame, say: nothing is held any more
        canvas.key(Qt::Key_Return);
        canvas.go(Qt::Key_Right, 10);
        canvas.key(Qt::Key_Return);
        QCOMPARE(moved.size(), std::size_t(2));
        QVERIFY(near(moved[1].second, {130, 45}));
        canvas.key(Qt::Key_Escape);
        QVERIFY(!tool.active() && canvas.view.tool() == nullptr);
    }

    void enterEndsWhatTheMouseDraws() {
        Canvas canvas;
        ZoneTool zone(canvas.view);
        std::size_t points = 0;
        zone.setFinished([&](ZoneShape, const std::vector<cv::Point2d>& drawn) { points = drawn.size(); });
        zone.start(ZoneShape::line);
        const CanvasPlace place{canvas.view.transform(), canvas.view.frame().image, QRectF(canvas.view.rect())};
        QVERIFY(zone.hint(place).contains(QStringLiteral("Enter")));
        QTest::mouseClick(&canvas.view, Qt::LeftButton, {}, {100, 100});
        QTest::mouseClick(&canvas.view, Qt::LeftButton, {}, {200, 100});
        canvas.key(Qt::Key_Left);
        QVERIFY(!zone.hint(place).contains(QStringLiteral("Enter")));  // it clicks at the cross
        canvas.key(Qt::Key_Return);
        QVERIFY(zone.drawing());
        canvas.moveMouse();
        canvas.key(Qt::Key_Return);
        QVERIFY(!zone.drawing());
        QCOMPARE(points, std::size_t(3));
        ControlPointTool control(canvas.view);
        control.start();
        canvas.key(Qt::Key_Left);
        canvas.key(Qt::Key_Return);
        QVERIFY(control.active());
        canvas.moveMouse();
        canvas.key(Qt::Key_Enter);
        QVERIFY(!control.active());
        QVERIFY(canvas.view.tool() == nullptr);
    }
};

}  // namespace eyrie::ui::tools_by_keys_test

EYRIE_UI_TEST(QApplication, tools_by_keys_test, ToolsByKeysTest)
#include "tools_by_keys_test.moc"
