#include <QApplication>
#include <QMenu>
#include <QTableView>
#include <QTest>
#include <QTimer>
#include <algorithm>
#include <cmath>

#include "canvas/video_view.h"
#include "correction/corrected_run.h"
#include "review/correct/track_correcting.h"
#include "review/events/event_review.h"
#include "review/events/event_thresholds.h"
#include "review/events/events_dock.h"
#include "review/events/events_panel.h"
#include "review/tracks/tracks_panel.h"
#include "support/replaced_tracks.h"
#include "ui/session/session_support.h"
#include "ui/support/ui_test.h"
#include "ui/window/window_with_run.h"
#include "widgets/message_bar.h"
#include "widgets/tables/table_roles.h"
#include "window/docks/review_docks.h"
#include "window/main_window.h"
#include "workspace/dock_registry.h"
#include "workspace/window_actions.h"

namespace eyrie::ui::correcting_window_test {

using test::kPatience_ms;

/// Tracks added, joined, split and rejected by hand, in the window.
class CorrectingWindowTest : public QObject {
    Q_OBJECT

    std::unique_ptr<test::OwnHome> home_;

    static std::unique_ptr<MainWindow> windowWithRun() {
        auto window = test::windowWithRun();
        return window && readyAgain(*window) ? std::move(window) : nullptr;
    }
    static bool readyAgain(MainWindow& window) {
        return QTest::qWaitFor(
            [&] {
                return window.events().review().state() == EventReview::State::found &&
                       window.events().review().tracks() && window.session().runData() &&
                       !window.session().runData()->tracks.empty();
            },
            kPatience_ms);
    }
    /// Confirmed tracks as the list has them.
    static std::vector<TrackSummary> tracks(MainWindow& window) {
        std::vector<TrackSummary> found;
        if (window.session().runData())
            for (const TrackSummary& track : window.session().runData()->tracks)
                if (track.confirmed && !track.doubtful) found.push_back(track);
        return found;
    }
    /// Waits until list and events are of so many tracks.
    static bool waitForTracks(MainWindow& window, std::size_t count) {
        return QTest::qWaitFor(
            [&] {
                const auto& stored = window.events().review().tracks();
                return tracks(window).size() == count && stored && stored->tracks.size() == count &&
                       window.actions().add_track->isEnabled();
            },
            kPatience_ms);
    }
    /// What the menu of the selected row offers.
    static QList<QAction*> menuOf(const TablePanel& panel) {
        QList<QAction*> offered;
        QTimer::singleShot(0, panel.table(), [&] {
            QWidget* popup = QApplication::activePopupWidget();
            if (const auto* menu = qobject_cast<QMenu*>(popup)) offered = menu->actions();
            if (popup != nullptr) popup->close();
        });
        emit panel.table()->customContextMenuRequested({});
        return offered;
    }
    static QString statusOf(MainWindow& window, TrackId track) {
        const QAbstractItemModel* shown = window.review().tracks().table()->model();
        for (int row = 0; row < shown->rowCount(); ++row)
            if (shown->index(row, 0).data(id_role).toInt() == track)
                return shown->index(row, TracksModel::status_column).data().toString();
        return QStringLiteral("not listed");
    }
    static bool tells(MainWindow& window, const QString& words) {
        return QTest::qWaitFor(
            [&] {
                const QStringList texts = window.messages().texts();
                return std::any_of(texts.begin(), texts.end(),
                                   [&](const QString& text) { return text.contains(words); });
            },
            kPatience_ms);
    }
    static bool goTo(MainWindow& window, FrameIndex frame) {
        window.session().goToFrame(frame);
        if (!test::shows(window.session(), frame)) return false;
        window.canvas().setFocus();
        return true;
    }
    static void drag(MainWindow& window, const OrientedBox& around) {
        const OrientedBox box = around.upright();
        const auto at = [&](double side) {
            return window.canvas()
                .transform()
                .viewFromImage({box.centre.x + side * box.length / 2, box.centre.y + side * box.width / 2})
                .toPoint();
        };
        QTest::mousePress(&window.canvas(), Qt::LeftButton, {}, at(-1));
        QTest::mouseMove(&window.canvas(), at(0));
        QTest::mouseMove(&window.canvas(), at(1));
        QTest::mouseRelease(&window.canvas(), Qt::LeftButton, {}, at(1));
    }
    static TrackSummary longest(MainWindow& window) {
        const std::vector<TrackSummary> all = tracks(window);
        return *std::max_element(all.begin(), all.end(),
                                 [](const TrackSummary& a, const TrackSummary& b) { return a.frames < b.frames; });
    }
    /// The run loses a track, as if it had missed the vehicle; answers where it was.
    static std::vector<TrackFrame> loseTrack(const std::filesystem::path& project, TrackId track) {
        ProjectFile file = ProjectFile::open(project);
        RunStore store(file);
        const int run = store.runs().back().id;
        std::vector<TrackFrame> lost = store.trackStates(run, track);
        std::vector<TrackFrame> kept;
        store.visitTrackStates(run, [&](FrameIndex frame, const TrackState& state) {
            if (state.id != track) kept.push_back({frame, state});
        });
        eyrie::test::replaceTrackStates(store, run, kept);
        return lost;
    }

