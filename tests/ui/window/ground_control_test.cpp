#include <QApplication>
#include <QClipboard>
#include <QTableView>
#include <QTest>
#include <QToolButton>

#include "canvas/video_view.h"
#include "core/geometry/place_text.h"
#include "review/earth/control_point_tool.h"
#include "review/earth/control_points_model.h"
#include "review/earth/control_points_panel.h"
#include "review/earth/earth_dock.h"
#include "review/earth/ground_control.h"
#include "review/earth/video_earth.h"
#include "store/labels/annotation_store.h"
#include "store/review/control_points.h"
#include "ui/support/ui_test.h"
#include "ui/window/flown_video.h"
#include "ui/window/window_with_run.h"
#include "widgets/message_bar.h"
#include "window/docks/watching_docks.h"
#include "workspace/window_actions.h"

namespace eyrie::ui::ground_control_test {

using test::kPatience_ms;

/// Places that a person finds in the picture and on a map.
class GroundControlTest : public QObject {
    Q_OBJECT

    std::unique_ptr<test::OwnHome> home_;
    static inline const std::vector<QPointF> kCorners{{20, 20}, {220, 25}, {210, 160}, {15, 150}};

    static GroundControl& control(MainWindow& window) { return window.watching().earth().control(); }
    static bool goTo(MainWindow& window, FrameIndex frame) {
        window.session().goToFrame(frame);
        return test::shows(window.session(), frame);
    }
    static QPoint inView(MainWindow& window, QPointF px) {
        return window.canvas().transform().viewFromImage(px).toPoint();
    }
    /// Clicks a place and writes where it is, or something else.
    static void set(MainWindow& window, QPointF px, const QString& text = {}) {
        if (!control(window).tool().active()) window.actions().control_points->trigger();
        control(window).setAskForPlace([&](const QString&, const QString& why) -> std::optional<QString> {
            if (!why.isEmpty()) return std::nullopt;
            return text.isEmpty() ? QString::fromStdString(
                                        placeText(test::flownPlace(window.canvas().frame().index, {px.x(), px.y()})))
                                  : text;
        });
        QTest::mouseClick(&window.canvas(), Qt::LeftButton, {}, inView(window, px));
    }
    static void setCorners(MainWindow& window) {
        for (const QPointF& px : kCorners) set(window, px);
    }
    static std::vector<ControlPoint> stored(MainWindow& window) {
        ProjectFile project = ProjectFile::open(window.session().project(), ProjectFile::Mode::read_only);
        for (const SequenceRecord& sequence : sequencesOf(project))
            if (sequence.path == window.session().media()->identity) return readControlPoints(project, sequence.id);
        return {};
    }
    static bool isStored(MainWindow& window, std::size_t count) {
        return QTest::qWaitFor([&] { return stored(window).size() == count; }, kPatience_ms);
    }
    static bool says(MainWindow& window, const QString& words) {
        return QTest::qWaitFor([&] { return control(window).panel().state().contains(words); }, kPatience_ms);
    }
    static double metresOff(MainWindow& window, FrameIndex frame, QPointF px) {
        const auto place = window.watching().earth().earth().placeOf(frame, px);
        return place ? cv::norm(LocalPlane(test::flownPlace(frame, {px.x(), px.y()})).metresOf(*place)) : 1e9;
    }
    static bool tells(MainWindow& window, const QString& words) {
        const QStringList texts = window.messages().texts();
        return std::any_of(texts.begin(), texts.end(), [&](const QString& text) { return text.contains(words); });
    }
    /// A window over the scene without a run.
    static std::unique_ptr<MainWindow> bareWindow() {
        auto window = std::make_unique<MainWindow>();
        window->resize(1280, 720);
        window->show();
        if (!QTest::qWaitForWindowActive(window.get())) return nullptr;
        if (!test::openAndWait(window->session(), test::sceneUnderTest(60))) return nullptr;
        return window;
    }

 private slots:
    void init() {
        home_ = std::make_unique<test::OwnHome>();
        QApplication::clipboard()->clear();
    }

