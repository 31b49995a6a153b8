#include "window/main_window.h"

#include <QAbstractButton>
#include <QDropEvent>
#include <QLineEdit>
#include <QMimeData>
#include <QSet>
#include <QSignalSpy>
#include <QTest>
#include <QTreeWidget>
#include <algorithm>

#include "canvas/layers/north_layer.h"
#include "canvas/layers/speed_layer.h"
#include "canvas/layers/stages/cluster_layer.h"
#include "canvas/layers/stages/corner_layer.h"
#include "canvas/layers/stages/detection_layer.h"
#include "canvas/layers/stages/image_stack_layer.h"
#include "canvas/layers/stages/roi_layer.h"
#include "canvas/layers/stages/vector_layer.h"
#include "canvas/layers/track_layer.h"
#include "canvas/layers/truth_layer.h"
#include "canvas/layers/zone_layer.h"
#include "canvas/timeline/timeline_view.h"
#include "canvas/video_view.h"
#include "label/label_actions.h"
#include "label/label_workspace.h"
#include "tune/inspect/inspection.h"
#include "tune/inspect/motion_statistics_panel.h"
#include "tune/inspect/stacks_panel.h"
#include "tune/inspect/stages_panel.h"
#include "ui/support/ui_support.h"
#include "ui/support/ui_test.h"
#include "widgets/chip_grid.h"
#include "widgets/message_bar.h"
#include "window/docks/review_docks.h"
#include "workspace/dock_registry.h"
#include "workspace/key_sheet.h"
#include "workspace/window_actions.h"
#include "workspace/workspaces.h"

namespace eyrie::ui::main_window_test {

using test::kPatience_ms;

class MainWindowTest : public QObject {
    Q_OBJECT

    std::unique_ptr<test::OwnHome> home_;

    static bool waitFor(const std::function<bool()>& condition) { return QTest::qWaitFor(condition, kPatience_ms); }
    static bool showsFrame(MainWindow& window, FrameIndex frame) {
        return waitFor(
            [&] { return window.canvas().frame().index == frame && !window.canvas().frame().image.isNull(); });
    }
    /// A window with a finished run over a small folder of images.
    std::unique_ptr<MainWindow> windowWithRun(int frames, const ChainOptions& chain = {}) {
        const auto folder = test::writeScene(*home_ / "images", frames);
        auto window = std::make_unique<MainWindow>();
        window->show();
        window->session().settings().options = chain;
        window->session().settings().options.view.oblique = false;
        QSignalSpy finished(&window->session(), &ProjectSession::runFinished);
        StartOptions options;
        options.input = folder;
        options.gsd_m_per_px = 0.25;
        window->start(options);
        if (!finished.wait(kPatience_ms)) return nullptr;
        waitFor([&] {
            return window->session().runData() && !window->session().running() &&
                   window->session().runData()->frames.size() == static_cast<size_t>(frames);
        });
        return window;
    }

 private slots:
    void init() { home_ = std::make_unique<test::OwnHome>(); }
    void cleanup() { home_.reset(); }

    void withoutAVideoItTeachesHowToBegin() {
        MainWindow window;
        window.show();
        QVERIFY(!window.session().video());
        QVERIFY(!window.actions().run->isEnabled());
        QVERIFY(!window.canvas().isVisible());
        bool offers_demo = false;
        for (const auto* button : window.findChildren<QAbstractButton*>())
            offers_demo = offers_demo || (button->isVisible() && button->text().contains(QStringLiteral("demo")));
        QVERIFY(offers_demo);
    }

    void withoutAVideoOnlyWhatNeedsNoneIsOffered() {
        MainWindow window;
        window.show();
        const WindowActions& actions = window.actions();
        for (const QAction* action :
             {actions.open_video, actions.open_folder, actions.watch_live, actions.open_project, actions.demo,
              actions.your_name, actions.keys, actions.workspaceAction(WorkspaceKind::label)})
            QVERIFY2(action->isEnabled(), qPrintable(action->text()));
        for (const QAction* action :
             {actions.save_as,       actions.save_copy,   actions.restore_state, actions.start_time,
              actions.export_tracks, actions.report,      actions.continue_run,  actions.play,
              actions.step_on,       actions.only_moving, actions.fit,           actions.steady,
              actions.follow_object, actions.measure,     actions.snapshot,      actions.why,
              actions.compare,       actions.next_event,  actions.relevant,      actions.like_track,
              actions.add_track,     actions.split_track, actions.undo_verdict,  actions.clip_event,
              actions.report_events, actions.bookmark,    actions.draw_zone,     actions.control_points,
              actions.next_error,    actions.wrong_truth})
            QVERIFY2(!action->isEnabled(), qPrintable(action->text()));
        actions.workspaceAction(WorkspaceKind::label)->trigger();
        const LabelActions& label = window.labelling().actions();
        for (const QAction* action :
             {label.draw, label.region_begins, label.next_object, label.next_attention, label.proposals,
              label.next_frame, label.import_labels, label.track_on, label.object_class[0], label.nudge[0]})
            QVERIFY2(!action->isEnabled(), qPrintable(action->text()));
    }

