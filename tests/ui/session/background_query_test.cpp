#include <QSignalSpy>
#include <QTest>
#include <atomic>
#include <barrier>
#include <future>
#include <latch>
#include <optional>
#include <stdexcept>
#include <thread>

#include "session/background/background_query.h"
#include "session/background/due_write.h"
#include "session/background/written_wait.h"
#include "ui/support/ui_test.h"

namespace eyrie::ui::background_query_test {

/// What objects of the window have done in the background.
class BackgroundQueryTest : public QObject {
    Q_OBJECT

    using Former = BackgroundQuery::Former;
    static constexpr int kPatience_ms = 10'000;

    /// Holds a task up until it is let go.
    struct Gate {
        std::promise<void> begun;
        std::promise<void> opened;

        void pass() {
            begun.set_value();
            opened.get_future().wait();
        }
        void awaitTask() { begun.get_future().wait(); }
        void open() { opened.set_value(); }
    };
    static void untilStopped(const BackgroundTask& task) {
        while (!task.stop().stop_requested()) std::this_thread::yield();
    }
    /// Everything that was told by now has arrived.
    static void deliver(BackgroundQuery& query) {
        bool arrived = false;
        query.post([&](const BackgroundTask& task) { task.tell([&] { arrived = true; }); });
        QVERIFY(QTest::qWaitFor([&] { return arrived; }, kPatience_ms));
    }

 private slots:
    void whatIsToBeWrittenIsWrittenWhenItsOwnerGoes() {
        std::vector<int> done;
        const auto pool = std::make_shared<TaskPool>();
        Gate gate;
        {
            BackgroundQuery query(pool);
            query.post([&](const BackgroundTask&) { gate.pass(); });
            gate.awaitTask();
            query.post([&](const BackgroundTask&) { done.push_back(1); });  // what the next one works on
            query.write([&](const BackgroundTask&) { done.push_back(2); });
            QCOMPARE(pool->writesDue(), 1);
            gate.open();
        }
        QCOMPARE(done, (std::vector<int>{1, 2}));
        QCOMPARE(pool->writesDue(), 0);
    }

    void whoWaitsForWritesHearsOfWhatFailedFirst() {
        const auto pool = std::make_shared<TaskPool>();
        BackgroundQuery query(pool);
        Gate gate;
        QStringList told;
        query.write(
            [&](const BackgroundTask&) {
                gate.pass();
                throw std::runtime_error("the disk is full");
            },
            [&](const QString& message) { told << message; });
        gate.awaitTask();
        WrittenWait wait(pool);
        wait.watch();
        QVERIFY(wait.anythingDue());
        wait.begin([&](bool all) { told << (all ? QStringLiteral("all") : QStringLiteral("too long")); });
        QVERIFY(wait.waiting());
        pool->countFailedWrite();
        wait.watch();  // a person who closes the window once more
        QVERIFY(wait.anythingFailed());
        gate.open();
        QVERIFY(QTest::qWaitFor([&] { return !wait.waiting(); }, kPatience_ms));
        QCOMPARE(told, (QStringList{QStringLiteral("the disk is full"), QStringLiteral("all")}));
        QVERIFY(wait.anythingFailed());
        wait.watch();
        QVERIFY2(!wait.anythingFailed(), "that was before");
    }

    void workThatGoesIntoAFileInTheEndIsWaitedForUntilThen() {
        const auto pool = std::make_shared<TaskPool>();
        const WrittenWait wait(pool);
        std::optional<DueWrite> work(std::in_place, pool);
        QVERIFY(wait.anythingDue());
        {
            const DueWrite taken_over = std::move(*work);
            work.reset();
            QVERIFY(wait.anythingDue());
        }
        QVERIFY(!wait.anythingDue());
    }

    void tasksAreDoneInOrderAndAwayFromTheWindow() {
        const auto here = std::this_thread::get_id();
        std::vector<int> told;
        std::atomic<int> at_once = 0;
        std::atomic<bool> alone = true;
        BackgroundQuery query;
        for (int i = 0; i < 50; ++i)
            query.post([&, i](const BackgroundTask& task) {
                if (++at_once > 1 || std::this_thread::get_id() == here) alone = false;
                task.tell([&, i] {
                    if (std::this_thread::get_id() == here) told.push_back(i);
                });
                --at_once;
            });
        deliver(query);
        QVERIFY(alone);
        QCOMPARE(told.size(), std::size_t(50));
        QVERIFY(std::is_sorted(told.begin(), told.end()));
    }

