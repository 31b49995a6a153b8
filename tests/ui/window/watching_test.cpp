#include <QApplication>
#include <QFileDialog>
#include <QLineEdit>
#include <QListWidget>
#include <QMenu>
#include <QPushButton>
#include <QSlider>
#include <QTest>
#include <QTimer>
#include <QWidgetAction>
#include <algorithm>
#include <cmath>

#include "canvas/timeline/timeline_view.h"
#include "canvas/video_view.h"
#include "ground/followed_pose.h"
#include "review/card/card_dock.h"
#include "review/card/story_sketch.h"
#include "review/events/event_review.h"
#include "review/events/events_dock.h"
#include "review/events/events_model.h"
#include "review/events/events_panel.h"
#include "review/mosaic/coverage_legend.h"
#include "review/mosaic/mosaic_panel.h"
#include "review/mosaic/mosaic_view.h"
#include "review/watch/measure_tool.h"
#include "review/watch/seen_watch.h"
#include "review/watch/watch_commands.h"
#include "review/watch/watched_ground.h"
#include "store/review/seen_store.h"
#include "ui/session/session_support.h"
#include "ui/support/ui_test.h"
#include "widgets/message_bar.h"
#include "window/bars/picture_button.h"
#include "window/docks/watching_docks.h"
#include "window/main_window.h"
#include "workspace/dock_registry.h"
#include "workspace/window_actions.h"

namespace eyrie::ui::watching_test {

using test::kPatience_ms;

namespace {

constexpr FrameIndex kAnchor = 20;
constexpr FrameIndex kLater = 40;
constexpr double kDriftPerFrame = 1;  ///< px by which the ground of the scene goes left

QPointF standing(FrameIndex frame) {
    return {150.0 - kDriftPerFrame * (frame - kAnchor), 90};
}

}  // namespace

/// How a person watches what a run found: steady, near, quickly, measuring.
class WatchingTest : public QObject {
    Q_OBJECT

    std::unique_ptr<test::OwnHome> home_;
    std::unique_ptr<MainWindow> window_;

    MainWindow& window() { return *window_; }
    VideoView& canvas() { return window_->canvas(); }
    const WindowActions& actions() { return window_->actions(); }
    bool goTo(FrameIndex frame) {
        window_->session().goToFrame(frame);
        return test::shows(window_->session(), frame);
    }
    QPointF inView(QPointF image) { return canvas().transform().viewFromImage(image); }
    void click(QPointF image) { QTest::mouseClick(&canvas(), Qt::LeftButton, {}, inView(image).toPoint()); }
    QString measured() { return window_->watching().commands().measureTool().text(); }
    bool tells(const QString& words) {
        const QStringList texts = window_->messages().texts();
        return std::any_of(texts.begin(), texts.end(), [&](const QString& text) { return text.contains(words); });
    }

 private slots:
    void initTestCase() {
        home_ = std::make_unique<test::OwnHome>();
        window_ = std::make_unique<MainWindow>();
        window_->resize(1280, 720);
        window_->show();
        QVERIFY(QTest::qWaitForWindowActive(window_.get()));
        QVERIFY(test::openAndWait(window_->session(), test::sceneUnderTest(60)));
        QVERIFY(!actions().steady->isEnabled());  // nothing is known of the ground yet
        QVERIFY(test::runAndWait(window_->session()));
        QTRY_VERIFY_WITH_TIMEOUT(window_->watching().ground().ground() != nullptr, kPatience_ms);
    }
    void cleanupTestCase() {
        window_.reset();
        home_.reset();
    }
    void init() {
        QVERIFY(goTo(kAnchor));
        canvas().fit();
        canvas().setFocus();
    }
    void cleanup() {
        actions().steady->setChecked(false);
        actions().follow_object->setChecked(false);
        actions().only_moving->setChecked(false);
        window().watching().commands().measureTool().end();
        window().session().selectTrack(std::nullopt);
    }

