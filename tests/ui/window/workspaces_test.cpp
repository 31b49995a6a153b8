#include "workspace/workspaces.h"

#include <QDockWidget>
#include <QLineEdit>
#include <QMap>
#include <QSettings>
#include <QTabBar>
#include <QTest>
#include <QToolBar>
#include <QToolButton>
#include <QTreeWidget>

#include "canvas/layers/north_layer.h"
#include "canvas/layers/overlay_table.h"
#include "canvas/layers/stages/cluster_layer.h"
#include "canvas/layers/stages/corner_layer.h"
#include "canvas/layers/stages/vector_layer.h"
#include "canvas/layers/track_layer.h"
#include "canvas/layers/zone_layer.h"
#include "canvas/timeline/timeline_view.h"
#include "canvas/video_view.h"
#include "label/label_workspace.h"
#include "review/card/card_dock.h"
#include "review/card/event_card.h"
#include "review/events/event_review.h"
#include "review/events/events_dock.h"
#include "review/inspector/track_inspector.h"
#include "ui/support/ui_support.h"
#include "ui/support/ui_test.h"
#include "ui/window/shown_window.h"
#include "widgets/message_bar.h"
#include "window/docks/watching_docks.h"
#include "window/main_window.h"
#include "window/theme.h"
#include "workspace/dock_registry.h"
#include "workspace/window_actions.h"

namespace eyrie::ui::workspaces_test {

using test::kPatience_ms;
using test::openWorkspace;
using test::shownWindow;
using test::windowWithVideo;

/// Review, label and tune: what each shows and keeps, and how much room it leaves.
class WorkspacesTest : public QObject {
    Q_OBJECT

    std::unique_ptr<test::OwnHome> home_;

    /// The least heights of what a window holds, for messages.
    static QString sizes(MainWindow& window) {
        QStringList texts{
            QStringLiteral("%1 x %2, canvas %3").arg(window.width()).arg(window.height()).arg(window.canvas().width())};
        for (const DockId id : allDocks())
            if (shown(window, id))
                texts << QStringLiteral("%1 %2 x %3")
                             .arg(window.docks().dock(id)->objectName())
                             .arg(window.docks().dock(id)->minimumSizeHint().width())
                             .arg(window.docks().dock(id)->minimumSizeHint().height());
        return texts.join(QStringLiteral(", "));
    }
    static bool shown(MainWindow& window, DockId id) { return !window.docks().dock(id)->isHidden(); }
    static OverlayDetail detail(MainWindow& window) { return window.overlays().style().detail; }

 private slots:
    void init() { home_ = std::make_unique<test::OwnHome>(); }
    void cleanup() { home_.reset(); }

    void reviewComesFirstWithTracksOnly() {
        const auto window = shownWindow();
        QVERIFY(window);
        QCOMPARE(window->workspaces().current(), WorkspaceKind::review);
        for (const OverlayRow& row : overlayTable())
            QCOMPARE(window->overlays().isVisible(row.kind),
                     row.kind == TrackLayer::kKind || row.kind == ZoneLayer::kKind || row.kind == NorthLayer::kKind);
        QVERIFY(shown(*window, DockId::tracks) && shown(*window, DockId::inspector));
        QVERIFY(!shown(*window, DockId::parameters) && !shown(*window, DockId::stages));
    }

    void keysSwitchBetweenThem() {
        const auto window = shownWindow();
        QVERIFY(window);
        openWorkspace(*window, Qt::Key_3);
        QCOMPARE(window->workspaces().current(), WorkspaceKind::tune);
        QVERIFY(shown(*window, DockId::parameters) && shown(*window, DockId::why) && shown(*window, DockId::sweeps));
        QVERIFY(window->overlays().isVisible(ClusterLayer::kKind));
        openWorkspace(*window, Qt::Key_2);
        QVERIFY(window->labelling().active());
        QVERIFY(shown(*window, DockId::objects) && !shown(*window, DockId::tracks));
        QVERIFY(!window->overlays().isVisible(TrackLayer::kKind));
        openWorkspace(*window, Qt::Key_1);
        QVERIFY(!window->labelling().active());
        QVERIFY(shown(*window, DockId::tracks) && !shown(*window, DockId::objects));
        QVERIFY(window->actions().workspaceAction(WorkspaceKind::review)->isChecked());
    }

