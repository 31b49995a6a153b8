#include <QComboBox>
#include <QDockWidget>
#include <QStatusBar>
#include <QTest>
#include <QToolBar>

#include "canvas/layers/stages/vector_layer.h"
#include "canvas/layers/track_layer.h"
#include "canvas/video_view.h"
#include "ui/support/ui_support.h"
#include "ui/support/ui_test.h"
#include "window/bars/overlay_button.h"
#include "window/bars/transport_bar.h"
#include "window/main_window.h"
#include "workspace/dock_registry.h"
#include "workspace/window_actions.h"
#include "workspace/workspaces.h"

namespace eyrie::ui::picture_alone_test {

using test::kPatience_ms;

/// The picture without what is around it: full screen, and no overlays.
class PictureAloneTest : public QObject {
    Q_OBJECT

    std::unique_ptr<test::OwnHome> home_;

    static std::unique_ptr<MainWindow> windowWithVideo() {
        auto made = std::make_unique<MainWindow>();
        made->resize(1280, 720);
        made->show();
        if (!QTest::qWaitForWindowActive(made.get())) return nullptr;
        made->session().openMedia(test::sceneUnderTest(5));
        return QTest::qWaitFor([&] { return made->canvas().isVisible(); }, kPatience_ms) ? std::move(made) : nullptr;
    }
    static QList<DockId> docksShown(MainWindow& window) {
        QList<DockId> shown;
        for (const DockId id : allDocks())
            if (!window.docks().dock(id)->isHidden()) shown << id;
        return shown;
    }
    static bool barsShown(MainWindow& window) {
        return window.statusBar()->isVisible() && window.findChild<QToolBar*>(QStringLiteral("run_bar"))->isVisible();
    }
    static void switchFullScreen(MainWindow& window) { window.actions().full_screen->trigger(); }

 private slots:
    void init() { home_ = std::make_unique<test::OwnHome>(); }
    void cleanup() { home_.reset(); }

    void fullScreenKeepsTransportAloneAndBringsTheLayoutBack() {
        const auto window = windowWithVideo();
        QVERIFY(window);
        window->docks().dock(DockId::runs)->hide();
        const QList<DockId> before = docksShown(*window);
        QVERIFY(!before.isEmpty() && barsShown(*window));
        QTest::keyClick(window.get(), Qt::Key_F11);
        QVERIFY(window->isFullScreen());
        QVERIFY(docksShown(*window).isEmpty());
        QVERIFY(!window->statusBar()->isVisible() &&
                !window->findChild<QToolBar*>(QStringLiteral("run_bar"))->isVisible());
        QVERIFY(window->findChild<TransportBar*>()->isVisible());
        switchFullScreen(*window);
        QVERIFY(!window->isFullScreen() && barsShown(*window));
        QCOMPARE(docksShown(*window), before);
    }

    void escapeLeavesItWhereverOneIs() {
        const auto window = windowWithVideo();
        QVERIFY(window);
        for (const WorkspaceKind kind : {WorkspaceKind::review, WorkspaceKind::label}) {
            window->workspaces().open(kind);
            switchFullScreen(*window);
            QVERIFY(window->isFullScreen());
            window->canvas().setFocus();
            QTest::keyClick(&window->canvas(), Qt::Key_Escape);
            QVERIFY(!window->isFullScreen());
            QVERIFY(!window->actions().full_screen->isChecked());
            QVERIFY(!docksShown(*window).isEmpty());
        }
    }

    void aWindowManagerThatEndsItIsFollowed() {
        const auto window = windowWithVideo();
        QVERIFY(window);
        switchFullScreen(*window);
        window->setWindowState(window->windowState() & ~Qt::WindowFullScreen);
        QVERIFY(!docksShown(*window).isEmpty() && barsShown(*window));
        QVERIFY(!window->actions().full_screen->isChecked());
    }