    void theGroundStandsStillUntilItIsSwitchedOff() {
        QTest::keyClick(&canvas(), Qt::Key_G, Qt::ShiftModifier);
        QVERIFY(actions().steady->isChecked());
        QTRY_VERIFY_WITH_TIMEOUT(window().watching().ground().sheets() != nullptr, kPatience_ms);
        QVERIFY(canvas().transform().onGround());
        QVERIFY(test::says(window(), QStringLiteral("ground held still")));
        QCOMPARE(window().watching().ground().sheets()->anchor(), kAnchor);
        const QPointF before = inView(standing(kAnchor));
        const double px = canvas().transform().scale();
        QVERIFY(goTo(kLater));
        QVERIFY(QLineF(inView(standing(kLater)), before).length() < 0.5 * px);
        // The picture itself has moved over the ground, and places under the cursor are still those of the picture.
        QVERIFY(QLineF(inView({0, 0}), inView({20, 0})).length() > 15 * px);
        QVERIFY(QLineF(canvas().transform().imageFromView(before), standing(kLater)).length() < 0.5);
        // The pixels as painted stand still, too.
        const QImage later = canvas().picture();
        QVERIFY(goTo(kLater - 5));
        const QImage earlier = canvas().picture();
        const QPoint place = inView(standing(kLater - 5)).toPoint();
        int difference = 0;
        for (int y = -12; y <= 12; ++y)
            for (int x = -12; x <= 12; ++x)
                difference +=
                    std::abs(qGray(later.pixel(place + QPoint(x, y))) - qGray(earlier.pixel(place + QPoint(x, y))));
        QVERIFY2(difference < 6 * 625, qPrintable(QString::number(difference / 625.0)));
        QTest::keyClick(&canvas(), Qt::Key_G, Qt::ShiftModifier);
        QVERIFY(!canvas().transform().onGround());
        QVERIFY(QLineF(inView(standing(kLater - 5)), before).length() > 5 * px);
    }

    void aFollowedVehicleIsInTheMiddleWithItsHeadingUp() {
        const auto& tracks = window().watching().ground().ground()->run->tracks;
        QVERIFY(!tracks.empty());
        const EventTrack& track = tracks.front();
        window().session().selectTrack(track.id);
        const double before = canvas().transform().scale();
        QTest::keyClick(&canvas(), Qt::Key_S);
        QVERIFY(actions().follow_object->isChecked());
        QVERIFY(canvas().transform().scale() > before);  // near enough to be seen
        for (const bool steady : {false, true}) {
            actions().steady->setChecked(steady);
            if (steady) QTRY_VERIFY_WITH_TIMEOUT(window().watching().ground().sheets() != nullptr, kPatience_ms);
            for (const FrameIndex frame : {kAnchor + 2, kAnchor + 9}) {
                QVERIFY(goTo(frame));
                const auto pose =
                    followedPose(track, frame, window().watching().ground().ground()->run->footage.camera);
                if (!pose) continue;
                const QPointF centre(pose->centre.x, pose->centre.y);
                QVERIFY(QLineF(inView(centre), QRectF(canvas().rect()).center()).length() < 2);
                const QPointF ahead =
                    canvas().transform().viewVector({std::cos(pose->heading), std::sin(pose->heading)}, centre);
                QVERIFY(ahead.y() < 0 && std::abs(ahead.x()) < 0.02 * std::abs(ahead.y()));
            }
        }
        QTest::keyClick(&canvas(), Qt::Key_S);
        QCOMPARE(canvas().transform().rotation(), 0.0);
        QVERIFY(canvas().transform().fitted());
    }

    void whereThereIsNothingToFollowTheWindowSaysSoAndWhatToDo() {
        QTest::keyClick(&canvas(), Qt::Key_S);
        QVERIFY(tells(QStringLiteral("No vehicle is selected")));
        const auto& tracks = window().watching().ground().ground()->run->tracks;
        const auto absent = std::find_if(tracks.begin(), tracks.end(), [](const EventTrack& track) {
            return track.boxes.front().frame > 0 || track.boxes.back().frame < 59;
        });
        QVERIFY(absent != tracks.end());
        const bool later = absent->boxes.front().frame > 0;
        const FrameIndex nearest = later ? absent->boxes.front().frame : absent->boxes.back().frame;
        QVERIFY(goTo(later ? 0 : 59));
        window().session().selectTrack(absent->id);
        QVERIFY(!tells(QStringLiteral("No vehicle is selected")));
        QVERIFY(tells(QStringLiteral("Track %1 is not in this frame").arg(absent->id)));
        const auto buttons = window().messages().findChildren<QPushButton*>();
        const auto go = std::find_if(buttons.begin(), buttons.end(), [&](const QPushButton* button) {
            return button->text() == QStringLiteral("Go to frame %1").arg(nearest);
        });
        QVERIFY(go != buttons.end());
        (*go)->click();
        QVERIFY(test::shows(window().session(), nearest));
        QVERIFY(!tells(QStringLiteral("is not in this frame")));
        const auto pose = followedPose(*absent, nearest, window().watching().ground().ground()->run->footage.camera);
        QVERIFY(pose.has_value());
        QTRY_VERIFY(QLineF(inView({pose->centre.x, pose->centre.y}), QRectF(canvas().rect()).center()).length() < 2);
        // Where it was switched off nobody is told.
        QVERIFY(goTo(later ? 0 : 59));
        window().session().selectTrack(std::nullopt);
        QVERIFY(tells(QStringLiteral("No vehicle is selected")));
        QTest::keyClick(&canvas(), Qt::Key_S);
        QVERIFY(!tells(QStringLiteral("No vehicle is selected")));
    }

