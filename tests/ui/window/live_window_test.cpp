#include <QAction>
#include <QLayout>
#include <QLineEdit>
#include <QPushButton>
#include <QSignalSpy>
#include <QSpinBox>
#include <QTest>

#include "review/events/event_review.h"
#include "review/events/event_thresholds.h"
#include "review/events/events_dock.h"
#include "review/events/events_panel.h"
#include "store/project/project_file.h"
#include "store/review/review_store.h"
#include "ui/session/session_support.h"
#include "ui/support/live_film.h"
#include "ui/support/ui_test.h"
#include "widgets/elided_label.h"
#include "widgets/message_bar.h"
#include "widgets/wiring.h"
#include "window/live/live_dialog.h"
#include "window/live/live_strip.h"
#include "window/live/live_text.h"
#include "window/live/live_watching.h"
#include "window/main_window.h"
#include "window/start_options.h"
#include "workspace/dock_registry.h"
#include "workspace/window_actions.h"

namespace eyrie::ui::live_window_test {

using eyrie::test::LiveSender;
using test::answer;
using test::kPatience_ms;
using test::press;
using test::says;

/// A live source through the window: what is asked, what is said, and that nothing is lost.
class LiveWindowTest : public QObject {
    Q_OBJECT

    std::unique_ptr<test::OwnHome> home_;

    static bool waitFor(const std::function<bool()>& condition) { return QTest::qWaitFor(condition, kPatience_ms); }
    static void type(LiveDialog& dialog, const QString& field, const QString& text) {
        auto* edit = dialog.findChild<QLineEdit*>(field);
        edit->setText(text);
        emit edit->textEdited(text);
    }
    static LiveDialog* askIn(MainWindow& window) {
        window.resize(1280, 720);
        window.show();
        window.session().settings().options.view.oblique = false;
        window.actions().watch_live->trigger();
        return window.live().dialog();
    }
    /// Fills the dialog for a source and waits until something of it is shown.
    bool watches(MainWindow& window, const test::LiveSource& source) {
        LiveDialog* dialog = askIn(window);
        if (dialog == nullptr) return false;
        type(*dialog, QStringLiteral("live_address"), QString::fromStdString(source.request.address));
        type(*dialog, QStringLiteral("live_project"), QString::fromStdString(source.request.project.string()));
        type(*dialog, QStringLiteral("live_gsd"), QStringLiteral("0.25"));
        dialog->findChild<QSpinBox*>(QStringLiteral("live_give_up"))->setValue(5);
        return press(*dialog, QStringLiteral("Watch")) && waitFor([&] {
                   return window.live().dialog() == nullptr && window.session().video() &&
                          window.session().video()->frame_count >= 15;
               });
    }

 private slots:
    void init() { home_ = std::make_unique<test::OwnHome>(); }
    void cleanup() { home_.reset(); }

    void theDialogTellsWhatIsWrongWithAnAddress() {
        MainWindow window;
        LiveDialog* dialog = askIn(window);
        QVERIFY(dialog != nullptr);
        const auto can_watch = [&] {
            for (const auto* button : dialog->findChildren<QPushButton*>())
                if (button->text() == QStringLiteral("Watch")) return button->isEnabled();
            return false;
        };
        type(*dialog, QStringLiteral("live_address"), QString());
        QVERIFY(!can_watch());
        for (const auto& [address, fault] :
             std::map<QString, QString>{{QStringLiteral("clip.mp4"), QStringLiteral("rtsp://clip.mp4")},
                                        {QStringLiteral("/films/clip.mp4"), QStringLiteral("Open video")},
                                        {QStringLiteral("/dev/null"), QStringLiteral("no camera")},
                                        {QStringLiteral("foo://camera"), QStringLiteral("is not known")},
                                        {QStringLiteral("udp://239.0.0.1"), QStringLiteral("port is missing")}}) {
            type(*dialog, QStringLiteral("live_address"), address);
            QVERIFY2(says(*dialog, fault), qPrintable(address));
            QVERIFY2(!can_watch(), qPrintable(address));
        }
        for (const auto& address : {QStringLiteral("rtsp://camera/stream"), QStringLiteral("/dev/video0")}) {
            type(*dialog, QStringLiteral("live_address"), address);
            QVERIFY2(can_watch(), qPrintable(address));
        }
    }