 private slots:
    void init() { home_ = std::make_unique<test::OwnHome>(); }
    void cleanup() { home_.reset(); }

    void aVehicleThatWasMissedIsAddedByABoxAndFollowedBothWays() {
        std::vector<TrackFrame> lost;
        std::size_t all = 0;
        {
            const auto window = windowWithRun();
            QVERIFY(window);
            all = tracks(*window).size();
            const TrackId track = longest(*window).id;
            const auto project = window->session().project();
            window->session().closeProject();
            lost = loseTrack(project, track);
        }
        QVERIFY(lost.size() > 20);
        const TrackFrame& middle = lost[lost.size() / 2];
        TrackId added = 0;
        {
            const auto window = windowWithRun();
            QVERIFY(window);
            QVERIFY(waitForTracks(*window, all - 1));
            QVERIFY(goTo(*window, middle.frame));
            QTest::keyClick(&window->canvas(), Qt::Key_Insert);
            QVERIFY(window->actions().add_track->isChecked());
            QTest::keyClick(&window->canvas(), Qt::Key_Escape);
            QVERIFY2(!window->actions().add_track->isChecked(), "Escape gives up");
            QTest::keyClick(&window->canvas(), Qt::Key_Insert);
            drag(*window, middle.state.box);
            QVERIFY2(waitForTracks(*window, all), qPrintable(window->messages().texts().join(QLatin1Char('\n'))));
            QVERIFY(tells(*window, QStringLiteral("Added track")));
            QVERIFY(window->session().selectedTrack());
            added = *window->session().selectedTrack();
            const auto summary = window->session().trackSummary(added);
            QVERIFY(summary != nullptr);
            QCOMPARE(statusOf(*window, added), tr("by hand"));
            QVERIFY2(summary->first_frame <= lost.front().frame + 5 && summary->last_frame >= lost.back().frame - 5,
                     qPrintable(QStringLiteral("%1 to %2 of %3 to %4")
                                    .arg(summary->first_frame)
                                    .arg(summary->last_frame)
                                    .arg(lost.front().frame)
                                    .arg(lost.back().frame)));
            const auto& corrections = window->events().review().tracks()->corrections;
            int near = 0;
            for (const TrackFrame& each : corrections.track(added)->states)
                for (const TrackFrame& was : lost)
                    near += was.frame == each.frame && overlap(was.state.box, each.state.box) > 0.3 ? 1 : 0;
            QVERIFY2(near > static_cast<int>(lost.size()) * 3 / 4, qPrintable(QString::number(near)));
            const auto in_picture = [&] {
                const auto& result = window->session().viewFrame().result;
                return result && std::any_of(result->tracks.begin(), result->tracks.end(),
                                             [&](const TrackState& state) { return state.id == added; });
            };
            QVERIFY(QTest::qWaitFor(in_picture, kPatience_ms));
            EventThresholds& limits = window->events().panel().thresholds();
            limits.setValue(QStringLiteral("events.over"), QStringLiteral("5"));
            limits.setValue(QStringLiteral("events.over_time"), QStringLiteral("0.2"));
            const auto has_event = [&] {
                const auto& found = window->events().review().found();
                return found && std::any_of(found->events.begin(), found->events.end(), [&](const Event& event) {
                           return std::count(event.tracks.begin(), event.tracks.end(), added) > 0;
                       });
            };
            QVERIFY2(QTest::qWaitFor(has_event, kPatience_ms), "events are computed over it");
            // Again, it is there.
            QTest::keyClick(&window->canvas(), Qt::Key_Insert);
            drag(*window, middle.state.box);
            QVERIFY(tells(*window, tr("Track %1 already follows this vehicle.").arg(added)));
            // Taken back, and brought back.
            QTest::keyClick(&window->canvas(), Qt::Key_Z);
            QVERIFY(waitForTracks(*window, all - 1));
            QTest::keyClick(&window->canvas(), Qt::Key_Z, Qt::ControlModifier | Qt::ShiftModifier);
            QVERIFY(waitForTracks(*window, all));
            window->session().selectTrack(added);
            QTest::keyClick(&window->canvas(), Qt::Key_Insert, Qt::ShiftModifier);
            QVERIFY(waitForTracks(*window, all - 1));
            QTest::keyClick(&window->canvas(), Qt::Key_Z);
            QVERIFY(waitForTracks(*window, all));
        }
        const auto window = windowWithRun();
        QVERIFY(window);
        QVERIFY2(waitForTracks(*window, all), "it is there the next day");
        QCOMPARE(statusOf(*window, added), tr("by hand"));
        // Engineers see what the run found.
        QTest::keyClick(window.get(), Qt::Key_3, Qt::ControlModifier);
        QVERIFY(QTest::qWaitFor([&] { return tracks(*window).size() == all - 1; }, kPatience_ms));
        QTest::keyClick(window.get(), Qt::Key_1, Qt::ControlModifier);
        QVERIFY(waitForTracks(*window, all));
        // A run that finds the vehicle itself shows its own.
        QVERIFY(test::runAndWait(window->session()));
        QVERIFY(waitForTracks(*window, all));
        const auto& states = window->events().review().tracks()->corrections.states;
        QCOMPARE(states.size(), std::size_t(1));
        QCOMPARE(states.begin()->second, CorrectionState::covered);
        for (const TrackSummary& track : tracks(*window)) QVERIFY(!track.corrected);
    }

