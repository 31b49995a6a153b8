#include <SQLiteCpp/SQLiteCpp.h>
#include <QApplication>
#include <QDoubleSpinBox>
#include <QLabel>
#include <QLineEdit>
#include <QListWidget>
#include <QMenu>
#include <QPushButton>
#include <QScopeGuard>
#include <QSignalSpy>
#include <QStatusBar>
#include <QTableView>
#include <QTest>

#include "canvas/video_view.h"
#include "review/runs/runs_panel.h"
#include "review/tracks/tracks_panel.h"
#include "session/background/due_write.h"
#include "store/health/project_contents.h"
#include "ui/session/session_support.h"
#include "ui/support/ui_support.h"
#include "ui/support/ui_test.h"
#include "widgets/empty_state.h"
#include "widgets/message_bar.h"
#include "window/docks/review_docks.h"
#include "window/earlier_state_dialog.h"
#include "window/main_window.h"
#include "window/run_guard.h"
#include "workspace/window_actions.h"

namespace eyrie::ui::window_files_test {

using test::Door;
using test::kPatience_ms;

/// Runs, files and projects through the window: what is asked, what is said, what is remembered.
class WindowFilesTest : public QObject {
    Q_OBJECT

    std::unique_ptr<test::OwnHome> home_;

    static bool waitFor(const std::function<bool()>& condition) { return QTest::qWaitFor(condition, kPatience_ms); }
    static bool open(MainWindow& window, const std::filesystem::path& path, double gsd_m_per_px = 0) {
        window.show();
        QSignalSpy ready(&window.session(), &ProjectSession::ready);
        StartOptions options;
        options.input = path;
        options.gsd_m_per_px = gsd_m_per_px;
        window.start(options);
        return ready.wait(kPatience_ms);
    }
    static bool opensMedia(MainWindow& window, const Media& media) {
        window.show();
        QSignalSpy ready(&window.session(), &ProjectSession::ready);
        window.session().openMedia(media);
        return ready.wait(kPatience_ms);
    }
    /// The run that starting with a folder of images makes.
    static bool runs(MainWindow& window, const std::filesystem::path& folder) {
        QSignalSpy finished(&window.session(), &ProjectSession::runFinished);
        window.session().settings().options.view.oblique = false;
        return open(window, folder, 0.25) && finished.wait(kPatience_ms);
    }
    static QLineEdit& gsd(MainWindow& window) { return *window.findChild<QLineEdit*>(QStringLiteral("gsd")); }
    static bool says(MainWindow& window, const QString& part) {
        return window.messages().texts().join(QLatin1Char('\n')).contains(part);
    }
    static bool asks(const MainWindow& window) {
        const auto boxes = window.findChildren<QMessageBox*>();
        return std::any_of(boxes.begin(), boxes.end(), [](const QMessageBox* box) { return box->isVisible(); });
    }
    std::filesystem::path images(const std::string& name, int frames = 12) {
        return test::writeScene(*home_ / name / "images", frames);
    }

 private slots:
    void init() { home_ = std::make_unique<test::OwnHome>(); }
    void cleanup() { home_.reset(); }

    void aGsdThatWasTypedCountsWithoutReturn() {
        MainWindow window;
        QVERIFY(runs(window, images("a")));
        QVERIFY(waitFor([&] { return window.actions().run->isEnabled(); }));
        gsd(window).setFocus();
        gsd(window).selectAll();
        QTest::keyClicks(&gsd(window), QStringLiteral("0,08"));
        QSignalSpy finished(&window.session(), &ProjectSession::runFinished);
        window.actions().run->trigger();
        QVERIFY(finished.wait(kPatience_ms));
        QVERIFY(waitFor([&] { return window.session().runs().size() == 2; }));
        QVERIFY(window.session().runs()[1].scale.gsd_known);
        QCOMPARE(window.session().runs()[1].scale.gsd_m_per_px, 0.08);
    }

