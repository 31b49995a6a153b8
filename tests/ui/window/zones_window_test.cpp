#include <sys/stat.h>

#include <QApplication>
#include <QLineEdit>
#include <QMenu>
#include <QTableView>
#include <QTest>
#include <QToolButton>
#include <algorithm>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <future>
#include <iterator>
#include <utility>

#include "canvas/layers/zone_layer.h"
#include "canvas/video_view.h"
#include "label/label_workspace.h"
#include "review/events/event_review.h"
#include "review/events/events_dock.h"
#include "review/events/events_panel.h"
#include "review/zones/zone_points_tool.h"
#include "review/zones/zone_review.h"
#include "review/zones/zone_tool.h"
#include "review/zones/zones_model.h"
#include "review/zones/zones_panel.h"
#include "ui/session/session_support.h"
#include "ui/support/ui_test.h"
#include "ui/window/window_with_run.h"
#include "widgets/message_bar.h"
#include "window/main_window.h"
#include "workspace/dock_registry.h"
#include "workspace/window_actions.h"

namespace eyrie::ui::zones_window_test {

using test::kPatience_ms;

namespace {

/// Around the way of the upper vehicle of the scene, as frame 30 shows it: it drives in after that frame, and out.
const std::vector<QPointF> kOnTheWay{{130, 40}, {175, 40}, {175, 75}, {130, 75}};
constexpr FrameIndex kDrawnIn = 30;

}  // namespace

/// Zones in the window: drawn with the mouse, kept in the project, watched.
class ZonesWindowTest : public QObject {
    Q_OBJECT

    std::unique_ptr<test::OwnHome> home_;

    static std::unique_ptr<MainWindow> windowWithRun() {
        auto window = test::windowWithRun();
        if (!window) return nullptr;
        window->docks().raise(DockId::events);
        const auto ready = [&] { return window->events().review().state() == EventReview::State::found; };
        if (!QTest::qWaitFor(ready, kPatience_ms)) return nullptr;
        window->session().goToFrame(kDrawnIn);
        if (!test::shows(window->session(), kDrawnIn)) return nullptr;
        window->canvas().setFocus();
        return window;
    }
    static void click(MainWindow& window, QPointF image_point, bool twice = false) {
        const QPoint place = window.canvas().transform().viewFromImage(image_point).toPoint();
        QTest::mouseClick(&window.canvas(), Qt::LeftButton, {}, place);
        if (twice) QTest::mouseDClick(&window.canvas(), Qt::LeftButton, {}, place);
    }
    static void draw(MainWindow& window, const std::vector<QPointF>& points, QAction* action) {
        action->trigger();
        for (std::size_t i = 0; i < points.size(); ++i) click(window, points[i], i + 1 == points.size());
    }
    static void drawZone(MainWindow& window) { draw(window, kOnTheWay, window.actions().draw_zone); }
    static bool waitForEvents(MainWindow& window, EventKind kind, int count) {
        return QTest::qWaitFor(
            [&] {
                const auto& found = window.events().model().found();
                return found && std::count_if(found->events.begin(), found->events.end(),
                                              [&](const Event& event) { return event.kind == kind; }) == count;
            },
            kPatience_ms);
    }
    static const std::map<int, StoredZone>& zones(MainWindow& window) { return window.events().review().zones(); }
    static bool tells(MainWindow& window, const QString& words) {
        const QStringList texts = window.messages().texts();
        return std::any_of(texts.begin(), texts.end(), [&](const QString& text) { return text.contains(words); });
    }

 private slots:
    void init() { home_ = std::make_unique<test::OwnHome>(); }
    void cleanup() { home_.reset(); }