    void labellingHasTheCanvasToItself() {
        actions().steady->setChecked(true);
        QTRY_VERIFY_WITH_TIMEOUT(canvas().transform().onGround(), kPatience_ms);
        actions().workspaceAction(WorkspaceKind::label)->trigger();
        QVERIFY(!canvas().transform().onGround());
        QVERIFY(!actions().steady->isEnabled());
        QVERIFY(!actions().measure->isEnabled());
        // Nor when it changes what can be done otherwise.
        window().session().renameRun(*window().session().currentRun(), QStringLiteral("watched"));
        QTRY_COMPARE_WITH_TIMEOUT(window().session().shownRun()->name, std::string("watched"), kPatience_ms);
        QVERIFY(!actions().measure->isEnabled());
        actions().workspaceAction(WorkspaceKind::review)->trigger();
        QVERIFY(actions().measure->isEnabled());
        QTRY_VERIFY_WITH_TIMEOUT(canvas().transform().onGround(), kPatience_ms);
    }

    void whatOneWorkspaceBeganOnTheCanvasEndsBeforeAnotherTakesIt() {
        window().session().selectTrack(window().watching().ground().ground()->run->tracks.front().id);
        actions().follow_object->setChecked(true);
        actions().measure->trigger();
        QVERIFY(window().watching().commands().measureTool().measuring());
        actions().workspaceAction(WorkspaceKind::label)->trigger();
        QVERIFY(!window().watching().commands().measureTool().measuring());
        QVERIFY(canvas().tool() != nullptr && canvas().tool() != &window().watching().commands().measureTool());
        QCOMPARE(canvas().transform().rotation(), 0.0);
        actions().workspaceAction(WorkspaceKind::review)->trigger();
        QVERIFY(canvas().tool() == nullptr);
    }

    void distancesAndSpeedsAreMeasuredOnTheGround() {
        QTest::keyClick(&canvas(), Qt::Key_M, Qt::ControlModifier);
        QVERIFY(actions().measure->isChecked());
        QVERIFY(measured().contains(QStringLiteral("Click where to begin")));
        click({60, 100});
        click({120, 100});
        QVERIFY2(measured().endsWith(QStringLiteral(" m")), qPrintable(measured()));
        QVERIFY(std::abs(measured().section(QLatin1Char(' '), 0, 0).toDouble() - 15) < 0.4);  // 60 px at 0.25 m
        // From one frame to another: what goes with the picture drives over this ground.
        click({60, 120});
        QVERIFY(goTo(kAnchor + 25));
        click({60, 120});
        // 25 px in a second at 0.25 m: 6.25 m/s.
        QVERIFY2(measured().contains(QStringLiteral("km/h")), qPrintable(measured()));
        const double speed = measured().section(QStringLiteral(": "), 1).section(QLatin1Char(' '), 0, 0).toDouble();
        QVERIFY2(std::abs(speed - 22.5) < 1.5, qPrintable(measured()));
        QTest::keyClick(&canvas(), Qt::Key_Escape);
        QVERIFY(!actions().measure->isChecked());
        QVERIFY(canvas().tool() == nullptr);
    }