    void theWindowStaysUntilAVehicleThatIsFollowedIsKept() {
        const auto window = windowWithRun();
        QVERIFY(window);
        const TrackSummary track = longest(*window);
        const FrameIndex middle = (track.first_frame + track.last_frame) / 2;
        QVERIFY(goTo(*window, middle));
        QTest::keyClick(&window->canvas(), Qt::Key_Insert);
        drag(*window, {{12, 12}, 16, 10, 0});  // nothing is there
        QVERIFY(window->events().correcting().working());
        window->close();
        QVERIFY(window->isVisible());
        QVERIFY(QTest::qWaitFor([&] { return !window->isVisible(); }, kPatience_ms));
        QVERIFY(!window->events().correcting().working());
    }

    void whileAVehicleIsFollowedItIsSaidHowLongItMayStillTake() {
        QCOMPARE(TrackCorrecting::followingText({212, false, 30, 90}, 4.2),
                 tr("Following the vehicle forwards: frame 212, at most 0:05 left."));
        QCOMPARE(TrackCorrecting::followingText({97, true, 300, 97}, 61),
                 tr("Following the vehicle backwards: frame 97, at most 1:01 left."));
    }

    void aTrackIsSplitAndJoinedAndANewRunCarriesItOver() {
        const auto window = windowWithRun();
        QVERIFY(window);
        const std::size_t all = tracks(*window).size();
        const TrackSummary whole = longest(*window);
        QVERIFY2(!window->actions().split_track->isEnabled(), "nothing is selected");
        window->session().selectTrack(whole.id);
        const FrameIndex cut = (whole.first_frame + whole.last_frame) / 2;
        QVERIFY(goTo(*window, whole.first_frame));
        QVERIFY(window->actions().split_track->isEnabled());
        const WindowActions& commands = window->actions();
        QCOMPARE(
            menuOf(window->review().tracks()).last(7),
            QList<QAction*>({commands.follow_object, commands.like_track, commands.join_tracks, commands.split_track,
                             commands.reject_tracks, commands.remove_correction, commands.clip_track}));
        window->activateWindow();
        QVERIFY(QTest::qWaitForWindowActive(window.get()));
        QTest::keyClick(&window->canvas(), Qt::Key_Y, Qt::ShiftModifier);
        QVERIFY(tells(*window, QStringLiteral("between its first and its last frame")));
        QVERIFY(waitForTracks(*window, all));
        QVERIFY(goTo(*window, cut));
        QTest::keyClick(&window->canvas(), Qt::Key_Y, Qt::ShiftModifier);
        QVERIFY2(waitForTracks(*window, all + 1), qPrintable(window->messages().texts().join(QLatin1Char('\n'))));
        const TrackId later = *window->session().selectedTrack();
        QVERIFY(later != whole.id);
        QCOMPARE(statusOf(*window, whole.id), tr("split"));
        QCOMPARE(window->session().trackSummary(whole.id)->last_frame, cut - 1);
        QCOMPARE(window->session().trackSummary(later)->first_frame, cut);

        // Joined again, from the list.
        QTest::keyClick(&window->canvas(), Qt::Key_J, Qt::ShiftModifier);
        QVERIFY(window->actions().join_tracks->isChecked());
        QTest::keyClick(&window->canvas(), Qt::Key_Escape);
        QVERIFY(!window->actions().join_tracks->isChecked());
        window->session().selectTrack(later);
        QTest::keyClick(&window->canvas(), Qt::Key_J, Qt::ShiftModifier);
        window->session().goToTrack(whole.id);
        QVERIFY2(waitForTracks(*window, all), qPrintable(window->messages().texts().join(QLatin1Char('\n'))));
        QCOMPARE(statusOf(*window, whole.id), tr("joined"));
        QCOMPARE(window->session().trackSummary(whole.id)->frames, whole.frames);
        QTest::keyClick(&window->canvas(), Qt::Key_Z);
        QVERIFY(waitForTracks(*window, all + 1));

        // Another run has other numbers, and the split is there.
        QVERIFY(test::runAndWait(window->session()));
        QVERIFY(waitForTracks(*window, all + 1));
        const auto& corrections = window->events().review().tracks()->corrections;
        QCOMPARE(corrections.states.begin()->second, CorrectionState::applied);
        QCOMPARE(corrections.tracks.begin()->second.states.back().frame, cut - 1);
        // What was found is never changed.
        ProjectFile file = ProjectFile::open(window->session().project(), ProjectFile::Mode::read_only);
        QCOMPARE(RunStore(file).tracks(RunStore(file).runs().front().id).size(), all);
        QTest::keyClick(&window->canvas(), Qt::Key_Z);
        QVERIFY(waitForTracks(*window, all));
    }