    void opensAFolderOfImagesRunsItAndStepsWithTheKeys() {
        const auto window = windowWithRun(30);
        QVERIFY(window);
        QCOMPARE(window->session().runs().size(), std::size_t(1));
        window->canvas().setFocus();
        QTest::keyClick(window.get(), Qt::Key_Home);
        QVERIFY(showsFrame(*window, 0));
        QTest::keyClick(window.get(), Qt::Key_Right);
        QVERIFY(showsFrame(*window, 1));
        QTest::keyClick(window.get(), Qt::Key_Right, Qt::ShiftModifier);
        QVERIFY(showsFrame(*window, 11));
        QTest::keyClick(window.get(), Qt::Key_Left);
        QVERIFY(showsFrame(*window, 10));
        QTest::keyClick(window.get(), Qt::Key_End);
        QVERIFY(showsFrame(*window, 29));
        QCOMPARE(window->timeline().currentFrame(), 29);
        QVERIFY(window->canvas().frame().result);
        QTest::mouseClick(&window->timeline(), Qt::LeftButton, {},
                          QPoint(static_cast<int>(window->timeline().axis().centreOf(17)), 10));  // on the ruler
        QVERIFY(showsFrame(*window, 17));
    }

    void overlaysAreSwitchedByTheirKeys() {
        MainWindow window;
        window.show();
        QVERIFY(QTest::qWaitForWindowActive(&window));
        const std::pair<Qt::Key, OverlayKind> keys[] = {
            {Qt::Key_C, CornerLayer::kKind},    {Qt::Key_V, VectorLayer::kKind},     {Qt::Key_M, ClusterLayer::kKind},
            {Qt::Key_R, RoiLayer::kKind},       {Qt::Key_D, DetectionLayer::kKind},  {Qt::Key_T, TrackLayer::kKind},
            {Qt::Key_U, TruthLayer::kKind},     {Qt::Key_S, ImageStackLayer::kKind}, {Qt::Key_6, SpeedLayer::kKind},
            {Qt::Key_7, OverlayKind{"scores"}}, {Qt::Key_Z, ZoneLayer::kKind},       {Qt::Key_8, NorthLayer::kKind},
            {Qt::Key_9, OverlayKind{"shadows"}}};
        for (const auto& [key, kind] : keys) {
            const bool before = window.overlays().isVisible(kind);
            QTest::keyClick(&window, key, Qt::AltModifier);
            QCOMPARE(window.overlays().isVisible(kind), !before);
            QTest::keyClick(&window, key, Qt::AltModifier);
            QCOMPARE(window.overlays().isVisible(kind), before);
        }
        const double length = window.overlays().style().detail.vector_length_factor;
        QTest::keyClick(&window, Qt::Key_PageUp, Qt::AltModifier);
        QVERIFY(window.overlays().style().detail.vector_length_factor > length);
        QTest::keyClick(&window, Qt::Key_B, Qt::AltModifier);
        QVERIFY(!window.overlays().style().detail.labels);
    }

    void noTwoCommandsShareAKey() {
        MainWindow window;
        QSet<QKeySequence> seen;
        for (const ActionSection& section : window.actions().sections())
            for (const QAction* action : section.actions)
                for (const QKeySequence& key : action->shortcuts()) {
                    QVERIFY2(!seen.contains(key), qPrintable(key.toString() + QStringLiteral(" of ") + action->text()));
                    seen.insert(key);
                }
    }

    void everyCommandWithAKeyIsOnTheSheet() {
        MainWindow window;
        const KeySheet sheet(window.keys(), {}, &window);
        QStringList texts;
        for (QTreeWidgetItemIterator item(sheet.findChild<QTreeWidget*>()); *item != nullptr; ++item)
            texts << (*item)->text(0);
        for (const ActionSection& section : window.actions().sections())
            for (const QAction* action : section.actions)
                if (!action->shortcuts().isEmpty())
                    QVERIFY(texts.contains(action->text().remove(QLatin1Char('&')).remove(QStringLiteral("…"))));
    }