    void distancesAreMeasuredWithoutAMouse() {
        QTest::mouseMove(&canvas(), inView({60, 100}).toPoint());  // the cross begins there
        actions().measure->trigger();
        const auto place = [&] {
            return canvas().transform().imageFromView(canvas().keyPointer().value_or(QPointF(-999, -999)));
        };
        QTest::keyClick(&canvas(), Qt::Key_Left);
        const QPointF begin = place();
        QTest::keyClick(&canvas(), Qt::Key_Return);
        for (int i = 0; i < 10; ++i) QTest::keyClick(&canvas(), Qt::Key_Right, Qt::ShiftModifier);
        const double metres = QLineF(begin, place()).length() * 0.25;
        QTest::keyClick(&canvas(), Qt::Key_Return);
        QVERIFY2(measured().endsWith(QStringLiteral(" m")), qPrintable(measured()));
        QVERIFY2(std::abs(measured().section(QLatin1Char(' '), 0, 0).toDouble() - metres) < 0.2,
                 qPrintable(measured()));
        // From one frame to another, in the same place of the view.
        QTest::keyClick(&canvas(), Qt::Key_Return);
        QVERIFY(goTo(kAnchor + 25));
        QTest::keyClick(&canvas(), Qt::Key_Return);
        QVERIFY2(measured().contains(QStringLiteral("km/h")), qPrintable(measured()));
        // Backspace takes the end back, and then the beginning.
        QTest::keyClick(&canvas(), Qt::Key_Backspace);
        QTest::keyClick(&canvas(), Qt::Key_Backspace);
        QVERIFY(measured().contains(QStringLiteral("Click where to begin")));
        QTest::keyClick(&canvas(), Qt::Key_Escape);
        QVERIFY(!actions().measure->isChecked());
    }

    void onlyWhatMovesIsPlayedWhereSwitchedOn() {
        QTest::keyClick(&canvas(), Qt::Key_Space, Qt::ControlModifier);
        QVERIFY(actions().only_moving->isChecked());
        QTRY_VERIFY_WITH_TIMEOUT(window().session().playback().spans().has_value(), kPatience_ms);
        QVERIFY(!window().session().playback().spans()->empty());
        QVERIFY(tells(QStringLiteral("Something moves")));
        // What the sensitivity hides does not count, as soon as it does.
        window().overlays().setMinScore(2);
        QTRY_VERIFY_WITH_TIMEOUT(window().session().playback().spans()->empty(), kPatience_ms);
        QVERIFY(tells(QStringLiteral("Nothing moves")));
        window().overlays().setMinScore(0);
        QTRY_VERIFY_WITH_TIMEOUT(!window().session().playback().spans()->empty(), kPatience_ms);
        QTest::keyClick(&canvas(), Qt::Key_Space, Qt::ControlModifier);
        QVERIFY(!window().session().playback().spans());
    }

    void picturesAreMadeBrighterAndEvenForTheEyeAlone() {
        const auto mean = [&] {
            const QImage grey = window().session().viewFrame().image.convertToFormat(QImage::Format_Grayscale8);
            double sum = 0;
            for (int y = 0; y < grey.height(); ++y)
                for (int x = 0; x < grey.width(); ++x) sum += grey.constScanLine(y)[x];
            return sum / grey.width() / grey.height();
        };
        auto* button = window().findChild<PictureButton*>();
        QVERIFY(button != nullptr);
        const double before = mean();
        button->brightness()->setValue(20);
        QTRY_VERIFY_WITH_TIMEOUT(mean() > before + 40, kPatience_ms);
        button->brightness()->setValue(0);
        QTRY_VERIFY_WITH_TIMEOUT(std::abs(mean() - before) < 0.5, kPatience_ms);
        QTest::keyClick(&canvas(), Qt::Key_H, Qt::ControlModifier);
        QVERIFY(window().session().pictureLook().even);
        button->reset();
        QVERIFY(window().session().pictureLook().plain());
        // Tab leads to the button, the space bar opens its menu, and Tab leads from entry to entry there.
        QVERIFY((button->focusPolicy() & Qt::TabFocus) != 0);
        bool opened = false;
        QTimer::singleShot(0, button, [&] {
            opened = QApplication::activePopupWidget() == button->menu();
            button->menu()->close();
        });
        QTest::keyClick(button, Qt::Key_Space);
        QVERIFY(opened);
        QList<QWidget*> reached;
        for (QAction* action : button->menu()->actions())
            if (const auto* entry = qobject_cast<QWidgetAction*>(action);
                entry != nullptr && (entry->defaultWidget()->focusPolicy() & Qt::TabFocus) != 0)
                reached << entry->defaultWidget()->focusProxy();
        QCOMPARE(reached, (QList<QWidget*>{button->brightness(), button->contrast()}));
    }

