#include "main_window/label_workspace.h"

#include <QDockWidget>
#include <QSignalSpy>
#include <QTest>
#include <cmath>
#include <fstream>
#include <numbers>

#include "main_window/label_actions.h"
#include "main_window/label_files.h"
#include "main_window/main_window.h"
#include "main_window/window_actions.h"
#include "panels/chip_grid.h"
#include "panels/message_bar.h"
#include "panels/object_inspector.h"
#include "panels/objects_panel.h"
#include "ui/ui_support.h"
#include "view/label_timeline.h"
#include "view/label_tool.h"
#include "view/video_view.h"

namespace eyrie::ui {

using test::kPatience_ms;

/// The label workspace driven as an annotator does: by mouse and keys.
class LabelWorkspaceTest : public QObject {
    Q_OBJECT

    std::unique_ptr<test::OwnHome> home_;

    static bool waitFor(const std::function<bool()>& condition) { return QTest::qWaitFor(condition, kPatience_ms); }

    /// A window that labels a folder of images; without a run unless one is asked for.
    std::unique_ptr<MainWindow> labellingWindow(int frames, bool with_run = false) {
        const auto folder = *home_ / "images";
        if (!std::filesystem::exists(folder)) test::writeScene(folder, frames);
        auto window = std::make_unique<MainWindow>();
        window->show();
        if (with_run) {
            QSignalSpy finished(&window->session(), &ProjectSession::runFinished);
            StartOptions options;
            options.input = folder;
            options.gsd_m_per_px = 0.25;
            window->start(options);
            if (!finished.wait(kPatience_ms)) return nullptr;
        } else {
            QSignalSpy ready(&window->session(), &ProjectSession::ready);
            window->session().settings().gsd_m_per_px = 0.25;
            window->session().open(folder);
            if (!ready.wait(kPatience_ms)) return nullptr;
            window->session().settings().gsd_m_per_px = 0.25;
        }
        window->actions().label_workspace->trigger();
        if (!waitFor([&] { return window->labelling().labels().isOpen(); })) return nullptr;
        go(*window, 0);
        return window;
    }
    static void go(MainWindow& window, FrameIndex frame) {
        window.session().goToFrame(frame);
        waitFor([&] { return window.canvas().frame().index == frame && !window.canvas().frame().image.isNull(); });
    }
    static void key(MainWindow& window, Qt::Key key, Qt::KeyboardModifiers keys = {}) {
        window.canvas().setFocus();
        QTest::keyClick(&window.canvas(), key, keys);
    }
    static QPoint at(MainWindow& window, double x, double y) {
        return window.canvas().transform().viewFromImage({x, y}).toPoint();
    }
    static void click(MainWindow& window, double x, double y, Qt::KeyboardModifiers keys = {}) {
        QTest::mouseClick(&window.canvas(), Qt::LeftButton, keys, at(window, x, y));
    }
    /// Draws an object by two clicks and answers its id.
    static ObjectId draw(MainWindow& window, QPointF rear, QPointF front) {
        key(window, Qt::Key_B);
        click(window, rear.x(), rear.y());
        click(window, front.x(), front.y());
        return window.labelling().labels().selected().value_or(0);
    }
    static const LabelledObject& object(MainWindow& window, ObjectId id) {
        return window.labelling().labels().annotations().objects.at(id);
    }

 private slots:
    void init() { home_ = std::make_unique<test::OwnHome>(); }
    void cleanup() { home_.reset(); }

    void switchingChangesDocksAndKeysAndNothingElse() {
        const auto window = labellingWindow(5);
        QVERIFY(window);
        auto* objects = window->findChild<QDockWidget*>(QStringLiteral("objects"));
        auto* runs = window->findChild<QDockWidget*>(QStringLiteral("runs"));
        QVERIFY(objects->isVisible() && !runs->isVisible());
        QVERIFY(!window->overlays().isVisible(OverlayKind::tracks));
        key(*window, Qt::Key_C);  // copies a box here, corners there
        QVERIFY(!window->overlays().isVisible(OverlayKind::corners));
        key(*window, Qt::Key_1, Qt::ControlModifier);
        QVERIFY(!window->labelling().active());
        QVERIFY(!objects->isVisible() && runs->isVisible());
        QVERIFY(window->overlays().isVisible(OverlayKind::tracks));
        key(*window, Qt::Key_C);
        QVERIFY(window->overlays().isVisible(OverlayKind::corners));
        key(*window, Qt::Key_2, Qt::ControlModifier);
        QVERIFY(window->labelling().active());
        QVERIFY(objects->isVisible() && !runs->isVisible());
    }