    void selectionIsOneEverywhere() {
        const auto window = windowWithRun(60);
        QVERIFY(window);
        ProjectSession& session = window->session();
        QVERIFY(!session.runData()->tracks.empty());
        const TrackSummary track = session.runData()->tracks.front();
        session.goToTrack(track.id);
        QVERIFY(waitFor([&] {
            return window->canvas().frame().index == session.currentFrame() && window->canvas().frame().result;
        }));
        session.selectTrack(std::nullopt);
        const TrackState* state = nullptr;
        for (const TrackState& s : window->canvas().frame().result->tracks)
            if (s.id == track.id) state = &s;
        QVERIFY(state);
        window->overlays().setTentativeTracks(true);
        const QPointF centre(state->box.centre.x, state->box.centre.y);
        QTest::mouseClick(&window->canvas(), Qt::LeftButton, {},
                          window->canvas().transform().viewFromImage(centre).toPoint());
        QVERIFY(session.selectedTrack());
        window->canvas().setFocus();
        QTest::keyClick(window.get(), Qt::Key_Escape);
        QVERIFY(!session.selectedTrack());
    }

    void theStagesOfWhatIsClickedAreShown() {
        const auto window = windowWithRun(40);
        QVERIFY(window);
        window->docks().raise(DockId::stages);
        window->session().goToFrame(30);
        QVERIFY(showsFrame(*window, 30));
        StagesPanel& stages = window->review().stages();
        QVERIFY(waitFor([&] { return !stages.explanation().isEmpty(); }));
        const FrameResult& result = *window->canvas().frame().result;
        QVERIFY(!result.clusters.empty());
        const OrientedBox& box = result.clusters.front().box;
        QTest::mouseClick(&window->canvas(), Qt::LeftButton, {},
                          window->canvas().transform().viewFromImage({box.centre.x, box.centre.y}).toPoint());
        QVERIFY(window->inspection().hasChoice());
        QVERIFY(waitFor([&] { return stages.explanation().isEmpty(); }));
        QStringList titles;
        for (const ChipCard& card : stages.grid().cards())
            for (const Chip& chip : card.chips) titles << chip.title;
        for (const char* title :
             {"Motion ROI", "Gradient", "Histogram", "Binary image", "Closing", "Components", "Kept"})
            QVERIFY2(titles.contains(QString::fromLatin1(title)), title);
        window->canvas().setFocus();
        QTest::keyClick(window.get(), Qt::Key_Escape);
        QVERIFY(!window->inspection().hasChoice());
        QVERIFY(!stages.explanation().isEmpty());
    }

    void withoutStackingTheDockOffersIt() {
        const auto window = windowWithRun(12);
        QVERIFY(window);
        window->docks().raise(DockId::stacks);
        StacksPanel& stacks = window->review().stacks();
        QVERIFY(waitFor([&] { return stacks.explanation().contains(QStringLiteral("no image stacking")); }));
        QSignalSpy finished(&window->session(), &ProjectSession::runFinished);
        for (auto* button : stacks.findChildren<QAbstractButton*>())
            if (button->isVisible() && button->text().contains(QStringLiteral("stacking"))) button->click();
        QVERIFY(finished.wait(kPatience_ms));
        QVERIFY(window->session().settings().options.stacking.enabled);
        QCOMPARE(window->session().runs().size(), std::size_t(2));
    }

    void stacksAreListedAndDrawnOverTheVideo() {
        ChainOptions chain;
        chain.stacking.enabled = true;
        chain.stacking.capacity = 12;
        chain.stacking.min_height = 5;
        const auto window = windowWithRun(40, chain);
        QVERIFY(window);
        window->session().goToFrame(30);
        QVERIFY(showsFrame(*window, 30));
        QTest::keyClick(window.get(), Qt::Key_S, Qt::AltModifier);
        QVERIFY(waitFor([&] { return !window->canvas().frame().stacks.empty(); }));
        QVERIFY(!window->canvas().frame().stacks.front().related.empty());
        window->docks().raise(DockId::stacks);
        StacksPanel& stacks = window->review().stacks();
        QVERIFY(waitFor([&] { return stacks.explanation().isEmpty(); }));
        QCOMPARE(stacks.grid().cards().size(), window->canvas().frame().stacks.size());
        QTest::mouseClick(stacks.grid().viewport(), Qt::LeftButton, {},
                          stacks.grid().pictureRect(0, 0).center().toPoint());
        QVERIFY(window->inspection().cluster());
    }

