#include "workspace/workspaces.h"

#include <QDockWidget>
#include <QLineEdit>
#include <QMap>
#include <QMenuBar>
#include <QSet>
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
#include "canvas/layers/stages/detection_layer.h"
#include "canvas/layers/stages/vector_layer.h"
#include "canvas/layers/track_layer.h"
#include "canvas/layers/zone_layer.h"
#include "canvas/timeline/timeline_view.h"
#include "canvas/video_view.h"
#include "label/label_actions.h"
#include "label/label_workspace.h"
#include "review/card/card_dock.h"
#include "review/card/event_card.h"
#include "review/events/event_review.h"
#include "review/events/events_dock.h"
#include "review/inspector/track_inspector.h"
#include "ui/support/ui_support.h"
#include "ui/support/ui_test.h"
#include "widgets/message_bar.h"
#include "window/main_window.h"
#include "window/theme.h"
#include "workspace/dock_registry.h"
#include "workspace/key_sheet.h"
#include "workspace/window_actions.h"

namespace eyrie::ui::workspaces_test {

using test::kPatience_ms;

/// Review, label and tune: what each shows, what it keeps, and the keys.
class WorkspacesTest : public QObject {
    Q_OBJECT

    std::unique_ptr<test::OwnHome> home_;

    static std::unique_ptr<MainWindow> window(QSize size = {1280, 720}) {
        auto made = std::make_unique<MainWindow>();
        made->resize(size);
        made->show();
        return QTest::qWaitForWindowActive(made.get()) ? std::move(made) : nullptr;
    }
    static std::unique_ptr<MainWindow> windowWithVideo(QSize size = {1280, 720}) {
        auto made = window(size);
        made->session().openMedia(test::sceneUnderTest(5));
        return QTest::qWaitFor([&] { return made->canvas().isVisible(); }, kPatience_ms) ? std::move(made) : nullptr;
    }
    static void go(MainWindow& window, Qt::Key key) {
        QTest::keyClick(&window, key, Qt::ControlModifier);
        QCoreApplication::processEvents();
    }
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
        const auto window = this->window();
        QVERIFY(window);
        QCOMPARE(window->workspaces().current(), WorkspaceKind::review);
        for (const OverlayRow& row : overlayTable())
            QCOMPARE(window->overlays().isVisible(row.kind),
                     row.kind == TrackLayer::kKind || row.kind == ZoneLayer::kKind || row.kind == NorthLayer::kKind);
        QVERIFY(shown(*window, DockId::tracks) && shown(*window, DockId::inspector));
        QVERIFY(!shown(*window, DockId::parameters) && !shown(*window, DockId::stages));
    }

    void keysSwitchBetweenThem() {
        const auto window = this->window();
        QVERIFY(window);
        go(*window, Qt::Key_3);
        QCOMPARE(window->workspaces().current(), WorkspaceKind::tune);
        QVERIFY(shown(*window, DockId::parameters) && shown(*window, DockId::why) && shown(*window, DockId::sweeps));
        QVERIFY(window->overlays().isVisible(ClusterLayer::kKind));
        go(*window, Qt::Key_2);
        QVERIFY(window->labelling().active());
        QVERIFY(shown(*window, DockId::objects) && !shown(*window, DockId::tracks));
        QVERIFY(!window->overlays().isVisible(TrackLayer::kKind));
        go(*window, Qt::Key_1);
        QVERIFY(!window->labelling().active());
        QVERIFY(shown(*window, DockId::tracks) && !shown(*window, DockId::objects));
        QVERIFY(window->actions().workspaceAction(WorkspaceKind::review)->isChecked());
    }