    void noTwoKeysOfTheWorkspaceAreTheSame() {
        const auto window = labellingWindow(3);
        QVERIFY(window);
        QSet<QKeySequence> seen;
        for (const auto& sections : {window->labelling().actions().sections(), window->actions().sections()})
            for (const ActionSection& section : sections)
                for (const QAction* action : section.actions)
                    for (const QKeySequence& keys : action->shortcuts()) {
                        QVERIFY2(!seen.contains(keys), qPrintable(keys.toString() + QLatin1Char(' ') + action->text()));
                        seen.insert(keys);
                    }
    }

    void drawsByTwoClicksWithTheSizeOfTheClass() {
        const auto window = labellingWindow(5);
        QVERIFY(window);
        const ObjectId id = draw(*window, {40, 60}, {58, 60});
        QVERIFY(id > 0);
        const LabelledObject& car = object(*window, id);
        QCOMPARE(car.object_class, std::string("car"));
        QCOMPARE(car.last_frame, 0);
        QVERIFY(std::abs(car.keyframes[0].box.width - 1.85 / 0.25) < 1e-9);
        QVERIFY(std::abs(car.keyframes[0].box.length - 18) < 1);
        QVERIFY(car.keyframes[0].heading_set);
        QCOMPARE(window->labelling().inspector().title(), QStringLiteral("car 1"));
    }

    void keysMoveAndTurnTheBoxByTheRightAmounts() {
        const auto window = labellingWindow(5);
        QVERIFY(window);
        const ObjectId id = draw(*window, {40, 60}, {58, 60});
        const double zoom = window->canvas().transform().zoom();
        const auto box = [&] { return object(*window, id).keyframes[0].box; };
        const OrientedBox start = box();
        key(*window, Qt::Key_Right);
        key(*window, Qt::Key_Down);
        QVERIFY(std::abs(box().centre.x - start.centre.x - 1) < 1e-9);
        QVERIFY(std::abs(box().centre.y - start.centre.y - 1) < 1e-9);
        key(*window, Qt::Key_Left, Qt::ControlModifier);
        QVERIFY(std::abs(box().centre.x - start.centre.x - 0.9) < 1e-9);
        key(*window, Qt::Key_Up, Qt::ShiftModifier);
        QVERIFY(std::abs(box().centre.y - start.centre.y + 4) < 1e-9);
        key(*window, Qt::Key_BracketRight);
        QVERIFY(std::abs(box().heading - start.heading - std::numbers::pi / 180) < 1e-9);
        key(*window, Qt::Key_BracketLeft);
        QVERIFY(std::abs(box().heading - start.heading) < 1e-9);
        QCOMPARE(window->canvas().transform().zoom(), zoom);
        QCOMPARE(window->session().currentFrame(), 0);
        key(*window, Qt::Key_Escape);
        key(*window, Qt::Key_Right);  // nothing is selected: the arrows step
        QCOMPARE(window->session().currentFrame(), 1);
    }

    void aSecondKeyframeIsInterpolatedAndEveryStepCanBeUndone() {
        const auto window = labellingWindow(12);
        QVERIFY(window);
        LabelSession& labels = window->labelling().labels();
        const ObjectId id = draw(*window, {40, 60}, {58, 60});
        go(*window, 10);
        QCOMPARE(window->labelling().tool().scene().marks.front().kind, LabelKind::expected);
        for (int i = 0; i < 4; ++i) key(*window, Qt::Key_Right, Qt::ShiftModifier);
        QCOMPARE(object(*window, id).last_frame, 10);
        QCOMPARE(object(*window, id).keyframes.size(), std::size_t(2));
        go(*window, 5);
        QCOMPARE(window->labelling().tool().scene().marks.front().kind, LabelKind::interpolated);
        const OrientedBox middle = window->labelling().tool().scene().marks.front().box;
        QVERIFY(std::abs(middle.centre.x - 59) < 1);
        for (int i = 0; i < 4; ++i) key(*window, Qt::Key_Z, Qt::ControlModifier);
        QCOMPARE(object(*window, id).last_frame, 0);
        key(*window, Qt::Key_Z, Qt::ControlModifier);
        QVERIFY(labels.annotations().objects.empty());
        QVERIFY(!labels.canUndo());
        for (int i = 0; i < 5; ++i) key(*window, Qt::Key_Z, Qt::ControlModifier | Qt::ShiftModifier);
        QCOMPARE(object(*window, id).last_frame, 10);
    }

