#include <cmath>

#include "ui/label/labelling.h"
#include "ui/support/ui_test.h"
#include "widgets/chip_grid.h"
#include "widgets/message_bar.h"
#include "workspace/dock_registry.h"

namespace eyrie::ui::label_help_test {

/// What takes work off the annotator: identity edits, proposals, tracking, chips and stacks.
class LabelHelpTest : public QObject, test::Labelling {
    Q_OBJECT

 private slots:
    void init() { begin(); }
    void cleanup() { end(); }

    void identityIsPutRightByKeys() {
        const auto window = labellingWindow(20);
        QVERIFY(window);
        LabelSession& labels = window->labelling().labels();
        const ObjectId id = draw(*window, {40, 60}, {58, 60});
        go(*window, 15);
        key(*window, Qt::Key_T);
        go(*window, 8);
        key(*window, Qt::Key_Y, Qt::ShiftModifier);  // split: shown first
        QCOMPARE(labels.annotations().objects.size(), std::size_t(1));
        QVERIFY(window->messages().texts().join(QLatin1Char(' ')).contains(QStringLiteral("frames 0 to 7")));
        const auto planned = [&] {
            QList<int> ids;
            for (const LabelMark& mark : window->labelling().tool().scene().marks)
                if (mark.kind == LabelKind::planned) ids.append(mark.id);
            return ids;
        };
        QCOMPARE(planned().size(), 1);  // what begins here, under its new number
        QVERIFY(planned().front() != id);
        key(*window, Qt::Key_Escape);
        QCOMPARE(planned().size(), 0);
        QCOMPARE(labels.selected(), std::optional<ObjectId>(id));
        key(*window, Qt::Key_Y, Qt::ShiftModifier);
        go(*window, 12);  // to look; what was shown is confirmed, not another split here
        key(*window, Qt::Key_Y, Qt::ShiftModifier);
        QCOMPARE(labels.annotations().objects.size(), std::size_t(2));
        QCOMPARE(object(*window, id).last_frame, 7);
        const ObjectId later = labels.selected().value_or(0);
        QVERIFY(later != id && later != 0);
        QCOMPARE(object(*window, later).last_frame, 15);
        labels.setSelection({id, later}, id);
        key(*window, Qt::Key_J, Qt::ShiftModifier);  // and join again
        key(*window, Qt::Key_J, Qt::ShiftModifier);
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
        QVERIFY(!proposals.pending().empty());
        const std::size_t offered = proposals.pending().size();
        key(*window, Qt::Key_P, Qt::ShiftModifier);
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
            key(*window, Qt::Key_P, Qt::ShiftModifier);
            key(*window, Qt::Key_Backspace);
            QCOMPARE(proposals.pending().size(), offered - 2);
            QCOMPARE(labels.annotations().objects.size(), std::size_t(1));
        }
    }

    void theProposalUnderTheCursorIsTakenOrRejectedWithoutAClick() {
        const auto window = labellingWindow(60, true);
        QVERIFY(window);
        LabelSession& labels = window->labelling().labels();
        LabelProposals& proposals = window->labelling().proposals();
        key(*window, Qt::Key_P);
        QVERIFY(waitFor([&] { return proposals.shown() && !proposals.working() && !proposals.pending().empty(); }));
        const Proposal offered = *proposals.pending().front();
        const FrameIndex frame = offered.object.keyframes.front().frame;
        go(*window, frame);
        const cv::Point2d centre = offered.object.keyframes.front().box.centre;
        const std::size_t before = proposals.pending().size();
        // Nowhere near one nothing is taken.
        QTest::mouseMove(&window->canvas(), at(*window, 0, 0));
        QVERIFY(waitFor([&] { return window->labelling().tool().cursorInImage().has_value(); }));
        key(*window, Qt::Key_Return);
        QCOMPARE(labels.annotations().objects.size(), std::size_t(0));
        const auto point_at_it = [&] {
            QTest::mouseMove(&window->canvas(), at(*window, centre.x, centre.y));
            return waitFor([&] {
                const auto place = window->labelling().tool().cursorInImage();
                return place && std::hypot(place->x() - centre.x, place->y() - centre.y) < 2;
            });
        };
        QVERIFY(point_at_it());
        key(*window, Qt::Key_Return);
        QCOMPARE(labels.annotations().objects.size(), std::size_t(1));
        QCOMPARE(proposals.pending().size(), before - 1);
        QVERIFY(!proposals.selected());  // the next one pointed at is meant, not one that was chosen meanwhile
        key(*window, Qt::Key_Z, Qt::ControlModifier);
        QCOMPARE(proposals.pending().size(), before);
        QVERIFY(point_at_it());
        key(*window, Qt::Key_Backspace);
        QCOMPARE(labels.annotations().objects.size(), std::size_t(0));
        QCOMPARE(proposals.pending().size(), before - 1);
        QVERIFY(proposals.rejectedCount() > 0);
    }