    void eachKeepsItsDocksAndOverlays() {
        const auto window = this->window();
        QVERIFY(window);
        window->docks().dock(DockId::runs)->hide();
        for (const Qt::Key key : {Qt::Key_V, Qt::Key_B, Qt::Key_X, Qt::Key_PageUp})
            QTest::keyClick(window.get(), key, Qt::AltModifier);
        go(*window, Qt::Key_3);
        QVERIFY(shown(*window, DockId::runs));
        QVERIFY(detail(*window) == OverlayDetail{});
        QVERIFY(window->actions().labels->isChecked() && !window->actions().rejected->isChecked());
        // Vectors are on here at first, and so are trails.
        for (const Qt::Key key : {Qt::Key_V, Qt::Key_A, Qt::Key_Y}) QTest::keyClick(window.get(), key, Qt::AltModifier);
        go(*window, Qt::Key_1);
        QVERIFY(!shown(*window, DockId::runs));
        QVERIFY(window->overlays().isVisible(VectorLayer::kKind));
        QVERIFY(!detail(*window).labels && detail(*window).trails);
        QVERIFY(detail(*window).rejected_detections && !detail(*window).tentative_tracks);
        QVERIFY(detail(*window).vector_length_factor > OverlayDetail{}.vector_length_factor);
        QVERIFY(!window->actions().labels->isChecked() && window->actions().trails->isChecked());
        QVERIFY(window->actions().rejected->isChecked() && !window->actions().tentative->isChecked());
        go(*window, Qt::Key_3);
        QVERIFY(!window->overlays().isVisible(VectorLayer::kKind));
        QVERIFY(detail(*window).labels && !detail(*window).trails);
        QVERIFY(!detail(*window).rejected_detections && detail(*window).tentative_tracks);
        QVERIFY(!window->actions().trails->isChecked() && window->actions().tentative->isChecked());
    }

    void allIsRememberedFromOneStartToTheNext() {
        OverlayDetail reviewed;
        {
            const auto first = window();
            QVERIFY(first);
            first->docks().dock(DockId::inspector)->hide();
            for (const Qt::Key key :
                 {Qt::Key_C, Qt::Key_B, Qt::Key_A, Qt::Key_X, Qt::Key_Y, Qt::Key_PageUp, Qt::Key_PageUp})
                QTest::keyClick(first.get(), key, Qt::AltModifier);
            reviewed = detail(*first);
            go(*first, Qt::Key_3);
            first->actions().colour_blind->trigger();
            first->close();
        }
        QVERIFY(!reviewed.labels && !reviewed.trails && reviewed.rejected_detections && reviewed.tentative_tracks);
        const auto second = window();
        QVERIFY(second);
        QCOMPARE(second->workspaces().current(), WorkspaceKind::tune);
        QVERIFY(detail(*second) == OverlayDetail{});
        QVERIFY(second->actions().colour_blind->isChecked());
        QVERIFY(second->overlays().palette() == PaletteKind::colour_blind);
        go(*second, Qt::Key_1);
        QVERIFY(detail(*second) == reviewed);
        QVERIFY(second->actions().tentative->isChecked() && !second->actions().labels->isChecked());
        QVERIFY(second->overlays().palette() == PaletteKind::colour_blind);
        QVERIFY(!shown(*second, DockId::inspector));
        QVERIFY(second->overlays().isVisible(CornerLayer::kKind));
    }

    void anOverlayThatSettingsDoNotKnowIsShownAsAtTheFirstStart() {
        const auto window = this->window();
        QVERIFY(window);
        go(*window, Qt::Key_3);
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
        const auto window = this->window();
        QVERIFY(window);
        const QString kept = QStringLiteral("label/layout");
        go(*window, Qt::Key_2);
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
        const auto window = this->window();
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
        const auto window = this->window();
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
            go(*window, key);
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
        go(*window, Qt::Key_2);
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
        go(*window, Qt::Key_1);
        QVERIFY(window->timeline().sizeHint().height() >= kWholeTimeline);
        go(*window, Qt::Key_2);
        window->resize(1280, 900);
        QTRY_VERIFY_WITH_TIMEOUT(window->timeline().sizeHint().height() >= kWholeTimeline, kPatience_ms);
    }