    void theSizeOfOneBoxGoesToAllKeyframes() {
        const auto window = labellingWindow(12);
        QVERIFY(window);
        const ObjectId id = draw(*window, {40, 60}, {58, 60});
        go(*window, 10);
        key(*window, Qt::Key_K);
        const double drawn = object(*window, id).keyframes.front().box.length;
        OrientedBox longer = object(*window, id).keyframes.back().box;
        longer.length = 25;
        QVERIFY(window->labelling().editor().setBox(id, 10, longer, false, QStringLiteral("longer")));
        key(*window, Qt::Key_K, Qt::ShiftModifier);
        QVERIFY(std::abs(object(*window, id).keyframes.front().box.length - 25) < 0.5);  // the camera comes nearer
        key(*window, Qt::Key_Z, Qt::ControlModifier);
        QCOMPARE(object(*window, id).keyframes.front().box.length, drawn);
    }

    void copyingABoxMovesOn() {
        const auto window = labellingWindow(8);
        QVERIFY(window);
        const ObjectId id = draw(*window, {40, 60}, {58, 60});
        key(*window, Qt::Key_C);
        key(*window, Qt::Key_C);
        QCOMPARE(window->session().currentFrame(), 2);
        QCOMPARE(object(*window, id).keyframes.size(), std::size_t(3));
        QCOMPARE(object(*window, id).last_frame, 2);
        key(*window, Qt::Key_Q);
        QCOMPARE(window->session().currentFrame(), 1);
        key(*window, Qt::Key_Delete);
        QCOMPARE(object(*window, id).keyframes.size(), std::size_t(2));
        go(*window, 6);
        key(*window, Qt::Key_T);
        QCOMPARE(object(*window, id).last_frame, 6);
        go(*window, 1);
        key(*window, Qt::Key_T);
        QCOMPARE(object(*window, id).last_frame, 1);
    }

    void flagsClassesAndReviewHaveKeys() {
        const auto window = labellingWindow(8);
        QVERIFY(window);
        LabelSession& labels = window->labelling().labels();
        const ObjectId id = draw(*window, {40, 60}, {58, 60});
        key(*window, Qt::Key_O);
        QCOMPARE(object(*window, id).keyframes[0].occlusion, Occlusion::partly);
        key(*window, Qt::Key_I);
        QVERIFY(object(*window, id).keyframes[0].ignore);
        key(*window, Qt::Key_2);
        QCOMPARE(object(*window, id).object_class, std::string("truck"));
        QCOMPARE(labels.drawnClass(), std::string("truck"));
        key(*window, Qt::Key_V);
        QCOMPARE(labels.review().stateAt(id, 0), ReviewState::checked);
        QVERIFY(!labels.annotations().reviews.front().person.empty());
        key(*window, Qt::Key_X);
        QCOMPARE(labels.review().stateAt(id, 0), ReviewState::questionable);
        key(*window, Qt::Key_Escape);
        key(*window, Qt::Key_U);
        QCOMPARE(labels.selected(), std::optional<ObjectId>(id));
    }

    void undoSurvivesARestart() {
        ObjectId id = 0;
        {
            const auto window = labellingWindow(6);
            QVERIFY(window);
            id = draw(*window, {40, 60}, {58, 60});
            key(*window, Qt::Key_Right);
            key(*window, Qt::Key_3);
            window->close();
        }
        const auto window = labellingWindow(6);
        QVERIFY(window);
        LabelSession& labels = window->labelling().labels();
        QCOMPARE(object(*window, id).object_class, std::string("bus"));
        const double x = object(*window, id).keyframes[0].box.centre.x;
        QVERIFY(labels.undoName().contains(QStringLiteral("bus")));
        key(*window, Qt::Key_Z, Qt::ControlModifier);
        QCOMPARE(object(*window, id).object_class, std::string("car"));
        key(*window, Qt::Key_Z, Qt::ControlModifier);
        QVERIFY(std::abs(object(*window, id).keyframes[0].box.centre.x - x + 1) < 1e-9);
        key(*window, Qt::Key_Y, Qt::ControlModifier);
        QVERIFY(std::abs(object(*window, id).keyframes[0].box.centre.x - x) < 1e-9);
    }

    void aSecondWindowReadsOnlyAndSaysWhy() {
        auto first = labellingWindow(6);
        QVERIFY(first);
        const ObjectId id = draw(*first, {40, 60}, {58, 60});
        const auto second = labellingWindow(6);
        QVERIFY(second);
        QVERIFY(second->labelling().labels().readOnly());
        QVERIFY(!second->messages().texts().isEmpty());
        QVERIFY(second->messages().texts().join(QLatin1Char(' ')).contains(QStringLiteral("read-only")));
        second->labelling().labels().select(id);
        const double x = object(*second, id).keyframes[0].box.centre.x;
        key(*second, Qt::Key_Right);
        key(*second, Qt::Key_B);
        QVERIFY(!second->labelling().tool().drawing());
        QVERIFY(std::abs(object(*second, id).keyframes[0].box.centre.x - x) < 1e-9);
        first->labelling().editor().nudge(1, 0);
        first.reset();
        second->labelling().actions().try_to_write->trigger();
        QVERIFY(second->labelling().labels().canEdit());
        QVERIFY(std::abs(object(*second, id).keyframes[0].box.centre.x - x - 1) < 1e-9);
    }