    void theNewestQuestionWins() {
        Gate gate;
        std::vector<int> done;
        const auto note = [&done](int number) {
            return
                [&done, number](const BackgroundTask& task) { task.tell([&done, number] { done.push_back(number); }); };
        };
        BackgroundQuery query;
        query.post([&](const BackgroundTask&) { gate.pass(); });
        for (int i = 1; i <= 3; ++i) query.ask(note(i));
        query.whenIdle(note(0));
        query.post(note(10));  // drops the idle work
        gate.open();
        QTRY_COMPARE(done.size(), std::size_t(2));
        deliver(query);
        QCOMPARE(done, (std::vector<int>{10, 3}));
    }

    void aLateAnswerToAnOldQuestionNeverArrives() {
        std::vector<int> answers;
        BackgroundQuery query;
        std::latch told(1);
        query.ask(
            [&](const BackgroundTask& task) {
                task.tell([&] { answers.push_back(1); });
                told.count_down();
                untilStopped(task);
                task.tell([&] { answers.push_back(2); });
                throw std::runtime_error("stopped");
            },
            [&](const QString&) { answers.push_back(3); });
        told.wait();  // on its way when the next question is asked
        query.ask([&](const BackgroundTask& task) { task.tell([&] { answers.push_back(4); }); });
        QTRY_COMPARE(answers, std::vector<int>{4});
        deliver(query);
        QCOMPARE(answers, std::vector<int>{4});
    }

    void anAnswerOnItsWayIsDroppedByCancelling() {
        bool answered = false;
        bool posted = false;
        BackgroundQuery query;
        std::latch told(2);
        query.post([&](const BackgroundTask& task) {
            task.tell([&] { posted = true; });
            told.count_down();
        });
        query.ask([&](const BackgroundTask& task) {
            task.tell([&] { answered = true; });
            told.count_down();
        });
        told.wait();
        query.cancel();
        deliver(query);
        QVERIFY(posted);
        QVERIFY(!answered);
    }

    void aQuestionMayBeLeftToFinish() {
        Gate gate;
        std::vector<int> answers;
        BackgroundQuery query;
        query.ask([&](const BackgroundTask& task) {
            gate.pass();
            if (!task.stop().stop_requested()) task.tell([&] { answers.push_back(1); });
        });
        gate.awaitTask();
        for (int i = 2; i <= 4; ++i)
            query.ask([&, i](const BackgroundTask& task) { task.tell([&, i] { answers.push_back(i); }); }, {},
                      Former::finish);
        gate.open();
        QTRY_COMPARE(answers, (std::vector<int>{1, 4}));
    }

    void anExceptionBecomesAMessage() {
        QStringList messages;
        const auto failed = [&](const QString& message) { messages << message; };
        BackgroundQuery query;
        query.post([](const BackgroundTask&) { throw std::runtime_error("the file is gone"); }, failed);
        query.post([](const BackgroundTask&) { throw std::runtime_error("nobody asks"); });
        deliver(query);
        query.ask([](const BackgroundTask&) { throw std::runtime_error("größer"); }, failed);
        QTRY_COMPARE(messages, (QStringList{QStringLiteral("the file is gone"), QStringLiteral("größer")}));
    }

    void aPostedTaskThatIsStoppedStillTells() {
        bool told = false;
        std::latch begun(1);
        BackgroundQuery query;
        std::stop_source stop = query.post([&](const BackgroundTask& task) {
            begun.count_down();
            untilStopped(task);
            task.tell([&] { told = true; });
        });
        begun.wait();
        query.cancel();  // of questions, not of this
        QVERIFY(!stop.stop_requested());
        stop.request_stop();
        QTRY_VERIFY(told);
    }