    void whatIsSeenIsSavedAndNeverOverAProject() {
        const std::filesystem::path seen = *home_ / "seen.png";
        window().watching().commands().writeSnapshot(seen,
                                                     snapshotOf(canvas(), window().session(), SnapshotKind::as_seen));
        QTRY_VERIFY_WITH_TIMEOUT(std::filesystem::exists(seen), kPatience_ms);
        const QImage view(QString::fromStdString(seen.string()));
        QCOMPARE(view.width(), canvas().width());  // a message above it may come or go meanwhile
        QCOMPARE(view.text(QStringLiteral("Frame")), QString::number(kAnchor));
        QCOMPARE(view.text(QStringLiteral("Video")), QStringLiteral("scene.mp4"));
        const std::filesystem::path alone = *home_ / "alone.png";
        window().watching().commands().writeSnapshot(alone,
                                                     snapshotOf(canvas(), window().session(), SnapshotKind::alone));
        QTRY_VERIFY_WITH_TIMEOUT(std::filesystem::exists(alone), kPatience_ms);
        QCOMPARE(QImage(QString::fromStdString(alone.string())).size(), QSize(240, 180));
        const auto project = window().session().project();
        const auto size = std::filesystem::file_size(project);
        window().watching().commands().writeSnapshot(project,
                                                     snapshotOf(canvas(), window().session(), SnapshotKind::alone));
        QTRY_VERIFY_WITH_TIMEOUT(tells(QString::fromStdString(project.filename().string())), kPatience_ms);
        QVERIFY(std::filesystem::file_size(project) >= size);
    }

    void aSnapshotIsOfTheMomentItWasAskedFor() {
        QApplication::setAttribute(Qt::AA_DontUseNativeDialogs);
        const std::filesystem::path path = *home_ / "asked.png";
        QTimer::singleShot(0, this, [&] {
            QTRY_VERIFY_WITH_TIMEOUT(QApplication::activeModalWidget() != nullptr, kPatience_ms);
            auto* dialog = qobject_cast<QFileDialog*>(QApplication::activeModalWidget());
            QVERIFY(dialog != nullptr);
            QVERIFY(goTo(kLater));  // the video went on meanwhile
            dialog->findChild<QLineEdit*>(QStringLiteral("fileNameEdit"))
                ->setText(QString::fromStdString(path.string()));
            QMetaObject::invokeMethod(dialog, "accept");
        });
        actions().snapshot_plain->trigger();
        window().activateWindow();
        QVERIFY(QTest::qWaitForWindowActive(window_.get()));
        QTRY_VERIFY_WITH_TIMEOUT(std::filesystem::exists(path), kPatience_ms);
        QCOMPARE(window().session().shownFrame(), kLater);
        QCOMPARE(QImage(QString::fromStdString(path.string())).text(QStringLiteral("Frame")), QString::number(kAnchor));
    }