    void fourPointsLayTheVideoOnTheEarthAndAreKept() {
        {
            const auto window = test::windowWithRun();
            QVERIFY(window);
            QVERIFY(goTo(*window, 10));
            setCorners(*window);
            QVERIFY(isStored(*window, 4));
            QVERIFY(says(*window, QStringLiteral("4 control points")));
            QVERIFY(says(*window, QStringLiteral("a fifth tells how well")));
            // A pixel of the view may be half a pixel of the picture astray.
            QVERIFY(metresOff(*window, 10, {100, 90}) < 0.5);
            // Carried by the registration of the run, which is read in the background.
            QTRY_VERIFY_WITH_TIMEOUT(metresOff(*window, 40, {100, 90}) < 1, kPatience_ms);
            QTest::keyClick(&window->canvas(), Qt::Key_Escape);
            QVERIFY(!control(*window).tool().active());
            QVERIFY(!window->actions().control_points->isChecked());
            window->close();
        }
        const auto window = test::windowWithRun();
        QVERIFY(window);
        QVERIFY(says(*window, QStringLiteral("4 control points")));
        QCOMPARE(control(*window).model().rowCount(), 4);
        QTRY_VERIFY_WITH_TIMEOUT(metresOff(*window, 40, {100, 90}) < 1, kPatience_ms);
    }

    void theyNeedNoRunAndThenHoldInTheirFrame() {
        const auto window = bareWindow();
        QVERIFY(window);
        setCorners(*window);
        QVERIFY(isStored(*window, 4));
        QVERIFY(says(*window, QStringLiteral("a pixel is 0.5")));
        QVERIFY(metresOff(*window, 0, {100, 90}) < 0.5);
        QVERIFY(!window->watching().earth().earth().placeOf(30, {100, 90}));
    }

    void whatIsWrongIsSaidPlainly() {
        const auto window = test::windowWithRun();
        QVERIFY(window);
        QVERIFY(says(*window, QStringLiteral("at least four places")));
        for (const QPointF& px : {QPointF(20, 20), QPointF(100, 60), QPointF(180, 100)}) set(*window, px);
        QVERIFY(says(*window, QStringLiteral("3 control points that the registration connects; four are needed")));
        set(*window, {220, 120});
        QVERIFY(says(*window, QStringLiteral("lie on a line")));
        control(*window).panel().table()->selectAll();
        QTest::keyClick(control(*window).panel().table(), Qt::Key_Delete);
        QVERIFY(isStored(*window, 0));
        setCorners(*window);
        set(*window, {120, 90});
        set(*window, {60, 60});
        QVERIFY(says(*window, QStringLiteral("6 control points")));
        QVERIFY(!control(*window).panel().state().contains(QStringLiteral("contradict")));
        set(*window, {170, 60}, QString::fromStdString(placeText(test::flownPlace(0, {130, 20}))));
        QVERIFY(says(*window, QStringLiteral("contradict each other")));
        QVERIFY(says(*window, QStringLiteral("without point 7")));
        QVERIFY(control(*window).model().recordAt(6)->suspect);
    }

    void whatIsNoPlaceIsAskedForAgain() {
        const auto window = test::windowWithRun();
        QVERIFY(window);
        window->actions().control_points->trigger();
        QStringList asked, reasons;
        control(*window).setAskForPlace([&](const QString& text, const QString& why) -> std::optional<QString> {
            asked << text;
            reasons << why;
            if (asked.size() == 1) return QStringLiteral("Munich");
            if (asked.size() == 2) return QStringLiteral("48°08'13.8\"N 11°34'34\"E");
            return std::nullopt;
        });
        QTest::mouseClick(&window->canvas(), Qt::LeftButton, {}, inView(*window, {50, 50}));
        QCOMPARE(asked.size(), 2);
        QVERIFY(reasons[1].contains(QStringLiteral("“Munich” is not a place")));
        QCOMPARE(asked[1], QStringLiteral("Munich"));  // can be mended
        QCOMPARE(control(*window).points().size(), std::size_t(1));
        QVERIFY(qAbs(control(*window).points()[0].place.latitude_deg - 48.137167) < 1e-5);
        // Given up, nothing is set; what was copied from a map is offered.
        QApplication::clipboard()->setText(QStringLiteral(" 48.5, 11.25 "));
        QTest::mouseClick(&window->canvas(), Qt::LeftButton, {}, inView(*window, {90, 50}));
        QCOMPARE(control(*window).points().size(), std::size_t(1));
        QCOMPARE(asked.last(), QStringLiteral("48.5, 11.25"));
    }