    void speedsAreCountedInRoundBins() {
        std::vector<double> speeds_px;
        for (int i = 0; i < 99; ++i) speeds_px.push_back(0.01 * i);
        speeds_px.push_back(50);  // a wild one
        const HistogramData data = speedHistogramOf(speeds_px, {});
        QVERIFY(data.value_label.contains(QStringLiteral("px/frame")));
        QCOMPARE(data.bin_width, 0.05);
        const auto& counts = data.series.front().counts;
        QVERIFY(counts.size() <= 26);
        double sum = 0;
        for (const double count : counts) sum += count;
        QCOMPARE(sum, 100.0);
        QCOMPARE(counts.back(), 1.0);
        QVERIFY(data.text().startsWith(QStringLiteral("speed (px/frame)\tmotion vectors\n0\t")));
        QVERIFY(speedHistogramOf({}, {}).series.front().counts.empty());
        const SceneScale metres{0.25, 25, true};
        QVERIFY(speedHistogramOf(speeds_px, metres).value_label.contains(QStringLiteral("km/h")));
    }

    void statisticsAreReadWhenTheyAreLookedAt() {
        const auto window = windowWithRun(30);
        QVERIFY(window);
        window->session().goToFrame(25);
        QVERIFY(showsFrame(*window, 25));
        MotionStatisticsPanel& statistics = window->review().statistics();
        QVERIFY(statistics.lives().data().series.empty());
        window->docks().raise(DockId::statistics);
        QVERIFY(waitFor([&] { return !statistics.lives().data().series.empty(); }));
        QCOMPARE(statistics.lives().data().series.size(), std::size_t(2));
        double shown = 0;
        for (const double count : statistics.speeds().data().series.front().counts) shown += count;
        const auto& vectors = window->canvas().frame().result->motion.motion_vectors;
        const auto of_corners =
            std::count_if(vectors.begin(), vectors.end(), [](const auto& vector) { return !vector.isInferred(); });
        QCOMPARE(shown, static_cast<double>(of_corners));
        double living = 0;  // all vectors of the frame live, though not all belong to a track
        for (const double count : statistics.lives().data().series.front().counts) living += count;
        QCOMPARE(living, shown);
        QVERIFY(statistics.speedTitle().contains(QStringLiteral("of frame 25")));
        window->session().goToFrame(0);  // no corner is old enough to move yet, and axes alone say nothing
        QVERIFY(showsFrame(*window, 0));
        QVERIFY(waitFor([&] { return statistics.speeds().isHidden() && statistics.lives().isHidden(); }));
        statistics.showWholeRun(true);
        QVERIFY(statistics.speedTitle().contains(QStringLiteral("of all frames")));
        QVERIFY(statistics.lifeTitle().contains(QStringLiteral("of the run")));
        double all = 0;
        for (const double count : statistics.speeds().data().series.front().counts) all += count;
        QVERIFY(all > shown);
    }

    void errorsStandInABarAndBlockNothing() {
        MainWindow window;
        window.show();
        StartOptions options;
        options.input = *home_ / "missing clip.mp4";
        window.start(options);
        QVERIFY(waitFor([&] { return !window.messages().texts().isEmpty(); }));
        QVERIFY(window.messages().texts().front().contains(QStringLiteral("missing clip.mp4")));
        QVERIFY(QApplication::activeModalWidget() == nullptr);
    }

    void aBrokenGsdIsRefusedWithAMessage() {
        const auto window = windowWithRun(12);
        QVERIFY(window);
        auto* field = window->findChild<QLineEdit*>(QStringLiteral("gsd"));
        QVERIFY(field);
        for (const char* broken : {"0", "-1", "nan", "abc", "1e9"}) {
            window->messages().dismissAll();
            field->setText(QString::fromLatin1(broken));
            field->setFocus();
            QTest::keyClick(field, Qt::Key_Return);
            QVERIFY2(!window->messages().texts().isEmpty(), broken);
            QCOMPARE(window->session().settings().gsd_m_per_px, 0.25);
        }
        window->messages().dismissAll();
        field->setText(QStringLiteral("80"));
        field->setFocus();
        QTest::keyClick(field, Qt::Key_Return);
        QVERIFY(window->messages().texts().front().contains(QStringLiteral("if 80 is in cm, give 0.8")));
        // One that can be used, but with which nothing can be found, is taken, and that is said.
        field->setText(QStringLiteral("9"));
        QTest::keyClick(field, Qt::Key_Return);
        QCOMPARE(window->session().settings().gsd_m_per_px, 9.0);
        QVERIFY(window->messages().texts().front().contains(QStringLiteral("at 9 m/px a car is 0.5 px long")));
        QCOMPARE(window->messages().texts().size(), 1);
        field->setFocus();
        field->setText(QString());
        QTest::keyClick(field, Qt::Key_Return);
        QVERIFY(window->messages().texts().isEmpty());
        QCOMPARE(window->session().settings().gsd_m_per_px, 0.0);
    }

