#include <QHelpEvent>
#include <QLabel>
#include <QStatusBar>
#include <QTest>
#include <QToolTip>

#include "canvas/timeline/timeline_view.h"
#include "review/earth/earth_dock.h"
#include "review/earth/video_earth.h"
#include "ui/session/session_support.h"
#include "ui/support/ui_test.h"
#include "ui/window/flown_video.h"
#include "widgets/message_bar.h"
#include "window/docks/watching_docks.h"
#include "window/main_window.h"

namespace eyrie::ui::parts_window_test {

using test::kPatience_ms;

/// Several files as one video, in the window.
class PartsWindowTest : public QObject {
    Q_OBJECT

    static constexpr int kFrames = 20;  ///< of each part
    std::unique_ptr<test::OwnHome> home_;

    /// Two flights that began at the same time of day, as two recordings.
    QList<QUrl> flown() {
        QList<QUrl> urls;
        for (const char* name : {"rec_2.ts", "rec_1.ts"}) {
            std::filesystem::create_directory(*home_ / "one");
            std::filesystem::rename(test::writeFlownVideo(*home_ / "one", kFrames), *home_ / name);
            std::filesystem::remove_all(*home_ / "one");
            urls << QUrl::fromLocalFile(QString::fromStdString((*home_ / name).string()));
        }
        return urls;
    }
    static bool opens(MainWindow& window, const QList<QUrl>& urls) {
        QSignalSpy ready(&window.session(), &ProjectSession::ready);
        test::drop(window, urls);
        return ready.wait(kPatience_ms);
    }
    static bool statusSays(const MainWindow& window, const QString& text) {
        const auto labels = window.statusBar()->findChildren<QLabel*>();
        return std::any_of(labels.begin(), labels.end(), [&](const QLabel* label) {
            return label->isVisible() && (label->text().contains(text) || label->toolTip().contains(text));
        });
    }
    static QString tipAt(TimelineView& timeline, FrameIndex frame) {
        const QPoint place(static_cast<int>(timeline.axis().centreOf(frame)), timeline.height() / 2);
        QHelpEvent help(QEvent::ToolTip, place, timeline.mapToGlobal(place));
        QApplication::sendEvent(&timeline, &help);
        return QToolTip::text();
    }

 private slots:
    void init() { home_ = std::make_unique<test::OwnHome>(); }
    void cleanup() { home_.reset(); }

    void droppedFilesAreOneVideoWhoseClockFollowsItsParts() {
        MainWindow window;
        window.resize(1280, 720);
        window.show();
        QVERIFY(opens(window, flown()));
        QCOMPARE(window.session().video()->frame_count, 2 * kFrames);
        QVERIFY(
            QTest::qWaitFor([&] { return !window.watching().earth().earth().clockText(0).isEmpty(); }, kPatience_ms));
        QCOMPARE(window.watching().earth().earth().clockText(5), QStringLiteral("2009-01-12 22:08:22.200 UTC"));
        QCOMPARE(window.watching().earth().earth().clockText(kFrames + 5),
                 QStringLiteral("2009-01-12 22:08:22.200 UTC"));
        QCOMPARE(window.watching().earth().earth().clockOrigin(), QStringLiteral("the video's metadata"));
        window.session().goToFrame(kFrames + 10);
        QVERIFY(test::shows(window.session(), kFrames + 10));
        QVERIFY(statusSays(window, QStringLiteral("2009-01-12 22:08:22.400 UTC")));
        QVERIFY(statusSays(window, QStringLiteral("rec_2.ts, its frame 10 of 20")));
        const QString tip = tipAt(window.timeline(), kFrames);
        QVERIFY2(tip.contains(QStringLiteral("rec_2.ts, its frame 0 of 20")), qPrintable(tip));
        QVERIFY2(tip.contains(QStringLiteral("2009-01-12 22:08:22.000 UTC")), qPrintable(tip));
    }

    void whatIsNoPartIsToldAndTheFormerVideoStays() {
        MainWindow window;
        window.show();
        const QList<QUrl> parts = flown();
        QVERIFY(opens(window, parts));
        QSignalSpy problem(&window.session(), &ProjectSession::problem);
        test::drop(window, QList<QUrl>{parts.front(), parts.front()});
        QVERIFY(problem.wait(kPatience_ms));
        QVERIFY(window.messages().texts().join(QLatin1Char('\n')).contains(QStringLiteral("is given twice")));
        QCOMPARE(window.session().video()->frame_count, 2 * kFrames);
    }
};

}  // namespace eyrie::ui::parts_window_test

EYRIE_UI_TEST(QApplication, parts_window_test, PartsWindowTest)
#include "parts_window_test.moc"