    void aFrameRateThatNobodySaidIsAskedForMarkedAndRemembered() {
        const auto folder = images("a");
        const QString asked = QStringLiteral("25 frames per second are assumed until you enter it");
        {
            MainWindow window;
            QVERIFY(runs(window, folder));
            QVERIFY(says(window, asked));
            QVERIFY(QApplication::activeModalWidget() == nullptr);
            QVERIFY(waitFor(
                [&] { return says(window, QStringLiteral("The frame rate is not known: 25 frames per second")); }));
            auto* rate = window.findChild<QDoubleSpinBox*>(QStringLiteral("frame_rate"));
            QCOMPARE(rate->suffix(), QStringLiteral(" fps?"));
            const auto status = [&] {
                for (const auto* label : window.statusBar()->findChildren<QLabel*>())
                    if (label->text().contains(QStringLiteral("at 25 fps (assumed)"))) return true;
                return false;
            };
            QVERIFY(waitFor(status));
            QVERIFY(window.session().runs().front().rate_assumed);
            // Passing through the field says nothing, Return in it does.
            rate->setFocus();
            window.canvas().setFocus();
            QVERIFY(window.session().video()->frame_rate_assumed);
            QVERIFY(waitFor([&] { return rate->isEnabled(); }));
            rate->setFocus();
            QTest::keyClick(rate, Qt::Key_Return);
            QVERIFY(waitFor([&] { return !window.session().video()->frame_rate_assumed; }));
            QVERIFY(waitFor([&] { return !says(window, asked); }));
            QVERIFY(waitFor([&] { return !status(); }));
            QCOMPARE(rate->suffix(), QStringLiteral(" fps"));
        }
        MainWindow window;
        QVERIFY(open(window, folder));
        QVERIFY(!says(window, asked));
        QVERIFY(!window.session().video()->frame_rate_assumed);
        QVERIFY2(window.session().runs().front().rate_assumed, "that run was made before anybody said it");
    }

    void aGsdOfTheMetadataStaysOneUntilSomebodyTypesAnother() {
        const auto folder = images("a");
        {
            MainWindow window;
            QVERIFY(runs(window, folder));
            ProjectFile project = ProjectFile::open(window.session().project());
            project.database().exec("UPDATE run SET gsd_m_per_px = 0.2512345678, scale_origin = 'metadata'");
        }
        MainWindow window;
        QVERIFY(open(window, folder));
        QCOMPARE(gsd(window).text(), QStringLiteral("0.251235"));
        QVERIFY(gsd(window).toolTip().contains(QStringLiteral("0.2512 m/px, from the video's metadata")));
        const auto next = [&] {
            QSignalSpy finished(&window.session(), &ProjectSession::runFinished);
            const std::size_t before = window.session().runs().size();
            if (!waitFor([&] { return window.actions().run->isEnabled(); })) return RunRecord();
            window.actions().run->trigger();
            if (!finished.wait(kPatience_ms)) return RunRecord();
            waitFor([&] { return window.session().runs().size() == before + 1; });
            return window.session().runs().back();
        };
        const RunRecord untouched = next();
        QCOMPARE(untouched.scale_basis.origin, ScaleOrigin::metadata);
        QCOMPARE(untouched.scale.gsd_m_per_px, 0.2512345678);
        gsd(window).setFocus();
        gsd(window).selectAll();
        QTest::keyClicks(&gsd(window), QStringLiteral("0.2"));
        const RunRecord typed = next();
        QCOMPARE(typed.scale_basis.origin, ScaleOrigin::given);
        QCOMPARE(typed.scale.gsd_m_per_px, 0.2);
        QVERIFY(waitFor([&] { return gsd(window).toolTip().contains(QStringLiteral("0.2 m/px, as given")); }));
    }

    void aGsdThatIsNoneIsToldAndNotWiped() {
        MainWindow window;
        QVERIFY(runs(window, images("a")));
        QVERIFY(waitFor([&] { return window.actions().run->isEnabled(); }));
        gsd(window).selectAll();
        QTest::keyClicks(&gsd(window), QStringLiteral("0.0.8"));
        window.actions().run->trigger();
        QVERIFY(!window.session().running());
        QVERIFY(says(window, QStringLiteral("“0.0.8”")));
        QCOMPARE(gsd(window).text(), QStringLiteral("0.0.8"));
        QTest::keyClick(&gsd(window), Qt::Key_Backspace);
        QVERIFY(!says(window, QStringLiteral("“0.0.8”")));  // it is being mended
    }