    void severalTracksAreRejectedAtOnceAndTakenBack() {
        std::size_t all = 0;
        std::vector<TrackId> two;
        {
            const auto window = windowWithRun();
            QVERIFY(window);
            all = tracks(*window).size();
            QVERIFY(all >= 2);
            const WindowActions& commands = window->actions();
            QVERIFY2(!commands.reject_tracks->isEnabled(), "nothing is selected");
            TracksPanel& list = window->review().tracks();
            const QAbstractItemModel* shown = list.table()->model();
            QCOMPARE(shown->rowCount(), static_cast<int>(all));
            const auto chooseFirstTwo = [&] {
                window->session().selectTrack(std::nullopt);
                window->session().selectTrack(shown->index(0, 0).data(id_role).toInt());
                list.table()->selectionModel()->select(shown->index(1, 0),
                                                       QItemSelectionModel::Select | QItemSelectionModel::Rows);
                return list.selectedIds();
            };
            window->docks().raise(DockId::events);
            QCOMPARE(chooseFirstTwo().size(), 2);
            QTest::keyClick(&window->canvas(), Qt::Key_Backspace);
            QVERIFY2(waitForTracks(*window, all - 1), "nobody sees the list: the selected track is meant alone");
            QVERIFY(tells(*window, tr("is rejected")));
            QTest::keyClick(&window->canvas(), Qt::Key_Z);
            QVERIFY(waitForTracks(*window, all));
            for (const QString& text : window->messages().texts())
                QVERIFY2(!text.contains(tr("is rejected")), "what was undone is told no longer");
            window->docks().raise(DockId::tracks);
            const QList<int> chosen = chooseFirstTwo();
            QCOMPARE(chosen.size(), 2);
            two.assign(chosen.begin(), chosen.end());
            QVERIFY(commands.reject_tracks->isEnabled());
            QTest::keyClick(&window->canvas(), Qt::Key_Backspace);
            QVERIFY2(waitForTracks(*window, all - 2), qPrintable(window->messages().texts().join(QLatin1Char('\n'))));
            QVERIFY(tells(*window, tr("2 tracks are rejected")));
            // They are listed still, and drawn no more.
            QCOMPARE(shown->rowCount(), static_cast<int>(all));
            for (const TrackId id : two) QCOMPARE(statusOf(*window, id), tr("rejected"));
            QVERIFY(list.countText().endsWith(tr("%1, %2 rejected").arg(QString()).arg(2)));
            const TrackSummary* summary = window->session().trackSummary(two[0]);
            QVERIFY(summary != nullptr);
            QVERIFY(goTo(*window, summary->first_frame));
            const auto is_drawn = [&] {
                const auto& result = window->session().viewFrame().result;
                return !result || std::any_of(result->tracks.begin(), result->tracks.end(),
                                              [&](const TrackState& state) { return state.id == two[0]; });
            };
            QVERIFY(QTest::qWaitFor([&] { return !is_drawn(); }, kPatience_ms));
            for (const auto& [id, correction] : window->events().review().corrections()) {
                QCOMPARE(correction.kind, CorrectionKind::reject);
                QVERIFY(!correction.when_utc.empty());
            }
            // One step, undone and done again.
            QTest::keyClick(&window->canvas(), Qt::Key_Z);
            QVERIFY(waitForTracks(*window, all));
            QTest::keyClick(&window->canvas(), Qt::Key_Z, Qt::ControlModifier | Qt::ShiftModifier);
            QVERIFY(waitForTracks(*window, all - 2));
            // One of them is taken back from the list, where it can be neither rejected again nor split.
            window->session().selectTrack(two[1]);
            QVERIFY(!commands.reject_tracks->isEnabled());
            QVERIFY(!commands.split_track->isEnabled());
            QVERIFY(!commands.join_tracks->isEnabled());
            QVERIFY(commands.remove_correction->isEnabled());
            commands.remove_correction->trigger();
            QVERIFY(waitForTracks(*window, all - 1));
            QVERIFY(tells(*window, tr("Track %1 is no longer %2.").arg(two[1]).arg(QStringLiteral("rejected"))));
            QCOMPARE(statusOf(*window, two[1]), tr("confirmed"));
            QTest::keyClick(&window->canvas(), Qt::Key_Z);
            QVERIFY(waitForTracks(*window, all - 2));
            // Both at once; others that nobody corrected do not matter.
            chooseFirstTwo();
            list.table()->selectAll();
            QVERIFY(commands.remove_correction->isEnabled());
            commands.remove_correction->trigger();
            QVERIFY(waitForTracks(*window, all));
            QVERIFY(tells(*window, tr("2 corrections were taken back")));
            QTest::keyClick(&window->canvas(), Qt::Key_Z);
            QVERIFY(waitForTracks(*window, all - 2));
        }
        const auto window = windowWithRun();
        QVERIFY(window);
        QVERIFY2(waitForTracks(*window, all - 2), "they are rejected the next day");
        for (const TrackId id : two) QCOMPARE(statusOf(*window, id), tr("rejected"));
        QVERIFY(test::runAndWait(window->session()));
        QVERIFY2(waitForTracks(*window, all - 2), "and in another run");
        // Engineers see what the run found.
        QTest::keyClick(window.get(), Qt::Key_3, Qt::ControlModifier);
        QVERIFY(QTest::qWaitFor([&] { return tracks(*window).size() == all; }, kPatience_ms));
    }

