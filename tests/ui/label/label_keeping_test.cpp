#include <QApplication>
#include <QSignalSpy>
#include <cmath>
#include <filesystem>

#include "label/lists/object_inspector.h"
#include "ui/label/labelling.h"
#include "ui/support/full_disk.h"
#include "ui/support/ui_test.h"
#include "widgets/message_bar.h"
#include "widgets/wiring.h"

namespace eyrie::ui::label_keeping_test {

/// Nothing labelled is lost, and only one window labels.
class LabelKeepingTest : public QObject, test::Labelling {
    Q_OBJECT

 private slots:
    void init() { begin(); }
    void cleanup() { end(); }

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

    void theWindowStaysUntilTrackingHasEnded() {
        const auto window = labellingWindow(6);
        QVERIFY(window);
        draw(*window, {40, 60}, {58, 60});
        const LabelActions& actions = window->labelling().actions();
        actions.track_on->trigger();
        QVERIFY(actions.stop_tracking->isEnabled());
        window->close();
        QVERIFY(window->isVisible());
        QVERIFY(waitFor([&] { return !window->isVisible(); }));
        QVERIFY(!actions.stop_tracking->isEnabled());
    }

    void anotherVideoIsOpenedWhenTrackingHasEnded() {
        const auto window = labellingWindow(6);
        QVERIFY(window);
        const auto other = test::writeScene(home() / "others", 8);
        draw(*window, {40, 60}, {58, 60});
        const LabelActions& actions = window->labelling().actions();
        bool tracks_still = false;
        whenChanged(window->session(), window.get(),
                    {{SessionChange::video, [&] { tracks_still = actions.stop_tracking->isEnabled(); }}});
        actions.track_on->trigger();
        QSignalSpy ready(&window->session(), &ProjectSession::ready);
        test::drop(*window, other);
        QVERIFY(!window->session().opening());
        QVERIFY(ready.wait(test::kPatience_ms));
        QVERIFY(!tracks_still);
        QCOMPARE(window->session().video()->frame_count, 8);
    }

    void theWindowStaysOnceWhereWhatIsBeingWrittenCannotBeStored() {
        const auto window = labellingWindow(6);
        QVERIFY(window);
        draw(*window, {40, 60}, {58, 60});
        QTest::keyClicks(&window->labelling().inspector().notes(), QStringLiteral("white van"));
        {
            const test::FullDisk full;
            window->close();
            QVERIFY(window->isVisible());
        }
        const QString told = window->messages().texts().join(QLatin1Char(' '));
        QVERIFY2(told.contains(QStringLiteral("disk")), qPrintable(told));
        QCoreApplication::processEvents();
        QVERIFY2(window->isVisible(), "the message is to be read");
        QVERIFY(waitFor([&] {
            return window->messages().texts().join(QLatin1Char(' ')).contains(QStringLiteral("Close it again"));
        }));
        window->close();
        QVERIFY(waitFor([&] { return !window->isVisible(); }));
    }

    void anotherVideoIsNotOpenedOnceWhereWhatIsBeingWrittenCannotBeStored() {
        const auto window = labellingWindow(6);
        QVERIFY(window);
        const auto other = test::writeScene(home() / "others", 8);
        draw(*window, {40, 60}, {58, 60});
        QTest::keyClicks(&window->labelling().inspector().notes(), QStringLiteral("white van"));
        {
            const test::FullDisk full;
            test::drop(*window, other);
            QVERIFY(!window->session().opening());
        }
        const auto told = [&] { return window->messages().texts().join(QLatin1Char(' ')); };
        QVERIFY2(waitFor([&] { return told().contains(QStringLiteral("Ask for it again")); }), qPrintable(told()));
        QSignalSpy ready(&window->session(), &ProjectSession::ready);
        test::drop(*window, other);
        QVERIFY(ready.wait(test::kPatience_ms));
        QCOMPARE(window->session().video()->frame_count, 8);
        QVERIFY2(!told().contains(QStringLiteral("Ask for it again")), qPrintable(told()));
    }