    void eachKeepsItsDocksAndOverlays() {
        const auto window = shownWindow();
        QVERIFY(window);
        window->docks().dock(DockId::runs)->hide();
        for (const Qt::Key key : {Qt::Key_V, Qt::Key_B, Qt::Key_X, Qt::Key_PageUp})
            QTest::keyClick(window.get(), key, Qt::AltModifier);
        openWorkspace(*window, Qt::Key_3);
        QVERIFY(shown(*window, DockId::runs));
        QVERIFY(detail(*window) == OverlayDetail{});
        QVERIFY(window->actions().labels->isChecked() && !window->actions().rejected->isChecked());
        // Vectors are on here at first, and so are trails.
        for (const Qt::Key key : {Qt::Key_V, Qt::Key_A, Qt::Key_Y}) QTest::keyClick(window.get(), key, Qt::AltModifier);
        openWorkspace(*window, Qt::Key_1);
        QVERIFY(!shown(*window, DockId::runs));
        QVERIFY(window->overlays().isVisible(VectorLayer::kKind));
        QVERIFY(!detail(*window).labels && detail(*window).trails);
        QVERIFY(detail(*window).rejected_detections && !detail(*window).tentative_tracks);
        QVERIFY(detail(*window).vector_length_factor > OverlayDetail{}.vector_length_factor);
        QVERIFY(!window->actions().labels->isChecked() && window->actions().trails->isChecked());
        QVERIFY(window->actions().rejected->isChecked() && !window->actions().tentative->isChecked());
        openWorkspace(*window, Qt::Key_3);
        QVERIFY(!window->overlays().isVisible(VectorLayer::kKind));
        QVERIFY(detail(*window).labels && !detail(*window).trails);
        QVERIFY(!detail(*window).rejected_detections && detail(*window).tentative_tracks);
        QVERIFY(!window->actions().trails->isChecked() && window->actions().tentative->isChecked());
    }

    void allIsRememberedFromOneStartToTheNext() {
        OverlayDetail reviewed;
        {
            const auto first = shownWindow();
            QVERIFY(first);
            first->docks().dock(DockId::inspector)->hide();
            for (const Qt::Key key :
                 {Qt::Key_C, Qt::Key_B, Qt::Key_A, Qt::Key_X, Qt::Key_Y, Qt::Key_PageUp, Qt::Key_PageUp})
                QTest::keyClick(first.get(), key, Qt::AltModifier);
            reviewed = detail(*first);
            openWorkspace(*first, Qt::Key_3);
            first->actions().colour_blind->trigger();
            first->close();
        }
        QVERIFY(!reviewed.labels && !reviewed.trails && reviewed.rejected_detections && reviewed.tentative_tracks);
        const auto second = shownWindow();
        QVERIFY(second);
        QCOMPARE(second->workspaces().current(), WorkspaceKind::tune);
        QVERIFY(detail(*second) == OverlayDetail{});
        QVERIFY(second->actions().colour_blind->isChecked());
        QVERIFY(second->overlays().palette() == PaletteKind::colour_blind);
        openWorkspace(*second, Qt::Key_1);
        QVERIFY(detail(*second) == reviewed);
        QVERIFY(second->actions().tentative->isChecked() && !second->actions().labels->isChecked());
        QVERIFY(second->overlays().palette() == PaletteKind::colour_blind);
        QVERIFY(!shown(*second, DockId::inspector));
        QVERIFY(second->overlays().isVisible(CornerLayer::kKind));
    }

    void anOverlayThatSettingsDoNotKnowIsShownAsAtTheFirstStart() {
        const auto window = shownWindow();
        QVERIFY(window);
        openWorkspace(*window, Qt::Key_3);
        QTest::keyClick(window.get(), Qt::Key_V, Qt::AltModifier);
        QTest::keyClick(window.get(), Qt::Key_M, Qt::AltModifier);
        QTest::keyClick(window.get(), Qt::Key_A, Qt::AltModifier);
        QTest::keyClick(window.get(), Qt::Key_X, Qt::AltModifier);
        QVariantMap state = window->workspaces().state();
        QVariantMap shown = state[QStringLiteral("tune/overlays")].toMap();
        QCOMPARE(shown.size(), static_cast<qsizetype>(overlayTable().size()));
        QCOMPARE(shown.remove(QStringLiteral("clusters")), 1);
        state[QStringLiteral("tune/overlays")] = shown;
        QVariantMap details = state[QStringLiteral("tune/overlay_detail")].toMap();
        QCOMPARE(details.remove(QStringLiteral("trails")), 1);
        details[QStringLiteral("vector_length")] = 1e9;  // nobody can draw that
        state[QStringLiteral("tune/overlay_detail")] = details;
        window->workspaces().restore(state);
        QVERIFY(detail(*window).trails && detail(*window).rejected_detections);
        QCOMPARE(detail(*window).vector_length_factor, OverlayDetail{}.vector_length_factor);
        QVERIFY(window->overlays().isVisible(ClusterLayer::kKind));
        QVERIFY(!window->overlays().isVisible(VectorLayer::kKind));
    }