    void whatWasRejectedIsNotOfferedWhenTheWindowIsOpenedAgain() {
        TrackId rejected = 0;
        std::size_t offered = 0;
        {
            const auto window = labellingWindow(60, true);
            QVERIFY(window);
            LabelProposals& proposals = window->labelling().proposals();
            key(*window, Qt::Key_P);
            QVERIFY(waitFor([&] { return proposals.shown() && !proposals.working() && !proposals.pending().empty(); }));
            offered = proposals.pending().size();
            rejected = proposals.pending().front()->track;
            proposals.reject({rejected});
            QCOMPARE(proposals.pending().size(), offered - 1);
        }
        const auto window = labellingWindow(60);
        QVERIFY(window);
        LabelProposals& proposals = window->labelling().proposals();
        QVERIFY(waitFor([&] { return window->session().currentRun().has_value(); }));
        key(*window, Qt::Key_P);
        QVERIFY(waitFor([&] { return proposals.shown() && !proposals.working() && proposals.rejectedCount() == 1; }));
        QCOMPARE(proposals.pending().size(), offered - 1);
        QVERIFY(proposals.find(rejected) != nullptr);
        proposals.offerAgain();
        QCOMPARE(proposals.pending().size(), offered);
        QCOMPARE(proposals.rejectedCount(), 0);
    }

    void theRunWhoseTracksAreProposedIsChosenBesideTheObjects() {
        const auto window = labellingWindow(60, true);
        QVERIFY(window);
        QVERIFY(window->docks().docksFor(WorkspaceKind::label).contains(window->docks().dock(DockId::runs)));
        const int first = *window->session().currentRun();
        QSignalSpy finished(&window->session(), &ProjectSession::runFinished);
        window->session().startRun();
        QVERIFY(finished.wait(test::kPatience_ms));
        const auto runs = [&] { return window->session().runs().size(); };
        QVERIFY(waitFor([&] { return runs() == 2 && window->session().currentRun() != first; }));
        key(*window, Qt::Key_P);
        LabelProposals& proposals = window->labelling().proposals();
        QVERIFY(waitFor([&] { return !proposals.working() && !proposals.pending().empty(); }));
        proposals.reject({proposals.pending().front()->track});
        QCOMPARE(proposals.rejectedCount(), 1);
        window->docks().raise(DockId::runs);
        window->session().showRun(first);
        QVERIFY(waitFor([&] { return !proposals.working() && !proposals.pending().empty(); }));
        QCOMPARE(proposals.rejectedCount(), 0);  // of that run none
    }