    void whatIsCorrectedWhileAnotherRunIsChosenIsGivenUpWithAWord() {
        const auto window = windowWithRun();
        QVERIFY(window);
        ProjectSession& session = window->session();
        const int first = *session.currentRun();
        QVERIFY(test::runAndWait(session));
        const auto second_is_read = [&] {
            return session.currentRun() != first && session.runData() &&
                   session.runData()->record.id == session.currentRun();
        };
        QVERIFY(QTest::qWaitFor(second_is_read, kPatience_ms));
        QVERIFY(readyAgain(*window));
        const TrackSummary track = longest(*window);
        QVERIFY(goTo(*window, (track.first_frame + track.last_frame) / 2));
        session.selectTrack(track.id);
        QVERIFY(QTest::qWaitFor([&] { return window->actions().split_track->isEnabled(); }, kPatience_ms));
        window->actions().split_track->trigger();
        QVERIFY(window->events().correcting().working());
        session.showRun(first);
        QVERIFY(tells(*window, QStringLiteral("given up: another run is shown now")));
        QVERIFY(window->events().review().corrections().empty());
    }

    void tracksOfTwoVehiclesAreNotJoined() {
        const auto window = windowWithRun();
        QVERIFY(window);
        const std::vector<TrackSummary> all = tracks(*window);
        for (const TrackSummary& one : all)
            for (const TrackSummary& other : all) {
                if (one.id >= other.id || one.first_frame > other.last_frame || other.first_frame > one.last_frame)
                    continue;
                window->session().selectTrack(one.id);
                QTest::keyClick(&window->canvas(), Qt::Key_J, Qt::ShiftModifier);
                window->session().selectTrack(other.id);
                QVERIFY(tells(*window, QStringLiteral("in different places at the same time")));
                QCOMPARE(tracks(*window).size(), all.size());
                return;
            }
        QFAIL("the scene has two vehicles at one time");
    }

    void whereNothingCanBeFollowedNothingIsAdded() {
        const auto window = windowWithRun();
        QVERIFY(window);
        const std::size_t all = tracks(*window).size();
        QVERIFY(goTo(*window, 30));
        QTest::keyClick(&window->canvas(), Qt::Key_Insert);
        // A click is no box; labelling ends what was begun.
        const QPoint place = window->canvas().transform().viewFromImage({20, 20}).toPoint();
        QTest::mouseClick(&window->canvas(), Qt::LeftButton, {}, place);
        QVERIFY(window->actions().add_track->isChecked());
        QTest::keyClick(window.get(), Qt::Key_2, Qt::ControlModifier);
        QVERIFY(!window->actions().add_track->isChecked());
        QVERIFY(!window->actions().add_track->isEnabled());
        QTest::keyClick(window.get(), Qt::Key_1, Qt::ControlModifier);
        QVERIFY(waitForTracks(*window, all));
    }
};

}  // namespace eyrie::ui::correcting_window_test

EYRIE_UI_TEST(QApplication, correcting_window_test, CorrectingWindowTest)
#include "correcting_window_test.moc"