    void aLayoutOfAnEarlierArrangementIsNotRestored() {
        const auto window = shownWindow();
        QVERIFY(window);
        const QString kept = QStringLiteral("label/layout");
        openWorkspace(*window, Qt::Key_2);
        QVERIFY(shown(*window, DockId::object));
        window->docks().dock(DockId::object)->hide();
        QVariantMap state = window->workspaces().state();
        window->workspaces().restore(state);
        QVERIFY2(!shown(*window, DockId::object), "of this arrangement it is");
        state[kept] = window->saveState(5);  // as versions kept it that had two columns
        window->workspaces().restore(state);
        QVERIFY(shown(*window, DockId::object));
        QVERIFY2(window->workspaces().state()[kept].toByteArray() != state[kept].toByteArray(),
                 "from now on this arrangement is kept");
    }

    void theLayoutCanBeReset() {
        const auto window = shownWindow();
        QVERIFY(window);
        for (const DockId id : allDocks()) window->docks().dock(id)->hide();
        QTest::keyClick(window.get(), Qt::Key_T, Qt::AltModifier);
        QTest::keyClick(window.get(), Qt::Key_B, Qt::AltModifier);
        window->workspaces().reset();
        QVERIFY(detail(*window) == OverlayDetail{});
        QVERIFY(shown(*window, DockId::tracks) && shown(*window, DockId::inspector));
        QVERIFY(window->overlays().isVisible(TrackLayer::kKind));
    }

    void aWindowThatIsShownAgainIsAsItWasLeft() {
        const auto window = shownWindow();
        QVERIFY(window);
        window->docks().dock(DockId::inspector)->hide();
        window->hide();
        window->show();
        QVERIFY(!shown(*window, DockId::inspector));
    }

    void theVideoKeepsHalfOfASmallWindow() {
        const auto window = windowWithVideo();
        QVERIFY(window);
        window->findChild<MessageBar*>()->setMaximumHeight(0);  // notices pass
        for (const Qt::Key key : {Qt::Key_1, Qt::Key_2, Qt::Key_3}) {
            openWorkspace(*window, key);
            QTest::qWait(0);
            QVERIFY2(window->size() == QSize(1280, 720), qPrintable(sizes(*window)));
            QVERIFY2(window->canvas().width() >= 640 && window->canvas().height() >= 360,
                     qPrintable(QStringLiteral("%1: %2 x %3")
                                    .arg(wordOf(window->workspaces().current()))
                                    .arg(window->canvas().width())
                                    .arg(window->canvas().height())));
        }
    }

    void whereOneLabelsTheVideoKeepsHalfOfTheAreaOfASmallWindow() {
        const auto window = windowWithVideo();
        QVERIFY(window);
        window->findChild<MessageBar*>()->setMaximumHeight(0);  // notices pass
        constexpr int kWholeTimeline = 104;                     // at least
        openWorkspace(*window, Qt::Key_2);
        const auto settled = [&] { return window->timeline().height() == window->timeline().sizeHint().height(); };
        QTRY_VERIFY_WITH_TIMEOUT(settled(), kPatience_ms);
        QTest::qWait(0);
        QVERIFY2(window->size() == QSize(1280, 720), qPrintable(sizes(*window)));
        const QSize video = window->canvas().size();
        QVERIFY2(2 * video.width() * video.height() >= window->width() * window->height(),
                 qPrintable(QStringLiteral("%1 x %2; %3").arg(video.width()).arg(video.height()).arg(sizes(*window))));
        QVERIFY2(shown(*window, DockId::objects) && shown(*window, DockId::object), "list and object are seen, too");
        QVERIFY(!window->docks().dock(DockId::objects)->visibleRegion().isEmpty());
        QVERIFY(!window->docks().dock(DockId::object)->visibleRegion().isEmpty());
        // The timeline leaves nothing out elsewhere, nor where there is room.
        QVERIFY(window->timeline().sizeHint().height() < kWholeTimeline);
        openWorkspace(*window, Qt::Key_1);
        QVERIFY(window->timeline().sizeHint().height() >= kWholeTimeline);
        openWorkspace(*window, Qt::Key_2);
        window->resize(1280, 900);
        QTRY_VERIFY_WITH_TIMEOUT(window->timeline().sizeHint().height() >= kWholeTimeline, kPatience_ms);
    }