    void aFinishedRunDoesNotPushAWindowOffASmallScreen() {
        const Theme theme(*qApp);
        for (const QSize first : {QSize(1280, 690), QSize(1600, 900)}) {
            const auto window = this->window(first);
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
                       window->card().card().subject() && !window->findChild<TrackInspector*>()->text().isEmpty();
            };
            QVERIFY(QTest::qWaitFor(filled, kPatience_ms));
            for (const Qt::Key key : {Qt::Key_1, Qt::Key_2, Qt::Key_3}) {
                go(*window, key);
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
            go(*window, key);
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
            go(*window, key);
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
        const auto window = this->window({1700, 900});
        QVERIFY(window);
        go(*window, Qt::Key_3);
        const auto bare = [&](DockId id) { return window->docks().dock(id)->titleBarWidget() != nullptr; };
        QVERIFY(QTest::qWaitFor([&] { return bare(DockId::stages); }, kPatience_ms));
        for (const DockId id : allDocks())
            if (shown(*window, id) && id != DockId::stages) window->docks().dock(id)->hide();
        QVERIFY(QTest::qWaitFor([&] { return !bare(DockId::stages); }, kPatience_ms));  // alone it has one
    }

    void aDockOfAnotherWorkspaceComesWhenItIsAskedFor() {
        const auto window = this->window();
        QVERIFY(window);
        window->docks().raise(DockId::why);
        QVERIFY(shown(*window, DockId::why));
        QCOMPARE(window->workspaces().current(), WorkspaceKind::review);
    }

    void gGoesToAFrameEverywhere() {
        const auto window = windowWithVideo();
        QVERIFY(window);
        for (const Qt::Key key : {Qt::Key_1, Qt::Key_2, Qt::Key_3}) {
            go(*window, key);
            QVERIFY(window->actions().go_to_frame->shortcuts().contains(QKeySequence(Qt::Key_G)));
            window->canvas().setFocus();
            QTest::keyClick(window.get(), Qt::Key_G);
            QVERIFY(!window->canvas().hasFocus());
        }
    }

    // ---- keys -------------------------------------------------------------------------------------------------------

    void aKeyCanBeChangedAndStaysSo() {
        {
            const auto window = this->window();
            QVERIFY(window);
            KeySheet sheet(window->keys(), {}, window.get());
            QAction* corners = window->actions().overlay.at(CornerLayer::kKind);
            sheet.choose(corners);
            sheet.setKey(QKeySequence(QStringLiteral("Alt+T")));
            QVERIFY2(sheet.answer().contains(QStringLiteral("Tracks")), qPrintable(sheet.answer()));
            QCOMPARE(corners->shortcut(), QKeySequence(QStringLiteral("Alt+C")));
            sheet.setKey(QKeySequence(Qt::Key_7));
            QCOMPARE(corners->shortcut(), QKeySequence(Qt::Key_7));
            QVERIFY(corners->toolTip().endsWith(QStringLiteral("(7)")));
            QTest::keyClick(window.get(), Qt::Key_7);
            QVERIFY(window->overlays().isVisible(CornerLayer::kKind));
        }
        const auto next = window();
        QVERIFY(next);
        QAction* corners = next->actions().overlay.at(CornerLayer::kKind);
        QCOMPARE(corners->shortcut(), QKeySequence(Qt::Key_7));
        next->keys().resetAll();
        QCOMPARE(corners->shortcut(), QKeySequence(QStringLiteral("Alt+C")));
    }

    /// A person may give a command of the window a key that labelling has: there it is labelling's.
    void aKeyThatLabellingTakesComesBack() {
        const auto window = this->window();
        QVERIFY(window);
        QAction* detections = window->actions().overlay.at(DetectionLayer::kKind);
        window->keys().setKeysOf(detections, {QKeySequence(Qt::Key_D)});
        go(*window, Qt::Key_2);
        QVERIFY(detections->shortcuts().isEmpty());  // D is the next frame here
        window->keys().setKeysOf(window->labelling().actions().next_frame, {QKeySequence(Qt::Key_F4)});
        QCOMPARE(detections->shortcut(), QKeySequence(Qt::Key_D));
        window->keys().setKeysOf(detections, {QKeySequence(Qt::Key_F4)});
        QVERIFY(detections->shortcuts().isEmpty());
        go(*window, Qt::Key_1);
        QCOMPARE(detections->shortcut(), QKeySequence(Qt::Key_F4));
    }

    void aKeyThatAPersonChoseIsNoOtherCommandsDefault() {
        QSettings().setValue(QStringLiteral("keys/Motion clusters"), QStringList{QStringLiteral("Alt+C")});
        const auto window = this->window();
        QVERIFY(window);
        QVERIFY(window->actions().overlay.at(CornerLayer::kKind)->shortcuts().isEmpty());
        QTest::keyClick(window.get(), Qt::Key_C, Qt::AltModifier);
        QVERIFY(window->overlays().isVisible(ClusterLayer::kKind));
        window->keys().resetAll();
        QTest::keyClick(window.get(), Qt::Key_C, Qt::AltModifier);
        QVERIFY(window->overlays().isVisible(CornerLayer::kKind));
    }

    void noKeyMeansTwoThings() {
        // On the canvas arrows move what is selected: a box by pixels, the event of the queue, and where nothing is,
        // the frame. Escape leaves what was begun and clears the selection. Backspace rejects what is selected.
        const QStringList alike{QStringLiteral("Left"),        QStringLiteral("Right"),    QStringLiteral("Shift+Left"),
                                QStringLiteral("Shift+Right"), QStringLiteral("Ctrl+Up"),  QStringLiteral("Ctrl+Down"),
                                QStringLiteral("Esc"),         QStringLiteral("Backspace")};
        const auto window = this->window();
        QVERIFY(window);
        const auto plain = [](const QAction* action) { return action->text().remove(QLatin1Char('&')); };
        QMap<QString, QString> meanings;
        QStringList twice;
        for (const KeyBindings::Group& group : window->keys().groups())
            for (const ActionSection& section : group.sections)
                for (const QAction* action : section.actions)
                    for (const QKeySequence& key : window->keys().keysOf(action)) {
                        const QString name = key.toString(QKeySequence::PortableText);
                        const QString before = meanings.value(name, plain(action));
                        meanings[name] = plain(action);
                        if (before != plain(action)) twice << name;
                    }
        for (const QString& name : twice)
            QVERIFY2(alike.contains(name), qPrintable(name + QLatin1Char(' ') + meanings[name]));
        for (const QString& name : alike) QVERIFY2(twice.contains(name), qPrintable(name));
    }

    void noMenuHasTheKeyOfACommand() {
        const auto window = this->window();
        QVERIFY(window);
        QSet<QKeySequence> menus;
        for (const QAction* menu : window->menuBar()->actions()) {
            const QKeySequence key = QKeySequence::mnemonic(menu->text());
            QVERIFY2(!key.isEmpty() && !menus.contains(key), qPrintable(menu->text()));
            menus.insert(key);
        }
        for (const KeyBindings::Group& group : window->keys().groups())
            for (const ActionSection& section : group.sections)
                for (const QAction* action : section.actions)
                    for (const QKeySequence& key : window->keys().keysOf(action))
                        QVERIFY2(!menus.contains(key), qPrintable(action->text()));
    }

    /// What the hand learned in one workspace does no harm in another.
    void keysOfTheWindowWorkWhereOneLabels() {
        const auto window = windowWithVideo();
        QVERIFY(window);
        go(*window, Qt::Key_2);
        window->canvas().setFocus();
        QTest::keyClick(&window->canvas(), Qt::Key_T, Qt::AltModifier);
        QVERIFY(window->overlays().isVisible(TrackLayer::kKind));
        QTest::keyClick(&window->canvas(), Qt::Key_Period);
        QVERIFY(QTest::qWaitFor([&] { return window->canvas().frame().index == 1; }, kPatience_ms));
        QTest::keyClick(&window->canvas(), Qt::Key_Comma);
        QVERIFY(QTest::qWaitFor([&] { return window->canvas().frame().index == 0; }, kPatience_ms));
        QTest::keyClick(&window->canvas(), Qt::Key_L);
        QVERIFY(window->session().playback().playing());
        QTest::keyClick(&window->canvas(), Qt::Key_K);
        QVERIFY(!window->session().playback().playing());
        const double speed = window->session().playback().speed();
        QTest::keyClick(&window->canvas(), Qt::Key_Greater);
        QVERIFY(window->session().playback().speed() > speed);
        QTest::keyClick(&window->canvas(), Qt::Key_Less);
        QCOMPARE(window->session().playback().speed(), speed);
        QTest::keyClick(&window->canvas(), Qt::Key_Space, Qt::ShiftModifier);
        QVERIFY(window->actions().loop->isChecked());
    }

    void theSheetOfKeysIsSearchedByCommandAndKey() {
        const auto window = this->window();
        QVERIFY(window);
        KeySheet sheet(window->keys(), {}, window.get());
        const auto visible = [&] {
            QStringList texts;
            for (QTreeWidgetItemIterator item(&sheet.list()); *item != nullptr; ++item)
                if ((*item)->parent() != nullptr && !(*item)->isHidden()) texts << (*item)->text(0);
            return texts;
        };
        const auto all = visible().size();
        sheet.search().setText(QStringLiteral("go to frame"));
        QCOMPARE(visible(), QStringList(QStringLiteral("Go to frame")));
        sheet.search().setText(QStringLiteral("ctrl+r"));
        QVERIFY(visible().contains(QStringLiteral("Run")));
        sheet.search().clear();
        QCOMPARE(visible().size(), all);
    }
};

}  // namespace eyrie::ui::workspaces_test

EYRIE_UI_TEST(QApplication, workspaces_test, WorkspacesTest)
#include "workspaces_test.moc"
