#include <QScopeGuard>
#include <QSignalSpy>
#include <QStatusBar>
#include <QTest>
#include <atomic>

#include "canvas/video_view.h"
#include "core/error.h"
#include "review/card/card_dock.h"
#include "review/inspector/inspector_panel.h"
#include "review/mosaic/mosaic_panel.h"
#include "review/watch/watched_ground.h"
#include "store/runs/result_writer.h"
#include "ui/session/session_support.h"
#include "ui/support/ui_test.h"
#include "widgets/message_bar.h"
#include "window/docks/watching_docks.h"
#include "window/main_window.h"
#include "workspace/dock_registry.h"
#include "workspace/window_actions.h"
#include "workspace/workspaces.h"

namespace eyrie::ui::watch_states_test {

using test::kPatience_ms;

/// What a person who watches is told where something is not there: while a run works, of what it did not keep or left
/// out, of a video that cannot be read.
class WatchStatesTest : public QObject {
    Q_OBJECT

    std::unique_ptr<test::OwnHome> home_;

    static std::unique_ptr<MainWindow> windowWith(const Media& media) {
        auto window = std::make_unique<MainWindow>();
        window->resize(1280, 720);
        window->show();
        if (!QTest::qWaitForWindowActive(window.get())) return nullptr;
        return test::openAndWait(window->session(), media) ? std::move(window) : nullptr;
    }
    /// A run of five frames with seven motion vectors and track 1 in each.
    std::unique_ptr<MainWindow> windowWithRun(
        const SceneScale& scale, const std::vector<std::pair<std::string, std::string>>& parameters) const {
        const auto images = test::writeScene(*home_ / "images", 5);
        const auto project = *home_ / (parameters.empty() ? "plain.eyrie" : parameters.front().second + ".eyrie");
        ProjectFile::openOrCreate(project);
        RunRecord run;
        run.sequence = {.path = images.string(), .size = {240, 180}, .frame_count = 5, .frame_rate_hz = 25};
        run.last_frame = 4;
        run.scale = scale;
        ResultWriter writer(project, run, parameters);
        for (int frame = 0; frame < 5; ++frame) {
            FrameResult result;
            result.motion.frame = frame;
            result.motion.image_size = {240, 180};
            result.motion.motion_vectors.resize(7);
            TrackState state;
            state.id = 1;
            state.box = {{40.0 + 3 * frame, 55}, 22, 11, 0};
            state.status = TrackStatus::confirmed;
            result.tracks.push_back(state);
            writer.write(result);
        }
        writer.finish(RunState::finished, "");
        auto window = std::make_unique<MainWindow>();
        window->resize(1280, 720);
        window->show();
        QSignalSpy ready(&window->session(), &ProjectSession::ready);
        window->session().open(project);
        const bool shown = ready.wait(kPatience_ms) &&
                           QTest::qWaitFor([&] { return window->session().runData() != nullptr; }, kPatience_ms);
        return shown ? std::move(window) : nullptr;
    }
    static bool tells(MainWindow& window, const QString& words) {
        const QStringList texts = window.messages().texts();
        return std::any_of(texts.begin(), texts.end(), [&](const QString& text) { return text.contains(words); });
    }
    static bool saysInInspector(MainWindow& window, const QString& words) {
        const auto* inspector = window.findChild<InspectorPanel*>();
        return inspector != nullptr && test::says(*inspector, words);
    }

 private slots:
    void init() { home_ = std::make_unique<test::OwnHome>(); }
    void cleanup() { home_.reset(); }

    void whyAllIsPlayedIsToldWhileARunWorks() {
        test::Door door;
        const auto window = windowWith(test::sceneUnderTest(40, [&](FrameIndex frame) { door.pass(frame); }));
        QVERIFY(window);
        window->actions().only_moving->trigger();
        QVERIFY(tells(*window, QStringLiteral("known once a run has finished")));
        window->actions().only_moving->trigger();
        door.closeFrom(20);
        QSignalSpy finished(&window->session(), &ProjectSession::runFinished);
        window->session().startRun();
        QTRY_VERIFY_WITH_TIMEOUT(door.reached() >= 20, kPatience_ms);
        window->actions().only_moving->trigger();
        QVERIFY(tells(*window, QStringLiteral("The run is still running")));
        QVERIFY(!window->session().playback().spans());
        door.open();
        QVERIFY(finished.wait(kPatience_ms));
        QTRY_VERIFY_WITH_TIMEOUT(window->session().playback().spans().has_value(), kPatience_ms);
        QVERIFY(!tells(*window, QStringLiteral("The run is still running")));
    }

    void theGroundIsKnownInAWindowThatBeginsWithTuning() {
        {
            MainWindow before;
            before.show();
            before.workspaces().open(WorkspaceKind::tune);
            before.close();
        }
        const auto window = windowWith(test::sceneUnderTest(30));
        QVERIFY(window);
        QVERIFY(window->workspaces().current() == WorkspaceKind::tune);
        QVERIFY(test::runAndWait(window->session()));
        QTRY_VERIFY_WITH_TIMEOUT(window->watching().ground().ground() != nullptr, kPatience_ms);
        QVERIFY(window->actions().steady->isEnabled());
    }