    void theScaleGivenAtTheStartStandsInTheDialog() {
        MainWindow window;
        window.show();
        StartOptions options;
        options.input = "udp://127.0.0.1:5000";
        options.gsd_m_per_px = 0.2;
        window.start(options);
        QVERIFY(window.live().dialog() != nullptr);
        const auto* gsd = window.live().dialog()->findChild<QLineEdit*>(QStringLiteral("live_gsd"));
        QCOMPARE(gsd->text(), QStringLiteral("0.2"));
    }

    void aCameraThatIsNotThereIsToldWhereItWasTyped() {
        MainWindow window;
        LiveDialog* dialog = askIn(window);
        type(*dialog, QStringLiteral("live_address"), QStringLiteral("camera:/dev/no-such-camera"));
        type(*dialog, QStringLiteral("live_project"), QString::fromStdString((*home_ / "p.eyrie").string()));
        QVERIFY(press(*dialog, QStringLiteral("Watch")));
        QVERIFY(waitFor([&] { return says(*dialog, QStringLiteral("/dev/no-such-camera: there is no such camera")); }));
        QVERIFY(!std::filesystem::exists(*home_ / "p.eyrie"));
    }

    void theRecordingLiesBesideTheProjectUnlessAnotherPlaceIsChosen() {
        MainWindow window;
        LiveDialog* dialog = askIn(window);
        const auto recording = [&] { return dialog->findChild<QLineEdit*>(QStringLiteral("live_recording"))->text(); };
        QVERIFY(recording().endsWith(QStringLiteral(".ts")));
        type(*dialog, QStringLiteral("live_project"), QStringLiteral("/here/patrol.eyrie"));
        QCOMPARE(recording(), QStringLiteral("/here/patrol.ts"));
        type(*dialog, QStringLiteral("live_recording"), QStringLiteral("/there/film.ts"));
        type(*dialog, QStringLiteral("live_project"), QStringLiteral("/here/other.eyrie"));
        QCOMPARE(recording(), QStringLiteral("/there/film.ts"));
    }

    void whatKeptTheSourceFromBeingWatchedIsToldWhereItWasTyped() {
        MainWindow window;
        LiveDialog* dialog = askIn(window);
        type(*dialog, QStringLiteral("live_address"), QStringLiteral("tcp://127.0.0.1:1"));
        type(*dialog, QStringLiteral("live_gsd"), QStringLiteral("much"));
        QVERIFY(press(*dialog, QStringLiteral("Watch")));
        QVERIFY(says(*dialog, QStringLiteral("GSD “much”")));
        type(*dialog, QStringLiteral("live_gsd"), QString());
        type(*dialog, QStringLiteral("live_project"), QString::fromStdString((*home_ / "absent/p.eyrie").string()));
        QVERIFY(press(*dialog, QStringLiteral("Watch")));
        QVERIFY(waitFor([&] { return says(*dialog, QStringLiteral("does not exist; make it first")); }));
        type(*dialog, QStringLiteral("live_project"), QString::fromStdString((*home_ / "p.eyrie").string()));
        QVERIFY(press(*dialog, QStringLiteral("Watch")));
        QVERIFY(waitFor([&] { return says(*dialog, QStringLiteral("check the address and that it sends")); }));
        QVERIFY2(press(*dialog, QStringLiteral("Cancel")), "it can be left");
        QVERIFY(waitFor([&] { return window.live().dialog() == nullptr; }));
    }

    void theStripTellsHowTheSourceStandsAndStopsIt() {
        MainWindow window;
        const test::LiveSource source(*home_ / "");
        const LiveSender sender(source.port, {{test::writeFilm(*home_ / "film.ts", 400), 16, 0.3}});
        QVERIFY(!window.liveStrip().isVisible());
        QVERIFY(watches(window, source));
        QVERIFY(window.liveStrip().isVisible());
        QVERIFY(waitFor([&] { return window.liveStrip().text().contains(QStringLiteral("recorded")); }));
        QVERIFY(window.liveStrip().text().contains(QString::fromStdString(source.request.address)));
        QVERIFY(press(window.liveStrip(), QStringLiteral("Stop watching")));
        QVERIFY(waitFor([&] { return !window.session().running(); }));
        QVERIFY(waitFor([&] { return !window.liveStrip().isVisible(); }));
        QVERIFY(waitFor([&] { return window.session().runData() && !window.session().runData()->record.live; }));
        QVERIFY(window.session().runs().back().frames_done >= 15);
    }