    void theCounterNamesThePicture() {
        auto door = std::make_shared<Door>();
        MainWindow window;
        QVERIFY(opensMedia(window, test::sceneUnderTest(80, [door](FrameIndex f) { door->pass(f); })));
        QVERIFY(waitFor([&] { return !window.canvas().frame().image.isNull(); }));
        const auto counter = [&](const QString& number) {
            const auto labels = window.findChildren<QLabel*>();
            return std::any_of(labels.begin(), labels.end(), [&](const QLabel* label) {
                return label->text().startsWith(QStringLiteral("frame ") + number + QStringLiteral(" / 79"));
            });
        };
        QVERIFY(counter(QStringLiteral("0")));
        window.session().settings().options.view.oblique = false;  // which reads elsewhere, too
        door->closeFrom(30);
        window.session().goToFrame(60);
        QCOMPARE(window.canvas().frame().index, 0);
        QVERIFY(counter(QStringLiteral("0")));
        door->open();
        QVERIFY(waitFor([&] { return window.canvas().frame().index == 60; }));
        QVERIFY(counter(QStringLiteral("60")));
    }

    void removingARunAsksAndCanBeUndone() {
        MainWindow window;
        QVERIFY(runs(window, images("a")));
        auto* list = window.findChild<RunsPanel*>();
        const int id = window.session().runs().front().id;
        list->selectId(id);
        QTest::keyClick(list->table(), Qt::Key_Delete);
        QVERIFY(asks(window));
        QVERIFY(test::answer(window, QStringLiteral("Cancel")));
        QCOMPARE(window.session().runs().size(), std::size_t(1));
        QVERIFY(waitFor([&] { return !asks(window); }));
        QTest::keyClick(list->table(), Qt::Key_Delete);
        QVERIFY(test::answer(window, QStringLiteral("Remove")));
        QVERIFY(waitFor([&] { return window.session().runs().empty(); }));
        QVERIFY(waitFor([&] { return window.actions().restore_run->isEnabled(); }));
        QVERIFY(!window.session().currentRun());
        QVERIFY(!says(window, QStringLiteral("has no run")));
        QVERIFY(waitFor([&] { return window.canvas().frame().result == nullptr; }));
        window.actions().restore_run->trigger();
        QVERIFY(waitFor([&] { return window.session().runs().size() == 1; }));
        QCOMPARE(window.session().runs().front().id, id);
        QVERIFY(!window.actions().restore_run->isEnabled());
    }

    void closingDuringARunAsks() {
        auto door = std::make_shared<Door>();
        MainWindow window;
        QVERIFY(opensMedia(window, test::sceneUnderTest(60, [door](FrameIndex f) { door->pass(f); })));
        window.session().settings().options.view.oblique = false;  // which reads elsewhere, too
        door->closeFrom(20);
        window.actions().run->trigger();
        QVERIFY(waitFor(
            [&] { return !window.session().runs().empty() && window.session().runs().back().frames_done >= 8; }));
        window.close();
        QVERIFY(window.isVisible() && asks(window));
        QVERIFY(test::answer(window, QStringLiteral("Cancel")));
        QVERIFY(window.isVisible() && window.session().running());
        QVERIFY(waitFor([&] { return !asks(window); }));
        window.close();
        QVERIFY(test::answer(window, QStringLiteral("Wait for its end")));
        QVERIFY(window.isVisible());
        door->open();
        QVERIFY(waitFor([&] { return !window.isVisible(); }));
        ProjectFile file = ProjectFile::open(window.session().project());
        QCOMPARE(RunStore(file).runs().front().state, RunState::finished);
    }

    void openingAnotherVideoDuringARunAsksAndBeginsAfresh() {
        const auto folder = images("a");
        auto door = std::make_shared<Door>();
        MainWindow window;
        QVERIFY(opensMedia(window, test::sceneUnderTest(200, [door](FrameIndex f) { door->pass(f); })));
        window.session().settings().options.view.oblique = false;  // which reads elsewhere, too
        door->closeFrom(20);
        window.actions().run->trigger();
        QVERIFY(waitFor(
            [&] { return !window.session().runs().empty() && window.session().runs().back().frames_done >= 8; }));
        test::drop(window, folder);
        QVERIFY(asks(window));
        QSignalSpy ready(&window.session(), &ProjectSession::ready);
        QVERIFY(test::answer(window, QStringLiteral("Stop the run")));
        door->open();
        QVERIFY(ready.wait(kPatience_ms));
        QCOMPARE(window.session().video()->frame_count, 12);
        QVERIFY(waitFor([&] { return !window.canvas().frame().image.isNull(); }));
        QCOMPARE(window.session().currentFrame(), 0);
        QVERIFY(!says(window, QStringLiteral("was stopped")));  // that was the former video's
    }