    void aZoneIsDrawnWatchedUndoneAndThereTheNextDay() {
        {
            const auto window = windowWithRun();
            QVERIFY(window);
            QTest::keyClick(&window->canvas(), Qt::Key_A, Qt::ControlModifier | Qt::ShiftModifier);
            QVERIFY(window->events().zones().tool().drawing());
            QVERIFY(window->actions().draw_zone->isChecked());
            click(*window, kOnTheWay[0]);
            click(*window, kOnTheWay[1]);
            click(*window, {20, 20});
            QTest::keyClick(&window->canvas(), Qt::Key_Backspace);
            QCOMPARE(window->events().zones().tool().points().size(), std::size_t(2));
            click(*window, kOnTheWay[2]);
            click(*window, kOnTheWay[3]);
            QTest::keyClick(&window->canvas(), Qt::Key_Return);
            QVERIFY(!window->events().zones().tool().drawing());
            QVERIFY(!window->actions().draw_zone->isChecked());
            QCOMPARE(zones(*window).size(), std::size_t(1));
            const Zone& zone = zones(*window).begin()->second.zone;
            QCOMPARE(zone.frame, kDrawnIn);
            for (std::size_t i = 0; i < kOnTheWay.size(); ++i)
                QVERIFY(std::hypot(zone.points[i].x - kOnTheWay[i].x(), zone.points[i].y - kOnTheWay[i].y()) < 1);
            // The name is being written.
            auto* editor = window->events().zones().panel().table()->findChild<QLineEdit*>();
            QVERIFY(editor != nullptr && editor->isVisible());
            editor->setText(QStringLiteral("yard"));
            // Events that are found meanwhile do not take it away.
            QVERIFY(waitForEvents(*window, EventKind::enters, 1));
            QCOMPARE(editor->text(), QStringLiteral("yard"));
            QTest::keyClick(editor, Qt::Key_Return);
            QTRY_COMPARE(zones(*window).begin()->second.zone.name, std::string("yard"));
            QVERIFY(waitForEvents(*window, EventKind::enters, 1));
            QVERIFY(waitForEvents(*window, EventKind::exits, 1));
            const auto& model = window->events().model();
            const auto lists = [&](const QString& kind) {
                for (int row = 0; row < model.rowCount(); ++row)
                    if (model.index(row, EventsModel::kind_column).data().toString() == kind) return true;
                return false;
            };
            QTRY_VERIFY_WITH_TIMEOUT(lists(QStringLiteral("Enters yard")), kPatience_ms);
            const auto* list = window->events().zones().panel().table()->model();
            QVERIFY(QTest::qWaitFor([&] { return list->index(0, ZonesModel::events_column).data().toInt() == 2; },
                                    kPatience_ms));

            window->canvas().setFocus();
            QTest::keyClick(&window->canvas(), Qt::Key_Z);
            QCOMPARE(zones(*window).begin()->second.zone.name, std::string("zone 1"));
            QTest::keyClick(&window->canvas(), Qt::Key_Z, Qt::ControlModifier);
            QVERIFY(zones(*window).empty());
            QVERIFY(waitForEvents(*window, EventKind::enters, 0));
            QTest::keyClick(&window->canvas(), Qt::Key_Z, Qt::ControlModifier | Qt::ShiftModifier);
            QTest::keyClick(&window->canvas(), Qt::Key_Z, Qt::ControlModifier | Qt::ShiftModifier);
            QVERIFY(waitForEvents(*window, EventKind::enters, 1));
            window->close();
        }
        const auto window = windowWithRun();
        QVERIFY(window);
        QCOMPARE(zones(*window).size(), std::size_t(1));
        QCOMPARE(zones(*window).begin()->second.zone.name, std::string("yard"));
        QVERIFY(waitForEvents(*window, EventKind::enters, 1));
        QTest::keyClick(&window->canvas(), Qt::Key_Z);  // undo survives closing
        QCOMPARE(zones(*window).begin()->second.zone.name, std::string("zone 1"));
    }

    void itIsShownWhereTheGroundHasCarriedIt() {
        const auto window = windowWithRun();
        QVERIFY(window);
        drawZone(*window);
        window->events().zones().panel().setAnchor(ZoneAnchor::image);
        draw(*window, {{100, 20}, {100, 90}}, window->actions().draw_line);
        QCOMPARE(window->canvas().frame().zones.size(), std::size_t(2));
        QVERIFY(window->overlays().isVisible(ZoneLayer::kKind));
        window->session().goToFrame(kDrawnIn + 20);
        QVERIFY(test::shows(window->session(), kDrawnIn + 20));
        const std::vector<ZoneMark>& marks = window->canvas().frame().zones;
        QCOMPARE(marks.size(), std::size_t(2));
        for (std::size_t i = 0; i < kOnTheWay.size(); ++i) {
            const QPointF there = kOnTheWay[i] - QPointF(20, 0);  // the ground drifts by a pixel a frame
            QVERIFY2(QLineF(marks[0].points[i], there).length() < 1.5, qPrintable(QString::number(i)));
        }
        QVERIFY(QLineF(marks[1].points[0], {100, 20}).length() < 1);
        QVERIFY(!marks[1].closed);
        QVERIFY(waitForEvents(*window, EventKind::crosses, 1));

        auto& model = window->events().zones().model();
        const QModelIndex name = model.index(0, ZonesModel::name_column);
        QVERIFY(model.setData(name, Qt::Unchecked, Qt::CheckStateRole));
        QCOMPARE(window->canvas().frame().zones.size(), std::size_t(1));
        QVERIFY(waitForEvents(*window, EventKind::enters, 1));  // hidden, yet watched
        window->events().zones().panel().selectId(model.recordAt(0)->id);
        QTest::keyClick(window->events().zones().panel().table(), Qt::Key_Delete);
        QCOMPARE(zones(*window).size(), std::size_t(1));
        QVERIFY(waitForEvents(*window, EventKind::enters, 0));
    }