    void whereThereIsLittleRoomTheStateOfTheSourceIsWhatRemains() {
        ElidedLabel label(Qt::ElideRight);
        label.setText(QStringLiteral("40 of 1,000 frames with fewer corners"));
        label.resize(label.sizeHint());
        const QImage whole = label.grab().toImage();
        label.resize(label.width() / 2, label.height());
        const QImage half = label.grab().toImage();
        QVERIFY2(half != whole.copy(half.rect()), "an ellipsis tells that it is cut");
        MainWindow window;
        window.resize(1280, 720);
        const test::LiveSource source(*home_ / "");
        const LiveSender sender(source.port, {{test::writeFilm(*home_ / "film.ts", 400), 16, 0.3}});
        QVERIFY(watches(window, source));
        const auto labels = window.liveStrip().findChildren<ElidedLabel*>();
        QVERIFY(waitFor([&] { return labels.front()->text().startsWith(QStringLiteral("receiving")); }));
        for (ElidedLabel* other : labels.mid(1)) other->setText(QString(400, QLatin1Char('x')));
        window.liveStrip().layout()->activate();
        const ElidedLabel& state = *labels.front();
        QVERIFY(state.width() >= state.fontMetrics().horizontalAdvance(state.text()));
        QVERIFY2(window.width() <= 1280, "the texts give way, not the window");
    }

    void whatHappenedSoFarIsListedWhileTheSourceIsWatched() {
        bool emptied = false;
        bool was_between = false;  // the run had ended, and its events were still to be searched
        bool judged_between = false;
        bool told_between = false;
        MainWindow window;
        const test::LiveSource source(*home_ / "");
        const LiveSender sender(source.port, {{test::writeFilm(*home_ / "film.ts", 600), 24, 0.3}});
        QVERIFY(watches(window, source));
        window.docks().raise(DockId::events);
        EventReview& review = window.events().review();
        EventsPanel& panel = window.events().panel();
        panel.thresholds().setValue(QStringLiteral("events.over"), QStringLiteral("5"));
        panel.thresholds().setValue(QStringLiteral("events.over_time"), QStringLiteral("0.2"));
        QVERIFY(waitFor([&] { return review.asOf().has_value(); }));
        QVERIFY(window.session().running());
        const FrameIndex first = *review.asOf();
        QVERIFY(panel.headerText().startsWith(QStringLiteral("As of frame ")));
        QVERIFY2(waitFor([&] { return review.asOf() && *review.asOf() > first && review.count() > 0; }),
                 "the list is made anew");
        QVERIFY(window.session().running());
        QVERIFY(window.actions().next_event->isEnabled());
        QVERIFY2(!window.actions().relevant->isEnabled(), "tracks may still change when the run ends");
        QVERIFY(!review.judge({0}, Judgement::relevant));
        window.messages().dismissAll();
        QObject listener;
        whenChanged(window.session(), &listener,
                    {{{SessionChange::current_run, SessionChange::run_data, SessionChange::run_ended}, [&] {
                          const auto& data = window.session().runData();
                          if (window.session().running() || !data || data->record.live || !review.asOf() ||
                              window.session().currentRun() != data->record.id)
                              return;
                          was_between = true;
                          judged_between = judged_between || review.judge({0}, Judgement::relevant);
                          const QString told = window.messages().texts().join(QLatin1Char('\n'));
                          told_between = told_between || told.contains(QStringLiteral("whole run has been searched"));
                      }}});
        connect(&window.events(), &EventsDock::eventsShown, &listener,
                [&] { emptied = emptied || (review.state() != EventReview::State::found && review.count() == 0); });
        QVERIFY(press(window.liveStrip(), QStringLiteral("Stop watching")));
        QVERIFY(waitFor([&] { return review.state() == EventReview::State::found; }));
        QVERIFY(was_between);
        QVERIFY(!judged_between);
        QVERIFY2(told_between, "it is not said to wait for an end that has been");
        QVERIFY2(!emptied, "what was found stays in the list until all is searched");
        QVERIFY(!review.asOf());
        QVERIFY(panel.headerText().contains(QStringLiteral("judged")));
        QVERIFY(!panel.headerText().contains(QStringLiteral("As of")));
    }