    void aRunThatIsBegunWhileLastChangesAreSavedIsNotStoppedUnasked() {
        const auto folder = images("a");
        auto door = std::make_shared<Door>();
        MainWindow window;
        QVERIFY(opensMedia(window, test::sceneUnderTest(200, [door](FrameIndex f) { door->pass(f); })));
        const auto at_last = qScopeGuard([door] { door->open(); });  // whoever waits there holds up the rest
        window.session().settings().options.view.oblique = false;    // which reads elsewhere, too
        door->closeFrom(20);
        std::optional<DueWrite> work(std::in_place);
        test::drop(window, folder);
        QVERIFY(says(window, QStringLiteral("Saving your last changes first")));
        window.actions().run->trigger();
        QVERIFY(window.session().running());
        work.reset();
        QVERIFY(waitFor([&] { return asks(window); }));
        QVERIFY(window.session().running());
        QVERIFY(!window.session().opening());
        work.emplace();  // something else is done while the question is open
        QSignalSpy ready(&window.session(), &ProjectSession::ready);
        QVERIFY(test::answer(window, QStringLiteral("Stop the run")));
        door->open();
        QVERIFY(waitFor([&] { return says(window, QStringLiteral("Saving your last changes first")); }));
        QVERIFY(!window.session().opening());
        work.reset();
        QVERIFY(ready.count() > 0 || ready.wait(kPatience_ms));
        QCOMPARE(window.session().video()->frame_count, 12);
    }

    void whereTheRunThatIsShownIsRemovedOthersCanBeComparedStill() {
        MainWindow window;
        QVERIFY(runs(window, images("a")));
        QVERIFY(waitFor([&] { return window.actions().run->isEnabled(); }));
        QVERIFY(test::runAndWait(window.session()));
        QVERIFY(waitFor([&] { return window.session().runs().size() == 2; }));
        QVERIFY(window.session().currentRun());
        window.session().removeRun(*window.session().currentRun());
        QVERIFY(!window.session().currentRun());
        QVERIFY(waitFor([&] { return window.actions().compare->isEnabled(); }));
        QCOMPARE(window.session().runs().size(), std::size_t(1));
        window.session().removeRun(window.session().runs().front().id);
        QVERIFY(waitFor([&] { return !window.actions().compare->isEnabled(); }));
    }

    void whyIsAskedOnlyAboutFramesThatWereProcessed() {
        MainWindow window;
        QVERIFY(opensMedia(window, test::sceneUnderTest(60)));
        window.session().settings().range = {0, 19};
        QVERIFY(test::runAndWait(window.session()));
        window.session().goToFrame(10);
        QVERIFY(waitFor([&] { return window.canvas().frame().index == 10 && window.actions().why->isEnabled(); }));
        window.session().goToFrame(50);
        QVERIFY(waitFor([&] { return window.canvas().frame().index == 50 && !window.actions().why->isEnabled(); }));
        window.session().goToFrame(11);
        QVERIFY(waitFor([&] { return window.canvas().frame().index == 11 && window.actions().why->isEnabled(); }));
    }

    void theEndOfARunIsSummarised() {
        MainWindow window;
        QVERIFY(runs(window, images("a", 40)));
        QVERIFY(waitFor([&] { return says(window, QStringLiteral("Run 1 finished")); }));
        QVERIFY(says(window, QStringLiteral("Scale: 0.25 m/px, as given.")));
    }

    void aRunWithoutTracksSaysWhy() {
        const auto folder = *home_ / "blank";
        std::filesystem::create_directories(folder);
        for (int i = 0; i < 12; ++i)
            cv::imwrite((folder / (std::to_string(10 + i) + ".png")).string(),
                        cv::Mat(120, 160, CV_8UC1, cv::Scalar(i)));
        MainWindow window;
        QVERIFY(runs(window, folder));
        QVERIFY(waitFor([&] { return says(window, QStringLiteral("No frame could be registered")); }));
        auto* tracks = window.findChild<TracksPanel*>();
        QVERIFY(waitFor([&] {
            return tracks->emptyState()->explanation().contains(QStringLiteral("No frame could be registered"));
        }));
    }