    void identityIsPutRightByKeys() {
        const auto window = labellingWindow(20);
        QVERIFY(window);
        LabelSession& labels = window->labelling().labels();
        const ObjectId id = draw(*window, {40, 60}, {58, 60});
        go(*window, 15);
        key(*window, Qt::Key_T);
        go(*window, 8);
        key(*window, Qt::Key_Y);  // split
        QCOMPARE(labels.annotations().objects.size(), std::size_t(2));
        QCOMPARE(object(*window, id).last_frame, 7);
        const ObjectId later = labels.selected().value_or(0);
        QVERIFY(later != id && later != 0);
        QCOMPARE(object(*window, later).last_frame, 15);
        labels.setSelection({id, later}, id);
        key(*window, Qt::Key_J);  // and join again
        QCOMPARE(labels.annotations().objects.size(), std::size_t(1));
        QCOMPARE(object(*window, id).last_frame, 15);
        go(*window, 5);
        key(*window, Qt::Key_Backspace, Qt::ControlModifier);
        QCOMPARE(object(*window, id).keyframes.front().frame, 5);
        go(*window, 10);
        key(*window, Qt::Key_Delete, Qt::ControlModifier);
        QCOMPARE(object(*window, id).last_frame, 10);
    }

    void tracksOfTheRunAreTakenOverByOneKey() {
        const auto window = labellingWindow(60, true);
        QVERIFY(window);
        LabelSession& labels = window->labelling().labels();
        LabelProposals& proposals = window->labelling().proposals();
        key(*window, Qt::Key_P);
        QVERIFY(waitFor([&] { return proposals.shown() && !proposals.working(); }));
        if (proposals.pending().empty()) QSKIP("the chain found no track in the toy scene");
        const std::size_t offered = proposals.pending().size();
        key(*window, Qt::Key_G);
        QVERIFY(proposals.selected());
        key(*window, Qt::Key_Return);
        QCOMPARE(labels.annotations().objects.size(), std::size_t(1));
        const ObjectId id = labels.annotations().objects.begin()->first;
        QCOMPARE(object(*window, id).origin, ObjectOrigin::proposal_accepted);
        QCOMPARE(proposals.pending().size(), offered - 1);
        key(*window, Qt::Key_Z, Qt::ControlModifier);
        QCOMPARE(proposals.pending().size(), offered);
        key(*window, Qt::Key_Z, Qt::ControlModifier | Qt::ShiftModifier);
        window->labelling().editor().goTo(id);
        key(*window, Qt::Key_Right);
        QCOMPARE(object(*window, id).origin, ObjectOrigin::proposal_corrected);
        if (offered > 1) {
            key(*window, Qt::Key_G);
            key(*window, Qt::Key_Backspace);
            QCOMPARE(proposals.pending().size(), offered - 2);
            QCOMPARE(labels.annotations().objects.size(), std::size_t(1));
        }
    }

    void aBoxIsTrackedThroughTheVideo() {
        const auto window = labellingWindow(40);
        QVERIFY(window);
        const ObjectId id = draw(*window, {20, 55.5}, {42, 55.5});
        key(*window, Qt::Key_F, Qt::ShiftModifier);
        QVERIFY(waitFor([&] { return object(*window, id).last_frame > 5; }));
        const OrientedBox end =
            boxAt(object(*window, id), object(*window, id).last_frame, window->labelling().labels().camera()).box;
        const double truth = 31 + 3.0 * object(*window, id).last_frame;
        QVERIFY2(std::abs(end.centre.x - truth) < 4, qPrintable(QString::number(end.centre.x - truth)));
        key(*window, Qt::Key_Z, Qt::ControlModifier);
        QCOMPARE(object(*window, id).last_frame, 0);
    }