    void aWorkspaceThatIsOpenedMeanwhileIsShownSoToo() {
        const auto window = windowWithVideo();
        QVERIFY(window);
        switchFullScreen(*window);
        window->workspaces().open(WorkspaceKind::tune);
        QVERIFY(docksShown(*window).isEmpty() && !window->statusBar()->isVisible());
        switchFullScreen(*window);
        QVERIFY(docksShown(*window).contains(DockId::parameters) && barsShown(*window));
        window->workspaces().open(WorkspaceKind::review);
        QVERIFY(docksShown(*window).contains(DockId::tracks) && barsShown(*window));
    }

    void noEmptyLayoutIsRemembered() {
        QList<DockId> before;
        {
            const auto first = windowWithVideo();
            QVERIFY(first);
            first->docks().dock(DockId::runs)->hide();
            before = docksShown(*first);
            switchFullScreen(*first);
            first->close();
        }
        MainWindow second;
        second.show();
        QVERIFY(QTest::qWaitForWindowActive(&second));
        QVERIFY(!second.isFullScreen());
        QVERIFY(!second.actions().full_screen->isChecked());
        QCOMPARE(docksShown(second), before);
        QVERIFY(barsShown(second));
    }

    // ---- overlays ---------------------------------------------------------------------------------------------------

    void oneKeyHidesAllOverlaysAndBringsThemBack() {
        const auto window = windowWithVideo();
        QVERIFY(window);
        QTest::keyClick(window.get(), Qt::Key_V, Qt::AltModifier);
        const OverlayProfile before = window->overlays().profile();
        QVERIFY(window->overlays().isDrawn(VectorLayer::kKind));
        QTest::keyClick(window.get(), Qt::Key_0, Qt::AltModifier);
        QVERIFY(!window->overlays().isDrawn(VectorLayer::kKind) && !window->overlays().isDrawn(TrackLayer::kKind));
        QVERIFY2(window->findChild<OverlayButton*>()->isChecked(), "the tool bar says that they are hidden");
        QVERIFY2(window->overlays().profile() == before, "what is kept of the workspace stays");
        QTest::keyClick(window.get(), Qt::Key_0, Qt::AltModifier);
        QVERIFY(window->overlays().isDrawn(VectorLayer::kKind) && window->overlays().isDrawn(TrackLayer::kKind));
        QVERIFY(!window->findChild<OverlayButton*>()->isChecked());
    }

    void whatIsSwitchedWhileAllAreHiddenIsShown() {
        const auto window = windowWithVideo();
        QVERIFY(window);
        const OverlayProfile before = window->overlays().profile();
        for (const Qt::Key key : {Qt::Key_T, Qt::Key_V}) {  // one that was shown, and one that was not
            QTest::keyClick(window.get(), Qt::Key_0, Qt::AltModifier);
            QVERIFY(window->actions().hide_overlays->isChecked());
            QTest::keyClick(window.get(), key, Qt::AltModifier);
            QVERIFY(!window->actions().hide_overlays->isChecked());
            QVERIFY(window->overlays().isDrawn(TrackLayer::kKind));
            QVERIFY(window->actions().overlay.at(TrackLayer::kKind)->isChecked());
        }
        QVERIFY(window->overlays().isDrawn(VectorLayer::kKind));
        window->overlays().setVisible(VectorLayer::kKind, false);
        QVERIFY(window->overlays().profile() == before);
    }

    // ---- speed ------------------------------------------------------------------------------------------------------

    void theFastestSpeedsAreInTheListAndOnTheKeys() {
        const auto window = windowWithVideo();
        QVERIFY(window);
        const auto* speeds = window->findChild<TransportBar*>()->findChild<QComboBox*>();
        QCOMPARE(speeds->itemText(speeds->count() - 2), QStringLiteral("16×"));
        QCOMPARE(speeds->itemText(speeds->count() - 1), QStringLiteral("32×"));
        for (const char* shown : {"2×", "4×", "8×", "16×", "32×", "32×"}) {
            window->actions().faster->trigger();
            QCOMPARE(speeds->currentText(), QString::fromUtf8(shown));
        }
    }
};

}  // namespace eyrie::ui::picture_alone_test

EYRIE_UI_TEST(QApplication, picture_alone_test, PictureAloneTest)
#include "picture_alone_test.moc"