    void theMosaicTellsWhenAPlaceWasSeenAndWhoCrossedIt() {
        QTest::keyClick(&canvas(), Qt::Key_M, Qt::ControlModifier | Qt::ShiftModifier);
        MosaicPanel& panel = window().watching().mosaic();
        QTRY_VERIFY_WITH_TIMEOUT(panel.mosaic() != nullptr && panel.mosaic()->share == 1, kPatience_ms);
        QCOMPARE(panel.mosaic()->pictures.size(), std::size_t(1));
        const SheetPicture& sheet = panel.mosaic()->pictures.front();
        // The camera went 59 px further.
        QVERIFY(std::abs(sheet.image.width() - 299) <= 3 && std::abs(sheet.image.height() - 180) <= 3);
        QVERIFY(!sheet.paths->empty());
        // A place that a vehicle crosses, by the mouse: on its way.
        const SheetPath& path = sheet.paths->front();
        const FramePoint& there = path.points[path.points.size() / 2];
        QTRY_VERIFY(panel.view().width() > 100);
        QTest::mouseClick(&panel.view(), Qt::LeftButton, {},
                          panel.view().viewFromSheet({there.at.x, there.at.y}).toPoint());
        const auto row_with = [&](const QString& words) {
            for (int row = 0; row < panel.list().count(); ++row)
                if (panel.list().item(row)->text().contains(words)) return row;
            return -1;
        };
        QTRY_VERIFY_WITH_TIMEOUT(row_with(QStringLiteral("seen")) == 0, kPatience_ms);
        const QString name = QStringLiteral("track %1").arg(path.track);
        QVERIFY(row_with(name) > 0);
        // By the keyboard: into the list, and go.
        panel.list().setFocus();
        panel.list().setCurrentRow(row_with(name));
        QTest::keyClick(&panel.list(), Qt::Key_Return);
        QCOMPARE(window().session().selectedTrack(), std::optional<TrackId>(path.track));
        QVERIFY(std::abs(window().session().currentFrame() - there.frame) < 12);
        panel.list().clear();
        panel.view().setFocus();
        QTest::keyClick(&panel.view(), Qt::Key_Plus);
        QTest::keyClick(&panel.view(), Qt::Key_Return);
        QTRY_VERIFY_WITH_TIMEOUT(panel.list().count() > 0, kPatience_ms);
        // What is kept of the view between frames is painted anew where it changes.
        const QImage first = panel.view().grab().toImage();
        panel.view().setColours(overlayColours(PaletteKind::colour_blind));
        QVERIFY(panel.view().grab().toImage() != first);
        panel.view().setColours(overlayColours(PaletteKind::thesis));
        QVERIFY(panel.view().grab().toImage() == first);
        QTest::keyClick(&panel.view(), Qt::Key_Left);
        QVERIFY(panel.view().grab().toImage() != first);
    }

    void theMosaicIsTintedByHowLongAndWhenLastTheGroundWasSeen() {
        actions().show_mosaic->trigger();
        MosaicPanel& panel = window().watching().mosaic();
        QTRY_VERIFY_WITH_TIMEOUT(panel.mosaic() != nullptr && panel.mosaic()->share == 1, kPatience_ms);
        QVERIFY(!panel.legend().isVisible());
        const QImage plain = panel.view().grab().toImage();
        panel.coverage().setCurrentIndex(static_cast<int>(CoverageLook::seen_for));
        QVERIFY(panel.legend().isVisible());
        // 60 frames at 25 a second, all of which show the middle; the borders were seen for a frame.
        QCOMPARE(panel.legend().times().front(), QStringLiteral("0.1 s"));
        QCOMPARE(panel.legend().times().back(), QStringLiteral("2.4 s"));
        const QImage seen_for = panel.view().grab().toImage();
        QVERIFY(seen_for != plain);
        panel.coverage().setCurrentIndex(static_cast<int>(CoverageLook::last_seen));
        QCOMPARE(panel.legend().times(),
                 (QStringList{QStringLiteral("0:00.0"), QStringLiteral("0:01.2"), QStringLiteral("0:02.4")}));
        const QImage last_seen = panel.view().grab().toImage();
        QVERIFY(last_seen != plain && last_seen != seen_for);
        // The camera goes right: what is left was seen last in the beginning, what is right in the end.
        const SheetCoverage& covered = *panel.view().coverage();
        QVERIFY(covered.last_frame.at<int>(5, 0) < 5);
        QCOMPARE(covered.last_frame.at<int>(5, covered.last_frame.cols - 2), 59);
        // Times of the day, where these are known.
        ClockOfFrames clock;
        clock.time = [](FrameIndex frame) { return QStringLiteral("12:00:%1").arg(frame, 2, 10, QLatin1Char('0')); };
        panel.setClock(clock);
        QCOMPARE(panel.legend().times().front(), QStringLiteral("12:00:00"));
        QCOMPARE(panel.legend().times().back(), QStringLiteral("12:00:59"));
        panel.setClock({});
        panel.coverage().setCurrentIndex(static_cast<int>(CoverageLook::none));
        QVERIFY(!panel.legend().isVisible());
        QTRY_VERIFY(panel.view().grab().toImage() == plain);  // once the legend has made room
    }