    void importShowsWhatItFoundAndExportWhatWasLost() {
        const auto window = labellingWindow(10);
        QVERIFY(window);
        LabelSession& labels = window->labelling().labels();
        const auto file = *home_ / "truth.txt";
        {
            std::ofstream out(file);
            for (int frame = 1; frame <= 6; ++frame)
                out << frame << ",4," << 20 + 3 * frame << ",30,20,10,1,1,1\n" << frame << ",9,100,80,20,10,1,1,1\n";
        }
        LabelImportDialog import(labels);
        QSignalSpy read(&import, &LabelImportDialog::fileRead);
        import.setFile(file);
        QVERIFY(read.wait(kPatience_ms));
        QVERIFY2(import.readyToImport(), qPrintable(import.report()));
        QVERIFY2(import.report().contains(QStringLiteral("12 boxes in 6 frames")), qPrintable(import.report()));
        QVERIFY(labels.annotations().objects.empty());
        QSignalSpy accepted(&import, &QDialog::accepted);
        import.accept();
        QVERIFY(accepted.wait(kPatience_ms));
        QCOMPARE(labels.annotations().objects.size(), std::size_t(2));
        QVERIFY(import.summary().contains(QStringLiteral("2 objects")));

        LabelExportDialog exported(labels);
        QSignalSpy finished(&exported, &LabelExportDialog::finishedExport);
        exported.setFormat(QStringLiteral("mot"));
        exported.setTarget(*home_ / "out.txt");
        exported.startExport();
        QVERIFY(finished.wait(kPatience_ms));
        QVERIFY2(finished.front().front().toBool(), qPrintable(exported.report()));
        QVERIFY(exported.report().contains(QStringLiteral("12 boxes")));

        key(*window, Qt::Key_Z, Qt::ControlModifier);
        QVERIFY(labels.annotations().objects.empty());
    }

    void aBrokenFileIsRefusedAndNothingChanges() {
        const auto window = labellingWindow(5);
        QVERIFY(window);
        const auto file = *home_ / "broken.txt";
        std::ofstream(file) << "1,2,not a number\n";
        LabelImportDialog import(window->labelling().labels());
        QSignalSpy read(&import, &LabelImportDialog::fileRead);
        import.setFile(file);
        QVERIFY(read.wait(kPatience_ms));
        QVERIFY(!import.readyToImport());
        QVERIFY(import.report().contains(QStringLiteral("broken.txt")));
    }

    void ignoreRegionsAreDrawnAndDeleted() {
        const auto window = labellingWindow(6);
        QVERIFY(window);
        LabelSession& labels = window->labelling().labels();
        key(*window, Qt::Key_Z);
        click(*window, 20, 20);
        click(*window, 120, 20);
        click(*window, 120, 90);
        QTest::mouseClick(&window->canvas(), Qt::RightButton, {}, at(*window, 30, 90));
        QCOMPARE(labels.annotations().regions.size(), std::size_t(1));
        QCOMPARE(labels.annotations().regions.begin()->second.last_frame, 5);
        QCOMPARE(window->labelling().tool().scene().regions.size(), std::size_t(1));
        QTest::mouseMove(&window->canvas(), at(*window, 100, 40));
        key(*window, Qt::Key_Z, Qt::ShiftModifier);
        QVERIFY(labels.annotations().regions.empty());
        key(*window, Qt::Key_Z, Qt::ControlModifier);
        QCOMPARE(labels.annotations().regions.size(), std::size_t(1));
    }

    void theObjectIsShownOverTime() {
        const auto window = labellingWindow(30);
        QVERIFY(window);
        draw(*window, {20, 55.5}, {42, 55.5});
        go(*window, 20);
        key(*window, Qt::Key_T);
        window->findChild<QDockWidget*>(QStringLiteral("object_chips"))->raise();
        ChipGrid& chips = window->labelling().chips();
        QVERIFY(waitFor([&] { return chips.cards().size() == 21; }));
        QCOMPARE(chips.cards().front().id, 0);
        key(*window, Qt::Key_Escape);
        QVERIFY(waitFor([&] { return chips.cards().empty(); }));
    }

    void listAndTimelineFollowEveryEdit() {
        const auto window = labellingWindow(10);
        QVERIFY(window);
        const ObjectId id = draw(*window, {40, 60}, {58, 60});
        key(*window, Qt::Key_C);
        auto* rows = window->findChild<LabelTimeline*>();
        QVERIFY(rows && rows->isVisible());
        QVERIFY(waitFor([&] { return rows->rows().size() == 1 && rows->rows().front().keyframes.size() == 2; }));
        QCOMPARE(window->labelling().objects().currentId(), id);
        key(*window, Qt::Key_Delete, Qt::ShiftModifier);
        QVERIFY(waitFor([&] { return rows->rows().empty(); }));
    }
};

}  // namespace eyrie::ui

QTEST_MAIN(eyrie::ui::LabelWorkspaceTest)
#include "label_workspace_test.moc"