    void aFinishedRunDoesNotPushAWindowOffASmallScreen() {
        const Theme theme(*qApp);
        for (const QSize first : {QSize(1280, 690), QSize(1600, 900)}) {
            const auto window = test::shownWindow(first);
            QVERIFY(window);
            window->session().settings().options.detection.method = DetectionMethod::gradient;
            window->session().settings().options.view.oblique = false;
            StartOptions options;
            options.input = test::writeScene(*home_ / "images", 60);
            options.gsd_m_per_px = 0.25;
            window->start(options);
            const auto& run = window->session().runData();
            const auto has_tracks = [&] { return !window->session().running() && run && !run->tracks.empty(); };
            QVERIFY(QTest::qWaitFor(has_tracks, kPatience_ms));
            window->findChild<MessageBar*>()->setMaximumHeight(0);  // notices pass
            window->session().selectTrack(run->tracks.front().id);
            // Lists, card and inspector are filled.
            const auto filled = [&] {
                return window->events().review().state() == EventReview::State::found &&
                       window->watching().card().card().subject() &&
                       !window->findChild<TrackInspector*>()->text().isEmpty();
            };
            QVERIFY(QTest::qWaitFor(filled, kPatience_ms));
            for (const Qt::Key key : {Qt::Key_1, Qt::Key_2, Qt::Key_3}) {
                openWorkspace(*window, key);
                QTest::qWait(0);
                const QSize least = window->minimumSizeHint();
                QVERIFY2(least.width() <= 1280 && least.height() <= 690,
                         qPrintable(QStringLiteral("%1 of %2 needs %3 x %4: %5")
                                        .arg(wordOf(window->workspaces().current()))
                                        .arg(first.width())
                                        .arg(least.width())
                                        .arg(least.height())
                                        .arg(sizes(*window))));
            }
        }
    }

    /// The choice of the workspaces is the end of the bar that begins with the run: what does not fit is hidden first.
    void everyWorkspaceCanBeChosenInASmallWindow() {
        const Theme theme(*qApp);
        const auto window = windowWithVideo();
        QVERIFY(window);
        window->findChild<MessageBar*>()->setMaximumHeight(0);  // notices pass
        auto* bar = window->findChild<QToolBar*>(QStringLiteral("run_bar"));
        QVERIFY(bar != nullptr);
        for (const Qt::Key key : {Qt::Key_1, Qt::Key_2, Qt::Key_3}) {
            openWorkspace(*window, key);
            QTest::qWait(0);
            QVERIFY2(window->size() == QSize(1280, 720), qPrintable(sizes(*window)));
            const auto* more = bar->findChild<QToolButton*>(QStringLiteral("qt_toolbar_ext_button"));
            QVERIFY2(
                more == nullptr || !more->isVisible(),
                qPrintable(QStringLiteral("the bar needs %1 of %2 px").arg(bar->sizeHint().width()).arg(bar->width())));
            for (QAction* action : bar->actions()) {
                const QWidget* button = bar->widgetForAction(action);
                QVERIFY(button != nullptr);
                const QRect place(button->mapTo(window.get(), QPoint()), button->size());
                QVERIFY2(button->isVisible() && window->rect().contains(place),
                         qPrintable(QStringLiteral("%1 up to %2").arg(action->text()).arg(place.right())));
            }
            for (const WorkspaceKind kind : allWorkspaces())
                QVERIFY(bar->actions().contains(window->actions().workspaceAction(kind)));
        }
    }

    void everyTabOfASmallWindowIsSeen() {
        const Theme theme(*qApp);
        const auto window = windowWithVideo();
        QVERIFY(window);
        for (const Qt::Key key : {Qt::Key_1, Qt::Key_2, Qt::Key_3}) {
            openWorkspace(*window, key);
            QTest::qWait(0);
            for (const QTabBar* tabs : window->findChildren<QTabBar*>()) {
                if (!tabs->isVisible() || tabs->count() == 0) continue;
                const int end = tabs->tabRect(tabs->count() - 1).right();
                QVERIFY2(end < tabs->width(),
                         qPrintable(QStringLiteral("%1: tabs up to %2 need %3 of %4 px")
                                        .arg(wordOf(window->workspaces().current()), tabs->tabText(tabs->count() - 1))
                                        .arg(end)
                                        .arg(tabs->width())));
            }
        }
    }

    void aDockAmongTabsHasNoTitleBesideItsTab() {
        const auto window = test::shownWindow({1700, 900});
        QVERIFY(window);
        openWorkspace(*window, Qt::Key_3);
        const auto bare = [&](DockId id) { return window->docks().dock(id)->titleBarWidget() != nullptr; };
        QVERIFY(QTest::qWaitFor([&] { return bare(DockId::stages); }, kPatience_ms));
        for (const DockId id : allDocks())
            if (shown(*window, id) && id != DockId::stages) window->docks().dock(id)->hide();
        QVERIFY(QTest::qWaitFor([&] { return !bare(DockId::stages); }, kPatience_ms));  // alone it has one
    }

    void aDockOfAnotherWorkspaceComesWhenItIsAskedFor() {
        const auto window = shownWindow();
        QVERIFY(window);
        window->docks().raise(DockId::why);
        QVERIFY(shown(*window, DockId::why));
        QCOMPARE(window->workspaces().current(), WorkspaceKind::review);
    }
};

}  // namespace eyrie::ui::workspaces_test

EYRIE_UI_TEST(QApplication, workspaces_test, WorkspacesTest)
#include "workspaces_test.moc"