    void theCardShowsTheEventInALoopWithItsSpeedAndNote() {
        window().docks().raise(DockId::card);
        EventsModel& model = window().events().model();
        QTRY_VERIFY_WITH_TIMEOUT(model.rowCount() > 0, kPatience_ms);
        int id = 0;
        for (int row = 0; row < model.rowCount() && id == 0; ++row)
            if (model.found()->eventAt(model.recordAt(row)->position) != nullptr) id = model.recordAt(row)->id;
        QVERIFY(id != 0);
        EventCard& card = window().watching().card().card();
        window().events().show(id);
        QVERIFY(card.subject().has_value());
        QCOMPARE(card.subject()->event, id);
        QTRY_VERIFY_WITH_TIMEOUT(card.story() && card.story()->chips.size() > 3, kPatience_ms);
        QCOMPARE(card.story()->chips.size(), card.story()->shown.size());
        const std::size_t before = card.chip();
        QTRY_VERIFY(card.chip() != before);
        QVERIFY2(card.speed().figureText().contains(QStringLiteral("km/h")), qPrintable(card.speed().figureText()));
        QVERIFY(card.way().figureText().endsWith(QStringLiteral(" m")));
        // A click on the curve goes there.
        QTest::mouseClick(&card.speed(), Qt::LeftButton, {}, QPoint(card.speed().width() - 3, 10));
        QCOMPARE(window().session().currentFrame(), card.story()->points.back().frame);
        card.note().setText(QStringLiteral("seen twice"));
        QTest::keyClick(&card.note(), Qt::Key_Return);
        QCOMPARE(model.recordAt(model.rowOf(id))->note, QStringLiteral("seen twice"));
        window().actions().undo_verdict->trigger();
        QCOMPARE(card.note().text(), QString());
        card.tags().setText(QStringLiteral("lorry,  gate 3, lorry"));
        QTest::keyClick(&card.tags(), Qt::Key_Return);
        QCOMPARE(card.tags().text(), QStringLiteral("lorry, gate 3"));
        // A track alone has a card without a note.
        window().session().selectTrack(std::nullopt);
        QVERIFY(!card.subject());
        window().session().selectTrack(window().watching().ground().ground()->run->tracks.back().id);
        QVERIFY(card.subject()->event == 0 && !card.note().isVisible());
    }

    void whatWasWatchedIsCounted() {
        const auto share = [&] {
            const QString text = window().events().panel().headerText();
            const int at = static_cast<int>(text.indexOf(QStringLiteral(" % of the time seen")));
            return at < 0 ? -1 : text.left(at).section(QLatin1Char(' '), -1).toInt();
        };
        QTRY_VERIFY_WITH_TIMEOUT(window().events().review().state() == EventReview::State::found, kPatience_ms);
        QVERIFY(goTo(0));
        window().session().playback().setSpeed(1, 0);
        window().session().togglePlay();
        QTRY_VERIFY_WITH_TIMEOUT(!window().session().playback().playing(), kPatience_ms);
        window().watching().seen().flush();
        QTRY_VERIFY_WITH_TIMEOUT(share() > 0, kPatience_ms);
        QVERIFY(share() <= 100);
        QVERIFY2(window().timeline().watched() && !window().timeline().watched()->empty(), "the timeline shows where");
    }

    void whatWasWatchedAndDoneLastIsKeptWhenTheWindowIsClosedAtOnce() {
        ProjectSession& session = window().session();
        QTRY_VERIFY_WITH_TIMEOUT(window().events().review().state() == EventReview::State::found, kPatience_ms);
        const std::filesystem::path path = session.project();
        const RunRecord run = *session.shownRun();
        QVERIFY(goTo(0));
        session.playback().setSpeed(1, 0);
        session.togglePlay();
        QTRY_VERIFY_WITH_TIMEOUT(!session.playback().playing(), kPatience_ms);
        session.renameRun(run.id, QStringLiteral("the last thing done"));
        window().close();
        QTRY_VERIFY_WITH_TIMEOUT(!window().isVisible(), kPatience_ms);
        ProjectFile project = ProjectFile::open(path, ProjectFile::Mode::read_only);
        QVERIFY(!seenByAnybody(project, run.sequence.id).empty());
        QCOMPARE(RunStore(project).run(run.id)->name, std::string("the last thing done"));
    }
};

}  // namespace eyrie::ui::watching_test

EYRIE_UI_TEST(QApplication, watching_test, WatchingTest)
#include "watching_test.moc"