    void zonesThatTheProjectHasAreWatchedMeanwhile() {
        const test::LiveSource source(*home_ / "");
        const LiveSender sender(source.port, {{test::writeFilm(*home_ / "film.ts", 600), 24, 0.3}});
        MainWindow window;
        QVERIFY(watches(window, source));
        // Once the run is stored, its video has a number.
        QVERIFY(waitFor([&] {
            const RunRecord* run = window.session().ownRun();
            return run != nullptr && run->sequence.id > 0;
        }));
        {
            ProjectFile project = ProjectFile::open(source.request.project);
            ReviewStore store(project, window.session().ownRun()->sequence.id);
            StoredZone zone;
            zone.id = store.newZoneId();
            zone.zone = {"all", ZoneShape::area, ZoneAnchor::image, 0, {{0, 0}, {9000, 0}, {9000, 9000}, {0, 9000}}};
            store.apply({"Add", {}, {}, {{std::nullopt, zone}}});
        }
        window.docks().raise(DockId::events);
        const EventReview& review = window.events().review();
        QVERIFY(waitFor([&] { return review.asOf() && review.found()->zones.size() == 1; }));
        QVERIFY(window.session().running());
        QCOMPARE(QString::fromStdString(review.found()->zones.front().name), QStringLiteral("all"));
        QVERIFY(press(window.liveStrip(), QStringLiteral("Stop watching")));
        QVERIFY(waitFor([&] { return review.state() == EventReview::State::found; }));
    }

    void closingTheWindowAsksAndKeepsAll() {
        const test::LiveSource source(*home_ / "");
        const LiveSender sender(source.port, {{test::writeFilm(*home_ / "film.ts", 400), 16, 0.3}});
        {
            MainWindow window;
            QVERIFY(watches(window, source));
            window.close();
            QVERIFY2(window.isVisible(), "it asks first");
            QVERIFY(answer(window, QStringLiteral("Stop watching")));
            QVERIFY(waitFor([&] { return !window.isVisible(); }));
        }
        ProjectFile file = ProjectFile::open(source.request.project, ProjectFile::Mode::read_only);
        const auto runs = RunStore(file).runs();
        QCOMPARE(runs.size(), std::size_t(1));
        QCOMPARE(runs[0].state, RunState::finished);
        QVERIFY(runs[0].frames_done >= 15);
    }

    void textsTellWhatIsLostAndWhatIsGivenUp() {
        LiveStatus status;
        status.load.facts.frames = 1000;
        status.load.facts.recorded_bytes = 12'300'000;
        status.load.facts.free_bytes = 38'000'000'000;
        QLocale::setDefault(QLocale(QLocale::English));
        QCOMPARE(liveStateText(status, 30), QStringLiteral("receiving"));
        QCOMPARE(liveLoadText(status), QStringLiteral("keeps pace"));
        QCOMPARE(liveRecordingText(status.load.facts), QStringLiteral("12.3 MB recorded"));
        QCOMPARE(liveSpaceText(status.load.facts), QStringLiteral("38.0 GB left on the disk."));
        QVERIFY(signalOf(status) == Signal::good);
        status.behind_s = 1.5;
        status.lighter = true;
        status.load.facts.skipped = 12;
        status.load.fewer_corners = 40;
        QCOMPARE(liveStateText(status, 30), QStringLiteral("receiving, 1.5 s behind"));
        QCOMPARE(liveLoadText(status), QStringLiteral("fewer corners now; 12 of 1,000 frames left out"));
        status.lighter = false;
        QCOMPARE(liveLoadText(status), QStringLiteral("12 of 1,000 frames left out; 40 with fewer corners"));
        status.load.facts.silent_s = 4;
        QCOMPARE(liveStateText(status, 30), QStringLiteral("no picture for 4.0 s"));
        QVERIFY(signalOf(status) == Signal::warning);
        status.load.facts.connected = false;
        QCOMPARE(liveStateText(status, 30), QStringLiteral("connection lost 4.0 s ago; trying again for 30.0 s"));
        QVERIFY(signalOf(status) == Signal::bad);
        status.load.facts.reconnects = 2;
        QVERIFY(liveLoadText(status).contains(QStringLiteral("connected again 2×")));
        QVERIFY(!isNearlyFull(status.load.facts));
        status.load.facts.free_bytes = 500'000'000;
        QVERIFY(isNearlyFull(status.load.facts));
        QCOMPARE(liveRecordingText(status.load.facts), QStringLiteral("12.3 MB recorded, only 500.0 MB left"));
        status.load.facts.free_bytes = 0;
        QCOMPARE(liveRecordingText(status.load.facts), QStringLiteral("12.3 MB recorded"));
    }
};

}  // namespace eyrie::ui::live_window_test

EYRIE_UI_TEST(QApplication, live_window_test, LiveWindowTest)
#include "live_window_test.moc"
