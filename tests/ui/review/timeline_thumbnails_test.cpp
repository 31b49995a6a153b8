#include "workspace/timeline_thumbnails.h"

#include <QMouseEvent>
#include <QTest>

#include "canvas/timeline/timeline_view.h"
#include "ui/session/session_support.h"
#include "ui/support/ui_test.h"

namespace eyrie::ui::timeline_thumbnails_test {

using test::kPatience_ms;

/// Small pictures over the timeline: of the right time, the newest, and gone when the pointer is.
class TimelineThumbnailsTest : public QObject {
    Q_OBJECT

    static constexpr int kFrames = 60;

    std::unique_ptr<test::OwnHome> home_;

    /// A timeline of a session, with pictures.
    struct Stage {
        ProjectSession session;
        TimelineView timeline;
        TimelineThumbnails thumbnails{session, timeline};
    };
    static std::unique_ptr<Stage> stageWithScene() {
        auto stage = std::make_unique<Stage>();
        if (!test::openAndWait(stage->session, test::sceneUnderTest(kFrames))) return nullptr;
        stage->timeline.setTimes(stage->session.timesUs());
        stage->timeline.resize(1000, 104);
        stage->timeline.show();
        return stage;
    }
    static void pointAt(Stage& stage, FrameIndex frame) {
        const QPointF place(stage.timeline.axis().centreOf(frame), 10);
        QMouseEvent move(QEvent::MouseMove, place, stage.timeline.mapToGlobal(place), Qt::NoButton, Qt::NoButton, {});
        QApplication::sendEvent(&stage.timeline, &move);
    }
    static void leave(Stage& stage) {
        QEvent leaving(QEvent::Leave);
        QApplication::sendEvent(&stage.timeline, &leaving);
    }

 private slots:
    void init() { home_ = std::make_unique<test::OwnHome>(); }
    void cleanup() { home_.reset(); }

    void thePictureIsThatOfTheTimeUnderThePointer() {
        const auto stage = stageWithScene();
        QVERIFY(stage);
        QVERIFY(!stage->thumbnails.shownFrame());
        pointAt(*stage, 30);
        QTRY_COMPARE_WITH_TIMEOUT(stage->thumbnails.shownFrame(), std::optional(30), kPatience_ms);
        const auto source = test::sceneUnderTest(kFrames).open({}, {});
        const Frame frame = source->read(30, true);
        const QImage expected = TimelineThumbnails::thumbnailOf(frame.colour.empty() ? frame.gray : frame.colour);
        QCOMPARE(expected.width(), TimelineThumbnails::kWidth);
        QCOMPARE(stage->thumbnails.shownPicture(), expected);
    }

    void ofManyPlacesTheNewestWins() {
        const auto stage = stageWithScene();
        QVERIFY(stage);
        for (int frame = 0; frame < kFrames; ++frame) pointAt(*stage, frame);
        QTRY_COMPARE_WITH_TIMEOUT(stage->thumbnails.shownFrame(), std::optional(kFrames - 1), kPatience_ms);
        // What was read is there at once.
        pointAt(*stage, 10);
        QTRY_COMPARE_WITH_TIMEOUT(stage->thumbnails.shownFrame(), std::optional(10), kPatience_ms);
        pointAt(*stage, kFrames - 1);
        QCOMPARE(stage->thumbnails.shownFrame(), std::optional(kFrames - 1));
    }

    void itIsGoneWhenThePointerIsAndWhileItScrubs() {
        const auto stage = stageWithScene();
        QVERIFY(stage);
        pointAt(*stage, 20);
        QTRY_VERIFY_WITH_TIMEOUT(stage->thumbnails.shownFrame(), kPatience_ms);
        leave(*stage);
        QVERIFY(!stage->thumbnails.shownFrame());
        pointAt(*stage, 20);
        QVERIFY(stage->thumbnails.shownFrame());
        QTest::mousePress(&stage->timeline, Qt::LeftButton, {}, {500, 10});
        QVERIFY(!stage->thumbnails.shownFrame());
        QTest::mouseRelease(&stage->timeline, Qt::LeftButton, {}, {500, 10});
    }

    void withoutAVideoThereIsNone() {
        const auto stage = stageWithScene();
        QVERIFY(stage);
        pointAt(*stage, 20);
        QTRY_VERIFY_WITH_TIMEOUT(stage->thumbnails.shownFrame(), kPatience_ms);
        stage->session.closeProject();
        QVERIFY2(!stage->thumbnails.shownFrame(), "it was of the video that is gone");
        pointAt(*stage, 20);
        QVERIFY2(!stage->thumbnails.shownFrame(), "nor is it remembered");
    }

    void placesCloseTogetherShareAPicture() {
        QCOMPARE(TimelineThumbnails::frameToRead(31, 8), 31);
        QCOMPARE(TimelineThumbnails::frameToRead(31, 2), 30);
        QCOMPARE(TimelineThumbnails::frameToRead(1234, 0.01), 1200);
    }
};

}  // namespace eyrie::ui::timeline_thumbnails_test

EYRIE_UI_TEST(QApplication, timeline_thumbnails_test, TimelineThumbnailsTest)
#include "timeline_thumbnails_test.moc"
