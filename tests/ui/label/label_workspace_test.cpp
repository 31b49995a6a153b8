#include <QDockWidget>
#include <QPushButton>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "canvas/layers/stages/corner_layer.h"
#include "canvas/layers/track_layer.h"
#include "label/canvas/label_timeline.h"
#include "label/computing/label_fitting.h"
#include "label/computing/label_tracking.h"
#include "label/computing/tracking_strip.h"
#include "label/lists/object_inspector.h"
#include "label/lists/objects_model.h"
#include "label/lists/objects_panel.h"
#include "ui/label/labelling.h"
#include "ui/support/ui_test.h"
#include "widgets/message_bar.h"

namespace eyrie::ui::label_workspace_test {

/// The label workspace driven as an annotator does: by mouse and keys.
class LabelWorkspaceTest : public QObject, test::Labelling {
    Q_OBJECT

 private slots:
    void init() { begin(); }
    void cleanup() { end(); }

    void switchingChangesDocksAndKeysAndNothingElse() {
        const auto window = labellingWindow(5);
        QVERIFY(window);
        auto* objects = window->findChild<QDockWidget*>(QStringLiteral("objects"));
        auto* tracks = window->findChild<QDockWidget*>(QStringLiteral("tracks"));
        QVERIFY(objects->isVisible());
        QVERIFY(tracks->isHidden());
        QVERIFY(!window->overlays().isVisible(TrackLayer::kKind));
        key(*window, Qt::Key_C);  // copies a box, here only
        QVERIFY(!window->overlays().isVisible(CornerLayer::kKind));
        key(*window, Qt::Key_1, Qt::ControlModifier);
        QVERIFY(!window->labelling().active());
        QVERIFY(!objects->isVisible() && !tracks->isHidden());
        QVERIFY(window->overlays().isVisible(TrackLayer::kKind));
        key(*window, Qt::Key_C);
        QVERIFY(!window->overlays().isVisible(CornerLayer::kKind));
        key(*window, Qt::Key_2, Qt::ControlModifier);
        QVERIFY(window->labelling().active());
        QVERIFY(objects->isVisible() && !tracks->isVisible());
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

    void theCrossOfADrawingThatEndedDoesNotComeBack() {
        const auto window = labellingWindow(5);
        QVERIFY(window);
        const VideoView& canvas = window->canvas();
        const auto& actions = window->labelling().actions();
        QTest::mouseMove(&window->canvas(), at(*window, 60, 60));  // the cross begins there
        actions.draw->trigger();
        key(*window, Qt::Key_Right);
        QVERIFY(canvas.keyPointer());
        key(*window, Qt::Key_Return);
        for (int i = 0; i < 4; ++i) key(*window, Qt::Key_Right, Qt::ShiftModifier);
        key(*window, Qt::Key_Return);
        QCOMPARE(window->labelling().labels().annotations().objects.size(), std::size_t(1));
        actions.region->trigger();
        QVERIFY(actions.region->isChecked());
        QVERIFY(!canvas.keyPointer());
        // Nor that of one that was given up for another.
        key(*window, Qt::Key_Left);
        QVERIFY(canvas.keyPointer());
        actions.draw->trigger();
        QVERIFY(actions.draw->isChecked());
        QVERIFY(!canvas.keyPointer());
    }

    void correctionsGoOnToWhatARunComputed() {
        const auto window = labellingWindow(30, true);
        QVERIFY(window);
        auto& proposals = window->labelling().proposals();
        key(*window, Qt::Key_P);
        QVERIFY(waitFor([&] { return !proposals.working() && !proposals.pending().empty(); }));
        key(*window, Qt::Key_Return, Qt::ControlModifier);
        LabelSession& labels = window->labelling().labels();
        QVERIFY(!labels.annotations().objects.empty());
        const ObjectId id = labels.annotations().objects.begin()->first;
        const auto computed = [&] {
            return std::ranges::count_if(object(*window, id).keyframes, [](const Keyframe& k) { return k.computed; });
        };
        const auto taken = object(*window, id).keyframes;
        QCOMPARE(computed(), static_cast<std::ptrdiff_t>(taken.size()));
        QVERIFY(taken.size() >= 2);
        labels.select(id);
        go(*window, taken.front().frame);
        key(*window, Qt::Key_Down, Qt::ShiftModifier);
        QCOMPARE(computed(), static_cast<std::ptrdiff_t>(taken.size()) - 1);
        QVERIFY(std::abs(object(*window, id).keyframes.back().box.centre.y - taken.back().box.centre.y) > 3);
        key(*window, Qt::Key_Z, Qt::ControlModifier);
        QCOMPARE(object(*window, id).keyframes.back().box.centre.y, taken.back().box.centre.y);
        // Told not to, only the box shown changes.
        window->labelling().actions().carry_corrections->trigger();
        key(*window, Qt::Key_Down, Qt::ShiftModifier);
        QCOMPARE(object(*window, id).keyframes.back().box.centre.y, taken.back().box.centre.y);
        key(*window, Qt::Key_Z, Qt::ControlModifier);
        // K says that a computed box is right; then the others can be laid on the pictures by it.
        key(*window, Qt::Key_R);
        QCOMPARE(computed(), static_cast<std::ptrdiff_t>(taken.size()) - 1);
        QCOMPARE(object(*window, id).keyframes.front().box.centre, taken.front().box.centre);
        key(*window, Qt::Key_F, Qt::ControlModifier);
        QVERIFY(waitFor([&] { return !window->labelling().fitting().working(); }));
        QVERIFY(!object(*window, id).keyframes.front().computed);
        QCOMPARE(object(*window, id).keyframes.front().box.centre, taken.front().box.centre);
        QVERIFY(object(*window, id).origin == ObjectOrigin::proposal_corrected);
    }

    void undoWhileABoxIsFollowedEndsThatAndKeepsTheObject() {
        const auto window = labellingWindow(60);
        QVERIFY(window);
        const ObjectId id = draw(*window, {20, 55}, {42, 55});
        window->labelling().actions().track_on->trigger();
        QVERIFY(window->labelling().tracking().working());
        key(*window, Qt::Key_Z);
        QVERIFY(waitFor([&] { return !window->labelling().tracking().working(); }));
        QVERIFY(!object(*window, id).keyframes.empty());
    }

    void whatIsBeingTrackedIsSaidWithAButtonThatEndsIt() {
        const auto window = labellingWindow(60);
        QVERIFY(window);
        draw(*window, {20, 55}, {42, 55});
        auto* strip = window->findChild<TrackingStrip*>();
        QVERIFY(strip != nullptr && !strip->isVisible());
        window->labelling().actions().track_on->trigger();
        QVERIFY(strip->isVisible());
        QCOMPARE(strip->text(), QStringLiteral("Tracking car 1 from frame 0, at most 59 frames"));
        strip->findChild<QPushButton*>()->click();
        QVERIFY(waitFor([&] { return !window->labelling().tracking().working(); }));
        QVERIFY(!strip->isVisible());
        strip->showAdvance({QStringLiteral("car 1"), 20, 20, 59, 3.4});
        QCOMPARE(strip->text(), QStringLiteral("Tracking car 1: frame 20, 20 of at most 59 frames, at most 0:04 left"));
    }

    void whatTrackingPlacedIsCalledComputed() {
        const auto window = labellingWindow(40);
        QVERIFY(window);
        const ObjectId id = draw(*window, {20, 55}, {42, 55});
        const auto* list = window->findChild<ObjectsModel*>();
        const auto shown = [&](int column, int role) { return list->data(list->index(0, column), role).toString(); };
        QVERIFY(waitFor([&] { return list->rowCount() == 1; }));
        QCOMPARE(shown(ObjectsModel::origin_column, Qt::DisplayRole), QStringLiteral("by hand"));
        QVERIFY(shown(0, Qt::ToolTipRole).contains(QStringLiteral("1 keyframe. Origin: by hand.")));
        window->labelling().actions().track_on->trigger();
        QVERIFY(waitFor([&] { return !window->labelling().tracking().working(); }));
        const auto computed = static_cast<int>(object(*window, id).keyframes.size()) - 1;
        QVERIFY(computed > 0);
        QVERIFY(waitFor([&] {
            return shown(ObjectsModel::origin_column, Qt::DisplayRole) == QStringLiteral("by hand, then computed");
        }));
        QVERIFY(shown(0, Qt::ToolTipRole).contains(QStringLiteral("%1 of them computed").arg(computed)));
    }

    void thatThereIsNoRunIsSaidUntilThereIsOne() {
        const auto window = labellingWindow(12);
        QVERIFY(window);
        const auto said = [&] {
            return window->messages().texts().join(QLatin1Char(' ')).contains(QStringLiteral("has no run yet"));
        };
        QVERIFY(said());
        QSignalSpy finished(&window->session(), &ProjectSession::runFinished);
        window->session().startRun();
        QVERIFY(finished.wait(test::kPatience_ms));
        QVERIFY(window->labelling().active());
        QVERIFY(!said());
    }

    void anObjectMayHaveAColourOfItsOwn() {
        const auto window = labellingWindow(5);
        QVERIFY(window);
        const ObjectId id = draw(*window, {40, 60}, {58, 60});
        const auto shown = [&] { return window->labelling().tool().scene().marks.front().colour; };
        const QColor of_class = shown();
        window->labelling().inspector().edits().set_colour(QColor(10, 200, 250));
        QCOMPARE(object(*window, id).colour, 0x0ac8faU);
        QCOMPARE(shown(), QColor(10, 200, 250));
        key(*window, Qt::Key_4);  // another class, the same colour
        QCOMPARE(shown(), QColor(10, 200, 250));
        key(*window, Qt::Key_Z, Qt::ControlModifier);
        window->labelling().inspector().edits().set_colour({});
        QCOMPARE(shown(), of_class);
        key(*window, Qt::Key_Z, Qt::ControlModifier);
        QCOMPARE(shown(), QColor(10, 200, 250));
    }

    void whatWasJustDrawnHasAStackOrSaysWhyNot() {
        const auto window = labellingWindow(12);
        QVERIFY(window);
        QVERIFY(draw(*window, {40, 60}, {58, 60}) > 0);
        QVERIFY(waitFor([&] { return window->labelling().tool().stackHere() != nullptr; }));
        const LoupeStack* stack = window->labelling().tool().stackHere();
        QVERIFY(!stack->image.isNull() || !stack->missing.isEmpty());
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

    void aBoxIsDrawnAnewForTheSelectedObject() {
        const auto window = labellingWindow(12);
        QVERIFY(window);
        const ObjectId id = draw(*window, {40, 60}, {58, 60});
        go(*window, 8);
        key(*window, Qt::Key_B, Qt::ControlModifier);
        click(*window, 60, 80);
        click(*window, 60, 104, Qt::ShiftModifier);
        click(*window, 66, 92);
        QCOMPARE(window->labelling().labels().annotations().objects.size(), std::size_t(1));
        QCOMPARE(object(*window, id).last_frame, 8);
        const Keyframe& drawn = object(*window, id).keyframes.back();
        QVERIFY(drawn.heading_set);
        QVERIFY(std::abs(drawn.box.heading - std::numbers::pi / 2) < 0.05);
        QVERIFY(std::abs(drawn.box.length - 24) < 1 && std::abs(drawn.box.width - 12) < 1);
        draw(*window, {140, 60}, {158, 60});  // and the next one is a new one again
        QCOMPARE(window->labelling().labels().annotations().objects.size(), std::size_t(2));
    }

    void theSizeOfOneBoxGoesToAllKeyframes() {
        const auto window = labellingWindow(12);
        QVERIFY(window);
        const ObjectId id = draw(*window, {40, 60}, {58, 60});
        go(*window, 10);
        key(*window, Qt::Key_R);
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
        key(*window, Qt::Key_I, Qt::ShiftModifier);
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

    void flagsGoOverARangeAndClassesOfOnesOwnAreTyped() {
        const auto window = labellingWindow(20);
        QVERIFY(window);
        LabelSession& labels = window->labelling().labels();
        const ObjectId id = draw(*window, {40, 60}, {58, 60});
        go(*window, 19);
        key(*window, Qt::Key_T);
        const ObjectId other = draw(*window, {140, 60}, {158, 60});
        go(*window, 8);
        labels.setSelection({id, other}, id);
        key(*window, Qt::Key_O);  // from frame 8 on
        window->session().settings().range = {3, 9};
        key(*window, Qt::Key_O, Qt::ShiftModifier);
        QCOMPARE(boxAt(object(*window, id), 5, labels.camera()).occlusion, Occlusion::partly);
        QCOMPARE(boxAt(object(*window, id), 2, labels.camera()).occlusion, Occlusion::none);
        window->labelling().inspector().edits().set_class(QStringLiteral("tram"));
        QCOMPARE(object(*window, id).object_class, std::string("tram"));
        QCOMPARE(object(*window, other).object_class, std::string("tram"));
    }

    void theKeyForAKeyframeDeletesNoOtherObject() {
        const auto window = labellingWindow(6);
        QVERIFY(window);
        LabelSession& labels = window->labelling().labels();
        const ObjectId kept = draw(*window, {40, 60}, {58, 60});
        const ObjectId gone = draw(*window, {140, 60}, {158, 60});
        labels.setSelection({kept, gone}, gone);
        key(*window, Qt::Key_Delete);  // its only keyframe
        QVERIFY(labels.object(gone) == nullptr);
        QVERIFY(labels.object(kept) != nullptr);
    }

    void stepsNameTheObjectWithItsClass() {
        const auto window = labellingWindow(40);
        QVERIFY(window);
        LabelSession& labels = window->labelling().labels();
        const ObjectId id = draw(*window, {20, 55}, {42, 55});  // one of the vehicles of the scene
        const QString name = QStringLiteral("car %1").arg(id);
        QCOMPARE(labels.undoName(), QStringLiteral("Draw %1").arg(name));
        key(*window, Qt::Key_Right);
        QCOMPARE(labels.undoName(), QStringLiteral("Move box of %1").arg(name));
        key(*window, Qt::Key_Left);
        window->labelling().actions().track_on->trigger();
        QVERIFY(waitFor([&] { return !window->labelling().tracking().working(); }));
        QVERIFY(object(*window, id).keyframes.size() > 1);
        QCOMPARE(labels.undoName(), QStringLiteral("Track %1").arg(name));
    }

    void ignoreRegionsAreDrawnAndDeleted() {
        const auto window = labellingWindow(6);
        QVERIFY(window);
        LabelSession& labels = window->labelling().labels();
        key(*window, Qt::Key_G, Qt::ControlModifier);
        click(*window, 20, 20);
        click(*window, 120, 20);
        click(*window, 120, 90);
        QTest::mouseClick(&window->canvas(), Qt::RightButton, {}, at(*window, 30, 90));
        QCOMPARE(labels.annotations().regions.size(), std::size_t(1));
        QCOMPARE(labels.annotations().regions.begin()->second.last_frame, 5);
        QCOMPARE(window->labelling().tool().scene().regions.size(), std::size_t(1));
        QTest::mouseMove(&window->canvas(), at(*window, 100, 40));
        const auto region = [&]() -> const IgnoreRegion& { return labels.annotations().regions.begin()->second; };
        const RegionAnchor anchor = region().anchor;
        key(*window, Qt::Key_G, Qt::AltModifier);
        QVERIFY(region().anchor != anchor);
        go(*window, 2);
        key(*window, Qt::Key_BracketLeft, Qt::ControlModifier);
        QCOMPARE(region().first_frame, 2);
        go(*window, 4);
        key(*window, Qt::Key_BracketRight, Qt::ControlModifier);
        QCOMPARE(region().last_frame, 4);
        key(*window, Qt::Key_G, Qt::ControlModifier | Qt::ShiftModifier);
        QVERIFY(labels.annotations().regions.empty());
        key(*window, Qt::Key_Z, Qt::ControlModifier);
        QCOMPARE(labels.annotations().regions.size(), std::size_t(1));
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

}  // namespace eyrie::ui::label_workspace_test

EYRIE_UI_TEST(QApplication, label_workspace_test, LabelWorkspaceTest)
#include "label_workspace_test.moc"