    void destructionStopsWaitsAndDropsWhatWasTold() {
        std::atomic<bool> ended = false;
        std::atomic<bool> second = false;
        bool called = false;
        auto held = std::make_shared<int>();
        {
            std::latch begun(1);
            BackgroundQuery query;
            query.post([&, held](const BackgroundTask& task) {
                task.tell([&called] { called = true; });
                begun.count_down();
                untilStopped(task);
                task.tell([&called] { called = true; });
                ended = true;
            });
            query.post([&](const BackgroundTask&) { second = true; });
            begun.wait();
        }
        QVERIFY(ended);
        QCOMPARE(held.use_count(), 1L);     // nothing that the task held is left
        QCoreApplication::processEvents();  // what was on its way when the owner went
        QVERIFY(!called);
        QVERIFY(!second);
    }

    void anOwnerThatGoesCanHaveDoneWhatWasPosted() {
        std::atomic<int> done = 0;
        {
            BackgroundQuery query;
            query.finishPosted();  // nothing is to do
            for (int i = 0; i < 20; ++i) query.post([&](const BackgroundTask&) { ++done; });
            query.finishPosted();
            QCOMPARE(done.load(), 20);
        }
        QCOMPARE(done.load(), 20);
    }

    void theOwnerMayGoWhenItIsAnswered() {
        auto query = std::make_unique<BackgroundQuery>();
        bool second = false;
        query->post([&](const BackgroundTask& task) {
            task.tell([&] { query.reset(); });
            task.tell([&] { second = true; });
        });
        QTRY_VERIFY(!query);
        QCoreApplication::processEvents();
        QVERIFY(!second);
    }

    void idleWorkYields() {
        std::atomic<bool> stopped = false;
        std::vector<int> done;
        std::latch begun(1);
        BackgroundQuery query;
        query.whenIdle([&](const BackgroundTask& task) {
            begun.count_down();
            untilStopped(task);
            stopped = true;
        });
        begun.wait();
        query.whenIdle([&](const BackgroundTask&) { done.push_back(0); });
        query.ask([&](const BackgroundTask& task) {
            query.whenIdle([&](const BackgroundTask& idle) { idle.tell([&] { done.push_back(2); }); });
            task.tell([&] { done.push_back(1); });
        });
        QTRY_COMPARE(done, (std::vector<int>{1, 2}));
        QVERIFY(stopped);
    }

    void whatSomebodyWaitsForOvertakesIdleWork() {
        Gate gate;
        int idle_done = 0;
        bool answered = false;
        const auto pool = std::make_shared<TaskPool>();
        BackgroundQuery idle(pool);
        BackgroundQuery other_idle(pool);
        BackgroundQuery waiting(pool);
        idle.whenIdle([&](const BackgroundTask& task) {
            gate.pass();
            task.tell([&] { ++idle_done; });
        });
        gate.awaitTask();
        other_idle.whenIdle([&](const BackgroundTask& task) { task.tell([&] { ++idle_done; }); });
        waiting.ask([&](const BackgroundTask& task) { task.tell([&] { answered = true; }); });
        QTRY_VERIFY(answered);
        QCOMPARE(idle_done, 0);  // of idle work one at a time
        gate.open();
        QTRY_COMPARE(idle_done, 2);
    }

    void nobodyWaitsForTheLongTasksOfOthers() {
        constexpr int many = 20;
        const auto pool = std::make_shared<TaskPool>();
        std::latch all_at_work(many);  // each needs all others: with fewer threads this would never end
        int ended = 0;
        std::vector<std::unique_ptr<BackgroundQuery>> queries;
        for (int i = 0; i < many; ++i) {
            queries.push_back(std::make_unique<BackgroundQuery>(pool));
            queries.back()->post([&](const BackgroundTask& task) {
                all_at_work.arrive_and_wait();
                task.tell([&] { ++ended; });
            });
        }
        QTRY_COMPARE(ended, many);
    }

    void asManyQuestionsAsComeAreNeverMixedUp() {
        std::vector<int> answers;
        BackgroundQuery query;
        constexpr int last = 2000;
        for (int i = 1; i <= last; ++i) {
            query.ask([&, i](const BackgroundTask& task) { task.tell([&, i] { answers.push_back(i); }); });
            if (i % 7 == 0) QCoreApplication::processEvents();
        }
        QTRY_VERIFY(!answers.empty() && answers.back() == last);
        QVERIFY(std::is_sorted(answers.begin(), answers.end()));
    }
};

}  // namespace eyrie::ui::background_query_test

EYRIE_UI_TEST(QCoreApplication, background_query_test, BackgroundQueryTest)
#include "background_query_test.moc"