    void severalProposalsAreTakenTogetherAsExactAsAsked() {
        const auto window = labellingWindow(60, true);
        QVERIFY(window);
        LabelSession& labels = window->labelling().labels();
        LabelProposals& proposals = window->labelling().proposals();
        key(*window, Qt::Key_P);
        QVERIFY(waitFor([&] { return proposals.shown() && !proposals.working(); }));
        QVERIFY(proposals.pending().size() >= 2);
        const auto keyframes = [&] {
            std::size_t count = 0;
            for (const Proposal* proposal : proposals.pending()) count += proposal->object.keyframes.size();
            return count;
        };
        const std::size_t usual = keyframes();
        const std::size_t offered = proposals.pending().size();
        proposals.setTolerance(50);
        QVERIFY(waitFor([&] { return !proposals.working() && proposals.pending().size() == offered; }));
        QVERIFY(keyframes() <= usual);
        const TrackId first = proposals.pending()[0]->track;
        const TrackId second = proposals.pending()[1]->track;
        window->labelling().tool().commands().choose_proposal(first, false);
        window->labelling().tool().commands().choose_proposal(second, true);
        QCOMPARE(proposals.selection(), (std::vector<TrackId>{first, second}));
        key(*window, Qt::Key_Return);
        QCOMPARE(labels.annotations().objects.size(), std::size_t(2));
        QCOMPARE(proposals.pending().size(), offered - 2);
        key(*window, Qt::Key_Z, Qt::ControlModifier);  // one step
        QCOMPARE(labels.annotations().objects.size(), std::size_t(0));
        window->labelling().tool().commands().choose_proposal(first, false);
        window->labelling().tool().commands().choose_proposal(second, true);
        window->labelling().tool().commands().choose_proposal(second, true);
        QCOMPARE(proposals.selection(), std::vector<TrackId>{first});
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

    void theLoupeShowsTheStackOfAnObjectThatLivesForAWhile() {
        const auto window = labellingWindow(30);
        QVERIFY(window);
        LabelTool& tool = window->labelling().tool();
        const ObjectId id = draw(*window, {20, 55.5}, {42, 55.5});
        QVERIFY(tool.stackHere() == nullptr);  // not at once
        go(*window, 20);
        for (int i = 0; i < 12; ++i) key(*window, Qt::Key_Right, Qt::ShiftModifier);
        QVERIFY(waitFor([&] { return tool.stackHere() != nullptr; }));
        QCOMPARE(tool.stackHere()->object, id);
        QCOMPARE(tool.stackHere()->frame, 20);
        QVERIFY(tool.stackHere()->layers >= 3);
        const QPointF centre(tool.scene().marks.front().box.centre.x, tool.scene().marks.front().box.centre.y);
        QTest::mouseMove(&window->canvas(), at(*window, centre.x(), centre.y()));
        key(*window, Qt::Key_Right);  // the loupe stands beside the box that a key moved
        const QImage with = window->canvas().grab().toImage();
        key(*window, Qt::Key_M, Qt::ShiftModifier);
        QVERIFY(tool.stackHere() == nullptr);
        QVERIFY(window->canvas().grab().toImage() != with);
        key(*window, Qt::Key_M, Qt::ShiftModifier);
        go(*window, 10);
        QVERIFY(waitFor([&] { return tool.stackHere() != nullptr && tool.stackHere()->frame == 10; }));
        key(*window, Qt::Key_Escape);
        QVERIFY(tool.stackHere() == nullptr);
    }

    void theObjectIsShownOverTime() {
        const auto window = labellingWindow(30);
        QVERIFY(window);
        draw(*window, {20, 55.5}, {42, 55.5});
        go(*window, 20);
        key(*window, Qt::Key_T);
        window->docks().raise(DockId::object_chips);
        ChipGrid& chips = window->labelling().chips();
        QVERIFY(waitFor([&] { return chips.cards().size() == 21; }));
        QCOMPARE(chips.cards().front().id, 0);
        key(*window, Qt::Key_Escape);
        QVERIFY(waitFor([&] { return chips.cards().empty(); }));
    }
};

}  // namespace eyrie::ui::label_help_test

EYRIE_UI_TEST(QApplication, label_help_test, LabelHelpTest)
#include "label_help_test.moc"
