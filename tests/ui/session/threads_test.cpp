#include <QTest>
#include <thread>

#include "session/background/lru_cache.h"
#include "session/background/mailbox.h"
#include "session/live_feed.h"
#include "ui/support/ui_test.h"

namespace eyrie::ui::threads_test {

/// What carries work and results between threads.
class ThreadsTest : public QObject {
    Q_OBJECT

    static Frame picture(FrameIndex index) {
        Frame frame;
        frame.index = index;
        frame.gray = cv::Mat(20, 30, CV_8UC1, cv::Scalar(index));
        return frame;
    }
    static std::shared_ptr<const FrameResult> resultOf(FrameIndex index) {
        auto result = std::make_shared<FrameResult>();
        result->motion.frame = index;
        return result;
    }

 private slots:
    void theNewestLetterWins() {
        Mailbox<int> mailbox;
        QVERIFY(mailbox.put(1));
        QVERIFY(!mailbox.put(2));  // the reader was told already
        QCOMPARE(mailbox.take(), std::optional(2));
        QVERIFY(!mailbox.take());
        QVERIFY(mailbox.put(3));
    }

    void aSlowReaderMissesLettersButNeverTheLast() {
        Mailbox<int> mailbox;
        constexpr int last = 20000;
        int told = 0;
        std::jthread writer([&] {
            for (int i = 1; i <= last; ++i)
                if (mailbox.put(i)) ++told;
        });
        int newest = 0;
        int taken = 0;
        while (newest < last)
            if (const auto letter = mailbox.take()) {
                QVERIFY(*letter > newest);
                newest = *letter;
                ++taken;
            }
        writer.join();
        QCOMPARE(told, taken);
    }

    void theCacheForgetsWhatWasUsedLongestAgo() {
        LruCache<int, QString> cache(100);
        cache.put(1, QStringLiteral("a"), 40);
        cache.put(2, QStringLiteral("b"), 40);
        QVERIFY(cache.find(1));
        cache.put(3, QStringLiteral("c"), 40);
        QVERIFY(!cache.contains(2));
        QVERIFY(cache.contains(1) && cache.contains(3));
        cache.put(1, QStringLiteral("d"), 10);
        QCOMPARE(cache.bytes(), std::size_t(50));
        cache.put(9, QStringLiteral("huge"), 1000);  // larger than the budget, still usable
        QCOMPARE(cache.count(), std::size_t(1));
        QCOMPARE(*cache.find(9), QStringLiteral("huge"));
    }

    void theLiveFeedTellsOnceAndKeepsEverySummary() {
        int told = 0;
        LiveFeed feed(10, [&] { ++told; });
        for (int i = 0; i < 200; ++i) feed.onFrame(resultOf(i), picture(i));
        QCOMPARE(told, 1);  // nobody fetched, so nobody was told again
        feed.flush();
        const auto shown = feed.takeFrame();
        QVERIFY(shown);
        QCOMPARE(shown->index, 199);  // the last frame of a run is always shown
        QCOMPARE(shown->image.pixelColor(3, 3).red(), 199);
        const auto summaries = feed.takeSummaries();
        QCOMPARE(summaries.size(), std::size_t(200));
        for (int i = 0; i < 200; ++i) QCOMPARE(summaries[static_cast<size_t>(i)].frame, i);
        QVERIFY(feed.takeSummaries().empty());
        feed.fetching();
        feed.flush();
        QCOMPARE(told, 2);
    }
};

}  // namespace eyrie::ui::threads_test

EYRIE_UI_TEST(QCoreApplication, threads_test, ThreadsTest)
#include "threads_test.moc"