    void notesThatAreBeingWrittenStayWithTheObjectOfTheProjectThatIsLeft() {
        {
            const auto window = labellingWindow(6);
            QVERIFY(window);
            draw(*window, {40, 60}, {58, 60});
            QTest::keyClicks(&window->labelling().inspector().notes(), QStringLiteral("white van"));
            QSignalSpy opened(&window->labelling().labels(), &LabelSession::opened);
            window->session().open(test::writeScene(home() / "others", 6));
            QVERIFY(opened.wait(test::kPatience_ms));
            QVERIFY(window->labelling().labels().annotations().objects.empty());
        }
        const auto window = labellingWindow(6);
        QVERIFY(window);
        QCOMPARE(window->labelling().labels().annotations().objects.size(), std::size_t(1));
        QCOMPARE(window->labelling().labels().annotations().objects.begin()->second.notes, std::string("white van"));
    }

    void whatIsLabelledWhileTheProjectIsSavedUnderAnotherNameIsThere() {
        const auto window = labellingWindow(6);
        QVERIFY(window);
        LabelSession& labels = window->labelling().labels();
        const ObjectId id = draw(*window, {40, 60}, {58, 60});
        const auto other = home() / "other.eyrie";
        double x = 0;
        window->session().saveProjectAs(other);
        QVERIFY(waitFor([&] {
            if (window->session().project() != other && labels.canEdit() && labels.selected()) {
                window->labelling().editor().nudge(1, 0);
                x = object(*window, id).keyframes[0].box.centre.x;
            }
            return window->session().project() == other && labels.isOpen() && labels.projectPath() == other;
        }));
        QVERIFY(x > 0);
        QCOMPARE(object(*window, id).keyframes[0].box.centre.x, x);
        QVERIFY(labels.canEdit());
    }

    void aSecondWindowReadsOnlyAndSaysWhy() {
        auto first = labellingWindow(6);
        QVERIFY(first);
        const ObjectId id = draw(*first, {40, 60}, {58, 60});
        const auto second = labellingWindow(6);
        QVERIFY(second);
        QVERIFY(second->labelling().labels().readOnly());
        QVERIFY(!second->messages().texts().isEmpty());
        QVERIFY(second->messages().texts().join(QLatin1Char(' ')).contains(QStringLiteral("The labels are read-only")));
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

    void aFaultWhileFollowingIsToldOnceAndEndsNothing() {
        auto first = labellingWindow(6);
        QVERIFY(first);
        const ObjectId id = draw(*first, {40, 60}, {58, 60});
        const auto second = labellingWindow(6);
        QVERIFY(second);
        LabelSession& labels = second->labelling().labels();
        QVERIFY(labels.readOnly());
        const double x = object(*second, id).keyframes[0].box.centre.x;
        const std::filesystem::path project = labels.projectPath();
        std::filesystem::path away = project;
        away += ".away";
        QSignalSpy problems(&labels, &LabelSession::problem);
        std::filesystem::rename(project, away);
        const bool told = QTest::qWaitFor([&] { return !problems.isEmpty(); }, test::kPatience_ms);
        std::filesystem::rename(away, project);
        QVERIFY(told);
        first->labelling().editor().nudge(1, 0);
        const auto follows = [&] { return std::abs(object(*second, id).keyframes[0].box.centre.x - x - 1) < 1e-9; };
        QVERIFY(QTest::qWaitFor(follows, test::kPatience_ms));
        QCOMPARE(problems.count(), 1);
    }

    void onAFullDiskNothingIsShownThatIsNotStored() {
        const auto window = labellingWindow(6);
        QVERIFY(window);
        const ObjectId id = draw(*window, {40, 60}, {58, 60});
        const double x = object(*window, id).keyframes[0].box.centre.x;
        {
            const test::FullDisk full;
            key(*window, Qt::Key_Right);
        }
        QCOMPARE(object(*window, id).keyframes[0].box.centre.x, x);
        const QString told = window->messages().texts().join(QLatin1Char(' '));
        QVERIFY2(told.contains(QStringLiteral("disk")), qPrintable(told));
        key(*window, Qt::Key_Right);  // there is room again
        QVERIFY(std::abs(object(*window, id).keyframes[0].box.centre.x - x - 1) < 1e-9);
    }
};

}  // namespace eyrie::ui::label_keeping_test

EYRIE_UI_TEST(QApplication, label_keeping_test, LabelKeepingTest)
#include "label_keeping_test.moc"