    void anArrowIsDrawnShownAndUndone() {
        const auto window = windowWithRun();
        QVERIFY(window);
        QTest::keyClick(&window->canvas(), Qt::Key_D, Qt::ControlModifier | Qt::ShiftModifier);
        QVERIFY(window->actions().draw_arrow->isChecked());
        click(*window, {175, 57});
        click(*window, {130, 57}, true);
        QVERIFY(!window->actions().draw_arrow->isChecked());
        QCOMPARE(zones(*window).size(), std::size_t(1));
        const Zone& arrow = zones(*window).begin()->second.zone;
        QCOMPARE(arrow.shape, ZoneShape::arrow);
        QCOMPARE(arrow.anchor, ZoneAnchor::ground);
        QCOMPARE(arrow.name, std::string("arrow 1"));
        const std::vector<ZoneMark>& marks = window->canvas().frame().zones;
        QCOMPARE(marks.size(), std::size_t(1));
        QVERIFY(marks[0].right_way && !marks[0].closed);
        QVERIFY(marks[0].points.front().x() > marks[0].points.back().x());
        window->canvas().setFocus();
        QTest::keyClick(&window->canvas(), Qt::Key_Z);
        QVERIFY(zones(*window).empty());
        QVERIFY(window->canvas().frame().zones.empty());
    }

    void aCornerIsDraggedInAnotherFrameAndUndone() {
        const auto window = windowWithRun();
        QVERIFY(window);
        drawZone(*window);
        const std::vector<cv::Point2d> drawn = zones(*window).begin()->second.zone.points;
        const auto choose = [&](const QString& text) {
            for (const auto* button : window->events().zones().panel().findChildren<QToolButton*>()) {
                if (button->menu() == nullptr) continue;
                emit button->menu()->aboutToShow();
                for (QAction* action : button->menu()->actions())
                    if (action->text() == text) return action->trigger(), true;
            }
            return false;
        };
        window->session().goToFrame(kDrawnIn + 10);
        QVERIFY(test::shows(window->session(), kDrawnIn + 10));
        window->actions().measure->trigger();
        QVERIFY(window->actions().measure->isChecked());
        QVERIFY(choose(QStringLiteral("Move its points")));
        QVERIFY(!window->actions().measure->isChecked());
        const ZonePointsTool& tool = window->events().zones().pointsTool();
        QVERIFY(tool.active());
        const QPointF corner(tool.points()[1].x, tool.points()[1].y);
        QVERIFY(QLineF(corner, {drawn[1].x - 10, drawn[1].y}).length() < 1.5);  // the ground drifts
        const auto on_canvas = [&](QPointF px) { return window->canvas().transform().viewFromImage(px).toPoint(); };
        QTest::mousePress(&window->canvas(), Qt::LeftButton, {}, on_canvas(corner));
        QTest::mouseMove(&window->canvas(), on_canvas(corner + QPointF(-10, 5)));
        QTest::mouseMove(&window->canvas(), on_canvas(corner + QPointF(-20, 10)));
        QTest::mouseRelease(&window->canvas(), Qt::LeftButton, {}, on_canvas(corner + QPointF(-20, 10)));
        const Zone& zone = zones(*window).begin()->second.zone;
        QCOMPARE(zone.frame, kDrawnIn);
        QVERIFY(std::hypot(zone.points[1].x - drawn[1].x + 20, zone.points[1].y - drawn[1].y - 10) < 1.5);
        for (const std::size_t other : {0, 2, 3}) QVERIFY(zone.points[other] == drawn[other]);
        QVERIFY(QLineF(window->canvas().frame().zones[0].points[1], corner + QPointF(-20, 10)).length() < 1.5);
        QTest::keyClick(&window->canvas(), Qt::Key_Z);
        QVERIFY(zones(*window).begin()->second.zone.points == drawn);
        QVERIFY(tool.active());
        QVERIFY(QLineF({tool.points()[1].x, tool.points()[1].y}, corner).length() < 1e-6);
        QTest::keyClick(&window->canvas(), Qt::Key_Escape);
        QVERIFY(!tool.active());
        QVERIFY(window->canvas().tool() == nullptr);
    }