    void typingInAFieldDoesNotSwitchOverlays() {
        const auto window = windowWithRun(12);
        QVERIFY(window);
        auto* field = window->findChild<QLineEdit*>(QStringLiteral("gsd"));
        field->setFocus();
        const bool before = window->overlays().isVisible(CornerLayer::kKind);
        QTest::keyClicks(field, QStringLiteral("c1f"));
        QCOMPARE(window->overlays().isVisible(CornerLayer::kKind), before);
        QVERIFY(field->text().contains(QStringLiteral("c1f")));
    }

    void aDroppedFileIsOpened() {
        const auto folder = test::writeScene(*home_ / "dropped", 5);
        MainWindow window;
        window.show();
        QMimeData data;
        data.setUrls({QUrl::fromLocalFile(QString::fromStdString(folder.string()))});
        QDragEnterEvent enter({50, 50}, Qt::CopyAction, &data, Qt::LeftButton, Qt::NoModifier);
        QApplication::sendEvent(&window, &enter);
        QVERIFY(enter.isAccepted());
        QDropEvent drop({50, 50}, Qt::CopyAction, &data, Qt::LeftButton, Qt::NoModifier);
        QApplication::sendEvent(&window, &drop);
        QVERIFY(waitFor([&] { return window.session().video().has_value(); }));
        QCOMPARE(window.session().video()->frame_count, 5);
    }

    void placeAndZoomAreRememberedPerProject() {
        {
            const auto window = windowWithRun(30);
            QVERIFY(window);
            window->session().goToFrame(21);
            window->canvas().restore(6, {100, 80});
            window->close();
            QVERIFY(waitFor([&] { return !window->isVisible(); }));  // it may wait for what is on its way into files
        }
        MainWindow window;
        window.show();
        StartOptions options;
        options.input = *home_ / "images";
        window.start(options);
        QVERIFY(waitFor([&] { return window.session().runData() && window.session().currentFrame() >= 21; }));
        window.session().playback().pause();
        QVERIFY(qAbs(window.canvas().transform().zoom() - 6) < 1e-6);
        QVERIFY(window.session().runs().size() == 1);  // a finished run is shown, not made anew
    }

    void closingDuringARunReturnsAtOnceAndKeepsTheFrames() {
        std::filesystem::path project;
        {
            MainWindow window;
            window.show();
            QSignalSpy ready(&window.session(), &ProjectSession::ready);
            window.session().openMedia(test::sceneUnderTest(100000, {}));
            QVERIFY(ready.wait(kPatience_ms));
            window.actions().run->trigger();
            QVERIFY(waitFor(
                [&] { return !window.session().runs().empty() && window.session().runs().back().frames_done >= 12; }));
            project = window.session().project();
            window.close();
            QVERIFY(test::answer(window, QStringLiteral("Stop the run")));
            // 100,000 frames would take an hour: closing at all shows that nobody waits for them.
            QVERIFY(waitFor([&] { return !window.isVisible(); }));
        }
        ProjectFile file = ProjectFile::open(project);
        const auto runs = RunStore(file).runs();
        QCOMPARE(runs.size(), std::size_t(1));
        QVERIFY(runs[0].frames_done >= 12);
        QVERIFY(RunStore(file).frameResult(runs[0].id, runs[0].frames_done - 1));
    }

    void stoppingShowsHowFarItCame() {
        MainWindow window;
        window.show();
        QSignalSpy ready(&window.session(), &ProjectSession::ready);
        window.session().openMedia(test::sceneUnderTest(100000, {}));
        QVERIFY(ready.wait(kPatience_ms));
        QSignalSpy finished(&window.session(), &ProjectSession::runFinished);
        window.actions().run->trigger();
        QVERIFY(waitFor(
            [&] { return !window.session().runs().empty() && window.session().runs().back().frames_done >= 5; }));
        QVERIFY(window.actions().stop->isEnabled());
        QVERIFY(!window.actions().run->isEnabled());
        window.actions().stop->trigger();
        QVERIFY(finished.wait(kPatience_ms));
        QVERIFY(waitFor([&] { return window.actions().run->isEnabled(); }));
        QVERIFY(waitFor([&] { return !window.messages().texts().isEmpty(); }));
    }
};

}  // namespace eyrie::ui::main_window_test

EYRIE_UI_TEST(QApplication, main_window_test, MainWindowTest)
#include "main_window_test.moc"