    void theTitleNamesTheProjectAndRecentEntriesAreProjects() {
        const auto first = images("a", 4);
        const auto second = images("b", 4);
        MainWindow window;
        QVERIFY(runs(window, first));
        QCOMPARE(window.windowTitle(), QStringLiteral("images – images.eyrie – Eyrie"));
        QVERIFY(runs(window, second));
        const auto menus = window.findChildren<QMenu*>();
        const auto recent =
            std::find_if(menus.begin(), menus.end(), [](QMenu* menu) { return menu->title().contains("recent"); });
        QVERIFY(recent != menus.end());
        const QList<QAction*> entries = (*recent)->actions();
        QVERIFY(entries.size() >= 2);
        QVERIFY(entries[0]->text().contains(QStringLiteral("images.eyrie")));
        QVERIFY(entries[0]->text() != entries[1]->text());
        QSignalSpy ready(&window.session(), &ProjectSession::ready);
        entries[1]->trigger();
        QVERIFY(ready.wait(kPatience_ms));
        QCOMPARE(window.session().project(), *home_ / "a" / "images.eyrie");
        QVERIFY(window.session().currentRun());
    }

    void aMissingVideoOffersToBeLocated() {
        const auto folder = images("a", 4);
        {
            MainWindow window;
            QVERIFY(runs(window, folder));
        }
        std::filesystem::remove_all(folder);
        MainWindow window;
        QVERIFY(open(window, *home_ / "a" / "images.eyrie"));
        QVERIFY(waitFor([&] { return says(window, QStringLiteral("images")); }));
        const auto buttons = window.messages().findChildren<QPushButton*>();
        QVERIFY(std::any_of(buttons.begin(), buttons.end(),
                            [](const QPushButton* button) { return button->text() == QStringLiteral("Locate…"); }));
        QVERIFY(!window.session().running());
    }

    void anEarlierStateIsRestored() {
        MainWindow window;
        QVERIFY(runs(window, images("a", 6)));
        const auto project = window.session().project();
        QVERIFY(waitFor([&] { return !listBackups(project).empty() || window.session().runs().size() == 1; }));
        QCOMPARE(backUp(project, BackupRequest()).outcome, BackupOutcome::made);  // as on another day
        QSignalSpy finished(&window.session(), &ProjectSession::runFinished);
        QVERIFY(waitFor([&] { return window.actions().run->isEnabled(); }));
        window.actions().run->trigger();
        QVERIFY(finished.wait(kPatience_ms));
        QVERIFY(waitFor([&] { return window.session().runs().size() == 2; }));
        window.actions().restore_state->trigger();
        auto* dialog = window.findChild<EarlierStateDialog*>();
        QVERIFY(dialog);
        QVERIFY(waitFor([&] { return dialog->list()->count() > 0; }));
        QVERIFY(test::says(*dialog, QStringLiteral("run 2")));  // it would be gone
        QSignalSpy ready(&window.session(), &ProjectSession::ready);
        QVERIFY(test::press(*dialog, QStringLiteral("Restore")));
        QVERIFY(ready.wait(kPatience_ms));
        QCOMPARE(window.session().project(), project);
        QCOMPARE(window.session().runs().size(), std::size_t(1));
        const auto kept = listBackups(project);
        QVERIFY(std::any_of(kept.begin(), kept.end(), [](const ProjectBackup& backup) {
            return backup.reason == BackupReason::before_restoring && contentsOf(backup.path).runs.size() == 2;
        }));
    }

    void whatWasWrongBeforeIsNotSaidAboutTheNextFile() {
        MainWindow window;
        window.show();
        window.session().open(*home_ / "missing.mp4");
        QVERIFY(waitFor([&] { return says(window, QStringLiteral("missing.mp4")); }));
        const auto folder = images("a", 4);
        QSignalSpy ready(&window.session(), &ProjectSession::ready);
        test::drop(window, folder);
        QVERIFY(ready.wait(kPatience_ms));
        QVERIFY(!says(window, QStringLiteral("missing.mp4")));
    }
};

}  // namespace eyrie::ui::window_files_test

EYRIE_UI_TEST(QApplication, window_files_test, WindowFilesTest)
#include "window_files_test.moc"