    void aLineIsDrawnWithoutAMouse() {
        const auto window = windowWithRun();
        QVERIFY(window);
        const auto press = [&](Qt::Key key, Qt::KeyboardModifiers modifiers = {}) {
            QTest::keyClick(&window->canvas(), key, modifiers);
        };
        window->actions().draw_line->trigger();
        press(Qt::Key_Left);
        QVERIFY(window->canvas().keyPointer());
        QCOMPARE(window->session().currentFrame(), kDrawnIn);  // the arrows step no frames meanwhile
        press(Qt::Key_Return);
        press(Qt::Key_Down, Qt::ShiftModifier);
        press(Qt::Key_Return);
        press(Qt::Key_Backspace);
        QCOMPARE(window->events().zones().tool().points().size(), std::size_t(1));
        for (int i = 0; i < 5; ++i) press(Qt::Key_Right, Qt::ShiftModifier);
        press(Qt::Key_Return);
        QVERIFY(window->events().zones().tool().drawing());
        press(Qt::Key_Return);  // again in the same place: done
        QVERIFY(!window->events().zones().tool().drawing());
        QCOMPARE(zones(*window).size(), std::size_t(1));
        QCOMPARE(zones(*window).begin()->second.zone.points.size(), std::size_t(2));
        QVERIFY(!window->canvas().keyPointer());
    }

    void whatIsNoZoneIsToldAndDrawingGoesOn() {
        const auto window = windowWithRun();
        QVERIFY(window);
        window->actions().draw_zone->trigger();
        click(*window, kOnTheWay[0]);
        click(*window, kOnTheWay[1]);
        QTest::keyClick(&window->canvas(), Qt::Key_Return);
        QVERIFY(tells(*window, QStringLiteral("An area needs three points or more")));
        QVERIFY(window->events().zones().tool().drawing());
        QTest::keyClick(&window->canvas(), Qt::Key_Escape);
        QVERIFY(!window->events().zones().tool().drawing());
        QVERIFY(zones(*window).empty());
        QVERIFY(!tells(*window, QStringLiteral("three points")));
        // Its keys are the window's own again.
        QVERIFY(window->canvas().tool() == nullptr);

        drawZone(*window);
        drawZone(*window);
        QCOMPARE(zones(*window).size(), std::size_t(2));
        auto& model = window->events().zones().model();
        model.setData(model.index(1, ZonesModel::name_column), QStringLiteral("zone 1"), Qt::EditRole);
        QVERIFY(tells(*window, QStringLiteral("There is a zone \"zone 1\" already")));
        QCOMPARE(zones(*window).rbegin()->second.zone.name, std::string("zone 2"));
        model.setData(model.index(1, ZonesModel::name_column), QStringLiteral("  "), Qt::EditRole);
        QVERIFY(tells(*window, QStringLiteral("needs a name")));
    }