    void pointsAreMovedChangedRemovedAndUndone() {
        const auto window = test::windowWithRun();
        QVERIFY(window);
        setCorners(*window);
        QVERIFY(isStored(*window, 4));
        const auto before = control(*window).points();
        QTest::mousePress(&window->canvas(), Qt::LeftButton, {}, inView(*window, kCorners[0]));
        QTest::mouseMove(&window->canvas(), inView(*window, {30, 25}));
        QTest::mouseMove(&window->canvas(), inView(*window, {40, 30}));
        QTest::mouseRelease(&window->canvas(), Qt::LeftButton, {}, inView(*window, {40, 30}));
        QVERIFY(cv::norm(control(*window).points()[0].px - cv::Point2d(40, 30)) < 0.6);
        ControlPointsModel& model = control(*window).model();
        const QModelIndex place = model.index(1, ControlPointsModel::place_column);
        QVERIFY(model.setData(place, QStringLiteral("48.001 N, 11.002 E"), Qt::EditRole));
        QCOMPARE(control(*window).points()[1].place, (GeoPoint{48.001, 11.002}));
        model.setData(place, QStringLiteral("nowhere"), Qt::EditRole);
        QVERIFY(tells(*window, QStringLiteral("“nowhere” is not a place")));
        control(*window).panel().table()->selectRow(3);
        QTest::keyClick(control(*window).panel().table(), Qt::Key_Delete);
        QVERIFY(isStored(*window, 3));
        const auto last = control(*window).points();

        window->canvas().setFocus();
        QTest::keyClick(&window->canvas(), Qt::Key_Z);
        QCOMPARE(control(*window).points().size(), std::size_t(4));
        QTest::keyClick(&window->canvas(), Qt::Key_Z, Qt::ControlModifier);
        control(*window).panel().undoButton()->click();
        QCOMPARE(control(*window).points(), before);
        QTRY_COMPARE_WITH_TIMEOUT(stored(*window), before, kPatience_ms);
        for (int i = 0; i < 3; ++i) control(*window).panel().redoButton()->click();
        QCOMPARE(control(*window).points(), last);
        QTRY_COMPARE_WITH_TIMEOUT(stored(*window), last, kPatience_ms);
        QVERIFY(!control(*window).panel().redoButton()->isEnabled());
    }

    void whatAnotherProgramChangedIsToldAndShown() {
        const auto window = test::windowWithRun();
        QVERIFY(window);
        set(*window, {50, 50});
        QVERIFY(isStored(*window, 1));
        {
            ProjectFile project = ProjectFile::open(window->session().project());
            replaceControlPoints(project, window->session().shownRun()->sequence.id, {{5, {1, 2}, {48, 11}}});
        }
        set(*window, {90, 50});
        QTRY_VERIFY_WITH_TIMEOUT(tells(*window, QStringLiteral("changed by another program")), kPatience_ms);
        QTRY_COMPARE_WITH_TIMEOUT(control(*window).points().size(), std::size_t(1), kPatience_ms);
        QCOMPARE(control(*window).points()[0].frame, 5);
    }

    void whatAnotherProgramSaysIsFollowedWithoutTouchingAnything() {
        const auto window = test::windowWithRun();
        QVERIFY(window);
        set(*window, {50, 50});
        QVERIFY(isStored(*window, 1));
        QVERIFY(control(*window).panel().undoButton()->isEnabled());
        const int video = window->session().shownRun()->sequence.id;
        ProjectFile project = ProjectFile::open(window->session().project());
        std::vector<ControlPoint> others;
        for (const QPointF& px : kCorners)
            others.push_back({7, {px.x(), px.y()}, test::flownPlace(7, {px.x(), px.y()})});
        replaceControlPoints(project, video, others);
        QTRY_COMPARE_WITH_TIMEOUT(control(*window).points(), others, kPatience_ms);
        QTRY_VERIFY_WITH_TIMEOUT(metresOff(*window, 7, {100, 90}) < 0.5, kPatience_ms);
        QVERIFY2(!control(*window).panel().undoButton()->isEnabled(), "nothing of theirs is taken back");
        replaceControlPoints(project, video, {});
        QTRY_VERIFY_WITH_TIMEOUT(control(*window).points().empty(), kPatience_ms);
        QVERIFY(says(*window, QStringLiteral("at least four places")));
    }

    void labellingTakesTheCanvas() {
        const auto window = test::windowWithRun();
        QVERIFY(window);
        window->actions().control_points->trigger();
        QVERIFY(control(*window).tool().active());
        QTest::keyClick(window.get(), Qt::Key_2, Qt::ControlModifier);
        QVERIFY(!control(*window).tool().active());
        QVERIFY(!window->actions().control_points->isEnabled());
        QTest::keyClick(window.get(), Qt::Key_1, Qt::ControlModifier);
        QVERIFY(window->actions().control_points->isEnabled());
        // Drawing a zone ends it, too.
        QTRY_VERIFY_WITH_TIMEOUT(window->actions().draw_zone->isEnabled(), kPatience_ms);
        window->actions().control_points->trigger();
        window->actions().draw_zone->trigger();
        QVERIFY(!control(*window).tool().active());
        QVERIFY(window->canvas().tool() != nullptr);
    }
};

}  // namespace eyrie::ui::ground_control_test

EYRIE_UI_TEST(QApplication, ground_control_test, GroundControlTest)
#include "ground_control_test.moc"