    void whatARunDidNotKeepIsNotCalledNothing() {
        const auto window = windowWithRun({}, {{"recording.details", "none"}});
        QVERIFY(window);
        window->session().goToFrame(3);
        QVERIFY(test::shows(window->session(), 3));
        QVERIFY(!window->session().detailsKept(3));
        QVERIFY(saysInInspector(*window, QStringLiteral("not kept (recording.details)")));
        QVERIFY(saysInInspector(*window, QStringLiteral("7")));  // motion vectors are counted all the same
        window->session().selectTrack(1);
        QTRY_VERIFY_WITH_TIMEOUT(saysInInspector(*window, QStringLiteral("not kept (recording.details)")),
                                 kPatience_ms);
        QVERIFY(!saysInInspector(*window, QStringLiteral("none here")));
        const auto keeping = windowWithRun({}, {{"recording.details", "all"}});
        QVERIFY(keeping);
        QVERIFY(keeping->session().detailsKept(3));
        keeping->session().selectTrack(1);
        QTRY_VERIFY_WITH_TIMEOUT(saysInInspector(*keeping, QStringLiteral("none here")), kPatience_ms);
    }

    void aTrackThatTheRunLeftOutIsFollowedAndItsCardSaysSo() {
        const auto window = windowWith(test::sceneUnderTest(40));
        QVERIFY(window);
        window->session().settings().options.finishing.min_score = 1;
        QVERIFY(test::runAndWait(window->session()));
        QTRY_VERIFY_WITH_TIMEOUT(window->watching().ground().ground() != nullptr, kPatience_ms);
        window->session().goToFrame(20);
        QVERIFY(test::shows(window->session(), 20));
        QTRY_VERIFY_WITH_TIMEOUT(!window->session().viewFrame().doubtful.empty(), kPatience_ms);
        const TrackState left_out = window->session().viewFrame().doubtful.front();
        QVERIFY(stateOf(window->session().viewFrame(), left_out.id) != nullptr);
        window->session().selectTrack(left_out.id);
        QVERIFY(window->watching().card().card().subject().has_value());
        QVERIFY(window->watching().card().card().subject()->title.contains(QStringLiteral("left out of the result")));
        window->actions().follow_object->trigger();
        const QPointF at = window->canvas().transform().viewFromImage({left_out.box.centre.x, left_out.box.centre.y});
        QVERIFY(QLineF(at, QRectF(window->canvas().rect()).center()).length() < 2);
    }

    void theCardReadsItsPicturesOnceTheFrameGoneToIsShown() {
        test::Door door;
        std::atomic<int> opened = 0, read_by_others = 0;
        Media media = test::sceneUnderTest(40);
        media.open = [&](const IndexProgress&, std::stop_token) {
            const bool is_shown = opened++ == 0;
            return std::make_unique<test::SceneSource>(40, [&door, &read_by_others, is_shown](FrameIndex frame) {
                if (is_shown)
                    door.pass(frame);
                else
                    ++read_by_others;
            });
        };
        const auto window = windowWith(media);
        QVERIFY(window);
        QVERIFY(test::runAndWait(window->session()));
        QTRY_VERIFY_WITH_TIMEOUT(window->watching().ground().ground() != nullptr, kPatience_ms);
        QVERIFY(!window->session().runData()->tracks.empty());
        window->docks().raise(DockId::card);
        EventCard& card = window->watching().card().card();
        window->session().goToFrame(2);
        QVERIFY(test::shows(window->session(), 2));
        const auto at_last = qScopeGuard([&door] { door.open(); });  // whoever waits there holds up the rest
        door.closeFrom(20);
        const int before = read_by_others;
        window->session().selectTrack(window->session().runData()->tracks.front().id);
        window->session().goToFrame(30);
        QTRY_VERIFY_WITH_TIMEOUT(door.reached() >= 20, kPatience_ms);
        QTest::qWait(100);
        QCOMPARE(read_by_others.load(), before);
        door.open();
        QTRY_VERIFY_WITH_TIMEOUT(card.story() && !card.story()->chips.empty(), kPatience_ms);
        QCOMPARE(window->session().shownFrame(), 30);
        QVERIFY(read_by_others > before);
    }

    void whyTheGroundIsNotLaidOutIsToldAndItIsTriedAgain() {
        const auto broken = std::make_shared<std::atomic<bool>>(false);
        const auto window = windowWith(test::sceneUnderTest(60, [broken](FrameIndex frame) {
            if (*broken && frame > 30) throw Error(ErrorKind::input, "the video ends in a scratch");
        }));
        QVERIFY(window);
        QVERIFY(test::runAndWait(window->session()));
        QTRY_VERIFY_WITH_TIMEOUT(window->watching().ground().ground() != nullptr, kPatience_ms);
        *broken = true;
        window->actions().show_mosaic->trigger();
        MosaicPanel& panel = window->watching().mosaic();
        QTRY_VERIFY_WITH_TIMEOUT(test::says(panel, QStringLiteral("could not be laid out: the video ends")),
                                 kPatience_ms);
        *broken = false;
        panel.setLookedAt(false);
        panel.setLookedAt(true);
        QTRY_VERIFY_WITH_TIMEOUT(panel.mosaic() && panel.mosaic()->share == 1, kPatience_ms);
        QVERIFY(!test::says(panel, QStringLiteral("could not be laid out")));
    }

    void inAnObliqueViewTheStatusBarTellsTheScaleOfThePlace() {
        const auto window = windowWithRun({0.2, 25, true, ScaleSlope::ofPicture({240, 180}, 0, 0.01)}, {});
        QVERIFY(window);
        // 50 px below the middle: 0.2 / 1.5.
        emit window->canvas().cursorMoved(QPointF(100, 139.5));
        QVERIFY(test::says(*window->statusBar(), QStringLiteral("0.133 m/px here")));
    }
};

}  // namespace eyrie::ui::watch_states_test

EYRIE_UI_TEST(QApplication, watch_states_test, WatchStatesTest)
#include "watch_states_test.moc"