    void filesGoInAndOut() {
        auto window = windowWithRun();
        QVERIFY(window);
        drawZone(*window);
        ZoneReview& review = window->events().zones();
        const auto at = [this](const char* name) { return QString::fromStdString((*home_ / name).string()); };
        review.writeFile(at("zones.json"));
        QTRY_VERIFY_WITH_TIMEOUT(tells(*window, QStringLiteral("--zone")), kPatience_ms);
        QVERIFY(std::filesystem::exists(*home_ / "zones.json"));
        review.readFile(at("zones.json"));
        QTRY_VERIFY_WITH_TIMEOUT(tells(*window, QStringLiteral("are here already")), kPatience_ms);
        QCOMPARE(zones(*window).size(), std::size_t(1));
        const StoredZone before = zones(*window).begin()->second;
        review.panel().selectId(before.id);
        QTest::keyClick(review.panel().table(), Qt::Key_Delete);
        QVERIFY(zones(*window).empty());
        review.readFile(at("zones.json"));
        QTRY_COMPARE_WITH_TIMEOUT(zones(*window).size(), std::size_t(1), kPatience_ms);
        QCOMPARE(zones(*window).begin()->second.zone, before.zone);
        std::ofstream(*home_ / "broken.json") << "{\"eyrie_zones\": 1, \"zones\": [{\"name\": \"a\",";
        review.readFile(at("broken.json"));
        QTRY_VERIFY_WITH_TIMEOUT(tells(*window, QStringLiteral("broken.json")), kPatience_ms);
        std::ofstream(*home_ / "equal.json")
            << R"({"eyrie_zones": 1, "zones": [{"name": "zone 1", "points": [[0, 0], [9, 0], [9, 9]]}]})";
        review.readFile(at("equal.json"));
        QTRY_VERIFY_WITH_TIMEOUT(tells(*window, QStringLiteral("There is a zone \"zone 1\" already")), kPatience_ms);
        QVERIFY2(!tells(*window, QStringLiteral("equal.json")), "nothing of it was read");
        review.writeFile(at("no/where.json"));
        QTRY_VERIFY_WITH_TIMEOUT(tells(*window, QStringLiteral("no/where.json")), kPatience_ms);
        QCOMPARE(zones(*window).size(), std::size_t(1));
        review.writeFile(at("last.json"));
        window.reset();
        QVERIFY2(std::filesystem::exists(*home_ / "last.json"), "closing the window loses nothing");
    }

    void theWindowDoesNotWaitForTheDisk() {
        const auto window = windowWithRun();
        QVERIFY(window);
        drawZone(*window);
        const std::filesystem::path slow = *home_ / "slow.json";
        QVERIFY(mkfifo(slow.c_str(), 0600) == 0);
        std::promise<void> went_on;
        // A disk that takes nothing before the window has gone on, or has waited for it in vain.
        auto disk = std::async(std::launch::async, [slow, gone_on = went_on.get_future()] {
            const auto waited = gone_on.wait_for(std::chrono::milliseconds(kPatience_ms));
            std::ifstream file(slow);
            const std::string text((std::istreambuf_iterator<char>(file)), std::istreambuf_iterator<char>());
            return std::pair(waited == std::future_status::ready, text);
        });
        window->events().zones().writeFile(QString::fromStdString(slow.string()));
        went_on.set_value();
        const auto [window_went_on, text] = disk.get();
        QVERIFY(window_went_on);
        QVERIFY(text.find("zone 1") != std::string::npos);
        QTRY_VERIFY_WITH_TIMEOUT(tells(*window, QStringLiteral("--zone")), kPatience_ms);
    }

    void aRenamedZoneKeepsItsVerdicts() {
        const auto window = windowWithRun();
        QVERIFY(window);
        drawZone(*window);
        QVERIFY(waitForEvents(*window, EventKind::enters, 1));
        EventReview& review = window->events().review();
        std::vector<std::size_t> places;
        for (std::size_t i = 0; i < review.count(); ++i)
            if (listedKindAt(*review.found(), i) == static_cast<int>(EventKind::enters)) places.push_back(i);
        QVERIFY(review.judge(places, Judgement::relevant));
        auto& model = window->events().zones().model();
        QVERIFY(model.setData(model.index(0, ZonesModel::name_column), QStringLiteral("yard"), Qt::EditRole));
        const auto judged_in_yard = [&] {
            for (std::size_t i = 0; i < review.count(); ++i) {
                const Event* event = review.found()->eventAt(i);
                if (event != nullptr && event->zone == "yard" && review.isJudged(i)) return true;
            }
            return false;
        };
        QVERIFY(QTest::qWaitFor(judged_in_yard, kPatience_ms));
        QCOMPARE(review.leftCount(), std::size_t(0));
    }

    void labellingTakesTheCanvas() {
        const auto window = windowWithRun();
        QVERIFY(window);
        window->actions().draw_zone->trigger();
        click(*window, kOnTheWay[0]);
        QTest::keyClick(window.get(), Qt::Key_2, Qt::ControlModifier);
        QVERIFY(!window->events().zones().tool().drawing());
        QVERIFY(!window->actions().draw_zone->isEnabled());
        QVERIFY(window->canvas().tool() != nullptr);
        QTest::keyClick(window.get(), Qt::Key_1, Qt::ControlModifier);
        QVERIFY(window->actions().draw_zone->isEnabled());
        QVERIFY(window->canvas().tool() == nullptr);
    }
};

}  // namespace eyrie::ui::zones_window_test

EYRIE_UI_TEST(QApplication, zones_window_test, ZonesWindowTest)
#include "zones_window_test.moc"
